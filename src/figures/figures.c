#include "figures/figures.h"

#include <math.h>
#include <string.h>

#include "figures/figures_chart.h"
#include "figures/figures_continuum.h"
#include "figures/figures_curve.h"
#include "figures/figures_die.h"
#include "figures/figures_label.h"
#include "figures/figures_law.h"
#include "figures/figures_pair.h"
#include "figures/figures_rate.h"
#include "figures/figures_relaxation.h"
#include "figures/figures_state.h"
#include "figures/figures_sweep.h"
#include "measure/theory.h"
#include "scene/loading_kind.h"
#include "scene/model.h"

#define RHO "<i>\xcf\x81</i>"

/* P2 Fig. 1. */
static bool compute_time(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    if (!gb_series_sample(&sample, set, NULL, "time_ns", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_axes(series, "time_ns", "time <i>t</i> (ns)", "p_MPa",
                   "pressure <i>p</i> (MPa)");
    const double *grid = gb_series_sample_grid(series, &sample, "time_ns");
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        gb_series_note(series, "run %zu: %s, group %zu", i + 1, run->directory,
                       run->group + 1);
        double *column = gb_series_column(series, "run_%zu_MPa", i + 1);
        memcpy(column, sample.rows + i * sample.size, sample.size * sizeof *column);
        if (gb_runset_members(set, run->group) > 1) {
            gb_series_draw(series, grid, column, NULL, GB_FIGURE_FAINT, (int)run->group,
                           NULL);
        }
    }
    const bool good = gb_figures_label_means(series, &sample, set, grid, err);
    gb_series_sample_finish(&sample);
    return good;
}

/* Models whose asymptotes are one curve. */
static bool same_asymptote(const struct gb_model *a, const struct gb_model *b)
{
    return a->rod.hertz == b->rod.hertz && a->rod.rod == b->rod.rod &&
           a->adhesion == b->adhesion && a->pascal_per_stress == b->pascal_per_stress;
}

/* P2 (5)-(8), once for groups of equal laws. */
static bool asymptote_columns(struct gb_series *series, const double *density,
                              const struct gb_runset *set, struct gb_error *err)
{
    struct gb_model *models = g_new0(struct gb_model, set->groups);
    size_t known = 0;
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (!gb_loading_kind_of(params)->given_rate || params->dimension != 2) {
            continue;
        }
        struct gb_model *model = &models[known];
        good = gb_model_init(model, params, err);
        bool seen = !good;
        for (size_t i = 0; i < known && !seen; i++) {
            seen = same_asymptote(&models[i], model);
        }
        if (seen) {
            continue;
        }
        known++;
        gb_series_note(series, "asymptote %zu: P2 (5)-(8) with the laws of group %zu",
                       known, g + 1);
        double *column = gb_series_column(series, "asymptote_%zu_MPa", known);
        for (size_t i = 0; i < series->rows; i++) {
            column[i] = 1e-6 * gb_theory_pressure(model, density[i]);
        }
        gb_series_draw(series, density, column, NULL, GB_FIGURE_LINE,
                       (int)(set->groups + known - 1), "asymptote");
        series->y.low = 0.0; /* where it pulls it means nothing */
    }
    g_free(models);
    return good;
}

/* The beginning of the curves drawn larger, as in P1 Fig. 5: up to a share of the highest
 * pressure. */
static void magnify_beginning(struct gb_series *series, size_t groups)
{
    const double share = 0.05;
    const double *density = g_ptr_array_index(series->columns, 0);
    double most = 0.0;
    size_t last = series->rows;
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        for (size_t i = 0; i < series->rows; i++) {
            most = isfinite(mean[i]) ? fmax(most, mean[i]) : most;
        }
    }
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        size_t i = 0;
        while (i < last && !(mean[i] > share * most)) {
            i++;
        }
        last = i;
    }
    if (last > 1 && last < series->rows) {
        series->inset[0] = density[0];
        series->inset[1] = density[last];
    }
}

