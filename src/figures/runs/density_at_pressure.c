#include "figures/runs/density_at_pressure.h"

#include <glib.h>

#include "base/alloc.h"
#include "measure/fit/average.h"

size_t gb_density_at_pressure(const struct gb_runset *set, size_t group,
                              double pressure_mpa, double *mean, double *error,
                              struct gb_error *err)
{
    double *values = g_new(double, set->count);
    size_t members = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (set->run[i].group != group) {
            continue;
        }
        good = gb_runset_points(&set->run[i], "load", "p_MPa", "density", &x, &y, &count,
                                err);
        if (good) {
            const struct gb_average_curve curve = {x, y, count};
            values[members++] = gb_average_crossing(&curve, pressure_mpa, NULL);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    const size_t used = gb_average_values(values, members, mean, error);
    g_free(values);
    if (good && used == 0) {
        gb_error_set(err, GB_ERR_INPUT, "%.300s: never reaches %g MPa",
                     gb_runset_first(set, group)->directory, pressure_mpa);
    }
    return good ? used : 0;
}
