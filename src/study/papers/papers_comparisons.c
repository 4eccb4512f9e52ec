#include "study/papers/papers_comparisons.h"

#include <math.h>

#include <glib.h>

#include "measure/fit/average.h"
#include "study/papers/papers_measures.h"

/* Points on the axes of the experiments. */
enum { NM_9, NM_16, NM_21, NM_38 };
enum { UNIAXIAL, BIAXIAL, ISOTROPIC };

#define MEAN         .measure = gb_papers_measures_mean
#define DIFFERENCE   .measure = gb_papers_measures_difference
#define LOADED       .read = gb_papers_measures_loaded
#define UNLOADED     .read = gb_papers_measures_unloaded
#define LOST         .read = gb_papers_measures_lost
#define K            .quantity = GB_READING_COORDINATION
#define FIG5         .experiment = {"P1-fig5"}
#define FIG12        .experiment = {"P1-fig12"}
#define POINTS       .scale = 100.0
#define ALL_RATES    .experiment = {"P2-v1", "P2-v2", "P2-v3", "P2-v4", "P2-v5"}
#define PRESSURE     .read = gb_papers_measures_at_density, .column = "p_MPa", .at = 0.95
#define OPTIONS      "radius current, motion full", {"P2-full"}, MEAN
#define LOADED_STATE .read = gb_papers_measures_share, .column = "p-1GPa"
#define CONTACTS     .read = gb_papers_measures_at_density, .column = "coordination"

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
static const char softest[] =
    "the printed range is that of m = 0.1 and 0.2; m = 0 is softer";
static const char own_law[] = "the hardening law is that of the curve here";
static const char filling[] =
    "the paper states neither the funnel nor the gravity nor the damping of its filling";
static const char bed[] = "one bed of the paper; beds scatter, `docs/die.md`";