static bool all_quasistatic(const struct gb_runset *set)
{
    for (size_t i = 0; i < set->count; i++) {
        if (gb_loading_kind_of(&set->run[i].params)->follows_time) {
            return false;
        }
    }
    return true;
}

/* P1 Fig. 5, P2 Fig. 2. */
static bool compute_densification(struct gb_series *series,
                                  const struct gb_figures_input *input,
                                  struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_axes(series, "density", "relative density " RHO, "p_MPa",
                   "pressure <i>p</i> (MPa)");
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    const bool good = gb_figures_label_means(series, &sample, set, grid, err) &&
                      asymptote_columns(series, grid, set, err);
    if (good && all_quasistatic(set)) {
        magnify_beginning(series, set->groups);
    }
    gb_series_sample_finish(&sample);
    return good;
}

/* Errors of the two means are taken as independent: replicas of equal seeds make the
 * difference better known than this, never worse known. */
static void difference_columns(struct gb_series *series, size_t group, const char *label,
                               const double *mean, const double *error,
                               const double *reference, const double *reference_error)
{
    double *difference = gb_series_column(series, "difference_%zu_MPa", group + 1);
    double *spread = gb_series_column(series, "se_%zu_MPa", group + 1);
    for (size_t i = 0; i < series->rows; i++) {
        difference[i] = mean[i] - reference[i];
        spread[i] = hypot(error[i], reference_error[i]);
    }
    gb_series_draw(series, g_ptr_array_index(series->columns, 0), difference, spread,
                   GB_FIGURE_LINE, (int)group, label);
}

/* P2 Fig. 3. */
static bool compute_difference(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    const size_t reference = input->reference;
    if (set->groups < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "difference: all runs have equal presets; accepted runs of "
                            "two groups at least");
    }
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_note(series, "reference: group %zu", reference + 1);
    gb_series_axes(series, "density", "relative density " RHO, "difference_MPa",
                   "difference of pressure \xce\x94<i>p</i> (MPa)");
    gb_series_sample_grid(series, &sample, "density");
    double *buffer = g_new(double, 4 * sample.size + 1);
    double *const at[4] = {buffer, buffer + sample.size, buffer + 2 * sample.size,
                           buffer + 3 * sample.size};
    bool good = gb_series_mean(&sample, set, reference, at[0], at[1], err);
    for (size_t g = 0; g < set->groups && good; g++) {
        if (g != reference) {
            good = gb_series_mean(&sample, set, g, at[2], at[3], err);
            char *label = gb_figures_label(set, g, NULL);
            difference_columns(series, g, label, at[2], at[3], at[0], at[1]);
            g_free(label);
        }
    }
    g_free(buffer);
    gb_series_sample_finish(&sample);
    return good;
}

