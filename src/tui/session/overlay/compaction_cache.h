#ifndef GB_TUI_SESSION_OVERLAY_COMPACTION_CACHE_H
#define GB_TUI_SESSION_OVERLAY_COMPACTION_CACHE_H

#include "greenbody/curve.h"
#include "many/lab/compaction_data.h"
#include "measure/fit/compaction/compaction_fits.h"

/* Equations of compaction fitted to the curve on display; fitted again only when it has
 * grown: linear intervals while a run is live (about 1 ms), profiles once it has ended. */
struct gb_compaction_cache {
    const struct gb_curve *curve; /* NULL: nothing fitted yet */
    size_t points;
    double first; /* density of the first point: another curve may have the address */
    enum gb_compaction_intervals intervals;
    bool fitted; /* else: reason */
    struct gb_error reason;
    struct gb_compaction_data data;
    struct gb_compaction_fits fits;
};

/* Fits the first `points` points of a curve, unless that is done; true if there are fits
 * to show. */
bool gb_compaction_cache_update(struct gb_compaction_cache *cache,
                                const struct gb_curve *curve, size_t points,
                                enum gb_compaction_intervals intervals);
void gb_compaction_cache_finish(struct gb_compaction_cache *cache); /* zeroed is fine */

#endif
