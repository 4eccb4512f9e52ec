#include "study/card/card_study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "measure/fit/average.h"
#include "scene/seed.h"
#include "study/card/card_fit.h"
#include "study/card/card_misfit.h"
#include "study/card/card_threads.h"

const struct gb_card_quantity_row gb_card_study_rows[GB_CARD_QUANTITIES] = {
    {"d_MPa", "d", "MPa", 1e-6},
    {"beta_deg", "beta", "degrees", 180.0 / M_PI},
    {"R", "R", "", 1.0},
    {"p_a_MPa", "p_a", "MPa", 1e-6},
    {"p_b_MPa", "p_b", "MPa", 1e-6},
    {"plastic_volume", "plastic volumetric strain", "", 1.0},
    {"E_GPa", "E", "GPa", 1e-9},
    {"nu", "nu", "", 1.0},
};

enum { DEFAULT_LEVELS = 6 };

/* A value with the interval of the jackknife. */
static struct gb_fit_value with_interval(double value, const double *without, int count)
{
    const double error = gb_average_jackknife(without, (size_t)count);
    const double half = error * gsl_cdf_tdist_Pinv(0.975, count - 1.0);
    return (struct gb_fit_value){value, error, value - half, value + half};
}

static struct gb_fit_value with_error(const double *values, int count)
{
    struct gb_fit_value mean;
    gb_average_values(values, (size_t)count, &mean.value, &mean.error);
    const double half = mean.error * gsl_cdf_tdist_Pinv(0.975, count - 1.0);
    mean.low = mean.value - half;
    mean.high = mean.value + half;
    return mean;
}

/* Cards, and predictions on the grid of the curve, of all cells but one. */
struct jackknife {
    struct gb_card_values *card;
    double *ratio, *pz; /* paths x replicas x GB_CARD_CURVE_POINTS */
    double *room;       /* replicas */
};

static bool jackknife_init(struct jackknife *jack, int replicas, struct gb_error *err)
{
    const size_t n = (size_t)replicas, curves = GB_CARD_PATHS * n;
    jack->card = gb_alloc_array(n, sizeof *jack->card, err);
    jack->ratio = gb_alloc_array(curves * GB_CARD_CURVE_POINTS, sizeof *jack->ratio, err);
    jack->pz = gb_alloc_array(curves * GB_CARD_CURVE_POINTS, sizeof *jack->pz, err);
    jack->room = gb_alloc_array(n, sizeof *jack->room, err);
    return jack->card && jack->ratio && jack->pz && jack->room;
}

static void jackknife_finish(struct jackknife *jack)
{
    gb_alloc_free(jack->card);
    gb_alloc_free(jack->ratio);
    gb_alloc_free(jack->pz);
    gb_alloc_free(jack->room);
}

/* Where the curve of all cells but one begins. */
static size_t curve_of(const struct gb_card_study *study, int path, int cell)
{
    return GB_CARD_CURVE_POINTS * (size_t)(path * study->options.replicas + cell);
}

static void set_grid(const struct gb_card_study *study, double *density)
{
    const double from = study->card.start_density;
    const double to = study->card.density[study->levels - 1];
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        density[i] = from + (to - from) * (i + 1.0) / GB_CARD_CURVE_POINTS;
    }
}

/* A point belongs to the same side of the surface as that of all cells: an interval that
 * contained changes of side would not be one of the parameters. */
static void keep_sides(const struct gb_card_study *study, struct gb_yield_point *points,
                       size_t size)
{
    for (size_t i = 0; i < size; i++) {
        for (size_t j = 0; j < study->points; j++) {
            const struct gb_yield_point *mean = &study->point[j];
            if (mean->density == points[i].density &&
                mean->direction == points[i].direction) {
                points[i].flow_volume = mean->flow_volume;
                points[i].flow_shear = mean->flow_shear;
            }
        }
    }
}

static bool fit_without(struct gb_card_study *study, struct jackknife *jack,
                        const struct gb_card_cell *cells, const double *grid,
                        struct gb_error *err)
{
    const struct gb_card_options *options = &study->options;
    struct gb_yield_point *points =
        gb_alloc_array(GB_CARD_POINTS_MAX, sizeof *points, err);
    bool good = points != NULL;
    for (int c = 0; c < options->replicas && good; c++) {
        const size_t size =
            gb_card_fit_points(cells, options->replicas, c, options, points);
        keep_sides(study, points, size);
        good = gb_card_fit_values(&jack->card[c], cells, options->replicas, c, options,
                                  points, size, err);
        for (int path = 0; path < GB_CARD_PATHS && good; path++) {
            const size_t at = curve_of(study, path, c);
            good =
                gb_card_fit_predict(&jack->card[c], study->levels, options->transition,
                                    (enum gb_card_path)path, grid, GB_CARD_CURVE_POINTS,
                                    jack->ratio + at, jack->pz + at, err);
        }
    }
    gb_alloc_free(points);
    return good;
}

static void take_intervals(struct gb_card_study *study, const struct jackknife *jack)
{
    const int replicas = study->options.replicas;
    for (int k = 0; k < study->levels; k++) {
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            for (int c = 0; c < replicas; c++) {
                jack->room[c] = jack->card[c].value[k][n];
            }
            study->quantity[k][n] =
                with_interval(study->card.value[k][n], jack->room, replicas);
        }
    }
}

