#ifndef GB_TUI_SESSION_REPLICA_BAND_H
#define GB_TUI_SESSION_REPLICA_BAND_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "tui/watch/runset_view.h"

/* More cells of a scene behind the plot: their mean with its standard error, read from
 * their directory while they are computed. */
struct gb_replica_band {
    char *directory; /* NULL: none */
    struct gb_params params;
    struct gb_runset_view runset;
    double due; /* s: when it is read again */
};

/* From now on the cells in that directory are shown. */
void gb_replica_band_follow(struct gb_replica_band *band, const char *directory,
                            const struct gb_params *params);
/* Reads it again when it is time, or at once; true when it did. */
bool gb_replica_band_refresh(struct gb_replica_band *band, bool at_once);
void gb_replica_band_finish(struct gb_replica_band *band); /* zeroed is fine */

/* What there is to be drawn; NULL: nothing yet. */
const struct gb_runset_view_group *
gb_replica_band_group(const struct gb_replica_band *band);

#endif
