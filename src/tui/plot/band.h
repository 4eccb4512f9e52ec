#ifndef GB_TUI_PLOT_BAND_H
#define GB_TUI_PLOT_BAND_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "tui/watch/runset_view.h"

/* More cells of a scene behind the plot: their mean with its standard error, read from
 * their directory while they are computed. */
struct gb_band {
    char *directory; /* NULL: none */
    struct gb_params params;
    struct gb_runset_view swarm;
    double due; /* s: when it is read again */
};

/* From now on the cells in that directory are shown. */
void gb_band_follow(struct gb_band *band, const char *directory,
                    const struct gb_params *params);
/* Reads it again when it is time, or at once; true when it did. */
bool gb_band_refresh(struct gb_band *band, bool at_once);
void gb_band_finish(struct gb_band *band); /* zeroed is fine */

/* What there is to be drawn; NULL: nothing yet. */
const struct gb_runset_view_group *gb_band_group(const struct gb_band *band);

#endif
