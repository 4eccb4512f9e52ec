#ifndef GB_STUDY_PAPERS_PAPERS_EXPERIMENTS_H
#define GB_STUDY_PAPERS_PAPERS_EXPERIMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "many/sweep/axes.h"

/* The simulations that the printed numbers of the papers need: a preset with changes, an
 * axis, and how many cells at each of its values. */

enum gb_papers_size {
    GB_PAPERS_FULL, /* the papers' cells */
    GB_PAPERS_FAST, /* small cells, few seeds */
    GB_PAPERS_SIZES
};

enum { GB_PAPERS_CHANGES = 4, GB_PAPERS_EXPERIMENTS_MOST = 32 };

/* One size of an experiment. */
struct gb_papers_extent {
    int cells; /* at each point; 0: the experiment is left out */
    const char *change[GB_PAPERS_CHANGES]; /* "group.key=value", NULL behind the last */
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
const struct gb_papers_experiment *gb_papers_experiments_table(void);

size_t gb_papers_experiments_count(void);

/* Index in the table; the number of rows for an unknown name. */
size_t gb_papers_experiments_index(const char *name);

/* Scene of one point of an experiment with the seed of its preset.  size
 * GB_PAPERS_SIZES: without the changes of a size.  Errors: GB_ERR_INPUT, those of presets
 * and keys. */
bool gb_papers_experiments_params(const struct gb_papers_experiment *experiment,
                                  enum gb_papers_size size, size_t point,
                                  struct gb_params *params, struct gb_error *err);

/* Its axis; gb_axes_finish is due in any case. */
bool gb_papers_experiments_axes(const struct gb_papers_experiment *experiment,
                                struct gb_axes *axes, struct gb_error *err);

#endif