static const struct gb_papers_comparison table[] = {
    {"P1-gamma", .measure = gb_papers_laws_surface_energy},
    {"P1-fig2-bound", .measure = gb_papers_laws_peel, .at = 0.01},
    {"P1-k-initial", FIG5, MEAN, .read = gb_papers_measures_initial, .point = NM_9,
     .why = first_contacts},
    {"P1-fig3", .experiment = {"P1-fig3"}, MEAN, .read = gb_papers_measures_percolation},
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
    {"P1-continuum-100", FIG12, .measure = gb_papers_measures_continuum, POINTS,
     .at = 100, .point = UNIAXIAL, .why = own_law},
    {"P1-continuum-200", FIG12, .measure = gb_papers_measures_continuum, POINTS,
     .at = 200, .point = UNIAXIAL, .why = own_law},
    {"P1-fig13-uniaxial", FIG12, MEAN, .read = gb_papers_measures_lateral, .at = 100,
     .point = UNIAXIAL},
    {"P1-fig13-biaxial", FIG12, MEAN, .read = gb_papers_measures_lateral, .at = 100,
     .point = BIAXIAL},
    {"P1-fig14", "uniaxial", FIG12, MEAN, .read = gb_papers_measures_across,
     .point = UNIAXIAL},
    {"P1-fig14", "biaxial", FIG12, MEAN, .read = gb_papers_measures_across,
     .point = BIAXIAL},
    {"P2-T", .measure = gb_papers_laws_unit_time, .scale = 1e12},
    {"P2-v1", .measure = gb_papers_laws_rate, .at = 1e-5, .scale = 1e-8},
    {"P2-asymptote", .experiment = {"P2-v1"}, .measure = gb_papers_rates_asymptote,
     .at = 0.95, POINTS},
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
    {"P2-table1-v1-p0", .experiment = {"P2-v1"}, .measure = gb_papers_rates_p0,
     .why = printed_radius},
    {"P2-table1-v2-p0", .experiment = {"P2-v2"}, .measure = gb_papers_rates_p0,
     .why = printed_radius},
    {"P2-table1-v3-p0", .experiment = {"P2-v3"}, .measure = gb_papers_rates_p0,
     .why = printed_radius},
    {"P2-table1-v4-p0", .experiment = {"P2-v4"}, .measure = gb_papers_rates_p0,
     .why = printed_radius},
    {"P2-table1-v5-p0", .experiment = {"P2-v5"}, .measure = gb_papers_rates_p0,
     .why = printed_radius},
    {"P2-table1-v1-fall", .experiment = {"P2-v1"}, .measure = gb_papers_rates_fall,
     .why = slow_stage},
    {"P2-table1-v2-fall", .experiment = {"P2-v2"}, .measure = gb_papers_rates_fall,
     .why = slow_stage},
    {"P2-table1-v3-fall", .experiment = {"P2-v3"}, .measure = gb_papers_rates_fall,
     .why = slow_stage},
    {"P2-table1-v4-fall", .experiment = {"P2-v4"}, .measure = gb_papers_rates_fall,
     .why = slow_stage},
    {"P2-table1-v5-fall", .experiment = {"P2-v5"}, .measure = gb_papers_rates_fall,
     .why = slow_stage},
    {"P2-table1-v1-tau1", .experiment = {"P2-v1"}, .measure = gb_papers_rates_fast},
    {"P2-table1-v2-tau1", .experiment = {"P2-v2"}, .measure = gb_papers_rates_fast},
    {"P2-table1-v3-tau1", .experiment = {"P2-v3"}, .measure = gb_papers_rates_fast},
    {"P2-table1-v4-tau1", .experiment = {"P2-v4"}, .measure = gb_papers_rates_fast},
    {"P2-table1-v1-tau2", .experiment = {"P2-v1"}, .measure = gb_papers_rates_slow,
     .why = slow_stage},
    {"P2-table1-v2-tau2", .experiment = {"P2-v2"}, .measure = gb_papers_rates_slow,
     .why = slow_stage},
    {"P2-table1-v3-tau2", .experiment = {"P2-v3"}, .measure = gb_papers_rates_slow,
     .why = slow_stage},
    {"P2-table1-v4-tau2", .experiment = {"P2-v4"}, .measure = gb_papers_rates_slow,
     .why = slow_stage},
    {"P2-table1-v1-p1", .experiment = {"P2-v1"},
     .measure = gb_papers_rates_fast_amplitude},
    {"P2-table1-v2-p1", .experiment = {"P2-v2"},
     .measure = gb_papers_rates_fast_amplitude},
    {"P2-table1-v3-p1", .experiment = {"P2-v3"},
     .measure = gb_papers_rates_fast_amplitude},
    {"P2-table1-v4-p1", .experiment = {"P2-v4"},
     .measure = gb_papers_rates_fast_amplitude},
    {"P2-table1-v1-p2", .experiment = {"P2-v1"},
     .measure = gb_papers_rates_slow_amplitude, .why = slow_stage},
    {"P2-table1-v2-p2", .experiment = {"P2-v2"},
     .measure = gb_papers_rates_slow_amplitude, .why = slow_stage},
    {"P2-table1-v3-p2", .experiment = {"P2-v3"},
     .measure = gb_papers_rates_slow_amplitude, .why = slow_stage},
    {"P2-table1-v4-p2", .experiment = {"P2-v4"},
     .measure = gb_papers_rates_slow_amplitude, .why = slow_stage},
    {"P2-table1-v5-p2", .experiment = {"P2-v5"},
     .measure = gb_papers_rates_slow_amplitude, .why = slow_stage},
    {"P2-fig4-0.95", ALL_RATES, .measure = gb_papers_rates_excess, .at = 1e8,
     .why = rates},
    {"P2-eq9-kv", ALL_RATES, .measure = gb_papers_rates_kv, .why = rates},
    {"P2-eq9-exponent", ALL_RATES, .measure = gb_papers_rates_exponent, .why = rates},
    {"P3-sigma0-0.05", .measure = gb_papers_laws_hollomon, .at = 0.05, .scale = 1e-6,
     .why = own_rule},
    {"P3-sigma0-0.1", .measure = gb_papers_laws_hollomon, .at = 0.1, .scale = 1e-6},
    {"P3-sigma0-0.2", .measure = gb_papers_laws_hollomon, .at = 0.2, .scale = 1e-6},
    {"P3-yield-force", .measure = gb_papers_laws_yield_force, .scale = 1e5},
    {"P3-yield-overlap", .measure = gb_papers_laws_yield_overlap, .scale = 1e9},
    {"P3-pair-hertz", .measure = gb_papers_laws_pair_hertz, .at = 50, POINTS},
    {"P3-pair-storakers", "m = 0", .measure = gb_papers_laws_pair_storakers, .at = 50,
     .hardening = 0, POINTS},
    {"P3-pair-storakers", "m = 0.1", .measure = gb_papers_laws_pair_storakers, .at = 50,
     .hardening = 0.1, POINTS},
    {"P3-pair-storakers", "m = 0.2", .measure = gb_papers_laws_pair_storakers, .at = 50,
     .hardening = 0.2, POINTS},
    {"P3-three-spheres", "m = 0", .measure = gb_papers_laws_unequal, .at = 0.02,
     .hardening = 0, .scale = 1e6, .why = softest},
    {"P3-three-spheres", "m = 0.1", .measure = gb_papers_laws_unequal, .at = 0.02,
     .hardening = 0.1, .scale = 1e6},
    {"P3-three-spheres", "m = 0.2", .measure = gb_papers_laws_unequal, .at = 0.02,
     .hardening = 0.2, .scale = 1e6},
    {"P3-H0",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = gb_papers_measures_first,
     .column = "height_um",
     .why = bed},
    {"P3-density-whole",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = gb_papers_measures_first,
     .column = "density",
     .why = bed},
    {"P3-density-central",
     NULL,
     {"P3-hertz"},
     MEAN,
     .read = gb_papers_measures_first,
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
        &data->experiment[gb_papers_experiments_index(row->experiment[0])];
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
        &data->experiment[gb_papers_experiments_index(experiment)];
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
    return row->measure == gb_papers_measures_difference
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
        const size_t index = gb_papers_experiments_index(row->experiment[e]);
        const size_t cells = data->experiment[index].most;
        if (cells > 1 || e == 0) { /* one cell alone weighs nothing in a fit of several */
            sum += isfinite(*value) ? variance(row, &all, index) : (double)NAN;
        }
    }
    *error = scale * sqrt(sum);
    g_free(reading);
    return cells_of(row, data);
}