static const struct gb_figures_row figures[] = {
    {"time", "pressure against time, every run and the mean (P2 Fig. 1)", GB_FIGURES_RUNS,
     NULL, compute_time},
    {"densification",
     "pressure against density, with asymptote in 2D (P1 Fig. 5, P2 Fig. 2)",
     GB_FIGURES_RUNS, NULL, compute_densification},
    {"difference", "pressure less that of the reference, against density (P2 Fig. 3)",
     GB_FIGURES_RUNS, NULL, compute_difference},
    {"rate", "pressure at given densities against rate, with power law (P2 Fig. 4)",
     GB_FIGURES_RUNS, NULL, gb_figures_rate},
    {"relaxation", "times of the relaxation after pressing, from its fit (P2 Table 1)",
     GB_FIGURES_RUNS, NULL, gb_figures_relaxation},
    {"decay", "pressure after pressing against time, with its fit (P2 (4))",
     GB_FIGURES_RUNS, NULL, gb_figures_relaxation_curve},
    {"unloading", "density against pressure, with unloading (P1 Fig. 11, 12)",
     GB_FIGURES_RUNS, NULL, gb_figures_curve_unloading},
    {"continuum",
     "pressure against density, with the continuum theory for three geometries (P1 Fig. "
     "12)",
     GB_FIGURES_RUNS, NULL, gb_figures_continuum},
    {"coordination", "mean coordination number against density (P1 Fig. 8)",
     GB_FIGURES_RUNS, NULL, gb_figures_curve_coordination},
    {"lateral", "lateral over axial pressure against density (P1 Fig. 13)",
     GB_FIGURES_RUNS, NULL, gb_figures_curve_lateral},
    {"size-effect", "gain in density at one pressure against diameter (P1 Fig. 6)",
     GB_FIGURES_RUNS, NULL, gb_figures_curve_size},
    {"sweep", "density at one pressure against a varied key, a line per value of others",
     GB_FIGURES_RUNS, NULL, gb_figures_sweep},
    {"rdf", "radial distribution function (P1 Fig. 4, 7)", GB_FIGURES_STATES, NULL,
     gb_figures_state_rdf},
    {"force-angle", "mean normal force against the angle to z (P1 Fig. 14)",
     GB_FIGURES_STATES, NULL, gb_figures_state_force},
    {"sizes", "particle sizes by number with log-normal law (P1 Fig. 10, P3 Fig. 14)",
     GB_FIGURES_STATES, NULL, gb_figures_state_sizes},
    {"sizes-volume", "particle sizes by volume (P3 Fig. 14)", GB_FIGURES_STATES, NULL,
     gb_figures_state_volumes},
    {"die-height", "change of height against pressure in a die (P3 Fig. 17)",
     GB_FIGURES_RUNS, NULL, gb_figures_die_height},
    {"die-density", "density, whole and in the middle of a die (P3 Fig. 18-20)",
     GB_FIGURES_RUNS, NULL, gb_figures_die_density},
    {"contact", "normal force of two particles, pressed and released (P1 Fig. 1)",
     GB_FIGURES_SCENE, "p1-set2-16nm", gb_figures_law_contact},
    {"bridge-strength", "stress that breaks a bridge, for three lengths (P1 Fig. 2)",
     GB_FIGURES_SCENE, "p1-set2-16nm", gb_figures_law_strength},
    {"pair", "force of two equal spheres, elastic and plastic (P3 Fig. 10)",
     GB_FIGURES_SCENE, "p3-pair", gb_figures_pair_force},
    {"line", "force on a small sphere between two large ones (P3 Fig. 11)",
     GB_FIGURES_SCENE, "p3-line", gb_figures_pair_force},
    {"critical-step", "critical time step of two equal spheres (P3 Fig. 12)",
     GB_FIGURES_SCENE, "p3-pair", gb_figures_pair_step},
    {"chart", "error against cost of numerical choices, from greenbody chart",
     GB_FIGURES_TABLE, NULL, gb_figures_chart},
    {"chart-error", "error at one pressure, with the scatter, against evaluations",
     GB_FIGURES_TABLE, NULL, gb_figures_chart_error},
    {0},
};

const struct gb_figures_row *gb_figures_all(void)
{
    return figures;
}

const char *const *gb_figures_ignored(const struct gb_figures_row *row)
{
    static const char *const of_loading[] = {"densification", "difference", "rate",
                                             "coordination", "lateral"};
    static const char *const held[] = {"loading.hold", "loading.record_time", NULL};
    static const char *const none[] = {NULL};
    for (size_t k = 0; k < G_N_ELEMENTS(of_loading); k++) {
        if (strcmp(row->name, of_loading[k]) == 0) {
            return held;
        }
    }
    return none;
}

const struct gb_figures_row *gb_figures_find(const char *name)
{
    for (const struct gb_figures_row *row = figures; row->name != NULL; row++) {
        if (strcmp(row->name, name) == 0) {
            return row;
        }
    }
    return NULL;
}
