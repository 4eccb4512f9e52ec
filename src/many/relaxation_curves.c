#include "many/relaxation_curves.h"

#include <glib.h>

#include "base/alloc.h"

/* Time of the last row of loading, ns. */
static bool end_of_loading(const struct gb_runset_run *run, double *end,
                           struct gb_error *err)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    if (!gb_runset_points(run, "load", "time_ns", "p_MPa", &x, &y, &count, err)) {
        return false;
    }
    *end = x[count - 1];
    gb_alloc_free(x);
    gb_alloc_free(y);
    return true;
}

static bool begin_at_zero(struct gb_average_curve *curve, const struct gb_runset_run *run,
                          struct gb_error *err)
{
    double end = 0.0;
    double *t = (double *)(uintptr_t)curve->x;
    if (!end_of_loading(run, &end, err)) {
        return false;
    }
    for (size_t k = 0; k < curve->count; k++) {
        t[k] -= end;
    }
    return true;
}

bool gb_relaxation_curves_read(struct gb_mean_curves *curves, const struct gb_runset *set,
                               size_t group, struct gb_error *err)
{
    bool good = gb_mean_curves_read(curves, set, group, "hold", "time_ns", "p_MPa", err);
    size_t k = 0;
    for (size_t i = 0; i < set->count && good; i++) {
        if (set->run[i].group == group) {
            good = begin_at_zero(&curves->curve[k++], &set->run[i], err);
        }
    }
    return good;
}

bool gb_relaxation_curves_fit(struct gb_fit_decay *fit,
                              const struct gb_average_curve *curves, size_t members,
                              struct gb_error *err)
{
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    const bool good = gb_mean_curves_mean(curves, members, &t, &p, &count, err) &&
                      gb_fit_decay(fit, t, p, count, err);
    gb_alloc_free(t);
    gb_alloc_free(p);
    return good;
}
