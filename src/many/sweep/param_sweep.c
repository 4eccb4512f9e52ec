#include "many/sweep/param_sweep.h"

#include <glib.h>

#include "base/file.h"

/* Parameters and directory of every run. */
static bool fill_runs(struct gb_param_sweep *sweep, const struct gb_params *params,
                      const char *directory, struct gb_error *err)
{
    for (size_t i = 0; i < sweep->ensemble.points * sweep->ensemble.replicas; i++) {
        struct gb_ensemble_run *run = &sweep->ensemble.run[i];
        run->params = *params;
        if (!gb_axes_apply(&sweep->axes, run->point, &run->params, err)) {
            return false;
        }
        run->params.seed += run->replica;
        /* the cores are shared by the runs, not by threads of each */
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        char *name = gb_axes_name(&sweep->axes, run->point);
        run->directory = g_strdup_printf("%s/%s_seed-%" G_GUINT64_FORMAT, directory, name,
                                         run->params.seed);
        g_free(name);
    }
    return true;
}

bool gb_param_sweep_fill(struct gb_param_sweep *sweep, const struct gb_params *params,
                         size_t replicas, const char *directory, struct gb_error *err)
{
    return gb_ensemble_init(&sweep->ensemble, gb_axes_points(&sweep->axes), replicas,
                            err) &&
           fill_runs(sweep, params, directory, err) &&
           (!(sweep->target.standard_error > 0.0) ||
            gb_sweep_target_apply(&sweep->target, &sweep->ensemble, err)) &&
           gb_ensemble_find_done(&sweep->ensemble, err);
}

void gb_param_sweep_finish(struct gb_param_sweep *sweep)
{
    gb_sweep_target_finish(&sweep->target);
    gb_ensemble_finish(&sweep->ensemble);
    gb_axes_finish(&sweep->axes);
}

bool gb_param_sweep_put(const char *directory, const char *name, GString *text,
                        struct gb_error *err)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

bool gb_param_sweep_write(struct gb_param_sweep *sweep, const char *directory,
                          struct gb_error *err)
{
    return gb_param_sweep_put(
               directory, "sweep.csv",
               gb_sweep_table_means(&sweep->ensemble, &sweep->axes, &sweep->at), err) &&
           gb_param_sweep_put(directory, "runs.csv",
                              gb_sweep_table_runs(&sweep->ensemble), err);
}
