#include "cli/pack/pack_percolation.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "measure/fit/average.h"
#include "measure/percolation.h"
#include "scene/model.h"
#include "scene/seed.h"

/* Density of count particles in the cell of the model. */
static double density_of(const struct gb_model *model, double count)
{
    const double particle = model->dimension == 2 ? M_PI / 4.0 : M_PI / 6.0;
    return particle * count / (model->edges[0] * model->edges[1] * model->edges[2]);
}

static bool find(const struct gb_params *params, struct gb_model *model, double *count,
                 struct gb_error *err)
{
    int64_t particles = 0;
    if (!gb_model_init(model, params, err)) {
        return false;
    }
    struct gb_chain_growth grow = gb_chain_growth_from_model(model);
    grow.cancelled = gb_signals_cancelled;
    if (!gb_percolation_find(&grow, &particles, err)) {
        return false;
    }
    *count = (double)particles;
    return true;
}

static void print_row(const struct gb_model *model, double count)
{
    gb_visible_print(stdout, "%" PRIu64 ",%.0f,%.6f\n", model->seed.value, count,
                     density_of(model, count));
}

static void print_mean(const struct gb_model *model, const double *count, int cells)
{
    double mean = NAN;
    double error = NAN;
    gb_average_values(count, (size_t)cells, &mean, &error);
    gb_visible_print(stdout, "# mean %.6g particles, density %.4f", mean,
                     density_of(model, mean));
    if (cells > 1) {
        gb_visible_print(stdout, "; standard error %.2g, %.1g; standard deviation %.3g",
                         error, density_of(model, error), error * sqrt((double)cells));
    }
    gb_visible_print(stdout, "; %d cell%s of %.5g x ", cells, cells > 1 ? "s" : "",
                     model->edges[0]);
    if (model->dimension == 3) {
        gb_visible_print(stdout, "%.5g x ", model->edges[1]);
    }
    gb_visible_print(stdout, "%.5g d\n", model->edges[2]);
}

bool gb_pack_percolation(const struct gb_params *params, int cells, struct gb_error *err)
{
    struct gb_params scene = *params;
    struct gb_model model;
    double *count = g_new(double, (gsize)cells);
    bool good = gb_seed_matters(params) ||
                gb_error_set(err, GB_ERR_INPUT,
                             "--percolation: expected structure.kind = grown and no "
                             "structure.from: other structures do not grow");
    for (int k = 0; k < cells && good; k++) {
        scene.seed = params->seed + (uint64_t)k;
        good = find(&scene, &model, &count[k], err);
        if (good && k == 0) {
            gb_visible_put(
                stdout,
                "# particles at which the growing cluster joins its images along all "
                "axes, P1 section III\nseed,particles,density\n");
        }
        if (good) {
            print_row(&model, count[k]);
        }
    }
    if (good) {
        print_mean(&model, count, cells);
        good = fflush(stdout) == 0 || gb_options_output_failed(err);
    }
    g_free(count);
    return good;
}
