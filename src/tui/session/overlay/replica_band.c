#include "tui/session/overlay/replica_band.h"

#include <glib.h>
#include <string.h>

#include "base/clock.h"

/* Seconds between two readings, or ten times the duration of one, whichever is longer. */
static const double reread_s = 1.0;
static const double share = 10.0;

void gb_replica_band_follow(struct gb_replica_band *band, const char *directory,
                            const struct gb_params *params)
{
    gb_replica_band_finish(band);
    band->directory = g_strdup(directory);
    band->params = *params;
}

/* An error of reading keeps the band shown: the next reading may succeed. */
bool gb_replica_band_refresh(struct gb_replica_band *band, bool at_once)
{
    struct gb_runset_view fresh;
    struct gb_error err = {0};
    const double from = gb_clock_s();
    if (band->directory == NULL || (!at_once && from < band->due)) {
        return false;
    }
    const bool good = gb_runset_view_read(&fresh, band->directory, &err);
    band->due = gb_clock_s() + MAX(reread_s, share * (gb_clock_s() - from));
    if (good) {
        gb_runset_view_finish(&band->runset);
        band->runset = fresh;
    } else {
        gb_runset_view_finish(&fresh);
    }
    return good;
}

void gb_replica_band_finish(struct gb_replica_band *band)
{
    gb_runset_view_finish(&band->runset);
    g_free(band->directory);
    memset(band, 0, sizeof *band);
}

const struct gb_runset_view_group *
gb_replica_band_group(const struct gb_replica_band *band)
{
    return band->directory != NULL && band->runset.groups > 0 ? &band->runset.group[0]
                                                              : NULL;
}
