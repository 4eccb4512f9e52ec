#ifndef GB_TUI_WATCH_RUNSET_VIEW_H
#define GB_TUI_WATCH_RUNSET_VIEW_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "many/runset.h"

/* A directory of many runs as it stands now: of a sweep, a calibration, replicas.  Read
 * from the runs' own files, so that it can be watched while others compute. */

enum { GB_RUNSET_VIEW_LEVELS = 48, GB_RUNSET_VIEW_VARIED = 2 };

struct gb_runset_view_run {
    char *name;      /* of its directory */
    int state;       /* enum gb_run_state */
    double progress; /* 0..1 */
    char error[120];
};

/* Replicas of one point: density where the loading first reaches each level. */
struct gb_runset_view_group {
    char *label; /* what tells it from the others; "" for a single one */
    size_t members;
    size_t reached[GB_RUNSET_VIEW_LEVELS]; /* how many of them got there */
    double mean[GB_RUNSET_VIEW_LEVELS], error[GB_RUNSET_VIEW_LEVELS];
    size_t place[GB_RUNSET_VIEW_VARIED]; /* which value of each varied key */
};

/* A key of which the groups have several values. */
struct gb_runset_view_key {
    const struct gb_field *field;
    char **values; /* as a preset would write them; numbers in their order */
    size_t count;
};

struct gb_runset_view {
    char *directory;
    struct gb_runset_view_run *run;
    size_t runs, done, failed, live;
    double progress; /* mean over the runs that are there */
    struct gb_runset_view_group *group;
    size_t groups;
    double level_pa[GB_RUNSET_VIEW_LEVELS]; /* spaced evenly in the logarithm */
    struct gb_runset_view_key key[GB_RUNSET_VIEW_VARIED];
    size_t keys; /* varied keys; more than GB_RUNSET_VIEW_VARIED: no map */
    char **fit;  /* of a calibration: lines of what it has found so far; else NULL */
};

/* Whether a directory has runs in it, or in its folder `runs` as that of a calibration,
 * and is none itself. */
bool gb_runset_view_is(const char *directory);

/* Reads all of it.  Errors: GB_ERR_INPUT when there is no run that can be read. */
bool gb_runset_view_read(struct gb_runset_view *runset, const char *directory,
                         struct gb_error *err);
void gb_runset_view_finish(struct gb_runset_view *runset); /* zeroed is fine */

/* The level nearest to a pressure, or below it where more groups got there as a whole. */
size_t gb_runset_view_level(const struct gb_runset_view *runset, double pressure_pa);

/* The group at these values of the two varied keys; NULL: there is none yet. */
const struct gb_runset_view_group *gb_runset_view_at(const struct gb_runset_view *runset,
                                                     size_t first, size_t second);

#endif
