/* Means of curves and of values: on a common grid, with standard errors and jackknife, and the
 * scatter of the density from cell to cell. */
#include "measure/average.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "greenbody/params.h"

/* Abscissae closer than this share of the span count as one. */
static const double equal_share = 1e-9;

static bool check_rising(const struct gb_average_curve *curve, struct gb_error *err)
{
    for (size_t i = 0; i < curve->count; i++) {
        if (!isfinite(curve->x[i]) || (i > 0 && curve->x[i] < curve->x[i - 1])) {
            return gb_error_set(
                err, GB_ERR_INPUT,
                "point %zu of a curve: x = %g after %g: must be finite and "
                "not descending",
                i + 1, curve->x[i], i > 0 ? curve->x[i - 1] : 0.0);
        }
    }
    return true;
}

/* y between points i - 1 and i. */
static double between(const struct gb_average_curve *curve, size_t i, double x)
{
    const double low = curve->x[i - 1];
    const double share = (x - low) / (curve->x[i] - low);
    /* the ends exactly: a missing neighbour is NaN and would spread to them */
    if (share <= 0.0) {
        return curve->y[i - 1];
    }
    if (share >= 1.0) {
        return curve->y[i];
    }
    return curve->y[i - 1] + share * (curve->y[i] - curve->y[i - 1]);
}

/* First point with x[i] >= x, count when there is none. */
static size_t lower_bound(const struct gb_average_curve *curve, double x)
{
    size_t low = 0;
    size_t high = curve->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (curve->x[middle] < x) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

bool gb_average_resample(const struct gb_average_curve *curve, const double *grid,
                         size_t size, double *y, struct gb_error *err)
{
    if (!check_rising(curve, err)) {
        return false;
    }
    for (size_t k = 0; k < size; k++) {
        const size_t i = lower_bound(curve, grid[k]);
        if (isnan(grid[k]) || i == curve->count || (i == 0 && curve->x[0] > grid[k])) {
            y[k] = NAN;
        } else if (i == 0 || curve->x[i] == grid[k]) {
            y[k] = curve->y[i];
        } else {
            y[k] = between(curve, i, grid[k]);
        }
    }
    return true;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Keeps one of each cluster; the ends stay exact, so that no curve ends before the grid
 * by rounding. */
static size_t merge_equal(double *grid, size_t size)
{
    const double margin = equal_share * (grid[size - 1] - grid[0]);
    const double last = grid[size - 1];
    size_t kept = 1;
    for (size_t i = 1; i < size; i++) {
        if (grid[i] - grid[kept - 1] > margin) {
            grid[kept++] = grid[i];
        }
    }
    if (kept > 1) {
        grid[kept - 1] = last - grid[kept - 1] <= margin ? last : grid[kept - 1];
    }
    return kept;
}

static size_t thin(double *grid, size_t size, size_t most)
{
    if (size <= most) {
        return size;
    }
    for (size_t k = 0; k < most; k++) {
        const double where = (double)k * (double)(size - 1) / (double)(most - 1);
        grid[k] = grid[(size_t)(where + 0.5)];
    }
    return most;
}

bool gb_average_grid(const struct gb_average_curve *curves, size_t count, size_t most,
                     double **grid, size_t *size, struct gb_error *err)
{
    size_t total = 0;
    for (size_t c = 0; c < count; c++) {
        if (!check_rising(&curves[c], err)) {
            return false;
        }
        total += curves[c].count;
    }
    if (total == 0) {
        return gb_error_set(err, GB_ERR_INPUT, "no points to average");
    }
    double *abscissae = gb_alloc_array(total, sizeof *abscissae, err);
    if (abscissae == NULL) {
        return false;
    }
    size_t filled = 0;
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; i < curves[c].count; i++) {
            abscissae[filled++] = curves[c].x[i];
        }
    }
    qsort(abscissae, total, sizeof *abscissae, compare_doubles);
    *size = thin(abscissae, merge_equal(abscissae, total), most);
    *grid = abscissae;
    return true;
}

/* Value k of count, stride apart. */
static size_t strided(const double *values, size_t count, size_t stride, double *mean,
                      double *error)
{
    size_t used = 0;
    double sum = 0.0;
    double squares = 0.0;
    for (size_t k = 0; k < count; k++) {
        if (!isnan(values[k * stride])) {
            used++;
            sum += values[k * stride];
        }
    }
    *mean = used > 0 ? sum / (double)used : (double)NAN;
    for (size_t k = 0; k < count; k++) {
        if (!isnan(values[k * stride])) {
            squares += (values[k * stride] - *mean) * (values[k * stride] - *mean);
        }
    }
    const double n = (double)used;
    *error = used > 1 ? sqrt(squares / (n * (n - 1.0))) : (double)NAN;
    return used;
}

size_t gb_average_values(const double *values, size_t count, double *mean, double *error)
{
    return strided(values, count, 1, mean, error);
}

double gb_average_jackknife(const double *without, size_t count)
{
    double mean = NAN;
    double error = NAN;
    const size_t used = gb_average_values(without, count, &mean, &error);
    return used > 1 ? error * ((double)used - 1.0) : (double)NAN;
}

void gb_average_rows(const double *rows, size_t count, size_t size,
                     enum gb_average_gaps gaps, double *mean, double *error)
{
    for (size_t k = 0; k < size; k++) {
        double spread = NAN;
        const size_t used = strided(rows + k, count, size, &mean[k], &spread);
        if (gaps == GB_AVERAGE_ALL && used < count) {
            mean[k] = NAN;
            spread = NAN;
        }
        if (error != NULL) {
            error[k] = spread;
        }
    }
}

double gb_average_crossing(const struct gb_average_curve *curve, double level, size_t *at)
{
    for (size_t i = 0; i < curve->count; i++) {
        const bool reached = curve->x[i] == level;
        const bool crossed = i > 0 &&
                             (curve->x[i - 1] < level) != (curve->x[i] < level) &&
                             isfinite(curve->x[i - 1]) && isfinite(curve->x[i]);
        if (reached || crossed) {
            if (at != NULL) {
                *at = i;
            }
            return reached ? curve->y[i] : between(curve, i, level);
        }
    }
    return (double)NAN;
}

static const double deviation = 0.0064;
static const double of_count = 1000.0;
static const double exponent = 0.4;

double gb_average_cell_scatter(const struct gb_params *params)
{
    const bool random = params->structure == GB_STRUCTURE_GROWN;
    return random && params->kind == GB_KIND_QUASISTATIC && params->dimension == 3 &&
                   params->from.path[0] == '\0' && params->count > 0
               ? deviation * pow(of_count / (double)params->count, exponent)
               : (double)NAN;
}
