#ifndef GB_TUI_SWARM_H
#define GB_TUI_SWARM_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "run/runset.h"

/* A directory of many runs as it stands now: of a sweep, a calibration, replicas.  Read
 * from the runs' own files, so that it can be watched while others compute. */

enum { GB_SWARM_LEVELS = 48, GB_SWARM_VARIED = 2 };

struct gb_swarm_run {
    char *name;      /* of its directory */
    int state;       /* enum gb_run_state */
    double progress; /* 0..1 */
    char error[120];
};

/* Replicas of one point: density where the loading first reaches each level. */
struct gb_swarm_group {
    char *label; /* what tells it from the others; "" for a single one */
    size_t members;
    size_t reached[GB_SWARM_LEVELS]; /* how many of them got there */
    double mean[GB_SWARM_LEVELS], error[GB_SWARM_LEVELS];
    size_t place[GB_SWARM_VARIED]; /* which value of each varied key */
};

/* A key of which the groups have several values. */
struct gb_swarm_key {
    const struct gb_field *field;
    char **values; /* as a preset would write them; numbers in their order */
    size_t count;
};

struct gb_swarm {
    char *directory;
    struct gb_swarm_run *run;
    size_t runs, done, failed, live;
    double progress; /* mean over the runs that are there */
    struct gb_swarm_group *group;
    size_t groups;
    double level_pa[GB_SWARM_LEVELS]; /* spaced evenly in the logarithm */
    struct gb_swarm_key key[GB_SWARM_VARIED];
    size_t keys; /* varied keys; more than GB_SWARM_VARIED: no map */
    char **fit;  /* of a calibration: lines of what it has found so far; else NULL */
};

/* Whether a directory has runs in it, or in its folder `runs` as that of a calibration,
 * and is none itself. */
bool gb_swarm_is(const char *directory);

/* Reads all of it.  Errors: GB_ERR_INPUT when there is no run that can be read. */
bool gb_swarm_read(struct gb_swarm *swarm, const char *directory, struct gb_error *err);
void gb_swarm_finish(struct gb_swarm *swarm); /* zeroed is fine */

/* The level nearest to a pressure, or below it where more groups got there as a whole. */
size_t gb_swarm_level(const struct gb_swarm *swarm, double pressure_pa);

/* The group at these values of the two varied keys; NULL: there is none yet. */
const struct gb_swarm_group *gb_swarm_at(const struct gb_swarm *swarm, size_t first,
                                         size_t second);

#endif
