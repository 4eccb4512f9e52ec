#include "many/sweep/sweep_shortfall.h"

#include <glib.h>

#include "greenbody/snapshot.h"
#include "io/follow.h"

char *gb_sweep_shortfall_text(const struct gb_ensemble_run *run)
{
    struct gb_snapshot shot = {0};
    struct gb_follow_engine engine;
    struct gb_error ignored;
    const bool told = run->ended && run->error.code == GB_OK &&
                      gb_follow_status(run->directory, &shot, &engine, &ignored) &&
                      shot.state == GB_RUN_DONE && shot.error.text[0] != '\0';
    return told ? g_strdup(shot.error.text) : NULL;
}

size_t gb_sweep_shortfall_runs(const struct gb_ensemble *ensemble)
{
    size_t runs = 0;
    for (size_t point = 0; point < ensemble->points; point++) {
        const size_t used = gb_ensemble_used(ensemble, point);
        for (size_t replica = 0; replica < used; replica++) {
            char *text =
                gb_sweep_shortfall_text(gb_ensemble_at(ensemble, point, replica));
            runs += text != NULL;
            g_free(text);
        }
    }
    return runs;
}
