#include "many/mean_curves.h"

#include <math.h>

#include <glib.h>

#include "base/alloc.h"

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
