#ifndef GB_STUDY_PAPERS_PAPERS_VERDICT_H
#define GB_STUDY_PAPERS_PAPERS_VERDICT_H

#include <stddef.h>

#include "study/papers/papers_printed.h"

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

/* Differences up to so many standard errors are within error. */
#define GB_PAPERS_VERDICT_ERRORS 2.0

/* The standard error of the difference is the root of the summed squares of the error here,
 * of the printed error with the rounding of its digits, and, where the paper says how many
 * cells it averages, of the error of its mean, here->error sqrt(here->size
 * here->cells / printed->cells): as many particles scatter as much.  Upper bounds are for the magnitude. */
struct gb_papers_verdict gb_papers_verdict_of(const struct gb_papers_printed *printed,
                                              const struct gb_papers_here *here);

/* Decimals that show two digits of an error. */
int gb_papers_verdict_digits(double error);

/* "within error", "off by 0.02 (5.3 standard errors)", ...; g_free. */
char *gb_papers_verdict_text(const struct gb_papers_verdict *verdict);

#endif
