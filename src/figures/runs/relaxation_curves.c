#include "figures/runs/relaxation_curves.h"

#include <math.h>

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

static bool read_run(struct gb_average_curve *curve, const struct gb_runset_run *run,
                     struct gb_error *err)
{
    double end = 0.0;
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    if (!end_of_loading(run, &end, err) ||
        !gb_runset_points(run, "hold", "time_ns", "p_MPa", &t, &p, &count, err)) {
        return false;
    }
    for (size_t k = 0; k < count; k++) {
        t[k] -= end;
    }
    *curve = (struct gb_average_curve){t, p, count};
    return true;
}

bool gb_relaxation_curves_read(struct gb_relaxation_curves *curves,
                               const struct gb_runset *set, size_t group,
                               struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    bool good = true;
    *curves = (struct gb_relaxation_curves){g_new0(struct gb_average_curve, members), 0};
    for (size_t i = 0; i < set->count && good; i++) {
        if (set->run[i].group == group) {
            good = read_run(&curves->curve[curves->count], &set->run[i], err);
            curves->count += good;
        }
    }
    if (!good) {
        gb_relaxation_curves_finish(curves);
    }
    return good;
}

void gb_relaxation_curves_finish(struct gb_relaxation_curves *curves)
{
    for (size_t k = 0; k < curves->count; k++) {
        gb_alloc_free((double *)(uintptr_t)curves->curve[k].x);
        gb_alloc_free((double *)(uintptr_t)curves->curve[k].y);
    }
    g_free(curves->curve);
    *curves = (struct gb_relaxation_curves){0};
}

bool gb_relaxation_curves_mean(const struct gb_average_curve *curves, size_t members,
                               double **t, double **p, size_t *count,
                               struct gb_error *err)
{
    size_t size = 0;
    if (!gb_average_grid(curves, members, GB_SERIES_GRID_MAX, t, &size, err)) {
        return false;
    }
    double *rows = gb_alloc_array(members * size, sizeof *rows, err);
    *p = gb_alloc_array(size, sizeof **p, err);
    bool good = rows != NULL && *p != NULL;
    for (size_t i = 0; i < members && good; i++) {
        good = gb_average_resample(&curves[i], *t, size, rows + i * size, err);
    }
    if (good) {
        gb_average_rows(rows, members, size, GB_AVERAGE_ALL, *p, NULL);
    }
    *count = 0;
    for (size_t i = 0; i < size && good; i++) {
        if (isfinite((*p)[i])) {
            (*t)[*count] = (*t)[i];
            (*p)[(*count)++] = (*p)[i];
        }
    }
    gb_alloc_free(rows);
    return good;
}
