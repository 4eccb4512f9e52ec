#ifndef GB_STUDY_PAPERS_PLAN_H
#define GB_STUDY_PAPERS_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "many/ensemble.h"
#include "many/param_sweep.h"
#include "many/runset.h"

enum gb_papers_size {
    GB_PAPERS_FULL, /* the papers' cells */
    GB_PAPERS_FAST, /* small cells, few seeds */
    GB_PAPERS_SIZES
};

enum { GB_PAPERS_CHANGES = 4, GB_PAPERS_EXPERIMENTS_MOST = 32 };

/* One size of an experiment. */
struct gb_papers_extent {
    int cells; /* at each point; 0: the experiment is left out */
    const char *change[GB_PAPERS_CHANGES]; /* "group.key=value", NULL after the last */
};

struct gb_papers_experiment {
    const char *name; /* of its directory, too */
    const char *doc;
    const char *preset;
    const char *change[GB_PAPERS_CHANGES];
    const char *axis; /* as --vary of a sweep; NULL: one point */
    struct gb_papers_extent extent[GB_PAPERS_SIZES];
};

/* THE table; the last row has no name. */
const struct gb_papers_experiment *gb_papers_plan_table(void);

size_t gb_papers_plan_count(void);

/* Index in the table; the number of rows for an unknown name. */
size_t gb_papers_plan_index(const char *name);

/* Scene of one point of an experiment with the seed of its preset.  size
 * GB_PAPERS_SIZES: without the changes of a size.  Errors: GB_ERR_INPUT, those of presets
 * and keys. */
bool gb_papers_plan_params(const struct gb_papers_experiment *experiment,
                           enum gb_papers_size size, size_t point,
                           struct gb_params *params, struct gb_error *err);

/* Its axis; free it by gb_param_sweep_axes_finish, also after an error. */
bool gb_papers_plan_axes(const struct gb_papers_experiment *experiment,
                         struct gb_axes *axes, struct gb_error *err);

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

/* Estimated processor time of the runs that have not ended, s, and their number. */
double gb_papers_plan_remaining_s(const struct gb_papers_plan *plan, size_t *runs);

/* runs.csv: a row per run, experiment, directory, seed, done, failed or missing, why.
 * Caller frees. */
GString *gb_papers_plan_runs(const struct gb_papers_plan *plan);

/* What was computed, read back from the run directories. */
struct gb_papers_cells {
    struct gb_runset set; /* of one experiment */
    size_t *point, *cell; /* of each run */
    size_t most;          /* largest cell + 1 */
};

struct gb_papers_data {
    struct gb_papers_cells experiment[GB_PAPERS_EXPERIMENTS_MOST];
};

/* Reads the runs that are done.  gb_papers_plan_data_finish is due in any case.  Errors: those
 * of gb_runset_read. */
bool gb_papers_plan_read(struct gb_papers_data *data, const struct gb_papers_plan *plan,
                         struct gb_error *err);
void gb_papers_plan_data_finish(struct gb_papers_data *data); /* zeroed is fine */

/* A view of the data, for the jackknife without the cells of one seed in one experiment. */
struct gb_papers_view {
    const struct gb_papers_data *data;
    size_t experiment; /* that lacks a cell; beyond the table: none does */
    size_t cell;
    const double *reading; /* of every run of a row's first experiment; NULL: none made */
};

/* Does the view lack run i of an experiment? */
bool gb_papers_plan_lacks(const struct gb_papers_view *view, size_t experiment, size_t i);

/* Runs of one point as a set of one group; its runs belong to the data, run of the set is
 * for g_free.  Returns their number. */
size_t gb_papers_plan_point(const struct gb_papers_view *view, size_t experiment,
                            size_t point, struct gb_runset *set);

#endif
