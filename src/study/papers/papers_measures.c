#include "study/papers/papers_measures.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "io/state/state_forces.h"
#include "many/mean_curves.h"
#include "measure/hardening.h"
#include "measure/percolation.h"
#include "run/experiment.h"

double gb_papers_measures_loaded(const struct gb_runset_run *run,
                                 const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_loaded(run->table, 1e6 * row->at, values);
    return values[row->quantity];
}

double gb_papers_measures_unloaded(const struct gb_runset_run *run,
                                   const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_unloaded(run->table, 1e6 * row->at, values);
    return values[row->quantity];
}

double gb_papers_measures_lost(const struct gb_runset_run *run,
                               const struct gb_papers_comparison *row)
{
    return gb_papers_measures_loaded(run, row) - gb_papers_measures_unloaded(run, row);
}

double gb_papers_measures_lateral(const struct gb_runset_run *run,
                                  const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_loaded(run->table, 1e6 * row->at, values);
    return values[GB_READING_PX] / values[GB_READING_PZ];
}

/* The structure is grown again: a run records it relaxed. */
double gb_papers_measures_initial(const struct gb_runset_run *run,
                                  const struct gb_papers_comparison *row)
{
    struct gb_experiment *experiment = NULL;
    struct gb_state *state = NULL;
    double coordination = NAN;
    (void)row;
    if (gb_experiment_create(&experiment, &run->params, NULL, NULL, NULL) &&
        gb_experiment_state(experiment, &state, NULL)) {
        coordination = state->point.coordination;
    }
    gb_state_destroy(state);
    gb_experiment_destroy(experiment);
    return coordination;
}

double gb_papers_measures_percolation(const struct gb_runset_run *run,
                                      const struct gb_papers_comparison *row)
{
    struct gb_model model;
    int64_t particles = 0;
    (void)row;
    if (!gb_model_init(&model, &run->params, NULL)) {
        return NAN;
    }
    const struct gb_chain_growth grow = gb_chain_growth_from_model(&model);
    return gb_percolation_find(&grow, &particles, NULL) ? (double)particles : (double)NAN;
}

double gb_papers_measures_first(const struct gb_runset_run *run,
                                const struct gb_papers_comparison *row)
{
    const double *column = gb_table_column(run->table, row->column, NULL);
    return column != NULL && gb_table_rows(run->table) > 0 ? column[0] : (double)NAN;
}

double gb_papers_measures_last(const struct gb_runset_run *run,
                               const struct gb_papers_comparison *row)
{
    const double *column = gb_table_column(run->table, row->column, NULL);
    for (size_t i = gb_table_rows(run->table); column != NULL && i > 0; i--) {
        if (strcmp(gb_table_word(run->table, i - 1), "load") == 0) {
            return column[i - 1];
        }
    }
    return NAN;
}

double gb_papers_measures_at_density(const struct gb_runset_run *run,
                                     const struct gb_papers_comparison *row)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    double value = NAN;
    if (gb_runset_points(run, "load", "density", row->column, &x, &y, &count, NULL)) {
        const struct gb_average_curve curve = {x, y, count};
        /* the end of a run may miss its last density by rounding */
        const bool end = fabs(x[count - 1] - row->at) < 1e-9 * row->at;
        value = gb_average_crossing(&curve, end ? fmin(x[count - 1], row->at) : row->at,
                                    NULL);
    }
    gb_alloc_free(x);
    gb_alloc_free(y);
    return value;
}

/* Mean over bins of the angle to z, from..to-1. */
static double mean_of(const double *force, int from, int to)
{
    double sum = 0.0;
    for (int k = from; k < to; k++) {
        sum += force[k] / (to - from);
    }
    return sum;
}

