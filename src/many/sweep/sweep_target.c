#include "many/sweep/sweep_target.h"

#include <math.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/units.h"
#include "many/reading.h"
#include "measure/fit/average.h"

/* The scatter of fewer replicas is too uncertain to stop at. */
enum { REPLICAS_MIN = 4 };

bool gb_sweep_target_parse(struct gb_sweep_target *target, const char *text,
                           struct gb_error *err)
{
    char **parts = g_strsplit(text, "@", 3);
    const bool good =
        g_strv_length(parts) == 2 &&
        gb_units_parse(parts[0], GB_DIM_NONE, &target->standard_error, NULL) &&
        gb_units_parse(parts[1], GB_DIM_PRESSURE, &target->pressure_pa, NULL) &&
        target->standard_error > 0.0 && target->pressure_pa > 0.0;
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--until-se %.80s: accepted a standard error of the "
                                "density and a pressure, as in 0.002@100MPa",
                                text);
}

/* The density of a run that has ended; its curve is read once. */
static double density_of(const struct gb_sweep_target *target,
                         const struct gb_ensemble *ensemble,
                         const struct gb_ensemble_run *run)
{
    const size_t i = (size_t)(run - ensemble->run);
    double values[GB_READING_QUANTITIES] = {NAN};
    struct gb_table *curve = NULL;
    if (target->is_read[i]) {
        return target->density[i];
    }
    if (run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL)) {
        gb_reading_loaded(curve, target->pressure_pa, values);
    }
    gb_table_destroy(curve);
    target->is_read[i] = true;
    target->density[i] = values[GB_READING_DENSITY];
    return target->density[i];
}

/* The first k replicas have all ended and are enough, for some k. */
static bool has_converged(const struct gb_ensemble *ensemble, size_t point, void *data)
{
    const struct gb_sweep_target *target = data;
    double *values = g_new(double, ensemble->replicas);
    bool enough = false;
    for (size_t r = 0; r < ensemble->replicas && !enough; r++) {
        const struct gb_ensemble_run *run = gb_ensemble_at(ensemble, point, r);
        double mean = NAN;
        double error = NAN;
        if (!run->ended) {
            break;
        }
        values[r] = density_of(target, ensemble, run);
        const size_t runs = gb_average_values(values, r + 1, &mean, &error);
        enough = runs >= REPLICAS_MIN && error <= target->standard_error;
    }
    g_free(values);
    return enough;
}

bool gb_sweep_target_apply(struct gb_sweep_target *target, struct gb_ensemble *ensemble,
                           struct gb_error *err)
{
    const size_t runs = ensemble->points * ensemble->replicas;
    target->density = gb_alloc_array(runs, sizeof *target->density, err);
    target->is_read =
        target->density ? gb_alloc_array(runs, sizeof *target->is_read, err) : NULL;
    ensemble->converged = has_converged;
    ensemble->data = target;
    return target->is_read != NULL;
}

void gb_sweep_target_finish(struct gb_sweep_target *target)
{
    gb_alloc_free(target->density);
    gb_alloc_free(target->is_read);
    target->density = NULL;
    target->is_read = NULL;
}

size_t gb_sweep_target_missed(const struct gb_sweep_target *target,
                              const struct gb_ensemble *ensemble)
{
    size_t missed = 0;
    for (size_t p = 0; p < ensemble->points && target->is_read != NULL; p++) {
        missed += !has_converged(ensemble, p, (void *)target);
    }
    return missed;
}
