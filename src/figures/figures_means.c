/* The usual figure: the mean of Y over X, one curve for each group of runs, with its standard
 * error.  Such a figure is a row with `mean`; what it shows besides is a function `more`. */

#include <math.h>
#include <string.h>

#include "figures/figures.h"
#include "figures/series.h"
#include "measure/theory.h"
#include "scene/loading_kind.h"
#include "scene/model.h"
#include "scene/size/sizes.h"

/* Whether two models have the same asymptote. */
static bool same_asymptote(const struct gb_model *a, const struct gb_model *b)
{
    return a->rod.hertz == b->rod.hertz && a->rod.rod == b->rod.rod &&
           a->adhesion == b->adhesion && a->pascal_per_stress == b->pascal_per_stress;
}

/* P2 (5)-(8), once for groups with the same laws. */
static bool asymptote_columns(struct gb_series *series, const double *density,
                              const struct gb_runset *set, struct gb_error *err)
{
    struct gb_model *models = g_new0(struct gb_model, set->groups);
    size_t known = 0;
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (!gb_loading_kind_of(params)->given_rate || params->dimension != 2 ||
            gb_sizes_polydisperse(params)) {
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
        series->y.low = 0.0; /* the asymptote has no meaning in tension */
    }
    g_free(models);
    return good;
}

/* The inset of P1 Fig. 5 shows the curves up to this fraction of the maximum pressure. */
static const double inset_fraction = 0.05;

static void set_inset(struct gb_series *series, size_t groups)
{
    const double *density = g_ptr_array_index(series->columns, 0);
    double max = 0.0;
    size_t last = series->rows;
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        for (size_t i = 0; i < series->rows; i++) {
            max = isfinite(mean[i]) ? fmax(max, mean[i]) : max;
        }
    }
    for (size_t g = 0; g < groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        size_t i = 0;
        while (i < last && !(mean[i] > inset_fraction * max)) {
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

static bool add_asymptote(struct gb_series *series, const struct gb_runset *set,
                          const double *density, struct gb_error *err)
{
    if (!asymptote_columns(series, density, set, err)) {
        return false;
    }
    if (all_quasistatic(set)) {
        set_inset(series, set->groups);
    }
    return true;
}

/* Where y is divided by another column it is left out while that one is below this fraction of
 * its maximum: the quotient of two small values is noise. */
static const double min_fraction = 0.01;

/* Replaces y of every run by y / over. */
static void divide(struct gb_series_sample *sample, const struct gb_series_sample *over,
                   size_t runs)
{
    for (size_t i = 0; i < runs; i++) {
        double *y = sample->rows + i * sample->size;
        const double *z = over->rows + i * sample->size;
        double max = 0.0;
        for (size_t k = 0; k < sample->size; k++) {
            max = isnan(z[k]) ? max : fmax(max, z[k]);
        }
        bool large = true; /* from here to the end of loading */
        for (size_t k = sample->size; k > 0; k--) {
            large = large && !(z[k - 1] <= min_fraction * max);
            y[k - 1] = large ? y[k - 1] / z[k - 1] : NAN;
        }
    }
}

static bool divide_by(const char *over, struct gb_series_sample *sample,
                      const struct gb_runset *set, const struct gb_figures_mean *mean,
                      struct gb_error *err)
{
    struct gb_series_sample divisor = {0};
    if (!gb_series_sample(&divisor, set, mean->branch, mean->x, over, err)) {
        return false;
    }
    divide(sample, &divisor, set->count);
    gb_series_sample_finish(&divisor);
    return true;
}

/* A column of every run, drawn thin where the group has more than one. */
static void draw_runs(struct gb_series *series, const struct gb_series_sample *sample,
                      const struct gb_runset *set, const double *grid, const char *unit)
{
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        gb_series_note(series, "run %zu: %s, group %zu", i + 1, run->directory,
                       run->group + 1);
        double *column = gb_series_column(series, "run_%zu%s", i + 1, unit);
        memcpy(column, sample->rows + i * sample->size, sample->size * sizeof *column);
        if (gb_runset_members(set, run->group) > 1) {
            gb_series_draw(series, grid, column, NULL, GB_FIGURE_FAINT, (int)run->group,
                           NULL);
        }
    }
}

bool gb_figures_means_compute(struct gb_series *series, const struct gb_runset *set,
                              const struct gb_figures_mean *mean, struct gb_error *err)
{
    const struct gb_series_points points = {mean->branch, mean->x, mean->y};
    struct gb_series_sample sample;
    bool good = false;
    if (!gb_series_sample(&sample, set, mean->branch, mean->x, mean->y, err)) {
        return false;
    }
    if (mean->over != NULL && !divide_by(mean->over, &sample, set, mean, err)) {
        goto done;
    }
    gb_series_init(series, sample.size);
    gb_series_note_groups(series, set);
    if (mean->over != NULL) {
        gb_series_note(series, "left out below %g of the maximum of %.2s", min_fraction,
                       mean->over);
    }
    const double *grid = gb_series_sample_grid(series, &sample, mean->x);
    if (mean->runs) {
        draw_runs(series, &sample, set, grid, mean->unit);
    }
    good = gb_series_means(series, &sample, set, grid, mean->column, mean->unit, err) &&
           (mean->more == NULL || mean->more(series, set, grid, err)) &&
           (!mean->unrelaxed || gb_series_unrelaxed(series, set, &points, err));
done:
    gb_series_sample_finish(&sample);
    return good;
}

const struct gb_figures_row gb_figures_means_rows[] = {
    {"time", "pressure against time, every run and the mean", "P2 Fig. 1",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "time_ns", .label = "time <i>t</i> (ns)"},
     .y = GB_FIGURES_PRESSURE_AXIS,
     .mean =
         {.x = "time_ns", .y = "p_MPa", .column = "mean", .unit = "_MPa", .runs = true}},
    {"densification", "pressure against density, with the asymptote in 2D",
     "P1 Fig. 5, P2 Fig. 2", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .ignored_keys = gb_figures_after_loading, .x = GB_FIGURES_DENSITY_AXIS,
     .y = GB_FIGURES_PRESSURE_AXIS,
     .mean = {"load", "density", "p_MPa", .column = "mean", .unit = "_MPa",
              .unrelaxed = true, .more = add_asymptote}},
    {0},
};
