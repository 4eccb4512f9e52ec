#include "study/yield/yield_surface.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stddef.h>

#include "base/alloc.h"
#include "measure/average.h"
#include "measure/yield_point.h"

enum { MOST = GB_YIELD_DIRECTIONS_MAX };

const struct gb_yield_surface_row gb_yield_surface_rows[GB_YIELD_QUANTITIES] = {
    [GB_YIELD_CENTRE_P] = {"centre_p", "MPa", 1e-6},
    [GB_YIELD_CENTRE_Q] = {"centre_q", "MPa", 1e-6},
    [GB_YIELD_HALF_P] = {"half_axis_p", "MPa", 1e-6},
    [GB_YIELD_HALF_Q] = {"half_axis_q", "MPa", 1e-6},
    [GB_YIELD_TENSION] = {"p_tension", "MPa", 1e-6},
    [GB_YIELD_PRESSURE] = {"p_compression", "MPa", 1e-6},
    [GB_YIELD_SHIFT] = {"shift", "1", 1.0},
    [GB_YIELD_MISFIT] = {"misfit", "1", 1.0},
    [GB_YIELD_ANGLE_RMS] = {"flow_angle_rms", "degrees", 1.0},
    [GB_YIELD_ANGLE_NOISE] = {"flow_angle_noise", "degrees", 1.0},
    [GB_YIELD_FLOW_DEVIATION] = {"flow_deviation", "degrees", 1.0},
    [GB_YIELD_DILATANCY_COMPRESSION] = {"dilatancy_compression", "1", 1.0},
    [GB_YIELD_DILATANCY_EXTENSION] = {"dilatancy_extension", "1", 1.0},
};

/* What the points of some cells say. */
struct summary {
    struct gb_yield_point mean[MOST];
    double angle[MOST], dilatancy[MOST];
    double quantity[GB_YIELD_QUANTITIES];
};

static bool is_there(const struct gb_yield_surface_data *data, int cell, int direction)
{
    return isfinite(data->point[cell * data->directions + direction].p_pa);
}

static int count_cells(const struct gb_yield_surface_data *data, int direction)
{
    int count = 0;
    for (int c = 0; c < data->cells; c++) {
        count += is_there(data, c, direction);
    }
    return count;
}

static bool counts(const struct gb_yield_surface_data *data, int direction)
{
    return 2 * count_cells(data, direction) >= data->cells;
}

/* Mean over the cells but one (-1: over all). */
static struct gb_yield_point mean_without(const struct gb_yield_surface_data *data,
                                          int direction, int without)
{
    struct gb_yield_point mean = {.p_error_pa = NAN, .q_error_pa = NAN};
    double count = 0.0;
    for (int c = 0; c < data->cells; c++) {
        if (c != without && is_there(data, c, direction)) {
            const struct gb_yield_point *point =
                &data->point[c * data->directions + direction];
            mean.density += point->density;
            mean.p_pa += point->p_pa;
            mean.q_pa += point->q_pa;
            mean.flow_volume += point->flow_volume;
            mean.flow_shear += point->flow_shear;
            mean.direction = point->direction;
            count++;
        }
    }
    mean.density /= count;
    mean.p_pa /= count;
    mean.q_pa /= count;
    mean.flow_volume /= count;
    mean.flow_shear /= count;
    return mean;
}

/* Degrees from -180 to 180. */
static double difference(double a, double b)
{
    return remainder(a - b, 2.0 * M_PI) * 180.0 / M_PI;
}

static void read_ellipse(struct summary *summary, const struct gb_ellipse *ellipse)
{
    double *quantity = summary->quantity;
    quantity[GB_YIELD_CENTRE_P] = ellipse->centre_p;
    quantity[GB_YIELD_CENTRE_Q] = ellipse->centre_q;
    quantity[GB_YIELD_HALF_P] = ellipse->half_p;
    quantity[GB_YIELD_HALF_Q] = ellipse->half_q;
    quantity[GB_YIELD_TENSION] = ellipse->centre_p - ellipse->half_p;
    quantity[GB_YIELD_PRESSURE] = ellipse->centre_p + ellipse->half_p;
    quantity[GB_YIELD_SHIFT] = ellipse->centre_p / ellipse->half_p;
    quantity[GB_YIELD_MISFIT] = ellipse->misfit;
}

/* 1 or -1 for loading towards +q or -q; 0 along the p axis. */
static double side_of(double direction)
{
    const double q = sin(direction);
    return fabs(q) < 1e-9 ? 0.0 : copysign(1.0, q);
}

static void measure_angles(struct summary *summary,
                           const struct gb_yield_surface_data *data,
                           const struct gb_ellipse *ellipse)
{
    double squares = 0.0, count = 0.0, deviation = 0.0, sided = 0.0;
    for (int d = 0; d < data->directions; d++) {
        const struct gb_yield_point *mean = &summary->mean[d];
        const double side = side_of(mean->direction);
        if (counts(data, d)) {
            summary->angle[d] = difference(
                atan2(mean->flow_shear, mean->flow_volume),
                gb_yield_point_ellipse_normal(ellipse, mean->p_pa, mean->q_pa));
            squares += summary->angle[d] * summary->angle[d];
            count++;
            deviation -= side * summary->angle[d];
            sided += fabs(side);
        }
    }
    summary->quantity[GB_YIELD_ANGLE_RMS] = sqrt(squares / count);
    summary->quantity[GB_YIELD_FLOW_DEVIATION] = deviation / sided;
}

static void fill_nan(double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        value[i] = NAN;
    }
}

