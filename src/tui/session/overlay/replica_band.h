#ifndef GB_TUI_SESSION_OVERLAY_REPLICA_BAND_H
#define GB_TUI_SESSION_OVERLAY_REPLICA_BAND_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "tui/watch/runset_view.h"

/* Replicas of a scene for the plot: mean and standard error, read from their directory
 * while they are computed. */
struct gb_replica_band {
    char *directory; /* NULL: none */
    struct gb_params params;
    struct gb_runset_view runset;
    double target, target_pa; /* standard error of density asked for; 0: none */
    double due;               /* clock of the next reading, s */
};

/* Shows the replicas in a directory from now on. */
void gb_replica_band_follow(struct gb_replica_band *band, const char *directory,
                            const struct gb_params *params);
/* Reads again when due, or now; true if it was read. */
bool gb_replica_band_refresh(struct gb_replica_band *band, bool at_once);
void gb_replica_band_finish(struct gb_replica_band *band); /* zeroed is fine */

/* The band to draw; NULL: none yet. */
const struct gb_runset_view_group *
gb_replica_band_group(const struct gb_replica_band *band);

#endif
