/* The numbers that are compared with printed ones: how each is read from runs, and the table. */
#include "study/papers_comparisons.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "io/preset.h"
#include "io/state_forces.h"
#include "many/mean_curves.h"
#include "measure/average.h"
#include "measure/power.h"
#include "measure/structure.h"
#include "measure/theory.h"
#include "run/experiment.h"
#include "scene/contact_pair.h"
#include "scene/derived.h"
#include "scene/model.h"

/* --- readings and measures of runs ---------------------------------------------------- */

/* Quantity where loading reaches `at` MPa. */
static double read_loaded(const struct gb_runset_run *run,
                          const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_loaded(run->table, 1e6 * row->at, values);
    return values[row->quantity];
}

/* Quantity unloaded from `at` MPa. */
static double read_unloaded(const struct gb_runset_run *run,
                            const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_unloaded(run->table, 1e6 * row->at, values);
    return values[row->quantity];
}

/* Loaded less unloaded. */
static double read_lost(const struct gb_runset_run *run,
                        const struct gb_papers_comparison *row)
{
    return read_loaded(run, row) - read_unloaded(run, row);
}

/* p_x/p_z where loading reaches `at` MPa. */
static double read_lateral(const struct gb_runset_run *run,
                           const struct gb_papers_comparison *row)
{
    double values[GB_READING_QUANTITIES];
    gb_reading_loaded(run->table, 1e6 * row->at, values);
    return values[GB_READING_PX] / values[GB_READING_PZ];
}

