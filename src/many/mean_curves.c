#include "many/mean_curves.h"

#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "many/runset.h"
#include "measure/average.h"

enum { GB_MEAN_CURVES_GRID = 4000 }; /* largest number of points of a mean */

bool gb_mean_curves_read(struct gb_mean_curves *curves, const struct gb_runset *set,
                         size_t group, const char *branch, const char *x, const char *y,
                         struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    bool good = true;
    *curves = (struct gb_mean_curves){g_new0(struct gb_average_curve, members), 0};
    for (size_t i = 0; i < set->count && good; i++) {
        double *at = NULL;
        double *value = NULL;
        size_t count = 0;
        if (set->run[i].group == group) {
            good = gb_runset_points(&set->run[i], branch, x, y, &at, &value, &count, err);
            curves->curve[curves->count] = (struct gb_average_curve){at, value, count};
            curves->count += good;
        }
    }
    return good;
}

void gb_mean_curves_finish(struct gb_mean_curves *curves)
{
    for (size_t k = 0; k < curves->count; k++) {
        gb_alloc_free((double *)(uintptr_t)curves->curve[k].x);
        gb_alloc_free((double *)(uintptr_t)curves->curve[k].y);
    }
    g_free(curves->curve);
    *curves = (struct gb_mean_curves){0};
}

bool gb_mean_curves_mean(const struct gb_average_curve *curves, size_t members,
                         double **x, double **y, size_t *count, struct gb_error *err)
{
    size_t size = 0;
    *y = NULL;
    *count = 0;
    if (!gb_average_grid(curves, members, GB_MEAN_CURVES_GRID, x, &size, err)) {
        *x = NULL;
        return false;
    }
    double *rows = gb_alloc_array(members * size, sizeof *rows, err);
    *y = gb_alloc_array(size, sizeof **y, err);
    bool good = rows != NULL && *y != NULL;
    for (size_t i = 0; i < members && good; i++) {
        good = gb_average_resample(&curves[i], *x, size, rows + i * size, err);
    }
    if (good) {
        gb_average_rows(rows, members, size, GB_AVERAGE_ALL, *y, NULL);
    }
    for (size_t i = 0; i < size && good; i++) {
        if (isfinite((*y)[i])) {
            (*x)[*count] = (*x)[i];
            (*y)[(*count)++] = (*y)[i];
        }
    }
    gb_alloc_free(rows);
    return good;
}

/* Time of the last row of loading, ns; false if there is none. */
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

bool gb_mean_curves_relaxation(struct gb_mean_curves *curves, const struct gb_runset *set,
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

bool gb_mean_curves_decay(struct gb_fit_decay *fit, const struct gb_average_curve *curves,
                          size_t members, struct gb_error *err)
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