/* A curve of pressing at a density, linear between its points. */
static bool curve_at(const GArray *curve, double density, double *px, double *pz)
{
    const struct gb_card_pressed *row =
        (const struct gb_card_pressed *)(void *)curve->data;
    for (guint i = 1; i < curve->len; i++) {
        if (row[i].density >= density && row[i - 1].density < density) {
            const double share =
                (density - row[i - 1].density) / (row[i].density - row[i - 1].density);
            *px = row[i - 1].px_pa + share * (row[i].px_pa - row[i - 1].px_pa);
            *pz = row[i - 1].pz_pa + share * (row[i].pz_pa - row[i - 1].pz_pa);
            return true;
        }
    }
    return false;
}

/* Ratio of the mean pressures; its error by the jackknife.  NaN beyond the end of a cell. */
static void simulate(struct gb_card_compared *at, const struct gb_card_cell *cells,
                     int replicas, int path, double *room)
{
    double px = 0.0, pz = 0.0, one_x, one_z;
    for (int c = 0; c < replicas; c++) {
        const bool there = curve_at(cells[c].curve[path], at->density, &one_x, &one_z);
        room[c] = there ? one_z : (double)NAN;
        px += there ? one_x : (double)NAN;
        pz += room[c];
    }
    at->simulated_pz = isfinite(pz) ? with_error(room, replicas)
                                    : (struct gb_fit_value){NAN, NAN, NAN, NAN};
    for (int c = 0; c < replicas; c++) {
        const bool there = curve_at(cells[c].curve[path], at->density, &one_x, &one_z);
        room[c] = there ? (px - one_x) / (pz - one_z) : (double)NAN;
    }
    at->simulated_ratio = with_interval(px / pz, room, replicas);
}

static bool compare(struct gb_card_study *study, const struct jackknife *jack,
                    const struct gb_card_cell *cells, int path, const double *grid,
                    struct gb_error *err)
{
    const int replicas = study->options.replicas;
    double ratio[GB_CARD_CURVE_POINTS], pz[GB_CARD_CURVE_POINTS];
    if (!gb_card_fit_predict(&study->card, study->levels, study->options.transition,
                             (enum gb_card_path)path, grid, GB_CARD_CURVE_POINTS, ratio,
                             pz, err)) {
        return false;
    }
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        struct gb_card_compared *at = &study->curve[path][i];
        at->density = grid[i];
        simulate(at, cells, replicas, path, jack->room);
        for (int c = 0; c < replicas; c++) {
            jack->room[c] = jack->ratio[curve_of(study, path, c) + (size_t)i];
        }
        at->predicted_ratio = with_interval(ratio[i], jack->room, replicas);
        for (int c = 0; c < replicas; c++) {
            jack->room[c] = jack->pz[curve_of(study, path, c) + (size_t)i];
        }
        at->predicted_pz = with_interval(pz[i], jack->room, replicas);
    }
    return true;
}

static bool fit(struct gb_card_study *study, const struct gb_card_cell *cells,
                struct gb_error *err)
{
    const struct gb_card_options *options = &study->options;
    struct jackknife jack = {.card = NULL};
    double grid[GB_CARD_CURVE_POINTS];
    study->points =
        gb_card_fit_points(cells, options->replicas, -1, options, study->point);
    bool good = gb_card_fit_values(&study->card, cells, options->replicas, -1, options,
                                   study->point, study->points, err) &&
                jackknife_init(&jack, options->replicas, err);
    if (good) {
        set_grid(study, grid);
        good = fit_without(study, &jack, cells, grid, err);
    }
    if (good) {
        take_intervals(study, &jack);
        study->compared_from = study->card.density[1];
    }
    for (int path = 0; path < GB_CARD_PATHS && good; path++) {
        good = compare(study, &jack, cells, path, grid, err);
        if (good) {
            gb_card_misfit_measure(&study->misfit[path], study->curve[path],
                                   study->compared_from);
        }
    }
    jackknife_finish(&jack);
    return good;
}

bool gb_card_study_run(struct gb_card_study *study, const struct gb_params *preset,
                       int jobs, const struct gb_card_callbacks *callbacks,
                       struct gb_error *err)
{
    const double begin = gb_clock_s();
    struct gb_card_threads threads = {
        .options = &study->options, .preset = preset, .callbacks = callbacks};
    const struct gb_pool_callbacks polled = {.cancelled = callbacks->cancelled,
                                             .data = callbacks->data};
    if (!gb_seed_check_cells(preset, (size_t)study->options.replicas, err)) {
        return false;
    }
    if (study->options.levels == 0 &&
        !gb_card_cell_scout(&study->options, preset, DEFAULT_LEVELS, &polled, err)) {
        return false;
    }
    study->levels = study->options.levels;
    const bool good = gb_card_threads_init(&threads, err) &&
                      gb_card_threads_work(&threads, jobs, err) &&
                      fit(study, threads.cell, err);
    gb_card_threads_finish(&threads);
    study->seconds = gb_clock_s() - begin;
    return good;
}
