#ifndef GB_STUDY_PAPERS_PAPERS_SAMPLE_H
#define GB_STUDY_PAPERS_PAPERS_SAMPLE_H

#include "many/runset.h"
#include "study/papers/papers_plan.h"

/* What was computed, read back from the run directories. */
struct gb_papers_cells {
    struct gb_runset set; /* of one experiment */
    size_t *point, *cell; /* of each run */
    size_t most;          /* largest cell + 1 */
};

struct gb_papers_data {
    struct gb_papers_cells experiment[GB_PAPERS_EXPERIMENTS_MOST];
};

/* Reads the runs that are done.  gb_papers_sample_finish is due in any case.  Errors: those
 * of gb_runset_read. */
bool gb_papers_sample_read(struct gb_papers_data *data, const struct gb_papers_plan *plan,
                           struct gb_error *err);
void gb_papers_sample_finish(struct gb_papers_data *data); /* zeroed is fine */

/* A view of the data, for the jackknife without the cells of one seed in one experiment. */
struct gb_papers_view {
    const struct gb_papers_data *data;
    size_t experiment; /* that lacks a cell; beyond the table: none does */
    size_t cell;
    const double *reading; /* of every run of a row's first experiment; NULL: none made */
};

/* Does the view lack run i of an experiment? */
bool gb_papers_sample_lacks(const struct gb_papers_view *view, size_t experiment,
                            size_t i);

/* Runs of one point as a set of one group; its runs belong to the data, run of the set is
 * for g_free.  Returns their number. */
size_t gb_papers_sample_point(const struct gb_papers_view *view, size_t experiment,
                              size_t point, struct gb_runset *set);

#endif
