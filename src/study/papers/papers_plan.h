#ifndef GB_STUDY_PAPERS_PAPERS_PLAN_H
#define GB_STUDY_PAPERS_PAPERS_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "many/ensemble.h"
#include "study/papers/papers_experiments.h"

/* The runs of the experiments, DIR/EXPERIMENT/POINT_seed-N, the longest first. */
struct gb_papers_options {
    enum gb_papers_size size;
    char **only; /* names of experiments or their beginnings, as P1; NULL: all */
    int count;   /* particles of a periodic cell; 0: those of the size */
    int cells;   /* at each point; 0: those of the size */
};

struct gb_papers_run {
    size_t experiment; /* index in the table */
    size_t point, cell;
};

struct gb_papers_plan {
    char *directory;
    bool selected[GB_PAPERS_EXPERIMENTS_MOST];
    struct gb_papers_run *run;   /* count of them, run k is ensemble.run[k] */
    struct gb_ensemble ensemble; /* a point for each run */
    double *cost;                /* estimated processor time of each, s */
    size_t count;
};

/* Lists the runs and marks those that are done.  gb_papers_plan_finish is due in any case.
 * Errors: GB_ERR_INPUT (a word of `only` that begins no experiment, a directory that holds
 * runs of another size), GB_ERR_MEMORY. */
bool gb_papers_plan_init(struct gb_papers_plan *plan,
                         const struct gb_papers_options *options, const char *directory,
                         struct gb_error *err);
void gb_papers_plan_finish(struct gb_papers_plan *plan); /* zeroed is fine */

/* Directory of an experiment; g_free. */
char *gb_papers_plan_directory(const struct gb_papers_plan *plan, size_t experiment);

/* Estimated processor time of the runs that have not ended, s, and their number. */
double gb_papers_plan_remaining_s(const struct gb_papers_plan *plan, size_t *runs);

/* runs.csv: a row per run, experiment, directory, seed, done, failed or missing, why.
 * Caller frees. */
GString *gb_papers_plan_runs(const struct gb_papers_plan *plan);

#endif
