#include "cli/figures.h"

#include <math.h>
#include <string.h>

#include "cli/figures_rate.h"
#include "cli/figures_relaxation.h"
#include "greenbody/model.h"
#include "measure/theory.h"

/* Which number is which group and run. */
static void note_groups(struct gb_series *series, const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        char *label = gb_runset_label(set, g);
        gb_series_note(series, "group %zu: %zu runs%s%s", g + 1,
                       gb_runset_members(set, g), *label ? ", " : "", label);
        g_free(label);
    }
}

static bool mean_columns(struct gb_series *series, const struct gb_series_sample *sample,
                         const struct gb_runset *set, struct gb_error *err)
{
    for (size_t g = 0; g < set->groups; g++) {
        double *mean = gb_series_column(series, "mean_%zu_MPa", g + 1);
        double *error = gb_series_column(series, "se_%zu_MPa", g + 1);
        if (!gb_series_mean(sample, set, g, mean, error, err)) {
            return false;
        }
    }
    return true;
}

static void grid_column(struct gb_series *series, const struct gb_series_sample *sample,
                        const char *name)
{
    memcpy(gb_series_column(series, "%s", name), sample->grid,
           sample->size * sizeof *sample->grid);
}

/* P2 Fig. 1. */
static bool compute_time(struct gb_series *series, const struct gb_runset *set,
                         const struct gb_figures_request *request, struct gb_error *err)
{
    struct gb_series_sample sample;
    (void)request;
    if (!gb_series_sample(&sample, set, NULL, "time_ns", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    note_groups(series, set);
    grid_column(series, &sample, "time_ns");
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        gb_series_note(series, "run %zu: %s, group %zu", i + 1, run->directory,
                       run->group + 1);
        memcpy(gb_series_column(series, "run_%zu_MPa", i + 1),
               sample.rows + i * sample.size, sample.size * sizeof *sample.rows);
    }
    const bool good = mean_columns(series, &sample, set, err);
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
        if (params->kind != GB_KIND_DYNAMIC || params->dimension != 2) {
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
    }
    g_free(models);
    return good;
}

/* P2 Fig. 2. */
static bool compute_densification(struct gb_series *series, const struct gb_runset *set,
                                  const struct gb_figures_request *request,
                                  struct gb_error *err)
{
    struct gb_series_sample sample;
    (void)request;
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    note_groups(series, set);
    grid_column(series, &sample, "density");
    const bool good = mean_columns(series, &sample, set, err) &&
                      asymptote_columns(series, sample.grid, set, err);
    gb_series_sample_finish(&sample);
    return good;
}

/* Errors of the two means are taken as independent: replicas of equal seeds make the
 * difference better known than this, never worse known. */
static void difference_columns(struct gb_series *series, size_t group, const double *mean,
                               const double *error, const double *reference,
                               const double *reference_error)
{
    double *difference = gb_series_column(series, "difference_%zu_MPa", group + 1);
    double *spread = gb_series_column(series, "se_%zu_MPa", group + 1);
    for (size_t i = 0; i < series->rows; i++) {
        difference[i] = mean[i] - reference[i];
        spread[i] = hypot(error[i], reference_error[i]);
    }
}

/* P2 Fig. 3. */
static bool compute_difference(struct gb_series *series, const struct gb_runset *set,
                               const struct gb_figures_request *request,
                               struct gb_error *err)
{
    struct gb_series_sample sample;
    const size_t reference = request->reference;
    if (set->groups < 2) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "difference: all runs have equal presets; accepted runs of "
                            "two groups at least");
    }
    if (!gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    note_groups(series, set);
    gb_series_note(series, "reference: group %zu", reference + 1);
    grid_column(series, &sample, "density");
    double *buffer = g_new(double, 4 * sample.size + 1);
    double *const at[4] = {buffer, buffer + sample.size, buffer + 2 * sample.size,
                           buffer + 3 * sample.size};
    bool good = gb_series_mean(&sample, set, reference, at[0], at[1], err);
    for (size_t g = 0; g < set->groups && good; g++) {
        if (g != reference) {
            good = gb_series_mean(&sample, set, g, at[2], at[3], err);
            difference_columns(series, g, at[2], at[3], at[0], at[1]);
        }
    }
    g_free(buffer);
    gb_series_sample_finish(&sample);
    return good;
}

static const struct gb_figures_row figures[] = {
    {"time", "pressure against time, every run, mean and standard error (P2 Fig. 1)",
     compute_time},
    {"densification",
     "pressure against density, mean and standard error; asymptote (P2 Fig. 2)",
     compute_densification},
    {"difference", "pressure less that of the reference, against density (P2 Fig. 3)",
     compute_difference},
    {"rate", "pressure at given densities against rate, with power law (P2 Fig. 4)",
     gb_figures_rate},
    {"relaxation", "the fit of the relaxation after pressing (P2 Table 1)",
     gb_figures_relaxation},
    {NULL, NULL, NULL},
};

const struct gb_figures_row *gb_figures_all(void)
{
    return figures;
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
