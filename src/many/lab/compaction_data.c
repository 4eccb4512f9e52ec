#include "many/lab/compaction_data.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* Default beginning of the window of runs, over the highest pressure. */
static const double first_share = 0.01;

/* Window ends take points that differ by rounding. */
static const double slack = 1e-9;

/* Standard errors are smoothed over the points within this share of all on either side:
 * few replicas know the error of one point badly. */
static const double smoothing_share = 1.0 / 8.0;

/* Least standard error, over the mean of all: an error of 0 is chance. */
static const double least_error = 0.1;

/* Highest pressure that all curves reach. */
static double common_pressure(const struct gb_average_curve *curves, size_t count)
{
    double common = INFINITY;
    for (size_t c = 0; c < count; c++) {
        double most = -INFINITY;
        for (size_t i = 0; i < curves[c].count; i++) {
            most = fmax(most, curves[c].x[i]);
        }
        common = fmin(common, most);
    }
    return common;
}

static size_t fewest_points(const struct gb_average_curve *curves, size_t count,
                            double from, double to)
{
    size_t fewest = GB_COMPACTION_DATA_LEVELS;
    for (size_t c = 0; c < count; c++) {
        size_t inside = 0;
        for (size_t i = 0; i < curves[c].count; i++) {
            inside += curves[c].x[i] >= from && curves[c].x[i] <= to;
        }
        fewest = MIN(fewest, inside);
    }
    return fewest;
}

static bool reserve(struct gb_compaction_data *data, size_t count, size_t replicas,
                    struct gb_error *err)
{
    data->memory = gb_alloc_array((4 + replicas) * count, sizeof *data->memory, err);
    data->points.count = count;
    data->points.stride = count;
    return data->memory != NULL;
}

/* Root mean square of the errors around each point. */
static void smooth_errors(const double *raw, size_t count, double *smooth)
{
    const size_t reach = (size_t)ceil(smoothing_share * (double)count);
    double all = 0.0;
    for (size_t i = 0; i < count; i++) {
        all += raw[i] * raw[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t from = i > reach ? i - reach : 0;
        const size_t to = MIN(i + reach, count - 1);
        double sum = 0.0;
        for (size_t k = from; k <= to; k++) {
            sum += raw[k] * raw[k];
        }
        smooth[i] = fmax(sqrt(sum / (double)(to - from + 1)), least_error * sqrt(all));
    }
}

static void fill_levels(struct gb_compaction_data *data,
                        const struct gb_average_curve *curves, size_t count, double from,
                        double to)
{
    const size_t size = data->points.count;
    double *pressure = data->memory;
    double *mean = pressure + size;
    double *raw = mean + size;
    double *error = raw + size;
    double *rows = error + size;
    for (size_t k = 0; k < size; k++) {
        const double share = size > 1 ? (double)k / (double)(size - 1) : 1.0;
        pressure[k] = k + 1 == size ? to : from * pow(to / from, share);
        for (size_t c = 0; c < count; c++) {
            rows[c * size + k] = gb_average_crossing(&curves[c], pressure[k], NULL);
        }
    }
    gb_average_rows(rows, count, size, GB_AVERAGE_ALL, mean, raw);
    data->points.pressure = pressure;
    data->points.density = mean;
    data->points.rows = rows;
    data->points.replicas = count;
    if (count > 1) {
        smooth_errors(raw, size, error);
        data->points.error = error[0] > 0.0 ? error : NULL;
    }
}

/* Levels that a curve only touches from above have no density: they are left out. */
static void drop_missing(struct gb_equations_points *points, double *memory)
{
    size_t first = 0;
    while (first < points->count && !isfinite(memory[points->stride + first])) {
        first++;
    }
    points->pressure += first;
    points->density += first;
    points->error = points->error != NULL ? points->error + first : NULL;
    points->rows += first;
    points->count -= first;
}

static void set_initial(struct gb_equations_points *points, double initial,
                        const struct gb_compaction_window *window)
{
    points->initial = isnan(window->initial) ? initial : window->initial;
    if (window->fits_initial) {
        points->initial = NAN;
    }
}

bool gb_compaction_data_curves(struct gb_compaction_data *data,
                               const struct gb_average_curve *curves, size_t count,
                               double initial, const struct gb_compaction_window *window,
                               struct gb_error *err)
{
    const double most = common_pressure(curves, count);
    const double to = isnan(window->to) ? most : fmin(window->to, most);
    const double from = isnan(window->from) ? first_share * most : window->from;
    *data = (struct gb_compaction_data){.curves = count};
    const size_t levels =
        from > 0.0 && from < to
            ? fewest_points(curves, count, from * (1.0 - slack), to * (1.0 + slack))
            : 0;
    if (levels < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading has no two points between %g and %g MPa", from, to);
    }
    if (!reserve(data, levels, count, err)) {
        return false;
    }
    fill_levels(data, curves, count, from, to);
    drop_missing(&data->points, data->memory);
    set_initial(&data->points, initial, window);
    return true;
}

/* Density of the last row before loading; NaN: there is none. */
static double density_before(const struct gb_runset_run *run)
{
    const double *density = gb_table_column(run->table, "density", NULL);
    double before = NAN;
    for (size_t i = 0; density != NULL && i < gb_table_rows(run->table); i++) {
        if (strcmp(gb_table_word(run->table, i), "load") == 0) {
            break;
        }
        before = isfinite(density[i]) ? density[i] : before;
    }
    return before;
}

bool gb_compaction_data_runs(struct gb_compaction_data *data, const struct gb_runset *set,
                             size_t group, const struct gb_compaction_window *window,
                             struct gb_error *err)
{
    struct gb_average_curve *curves = g_new0(struct gb_average_curve, set->count + 1);
    double **arrays = g_new0(double *, 2 * set->count + 1);
    double initial = 0.0;
    size_t members = 0;
    bool good = true;
    *data = (struct gb_compaction_data){0};
    for (size_t i = 0; i < set->count && good; i++) {
        const struct gb_runset_run *run = &set->run[i];
        if (run->group == group) {
            struct gb_average_curve *curve = &curves[members];
            double **x = &arrays[2 * members];
            good = gb_runset_points(run, "load", "p_MPa", "density", &x[0], &x[1],
                                    &curve->count, err);
            curve->x = x[0];
            curve->y = x[1];
            initial += good ? density_before(run) : 0.0;
            members += good;
        }
    }
    struct gb_error cause = {0};
    if (good && !gb_compaction_data_curves(data, curves, members,
                                           initial / (double)members, window, &cause)) {
        good = gb_error_set(err, cause.code, "%.300s: %s",
                            gb_runset_first(set, group)->directory, cause.text);
    }
    for (size_t i = 0; i < 2 * set->count; i++) {
        gb_alloc_free(arrays[i]);
    }
    g_free(arrays);
    g_free(curves);
    if (!good) {
        gb_compaction_data_finish(data);
    }
    return good;
}

void gb_compaction_data_finish(struct gb_compaction_data *data)
{
    gb_alloc_free(data->memory);
    *data = (struct gb_compaction_data){0};
}