/* Fitted in MPa: of the size of 1 to 1000. */
static void fit(struct summary *summary, const struct gb_yield_surface_data *data)
{
    double p[MOST], q[MOST];
    size_t count = 0;
    struct gb_ellipse ellipse;
    struct gb_error ignored = {0};
    for (int d = 0; d < data->directions; d++) {
        if (counts(data, d)) {
            p[count] = 1e-6 * summary->mean[d].p_pa;
            q[count++] = 1e-6 * summary->mean[d].q_pa;
        }
    }
    if (!gb_yield_point_ellipse(&ellipse, p, q, count, &ignored)) {
        return;
    }
    ellipse.centre_p *= 1e6;
    ellipse.centre_q *= 1e6;
    ellipse.half_p *= 1e6;
    ellipse.half_q *= 1e6;
    read_ellipse(summary, &ellipse);
    measure_angles(summary, data, &ellipse);
}

static void summarise(struct summary *summary, const struct gb_yield_surface_data *data,
                      int without)
{
    fill_nan(summary->angle, MOST);
    fill_nan(summary->dilatancy, MOST);
    fill_nan(summary->quantity, GB_YIELD_QUANTITIES);
    for (int d = 0; d < data->directions; d++) {
        summary->mean[d] = mean_without(data, d, without);
        if (counts(data, d)) {
            summary->dilatancy[d] =
                -summary->mean[d].flow_volume / fabs(summary->mean[d].flow_shear);
        }
    }
    const int quarter = data->directions / 4;
    summary->quantity[GB_YIELD_DILATANCY_COMPRESSION] = summary->dilatancy[quarter];
    summary->quantity[GB_YIELD_DILATANCY_EXTENSION] = summary->dilatancy[3 * quarter];
    fit(summary, data);
}

static struct gb_fit_value value_with(double value, double error, int cells)
{
    const double quantile =
        cells > 1 ? gsl_cdf_tdist_Pinv(0.975, cells - 1.0) : (double)NAN;
    return (struct gb_fit_value){value, error, value - quantile * error,
                                 value + quantile * error};
}

/* A number of the summary (at `offset` bytes) with its error over the summaries without one
 * cell each. */
static struct gb_fit_value jackknife(const struct summary *all,
                                     const struct summary *without, int cells,
                                     size_t offset)
{
    double value[GB_YIELD_REPLICAS_MAX];
    for (int c = 0; c < cells; c++) {
        const char *at = (const char *)&without[c] + offset;
        value[c] = *(const double *)(const void *)at;
    }
    const char *at = (const char *)all + offset;
    return value_with(
        *(const double *)(const void *)at,
        cells > 1 ? gb_average_jackknife(value, (size_t)cells) : (double)NAN, cells);
}

#define AT(member, index)                                                                \
    (offsetof(struct summary, member) +                                                  \
     (size_t)(index) * sizeof((struct summary){0}.member[0]))

static void fill_direction(struct gb_yield_surface_direction *direction, int d,
                           const struct gb_yield_surface_data *data,
                           const struct summary *all, const struct summary *without)
{
    const size_t at = AT(mean, d);
    const int cells = data->cells;
    direction->mean = all->mean[d];
    direction->cells = count_cells(data, d);
    direction->mean.p_error_pa =
        jackknife(all, without, cells, at + offsetof(struct gb_yield_point, p_pa)).error;
    direction->mean.q_error_pa =
        jackknife(all, without, cells, at + offsetof(struct gb_yield_point, q_pa)).error;
    direction->angle = jackknife(all, without, cells, AT(angle, d));
    direction->dilatancy = jackknife(all, without, cells, AT(dilatancy, d));
}

/* rms of the errors of the angles. */
static double noise_of(const struct gb_yield_surface *surface)
{
    double squares = 0.0, count = 0.0;
    for (int d = 0; d < surface->directions; d++) {
        const double error = surface->direction[d].angle.error;
        if (isfinite(error)) {
            squares += error * error;
            count++;
        }
    }
    return sqrt(squares / count);
}

static struct gb_fit_value over_cells(const double *value, int cells)
{
    double mean, error;
    const size_t count = gb_average_values(value, (size_t)cells, &mean, &error);
    return value_with(mean, error, (int)count);
}

static void fill(struct gb_yield_surface *surface,
                 const struct gb_yield_surface_data *data, const struct summary *all,
                 const struct summary *without)
{
    double density[GB_YIELD_REPLICAS_MAX];
    for (int c = 0; c < data->cells; c++) {
        density[c] = data->point[c * data->directions].density;
    }
    surface->cells = data->cells;
    surface->directions = data->directions;
    surface->density = over_cells(density, data->cells);
    surface->top_p = over_cells(data->top_p, data->cells);
    surface->top_q = over_cells(data->top_q, data->cells);
    for (int d = 0; d < data->directions; d++) {
        fill_direction(&surface->direction[d], d, data, all, without);
    }
    for (int k = 0; k < GB_YIELD_QUANTITIES; k++) {
        surface->quantity[k] = jackknife(all, without, data->cells, AT(quantity, k));
    }
    surface->quantity[GB_YIELD_ANGLE_NOISE] =
        (struct gb_fit_value){noise_of(surface), NAN, NAN, NAN};
}

bool gb_yield_surface_measure(struct gb_yield_surface *surface,
                              const struct gb_yield_surface_data *data,
                              struct gb_error *err)
{
    struct summary *summary =
        gb_alloc_array((size_t)data->cells + 1, sizeof *summary, err);
    if (summary == NULL) {
        return false;
    }
    for (int c = -1; c < data->cells; c++) {
        summarise(&summary[c + 1], data, c);
    }
    fill(surface, data, &summary[0], &summary[1]);
    gb_alloc_free(summary);
    return true;
}