/* The structure is grown again: a run records it relaxed. */
static double read_initial(const struct gb_runset_run *run,
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

/* Particles at which the structure joins its images along all axes, N_1 of P1 section III:
 * it is grown again with the parameters of the run. */
static double read_percolation(const struct gb_runset_run *run,
                               const struct gb_papers_comparison *row)
{
    struct gb_model model;
    int64_t particles = 0;
    (void)row;
    if (!gb_model_init(&model, &run->params, NULL)) {
        return NAN;
    }
    const struct gb_chain_growth grow = gb_chain_growth_from_model(&model);
    return gb_structure_percolation(&grow, &particles, NULL) ? (double)particles
                                                             : (double)NAN;
}

/* Column in the first row of the run. */
static double read_first(const struct gb_runset_run *run,
                         const struct gb_papers_comparison *row)
{
    const double *column = gb_table_column(run->table, row->column, NULL);
    return column != NULL && gb_table_rows(run->table) > 0 ? column[0] : (double)NAN;
}

/* Column where loading reaches density `at`. */
static double read_at_density(const struct gb_runset_run *run,
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

/* Mean normal force of contacts within 25 degrees of the plane across z over that within 25
 * degrees of z, in the last state. */
static double read_across(const struct gb_runset_run *run,
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

/* Fraction of the particles with `contacts` contacts in the kept state snapshots/`column`.h5. */
static double read_share(const struct gb_runset_run *run,
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
    const size_t experiment = gb_papers_plan_index(row->experiment[0]);
    const struct gb_papers_cells *cells = &view->data->experiment[experiment];
    double *values = g_new(double, cells->set.count + 1);
    size_t count = 0;
    double mean = NAN;
    double error = NAN;
    for (size_t i = 0; i < cells->set.count; i++) {
        if (cells->point[i] == point && !gb_papers_plan_lacks(view, experiment, i)) {
            values[count++] = view->reading[i];
        }
    }
    gb_average_values(values, count, &mean, &error);
    g_free(values);
    return mean;
}

/* Mean of the reading at a point. */
double gb_papers_comparisons_mean(const struct gb_papers_view *view,
                                  const struct gb_papers_comparison *row)
{
    return mean_at(view, row, row->point);
}

/* Difference of the means at `point` and `other`. */
double gb_papers_comparisons_difference(const struct gb_papers_view *view,
                                        const struct gb_papers_comparison *row)
{
    return mean_at(view, row, row->point) - mean_at(view, row, row->other);
}

/* Density that a geometry reaches at a pressure; bisection, since it rises with it. */
static double density_of(const struct gb_hardening *law, int geometry, double pressure_pa)
{
    double low = law->start;
    double high = gb_theory_hardening_density_max(law, geometry);
    if (!(gb_theory_hardening_pressure(law, geometry, high) >= pressure_pa)) {
        return NAN;
    }
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        if (gb_theory_hardening_pressure(law, geometry, middle) < pressure_pa) {
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
    good = good &&
           gb_theory_hardening_init(law, GB_GEOMETRY_UNIAXIAL, density, mpa, count, NULL);
    gb_alloc_free(density);
    gb_alloc_free(mpa);
    gb_mean_curves_finish(&curves);
    return good;
}

/* Density at `at` MPa by continuum theory, P1 (18)-(23): isotropic less uniaxial, with the
 * hardening law of the mean curve of `point`, which is uniaxial. */
static double continuum_difference(const struct gb_papers_view *view,
                                   const struct gb_papers_comparison *row)
{
    struct gb_runset set;
    struct gb_hardening law = {0};
    double difference = NAN;
    if (gb_papers_plan_point(view, gb_papers_plan_index(row->experiment[0]), row->point,
                             &set) > 0 &&
        fit_law(&law, &set)) {
        difference = density_of(&law, GB_GEOMETRY_ISOTROPIC, 1e6 * row->at) -
                     density_of(&law, GB_GEOMETRY_UNIAXIAL, 1e6 * row->at);
    }
    gb_theory_hardening_finish(&law);
    g_free(set.run);
    return difference;
}

/* --- dynamic runs: rates and relaxation ----------------------------------------------- */

/* P2's fast stage takes 0.07 to 0.45 ns, its slow one 4 to 30 ns (Table 1): a single
 * exponential belongs to the stage on whose side of this its time lies, ns. */
static const double stages_ns = 1.0;

/* P2 (9), and the densities at which the curves are compared. */
static const double end_density = 0.95;
static const double rate_exponent = 0.25, density_power = 3.0;
static const double densities[] = {0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95};

static bool fit_decay(const struct gb_papers_view *view,
                      const struct gb_papers_comparison *row, struct gb_fit_decay *fit)
{
    struct gb_runset set;
    struct gb_mean_curves curves = {0};
    const bool good = gb_papers_plan_point(view, gb_papers_plan_index(row->experiment[0]),
                                           row->point, &set) > 0 &&
                      gb_mean_curves_relaxation(&curves, &set, 0, NULL) &&
                      gb_mean_curves_decay(fit, curves.curve, curves.count, NULL);
    gb_mean_curves_finish(&curves);
    g_free(set.run);
    return good;
}

/* Mean pressure of an experiment at a density; false with fewer than two cells. */
static bool mean_pressure(const struct gb_papers_view *view, const char *experiment,
                          double density, struct gb_power_point *point)
{
    const struct gb_papers_comparison at = {.column = "p_MPa", .at = density};
    struct gb_runset set;
    const size_t count =
        gb_papers_plan_point(view, gb_papers_plan_index(experiment), 0, &set);
    double *values = g_new(double, count + 1);
    for (size_t i = 0; i < count; i++) {
        values[i] = read_at_density(&set.run[i], &at);
    }
    *point = (struct gb_power_point){.rho = density};
    const size_t used = gb_average_values(values, count, &point->p, &point->error);
    point->v = count > 0 ? set.run[0].params.rate_per_s : 0.0;
    g_free(values);
    g_free(set.run);
    return used > 1 && point->error > 0.0;
}

/* Parameters of P2 (4), fitted to the mean curve of holding: p0, MPa. */
static double rates_p0(const struct gb_papers_view *view,
                       const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    return fit_decay(view, row, &fit) ? fit.p0.value : (double)NAN;
}

/* Of the mean curve, so that it is there without exponentials, too. */
static double rates_fall(const struct gb_papers_view *view,
                         const struct gb_papers_comparison *row)
{
    const double end = rates_p0(view, row);
    struct gb_power_point point;
    (void)mean_pressure(view, row->experiment[0], end_density, &point);
    return point.p - end;
}

/* The slow exponential of a fit; -1: it has none. */
static int find_slow(const struct gb_fit_decay *fit)
{
    const int term = fit->terms - 1;
    return term >= 0 && fit->tau[term].value >= stages_ns ? term : -1;
}

/* Amplitude of the slow stage, MPa. */
static double rates_slow_amplitude(const struct gb_papers_view *view,
                                   const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    const int term = fit_decay(view, row, &fit) ? find_slow(&fit) : -1;
    return term >= 0 ? fit.amplitude[term].value : (double)NAN;
}

/* What the slow stage leaves of the fall: a fit extrapolates to times before its first
 * point. */
static double rates_fast_amplitude(const struct gb_papers_view *view,
                                   const struct gb_papers_comparison *row)
{
    const double slow = rates_slow_amplitude(view, row);
    return rates_fall(view, row) - (isnan(slow) ? 0.0 : slow);
}

/* Where a falling curve that begins at (0, from) first reaches a level; NaN: nowhere. */
static double reach(const double *t, const double *p, size_t count, double from,
                    double level)
{
    double t0 = 0.0;
    double p0 = from;
    for (size_t k = 0; k < count; k++) {
        if (t[k] > t0 && p[k] <= level && p0 > level) {
            return t0 + (p0 - level) / (p0 - p[k]) * (t[k] - t0);
        }
        t0 = t[k];
        p0 = p[k];
    }
    return NAN;
}

/* On the mean curve itself, for the same reason. */
static double rates_fast(const struct gb_papers_view *view,
                         const struct gb_papers_comparison *row)
{
    struct gb_runset set;
    struct gb_mean_curves curves = {0};
    struct gb_power_point start;
    double *t = NULL;
    double *p = NULL;
    size_t count = 0;
    double efold = NAN;
    const double end = rates_p0(view, row);
    (void)mean_pressure(view, row->experiment[0], end_density, &start);
    if (gb_papers_plan_point(view, gb_papers_plan_index(row->experiment[0]), row->point,
                             &set) > 0 &&
        gb_mean_curves_relaxation(&curves, &set, 0, NULL) &&
        gb_mean_curves_mean(curves.curve, curves.count, &t, &p, &count, NULL)) {
        efold = reach(t, p, count, start.p, end + (start.p - end) / M_E);
    }
    gb_alloc_free(t);
    gb_alloc_free(p);
    gb_mean_curves_finish(&curves);
    g_free(set.run);
    return efold < stages_ns ? efold : (double)NAN;
}

/* Longest time constant, ns; NaN unless above 1 ns. */
static double rates_slow(const struct gb_papers_view *view,
                         const struct gb_papers_comparison *row)
{
    struct gb_fit_decay fit;
    const int term = fit_decay(view, row, &fit) ? find_slow(&fit) : -1;
    return term >= 0 ? fit.tau[term].value : (double)NAN;
}

enum { RATE_POINTS = GB_PAPERS_USED * G_N_ELEMENTS(densities) };

static size_t collect(const struct gb_papers_view *view,
                      const struct gb_papers_comparison *row,
                      struct gb_power_point points[RATE_POINTS])
{
    size_t count = 0;
    for (size_t k = 0; k < G_N_ELEMENTS(densities); k++) {
        for (int e = 0; e < GB_PAPERS_USED && row->experiment[e] != NULL; e++) {
            count +=
                mean_pressure(view, row->experiment[e], densities[k], &points[count]);
        }
    }
    return count;
}

/* The law (9) of the scenes; false without runs. */
static bool law_of(const struct gb_papers_view *view,
                   const struct gb_papers_comparison *row, struct gb_power_law *law)
{
    const struct gb_runset *set =
        &view->data->experiment[gb_papers_plan_index(row->experiment[0])].set;
    *law = (struct gb_power_law){rate_exponent, density_power, 0.0};
    if (set->count > 0) {
        law->rho0 = gb_derived_structure_density(&set->run[0].params);
    }
    return set->count > 0;
}

/* P2 (9) fitted to the mean pressures of all its experiments with the printed exponents: k_v,
 * MPa s^(1/4). */
static double rates_kv(const struct gb_papers_view *view,
                       const struct gb_papers_comparison *row)
{
    struct gb_power_point points[RATE_POINTS];
    struct gb_power_law law;
    struct gb_power_rate fit;
    return law_of(view, row, &law) &&
                   gb_power_rate(&fit, &law, points, collect(view, row, points), NULL)
               ? fit.k_v.value
               : (double)NAN;
}

/* k_v v^(1/4) (rho - rho0)^3 at the rate `at`, 1/s, and density 0.95, MPa. */
static double rates_excess(const struct gb_papers_view *view,
                           const struct gb_papers_comparison *row)
{
    struct gb_power_law law;
    return law_of(view, row, &law) ? rates_kv(view, row) * pow(row->at, law.exponent) *
                                         pow(end_density - law.rho0, law.power)
                                   : (double)NAN;
}

/* The exponent of the rate where it is free. */
static double rates_exponent(const struct gb_papers_view *view,
                             const struct gb_papers_comparison *row)
{
    struct gb_power_point points[RATE_POINTS];
    struct gb_power_law law;
    struct gb_fit_value fit;
    return law_of(view, row, &law) &&
                   gb_power_exponent(&fit, &law, points, collect(view, row, points), NULL)
               ? fit.value
               : (double)NAN;
}

/* |density of the asymptote (5)-(8) at the pressure of the mean curve where it reaches
 * density `at`, over that density, less 1|. */
static double rates_asymptote(const struct gb_papers_view *view,
                              const struct gb_papers_comparison *row)
{
    struct gb_power_point point;
    struct gb_model model;
    double density = NAN;
    const struct gb_runset *set =
        &view->data->experiment[gb_papers_plan_index(row->experiment[0])].set;
    return set->count > 0 && mean_pressure(view, row->experiment[0], row->at, &point) &&
                   gb_model_init(&model, &set->run[0].params, NULL) &&
                   gb_theory_density(&model, 1e6 * point.p, &density, NULL)
               ? fabs(density / row->at - 1.0)
               : (double)NAN;
}

/* --- laws alone ----------------------------------------------------------------------- */

static bool load(const char *name, struct gb_params *params)
{
    struct gb_preset *preset = NULL;
    const bool good = gb_preset_load(&preset, name, NULL);
    if (good) {
        *params = *gb_preset_params(preset);
    }
    gb_preset_destroy(preset);
    return good;
}

/* f_a,max = pi gamma d, P1 section II.B. */
static double laws_surface_energy(const struct gb_papers_view *view,
                                  const struct gb_papers_comparison *row)
{
    struct gb_params params;
    struct gb_model model;
    (void)view;
    (void)row;
    return load("p1-set2-9.7nm", &params) && gb_model_init(&model, &params, NULL)
               ? model.dispersion.contact * model.newton_per_force /
                     (M_PI * model.metre_per_length)
               : (double)NAN;
}

/* GPa, bridges of length `at` d. */
static double laws_peel(const struct gb_papers_view *view,
                        const struct gb_papers_comparison *row)
{
    enum { POINTS = 1000 };
    static const double deepest = 0.05; /* the range of P1 Fig. 2, d */
    struct gb_params params;
    struct gb_model model;
    double strongest = 0.0;
    (void)view;
    if (!load("p1-set2-9.7nm", &params)) {
        return NAN;
    }
    params.bridge_length = (struct gb_relative){row->at, true};
    if (!gb_model_init(&model, &params, NULL)) {
        return NAN;
    }
    for (int k = 0; k <= POINTS; k++) {
        const double stress =
            gb_law_bridge_peel_stress(&model.bridge, &model.rod, deepest * k / POINTS);
        strongest = fmax(strongest, 1e-9 * model.pascal_per_stress * stress);
    }
    return strongest;
}

/* s, of P2's discs. */
static double laws_unit_time(const struct gb_papers_view *view,
                             const struct gb_papers_comparison *row)
{
    struct gb_params params;
    (void)view;
    (void)row;
    return load("p2-v1", &params) ? gb_derived_unit_time_s(&params) : (double)NAN;
}

/* Both edges of the square lose the share in a step of 0.04 T: P2 section 2. */
static double laws_rate(const struct gb_papers_view *view,
                        const struct gb_papers_comparison *row)
{
    static const double step = 0.04;
    return 2.0 * row->at / (step * laws_unit_time(view, row));
}

static bool load_pair(const char *name, double exponent, struct gb_contact_pair *pair,
                      struct gb_params *params)
{
    if (!load(name, params)) {
        return false;
    }
    params->hardening = exponent;
    return gb_contact_pair_init(pair, params, NULL);
}

/* Pa, exponent `at`. */
static double laws_hollomon(const struct gb_papers_view *view,
                            const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", row->at, &pair, &params) ? gb_derived_hollomon_pa(&params)
                                                         : (double)NAN;
}

/* N. */
static double laws_yield_force(const struct gb_papers_view *view,
                               const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    (void)row;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_yield_force(&pair.law.hertz, pair.radius, pair.yield_pa)
               : (double)NAN;
}

/* m. */
static double laws_yield_overlap(const struct gb_papers_view *view,
                                 const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_overlap(&pair.law.hertz, pair.radius,
                                      laws_yield_force(view, row))
               : (double)NAN;
}

/* F = `at` MPa x 4 R^2, P3 (31), (32). */
static double pair_force(const struct gb_contact_pair *pair, double mpa)
{
    return 1e6 * mpa * pair->diameter * pair->diameter;
}

/* h/2R at F/4R^2 = `at` MPa. */
static double laws_pair_hertz(const struct gb_papers_view *view,
                              const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_overlap(&pair.law.hertz, pair.radius,
                                      pair_force(&pair, row->at)) /
                     pair.diameter
               : (double)NAN;
}

/* Inverse of (16), which is a power of the overlap. */
static double plastic_overlap(const struct gb_contact_pair *pair, double force)
{
    const double unit = gb_law_storakers_plastic(&pair->law, pair->radius, pair->radius);
    return pair->radius * pow(force / unit, 1.0 / (1.0 + 0.5 * pair->law.exponent));
}

/* The same by P3 (16). */
static double laws_pair_storakers(const struct gb_papers_view *view,
                                  const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", row->hardening, &pair, &params)
               ? plastic_overlap(&pair, pair_force(&pair, row->at)) / pair.diameter
               : (double)NAN;
}

/* m, spheres of 10 and 2 um at `at` N. */
static double laws_unequal(const struct gb_papers_view *view,
                           const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-line", row->hardening, &pair, &params)
               ? plastic_overlap(&pair, row->at)
               : (double)NAN;
}

/* --- the table ------------------------------------------------------------------------ */

/* Points on the axes of the experiments. */
enum { NM_9, NM_16, NM_21, NM_38 };
enum { UNIAXIAL, BIAXIAL, ISOTROPIC };

#define MEAN         .measure = gb_papers_comparisons_mean
#define DIFFERENCE   .measure = gb_papers_comparisons_difference
#define LOADED       .read = read_loaded
#define UNLOADED     .read = read_unloaded
#define LOST         .read = read_lost
#define K            .quantity = GB_READING_COORDINATION
#define FIG5         .experiment = {"P1-fig5"}
#define FIG12        .experiment = {"P1-fig12"}
#define POINTS       .scale = 100.0
#define ALL_RATES    .experiment = {"P2-v1", "P2-v2", "P2-v3", "P2-v4", "P2-v5"}
#define PRESSURE     .read = read_at_density, .column = "p_MPa", .at = 0.95
#define OPTIONS      "radius current, motion full", {"P2-full"}, MEAN
#define LOADED_STATE .read = read_share, .column = "p-1GPa"
#define CONTACTS     .read = read_at_density, .column = "coordination"

static const char stopping[] =
    "a relaxation that ends early gives it, P1 states no stopping rule; "
    "`docs/validation.md`";
static const char coordination[] =
    "no stopping rule of the relaxation explains it; `docs/validation.md`";
static const char first_contacts[] =
    "in a small cell the first particles, which touch fewer others, weigh more";
static const char slow_stage[] =
    "no quantity of the printed model gives a slow stage; `docs/validation.md`";
static const char printed_radius[] =
    "with `contact.bridge_radius = current` and `contact.relative_motion = full` the "
    "pressures are P2's; `docs/validation.md`";
static const char contacts[] =
    "the initial structure decides, (8) begins with 3.05 contacts; "
    "`docs/validation.md`";
static const char rates[] = "the pressures prefer no exponent; `docs/validation.md`";
static const char own_rule[] =
    "the paper's own rule, a curve through the yield point, gives 1049 MPa";
static const char softest[] = "the printed range is from m = 0.1 to 0.2; m = 0 is softer";
static const char own_law[] = "the hardening law comes from the curve here";
static const char filling[] =
    "the paper states neither the funnel nor the gravity nor the damping of its filling";
static const char bed[] = "one bed of the paper; beds scatter, `docs/die.md`";

static const struct gb_papers_comparison table[] = {
    {"P1-gamma", .measure = laws_surface_energy},
    {"P1-fig2-bound", .measure = laws_peel, .at = 0.01},
    {"P1-k-initial", FIG5, MEAN, .read = read_initial, .point = NM_9,
     .why = first_contacts},
    {"P1-fig3", .experiment = {"P1-fig3"}, MEAN, .read = read_percolation},
    {"P1-fig5-9.7nm", FIG5, MEAN, LOADED, .at = 100, .point = NM_9, .why = stopping},
    {"P1-fig5-38nm", FIG5, MEAN, LOADED, .at = 100, .point = NM_38, .why = stopping},
    {"P1-fig5-difference", FIG5, DIFFERENCE, LOADED, POINTS, .at = 100, .point = NM_38,
     .other = NM_9, .why = stopping},
    {"P1-1GPa-loaded", FIG5, DIFFERENCE, LOADED, POINTS, .at = 1000, .point = NM_38,
     .other = NM_9, .why = stopping},
    {"P1-1GPa-unloaded", FIG5, DIFFERENCE, UNLOADED, POINTS, .at = 1000, .point = NM_38,
     .other = NM_9, .why = stopping},
    {"P1-loss", "9.7 nm", FIG5, MEAN, LOST, POINTS, .at = 100, .point = NM_9},
    {"P1-loss", "16 nm", FIG5, MEAN, LOST, POINTS, .at = 100, .point = NM_16},
    {"P1-loss", "21 nm", FIG5, MEAN, LOST, POINTS, .at = 100, .point = NM_21},
    {"P1-loss", "38 nm", FIG5, MEAN, LOST, POINTS, .at = 100, .point = NM_38},
    {"P1-fig6-nobridge",
     NULL,
     {"P1-fig6"},
     DIFFERENCE,
     LOADED,
     POINTS,
     .at = 100,
     .point = NM_38,
     .other = NM_9,
     .why = stopping},
    {"P1-fig8-9.7nm", FIG5, MEAN, LOADED, K, .at = 1000, .point = NM_9,
     .why = coordination},
    {"P1-fig8-38nm", FIG5, MEAN, LOADED, K, .at = 1000, .point = NM_38,
     .why = coordination},
    {"P1-fig8-unloaded-9.7nm", FIG5, MEAN, UNLOADED, K, .at = 1000, .point = NM_9,
     .why = coordination},
    {"P1-fig8-unloaded-38nm", FIG5, MEAN, UNLOADED, K, .at = 1000, .point = NM_38,
     .why = coordination},
    {"P1-ten-9.7nm", FIG5, MEAN, LOADED_STATE, POINTS, .contacts = 10, .point = NM_9,
     .why = coordination},
    {"P1-ten-38nm", FIG5, MEAN, LOADED_STATE, POINTS, .contacts = 10, .point = NM_38,
     .why = coordination},
    {"P1-twelve", "9.7 nm", FIG5, MEAN, LOADED_STATE, POINTS, .contacts = 12,
     .point = NM_9},
    {"P1-twelve", "38 nm", FIG5, MEAN, LOADED_STATE, POINTS, .contacts = 12,
     .point = NM_38},
    {"P1-fig11-100", FIG12, MEAN, UNLOADED, .at = 100, .point = UNIAXIAL,
     .why = stopping},
    {"P1-fig12-100", FIG12, DIFFERENCE, UNLOADED, POINTS, .at = 100, .point = ISOTROPIC,
     .other = UNIAXIAL},
    {"P1-fig12-200", FIG12, DIFFERENCE, UNLOADED, POINTS, .at = 200, .point = ISOTROPIC,
     .other = UNIAXIAL, .why = stopping},
    {"P1-continuum-100", FIG12, .measure = continuum_difference, POINTS, .at = 100,
     .point = UNIAXIAL, .why = own_law},
    {"P1-continuum-200", FIG12, .measure = continuum_difference, POINTS, .at = 200,
     .point = UNIAXIAL, .why = own_law},
    {"P1-fig13-uniaxial", FIG12, MEAN, .read = read_lateral, .at = 100,
     .point = UNIAXIAL},
    {"P1-fig13-biaxial", FIG12, MEAN, .read = read_lateral, .at = 100, .point = BIAXIAL},
    {"P1-fig14", "uniaxial", FIG12, MEAN, .read = read_across, .point = UNIAXIAL},
    {"P1-fig14", "biaxial", FIG12, MEAN, .read = read_across, .point = BIAXIAL},
    {"P2-T", .measure = laws_unit_time, .scale = 1e12},
    {"P2-v1", .measure = laws_rate, .at = 1e-5, .scale = 1e-8},
    {"P2-asymptote", .experiment = {"P2-v1"}, .measure = rates_asymptote, .at = 0.95,
     POINTS},
    {"P2-eq8-0.8", "v1", {"P2-v1"}, MEAN, CONTACTS, .at = 0.8, .why = contacts},
    {"P2-eq8-0.8", "v3", {"P2-v3"}, MEAN, CONTACTS, .at = 0.8, .why = contacts},
    {"P2-eq8-0.9", "v1", {"P2-v1"}, MEAN, CONTACTS, .at = 0.9, .why = contacts},
    {"P2-eq8-0.9", "v3", {"P2-v3"}, MEAN, CONTACTS, .at = 0.9, .why = contacts},
    {"P2-eq8-0.95", "v1", {"P2-v1"}, MEAN, CONTACTS, .at = 0.95, .why = contacts},
    {"P2-eq8-0.95", "v3", {"P2-v3"}, MEAN, CONTACTS, .at = 0.95, .why = contacts},
    {"P2-table1-v1-p", NULL, {"P2-v1"}, MEAN, PRESSURE, .why = printed_radius},
    {"P2-table1-v2-p", NULL, {"P2-v2"}, MEAN, PRESSURE, .why = printed_radius},
    {"P2-table1-v3-p", NULL, {"P2-v3"}, MEAN, PRESSURE, .why = printed_radius},
    {"P2-table1-v4-p", NULL, {"P2-v4"}, MEAN, PRESSURE, .why = printed_radius},
    {"P2-table1-v5-p", NULL, {"P2-v5"}, MEAN, PRESSURE, .why = printed_radius},
    {"P2-table1-v1-p", OPTIONS, PRESSURE, .point = 0},
    {"P2-table1-v2-p", OPTIONS, PRESSURE, .point = 1},
    {"P2-table1-v3-p", OPTIONS, PRESSURE, .point = 2},
    {"P2-table1-v1-p0", .experiment = {"P2-v1"}, .measure = rates_p0,
     .why = printed_radius},
    {"P2-table1-v2-p0", .experiment = {"P2-v2"}, .measure = rates_p0,
     .why = printed_radius},
    {"P2-table1-v3-p0", .experiment = {"P2-v3"}, .measure = rates_p0,
     .why = printed_radius},
    {"P2-table1-v4-p0", .experiment = {"P2-v4"}, .measure = rates_p0,
     .why = printed_radius},
    {"P2-table1-v5-p0", .experiment = {"P2-v5"}, .measure = rates_p0,
     .why = printed_radius},
    {"P2-table1-v1-fall", .experiment = {"P2-v1"}, .measure = rates_fall,
     .why = slow_stage},
    {"P2-table1-v2-fall", .experiment = {"P2-v2"}, .measure = rates_fall,
     .why = slow_stage},
    {"P2-table1-v3-fall", .experiment = {"P2-v3"}, .measure = rates_fall,
     .why = slow_stage},
    {"P2-table1-v4-fall", .experiment = {"P2-v4"}, .measure = rates_fall,
     .why = slow_stage},
    {"P2-table1-v5-fall", .experiment = {"P2-v5"}, .measure = rates_fall,
     .why = slow_stage},
    {"P2-table1-v1-tau1", .experiment = {"P2-v1"}, .measure = rates_fast},
    {"P2-table1-v2-tau1", .experiment = {"P2-v2"}, .measure = rates_fast},
    {"P2-table1-v3-tau1", .experiment = {"P2-v3"}, .measure = rates_fast},
    {"P2-table1-v4-tau1", .experiment = {"P2-v4"}, .measure = rates_fast},
    {"P2-table1-v1-tau2", .experiment = {"P2-v1"}, .measure = rates_slow,
     .why = slow_stage},
    {"P2-table1-v2-tau2", .experiment = {"P2-v2"}, .measure = rates_slow,
     .why = slow_stage},
    {"P2-table1-v3-tau2", .experiment = {"P2-v3"}, .measure = rates_slow,
     .why = slow_stage},
    {"P2-table1-v4-tau2", .experiment = {"P2-v4"}, .measure = rates_slow,
     .why = slow_stage},
    {"P2-table1-v1-p1", .experiment = {"P2-v1"}, .measure = rates_fast_amplitude},
    {"P2-table1-v2-p1", .experiment = {"P2-v2"}, .measure = rates_fast_amplitude},
    {"P2-table1-v3-p1", .experiment = {"P2-v3"}, .measure = rates_fast_amplitude},
    {"P2-table1-v4-p1", .experiment = {"P2-v4"}, .measure = rates_fast_amplitude},
    {"P2-table1-v1-p2", .experiment = {"P2-v1"}, .measure = rates_slow_amplitude,
     .why = slow_stage},
    {"P2-table1-v2-p2", .experiment = {"P2-v2"}, .measure = rates_slow_amplitude,
     .why = slow_stage},
    {"P2-table1-v3-p2", .experiment = {"P2-v3"}, .measure = rates_slow_amplitude,
     .why = slow_stage},
    {"P2-table1-v4-p2", .experiment = {"P2-v4"}, .measure = rates_slow_amplitude,
     .why = slow_stage},
    {"P2-table1-v5-p2", .experiment = {"P2-v5"}, .measure = rates_slow_amplitude,
     .why = slow_stage},
    {"P2-fig4-0.95", ALL_RATES, .measure = rates_excess, .at = 1e8, .why = rates},
    {"P2-eq9-kv", ALL_RATES, .measure = rates_kv, .why = rates},
    {"P2-eq9-exponent", ALL_RATES, .measure = rates_exponent, .why = rates},
    {"P3-sigma0-0.05", .measure = laws_hollomon, .at = 0.05, .scale = 1e-6,
     .why = own_rule},
    {"P3-sigma0-0.1", .measure = laws_hollomon, .at = 0.1, .scale = 1e-6},
    {"P3-sigma0-0.2", .measure = laws_hollomon, .at = 0.2, .scale = 1e-6},
    {"P3-yield-force", .measure = laws_yield_force, .scale = 1e5},
    {"P3-yield-overlap", .measure = laws_yield_overlap, .scale = 1e9},
    {"P3-pair-hertz", .measure = laws_pair_hertz, .at = 50, POINTS},
    {"P3-pair-storakers", "m = 0", .measure = laws_pair_storakers, .at = 50,
     .hardening = 0, POINTS},
    {"P3-pair-storakers", "m = 0.1", .measure = laws_pair_storakers, .at = 50,
     .hardening = 0.1, POINTS},
    {"P3-pair-storakers", "m = 0.2", .measure = laws_pair_storakers, .at = 50,
     .hardening = 0.2, POINTS},
    {"P3-three-spheres", "m = 0", .measure = laws_unequal, .at = 0.02, .hardening = 0,
     .scale = 1e6, .why = softest},
    {"P3-three-spheres", "m = 0.1", .measure = laws_unequal, .at = 0.02, .hardening = 0.1,
     .scale = 1e6},
    {"P3-three-spheres", "m = 0.2", .measure = laws_unequal, .at = 0.02, .hardening = 0.2,
     .scale = 1e6},
    {"P3-H0",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = read_first,
     .column = "height_um",
     .why = bed},
    {"P3-density-whole",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = read_first,
     .column = "density",
     .why = bed},
    {"P3-density-central",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = read_first,
     .column = "central_density",
     .why = filling},
    {0},
};

const struct gb_papers_comparison *gb_papers_comparisons_table(void)
{
    return table;
}

/* What a row reads from the runs of its points in its first experiment, NaN for the others;
 * NULL: it reads none. */
static double *read_runs(const struct gb_papers_comparison *row,
                         const struct gb_papers_data *data)
{
    if (row->read == NULL) {
        return NULL;
    }
    const struct gb_papers_cells *cells =
        &data->experiment[gb_papers_plan_index(row->experiment[0])];
    double *reading = g_new(double, cells->set.count + 1);
    for (size_t i = 0; i < cells->set.count; i++) {
        const bool used = cells->point[i] == row->point || cells->point[i] == row->other;
        reading[i] = used ? row->read(&cells->set.run[i], row) : (double)NAN;
    }
    return reading;
}

/* Variance by the jackknife over the cells of one experiment; NaN with fewer than two. */
static double variance(const struct gb_papers_comparison *row,
                       const struct gb_papers_view *all, size_t experiment)
{
    const size_t cells = all->data->experiment[experiment].most;
    double *without = g_new(double, cells + 1);
    for (size_t k = 0; k < cells; k++) {
        const struct gb_papers_view view = {all->data, experiment, k, all->reading};
        without[k] = row->measure(&view, row);
    }
    const double error = gb_average_jackknife(without, cells);
    g_free(without);
    return error * error;
}

static size_t count_cells(const struct gb_papers_data *data, const char *experiment,
                          size_t point)
{
    const struct gb_papers_cells *cells =
        &data->experiment[gb_papers_plan_index(experiment)];
    size_t count = 0;
    for (size_t i = 0; i < cells->set.count; i++) {
        count += cells->point[i] == point;
    }
    return count;
}

/* Cells of the first experiment at the point of a row, of a difference the fewer ones. */
static size_t cells_of(const struct gb_papers_comparison *row,
                       const struct gb_papers_data *data)
{
    if (row->experiment[0] == NULL) {
        return 0;
    }
    const size_t count = count_cells(data, row->experiment[0], row->point);
    return row->measure == gb_papers_comparisons_difference
               ? MIN(count, count_cells(data, row->experiment[0], row->other))
               : count;
}

size_t gb_papers_comparisons_value(const struct gb_papers_comparison *row,
                                   const struct gb_papers_data *data, double *value,
                                   double *error)
{
    double *reading = read_runs(row, data);
    const struct gb_papers_view all = {data, GB_PAPERS_EXPERIMENTS_MOST, 0, reading};
    const double scale = row->scale != 0.0 ? row->scale : 1.0;
    double sum = row->experiment[0] != NULL ? 0.0 : (double)NAN;
    *value = scale * row->measure(&all, row);
    for (int e = 0; e < GB_PAPERS_USED && row->experiment[e] != NULL; e++) {
        const size_t index = gb_papers_plan_index(row->experiment[e]);
        const size_t cells = data->experiment[index].most;
        if (cells > 1 || e == 0) { /* one cell alone weighs nothing in a fit of several */
            sum += isfinite(*value) ? variance(row, &all, index) : (double)NAN;
        }
    }
    *error = scale * sqrt(sum);
    g_free(reading);
    return cells_of(row, data);
}
