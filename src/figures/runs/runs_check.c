#include "figures/runs/runs_check.h"

#include "scene/loading_kind.h"

static bool refuse(const struct gb_runset_run *run, const char *kind, const char *figure,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: scene.kind is not %s, which the figure %s takes",
                        run->directory, kind, figure);
}

bool gb_runs_check_dynamic(const struct gb_runset *set, const char *figure,
                           struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        if (!gb_loading_kind_of(&set->run[i].params)->given_rate) {
            return refuse(&set->run[i], "dynamic", figure, err);
        }
    }
    return true;
}

bool gb_runs_check_die(const struct gb_runset *set, const char *figure,
                       struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        if (gb_loading_kind_of(&set->run[i].params)->columns != GB_COLUMNS_DIE) {
            return refuse(&set->run[i], "die", figure, err);
        }
    }
    return true;
}