double gb_papers_measures_across(const struct gb_runset_run *run,
                                 const struct gb_papers_comparison *row)
{
    enum { ANGLES = GB_STATE_FORCES_ANGLES, SIDE = 5 }; /* 25 degrees */
    double force[ANGLES];
    double ratio = NAN;
    struct gb_state *state = NULL;
    char *path = g_build_filename(run->directory, "state.h5", NULL);
    (void)row;
    if (gb_state_read(&state, path, NULL)) {
        gb_state_forces_by_angle(state, force);
        ratio = mean_of(force, ANGLES - SIDE, ANGLES) / mean_of(force, 0, SIDE);
    }
    gb_state_destroy(state);
    g_free(path);
    return ratio;
}

double gb_papers_measures_share(const struct gb_runset_run *run,
                                const struct gb_papers_comparison *row)
{
    struct gb_state *state = NULL;
    int64_t found = 0;
    double share = NAN;
    char *path = g_strdup_printf("%s/snapshots/%s.h5", run->directory, row->column);
    if (gb_state_read(&state, path, NULL)) {
        for (int64_t i = 0; i < state->count; i++) {
            found += state->contacts[i] == row->contacts;
        }
        share = (double)found / (double)state->count;
    }
    gb_state_destroy(state);
    g_free(path);
    return share;
}

/* Mean of the readings at a point. */
static double mean_at(const struct gb_papers_view *view,
                      const struct gb_papers_comparison *row, size_t point)
{
    const size_t experiment = gb_papers_experiments_index(row->experiment[0]);
    const struct gb_papers_cells *cells = &view->data->experiment[experiment];
    double *values = g_new(double, cells->set.count + 1);
    size_t count = 0;
    double mean = NAN;
    double error = NAN;
    for (size_t i = 0; i < cells->set.count; i++) {
        if (cells->point[i] == point && !gb_papers_sample_lacks(view, experiment, i)) {
            values[count++] = view->reading[i];
        }
    }
    gb_average_values(values, count, &mean, &error);
    g_free(values);
    return mean;
}

double gb_papers_measures_mean(const struct gb_papers_view *view,
                               const struct gb_papers_comparison *row)
{
    return mean_at(view, row, row->point);
}

double gb_papers_measures_difference(const struct gb_papers_view *view,
                                     const struct gb_papers_comparison *row)
{
    return mean_at(view, row, row->point) - mean_at(view, row, row->other);
}

/* Density that a geometry reaches at a pressure; bisection, since it rises with it. */
static double density_of(const struct gb_hardening *law, int geometry, double pressure_pa)
{
    double low = law->start;
    double high = gb_hardening_density_max(law, geometry);
    if (!(gb_hardening_pressure(law, geometry, high) >= pressure_pa)) {
        return NAN;
    }
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        if (gb_hardening_pressure(law, geometry, middle) < pressure_pa) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

/* The hardening law of the mean curve of a point. */
static bool fit_law(struct gb_hardening *law, const struct gb_runset *set)
{
    struct gb_mean_curves curves;
    double *density = NULL;
    double *mpa = NULL;
    size_t count = 0;
    bool good =
        gb_mean_curves_read(&curves, set, 0, "load", "density", "p_MPa", NULL) &&
        gb_mean_curves_mean(curves.curve, curves.count, &density, &mpa, &count, NULL);
    for (size_t i = 0; i < count && good; i++) {
        mpa[i] *= 1e6;
    }
    good =
        good && gb_hardening_init(law, GB_GEOMETRY_UNIAXIAL, density, mpa, count, NULL);
    gb_alloc_free(density);
    gb_alloc_free(mpa);
    gb_mean_curves_finish(&curves);
    return good;
}

double gb_papers_measures_continuum(const struct gb_papers_view *view,
                                    const struct gb_papers_comparison *row)
{
    struct gb_runset set;
    struct gb_hardening law = {0};
    double difference = NAN;
    if (gb_papers_sample_point(view, gb_papers_experiments_index(row->experiment[0]),
                               row->point, &set) > 0 &&
        fit_law(&law, &set)) {
        difference = density_of(&law, GB_GEOMETRY_ISOTROPIC, 1e6 * row->at) -
                     density_of(&law, GB_GEOMETRY_UNIAXIAL, 1e6 * row->at);
    }
    gb_hardening_finish(&law);
    g_free(set.run);
    return difference;
}
