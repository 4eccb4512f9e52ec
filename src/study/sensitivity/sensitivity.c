#include "study/sensitivity/sensitivity.h"

#include <math.h>

#include "base/alloc.h"
#include "many/sweep/sweep_readings.h"

/* A range of values that is rounding beside their mean. */
static const double least_range = 1e-9;

struct work {
    struct gb_param_sweep *sweep;
    struct gb_sweep_readings *reading; /* of each point */
    double *at;                        /* points x keys, -1 to 1 */
    double *value;                     /* points x replicas */
};

static bool open_work(struct work *work, struct gb_error *err)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    const struct gb_axes *axes = &work->sweep->axes;
    work->reading = gb_alloc_array(ensemble->points, sizeof *work->reading, err);
    work->at = gb_alloc_array(ensemble->points * axes->count, sizeof(double), err);
    work->value =
        gb_alloc_array(ensemble->points * ensemble->replicas, sizeof(double), err);
    if (!work->reading || !work->at || !work->value) {
        return false;
    }
    for (size_t p = 0; p < ensemble->points; p++) {
        gb_sweep_readings_init(&work->reading[p], &work->sweep->ensemble, p,
                               &work->sweep->at);
        for (size_t k = 0; k < axes->count; k++) {
            work->at[p * axes->count + k] = 2.0 * axes->axis[k].share[p] - 1.0;
        }
    }
    return true;
}

static void close_work(struct work *work)
{
    for (size_t p = 0; work->reading != NULL && p < work->sweep->ensemble.points; p++) {
        gb_sweep_readings_finish(&work->reading[p]);
    }
    gb_alloc_free(work->reading);
    gb_alloc_free(work->at);
    gb_alloc_free(work->value);
}

/* Values of one figure; false where they do not vary. */
static bool collect(const struct work *work, const struct gb_sensitivity_item *of)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    double low = INFINITY, high = -INFINITY;
    for (size_t p = 0; p < ensemble->points; p++) {
        const double *from = gb_sweep_readings_at(&work->reading[p], of->branch,
                                                  of->pressure, of->quantity);
        for (size_t r = 0; r < ensemble->replicas; r++) {
            const double value = r < work->reading[p].runs ? from[r] : (double)NAN;
            work->value[p * ensemble->replicas + r] = value;
            low = fmin(low, value);
            high = fmax(high, value);
        }
    }
    return high - low > least_range * fmax(fabs(high), fabs(low));
}

/* Adds a figure where it has enough values. */
static bool add(struct gb_sensitivity *sensitivity, const struct work *work,
                struct gb_sensitivity_item of, struct gb_error *err)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    struct gb_error why = {0};
    if (!collect(work, &of)) {
        return true;
    }
    if (gb_sobol_indices_fit(&of.indices, work->sweep->axes.count, ensemble->points,
                             ensemble->replicas, work->at, work->value, &why)) {
        sensitivity->item[sensitivity->count++] = of;
        return true;
    }
    return why.code == GB_ERR_INPUT || gb_error_set(err, why.code, "%s", why.text);
}

static bool fill(struct gb_sensitivity *sensitivity, const struct work *work,
                 struct gb_error *err)
{
    const size_t pressures = work->sweep->at.count;
    struct gb_sensitivity_item of = {0};
    for (of.branch = 0; of.branch < GB_SWEEP_BRANCHES; of.branch++) {
        for (of.pressure = 0; of.pressure < pressures; of.pressure++) {
            for (of.quantity = 0; of.quantity < GB_READING_QUANTITIES; of.quantity++) {
                if (!add(sensitivity, work, of, err)) {
                    return false;
                }
            }
        }
    }
    return true;
}

bool gb_sensitivity_check(const struct gb_axes *axes, struct gb_error *err)
{
    const size_t terms = gb_surrogate_terms(axes->count, GB_SURROGATE_QUADRATIC);
    return axes->design >= terms ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--design sobol:%zu: accepted %zu points or more for %zu keys, "
                        "the terms of a quadratic",
                        axes->design, terms, axes->count);
}

bool gb_sensitivity_init(struct gb_sensitivity *sensitivity, struct gb_param_sweep *sweep,
                         struct gb_error *err)
{
    struct work work = {.sweep = sweep};
    *sensitivity = (struct gb_sensitivity){0};
    sensitivity->item =
        gb_alloc_array(GB_SWEEP_BRANCHES * sweep->at.count * GB_READING_QUANTITIES,
                       sizeof *sensitivity->item, err);
    const bool good = sensitivity->item != NULL && open_work(&work, err) &&
                      fill(sensitivity, &work, err);
    close_work(&work);
    return good;
}

void gb_sensitivity_finish(struct gb_sensitivity *sensitivity)
{
    gb_alloc_free(sensitivity->item);
    *sensitivity = (struct gb_sensitivity){0};
}
