#include "figures/report/report_springback.h"

#include <math.h>

#include "base/alloc.h"
#include "measure/fit/average.h"

/* Density of the recorded point from which unloading began: the first of loading at or above
 * the pressure.  NaN: there is none. */
static double density_before(const struct gb_runset_run *run, double from_mpa)
{
    double *pressure = NULL;
    double *density = NULL;
    size_t count = 0;
    double found = NAN;
    if (gb_runset_points(run, "load", "p_MPa", "density", &pressure, &density, &count,
                         NULL)) {
        for (size_t k = 0; k < count && isnan(found); k++) {
            found = pressure[k] >= from_mpa ? density[k] : found;
        }
    }
    gb_alloc_free(pressure);
    gb_alloc_free(density);
    return found;
}

/* Of one run, percent; NaN: it has no such branch. */
static double of_run(const struct gb_runset_run *run, const char *branch, double from_mpa)
{
    double *step = NULL;
    double *density = NULL;
    size_t count = 0;
    double value = NAN;
    if (run->table != NULL &&
        gb_runset_points(run, branch, "step", "density", &step, &density, &count, NULL)) {
        value = 100.0 * (density_before(run, from_mpa) / density[count - 1] - 1.0);
    }
    gb_alloc_free(step);
    gb_alloc_free(density);
    return value;
}

size_t gb_report_springback(const struct gb_runset *set, size_t group, double from_mpa,
                            double *mean, double *error)
{
    double *values = g_new(double, set->count);
    char *branch = g_strdup_printf("unload:%gMPa", from_mpa);
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            values[count++] = of_run(&set->run[i], branch, from_mpa);
        }
    }
    const size_t used = gb_average_values(values, count, mean, error);
    g_free(branch);
    g_free(values);
    return used;
}
