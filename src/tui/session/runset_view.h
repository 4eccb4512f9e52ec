#ifndef GB_TUI_SESSION_RUNSET_VIEW_H
#define GB_TUI_SESSION_RUNSET_VIEW_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/snapshot.h"
#include "greenbody/status.h"
#include "many/runset.h"

/* Summary of a directory of many runs: sweep, calibration or replicas.  It is read from
 * the files of the runs, which other processes may still be writing. */

enum { GB_RUNSET_VIEW_LEVELS = 128, GB_RUNSET_VIEW_VARIED = 2 };

struct gb_runset_view_run {
    char *name; /* name of its directory */
    enum gb_run_state state;
    double progress; /* 0..1 */
    char error[120];
};

/* Replicas of one setting: the densities at which loading first reaches each level. */
struct gb_runset_view_group {
    char *label; /* difference to the other groups; "" for a single one */
    size_t members;
    size_t reached[GB_RUNSET_VIEW_LEVELS]; /* members that reached the level */
    double mean[GB_RUNSET_VIEW_LEVELS], error[GB_RUNSET_VIEW_LEVELS];
    size_t value_index[GB_RUNSET_VIEW_VARIED]; /* index of the value of each varied key */
};

/* A key with several values among the groups. */
struct gb_runset_view_key {
    const struct gb_field *field;
    char **values; /* as in a preset; numbers sorted */
    size_t count;
};

struct gb_runset_view {
    char *directory;
    struct gb_runset_view_run *run;
    size_t runs, done, failed, live;
    double progress; /* mean over the existing runs */
    struct gb_runset_view_group *group;
    size_t groups;
    double level_pa[GB_RUNSET_VIEW_LEVELS]; /* ascending: round numbers, pressures of the
                                             * table of the sweep, the largest */
    bool tabulated[GB_RUNSET_VIEW_LEVELS];  /* pressures of the table */
    size_t levels;
    struct gb_runset_view_key key[GB_RUNSET_VIEW_VARIED];
    size_t keys; /* number of varied keys; above GB_RUNSET_VIEW_VARIED: no map */
    char **fit;  /* lines of the fit of a calibration; NULL: none */
};

/* Reads the directory.  Errors: GB_ERR_INPUT when no run can be read. */
bool gb_runset_view_read(struct gb_runset_view *runset, const char *directory,
                         struct gb_error *err);
void gb_runset_view_finish(struct gb_runset_view *runset); /* zeroed is fine */

/* The level nearest to a pressure. */
size_t gb_runset_view_nearest(const struct gb_runset_view *runset, double pressure_pa);

/* The level of the table (without a table: any level) nearest to a pressure, or a lower
 * level that all replicas of more groups have reached. */
size_t gb_runset_view_level(const struct gb_runset_view *runset, double pressure_pa);

/* The group with these values of the two varied keys; NULL: none yet. */
const struct gb_runset_view_group *gb_runset_view_at(const struct gb_runset_view *runset,
                                                     size_t first, size_t second);

/* Does a directory, or its folder `runs`, contain runs without being a run itself? */
bool gb_runset_view_any(const char *directory);

#endif
