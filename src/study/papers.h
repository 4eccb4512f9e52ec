#ifndef GB_STUDY_PAPERS_H
#define GB_STUDY_PAPERS_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "io/lab/lab_grid.h"
#include "study/papers_comparisons.h"

enum gb_papers_relation {
    GB_PAPERS_EQUAL, /* "=" */
    GB_PAPERS_ABOUT, /* "~" */
    GB_PAPERS_BELOW  /* "<": the value is an upper bound */
};

struct gb_papers_printed {
    const char *paper, *item, *id, *quantity, *condition, *unit, *source;
    const char *digits; /* the value as printed */
    double value;
    double error; /* standard error: printed, rounding of the digits, and "about" */
    enum gb_papers_relation relation;
    double cells;            /* that the paper averages; NaN: not stated */
    const char *figure;      /* "": in none */
    double x, y;             /* its point there */
    double x_error, y_error; /* NaN for the coordinate that is not the value */
    const char *series;
    const char *without; /* why it is not compared; "": it is */
    int line;            /* of the file */
};

struct gb_papers_numbers {
    struct gb_lab_grid grid; /* owns the texts */
    char *path;
    struct gb_papers_printed *row;
    size_t count;
};

/* Reads a file, NULL: the one of the program.  gb_papers_printed_finish is due in any case.
 * Errors: GB_ERR_INPUT with line, column and what is expected; GB_ERR_MACHINE. */
bool gb_papers_printed_read(struct gb_papers_numbers *numbers, const char *path,
                            struct gb_error *err);

void gb_papers_printed_finish(struct gb_papers_numbers *numbers); /* zeroed is fine */

/* NULL: no number of this id. */
const struct gb_papers_printed *
gb_papers_printed_find(const struct gb_papers_numbers *numbers, const char *id);

enum gb_papers_outcome {
    GB_PAPERS_WITHIN,   /* within error */
    GB_PAPERS_OFF,      /* off by `difference` */
    GB_PAPERS_UNJUDGED, /* no error here: a single cell, or a fit that needs all cells */
    GB_PAPERS_ABSENT,   /* the runs have no such value */
    GB_PAPERS_NOT_COMPUTED /* there are no runs */
};

/* A number of here beside a printed one. */
struct gb_papers_verdict {
    enum gb_papers_outcome outcome;
    double difference; /* here less printed; of a bound what exceeds it, 0 below */
    double error;      /* standard error of the difference */
};

/* A number of here. */
struct gb_papers_here {
    double value; /* NaN: the runs have none */
    double error; /* standard error; NaN: unknown */
    size_t cells; /* 0: no runs */
    bool exact;   /* from the laws alone, without runs and error */
    double size;  /* of a cell over the paper's, by particles; 0: 1 */
};

/* The standard error of the difference is the root of the summed squares of the error here,
 * of the printed error with the rounding of its digits, and, where the paper says how many
 * cells it averages, of the error of its mean, here->error sqrt(here->size
 * here->cells / printed->cells): as many particles scatter as much.  Upper bounds are for the magnitude. */
struct gb_papers_verdict gb_papers_verdict_of(const struct gb_papers_printed *printed,
                                              const struct gb_papers_here *here);

/* "within error", "off by 0.02 (5.3 standard errors)", ...; g_free. */
char *gb_papers_verdict_text(const struct gb_papers_verdict *verdict);

/* All comparisons with the papers whose experiments are selected. */
struct gb_papers_result {
    const struct gb_papers_printed *printed;
    const struct gb_papers_comparison *comparison;
    struct gb_papers_here here;
    struct gb_papers_verdict verdict;
};

struct gb_papers_results {
    struct gb_papers_result *result;
    size_t count;
};

/* Every comparison of the runs of a plan that are done, in the order of the table.
 * gb_papers_finish is due in any case.  Errors: a comparison whose number is not printed
 * (GB_ERR_INPUT), those of gb_papers_plan_read. */
bool gb_papers_evaluate(struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers,
                        const struct gb_papers_plan *plan, struct gb_error *err);

void gb_papers_finish(struct gb_papers_results *results); /* zeroed is fine */

/* Is an experiment of the paper that an id, "P1-...", belongs to? */
bool gb_papers_selected_paper(const char *id, const struct gb_papers_plan *plan);

/* A figure of the page. */
struct gb_papers_figure {
    const char *file;  /* beside the page; NULL: could not be drawn */
    const char *title; /* Markdown */
    char *command;     /* that draws it alone; owned */
    char *why;         /* it could not be drawn; owned */
};

/* papers.md: a table per paper with every comparison, numbers without one, figures, and how
 * it was computed.  Depends on the results alone.  Caller frees. */
GString *gb_papers_text(const struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers,
                        const struct gb_papers_plan *plan,
                        const struct gb_papers_figure *figures, size_t count,
                        const char *command);

/* papers.csv: a row per comparison.  Caller frees. */
GString *gb_papers_table(const struct gb_papers_results *results);

#endif
