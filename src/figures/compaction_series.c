#include "figures/compaction_series.h"

#include <math.h>
#include <string.h>

#include "figures/series.h"

static const double percent = 100.0; /* residuals: % of theoretical density */

bool gb_compaction_series_init(struct gb_compaction_series *one,
                               const struct gb_compaction_data *data,
                               const struct gb_equation *only, const char *label,
                               struct gb_error *err)
{
    *one = (struct gb_compaction_series){.data = *data, .label = g_strdup(label)};
    if (!gb_compaction_fits(&one->fits, &one->data.points, only, GB_COMPACTION_PROFILE,
                            err)) {
        return false;
    }
    const struct gb_error *refusal = &one->fits.fit[0].refusal;
    return one->fits.fitted > 0 || gb_error_set(err, refusal->code, "%s", refusal->text);
}

void gb_compaction_series_finish(struct gb_compaction_series *one)
{
    gb_compaction_data_finish(&one->data);
    g_free(one->label);
    *one = (struct gb_compaction_series){0};
}

/* Walker's and Balshin's equations are one curve, drawn as Walker's. */
static bool is_drawn(const struct gb_compaction_fits *fits, size_t index)
{
    return index < fits->fitted &&
           strcmp(fits->fit[index].equation->name, "balshin") != 0;
}

static const char *title_of(const struct gb_equation *equation)
{
    return strcmp(equation->name, "walker") == 0 ? "Walker, Balshin" : equation->title;
}

/* Parameters of all equations as comment lines. */
static void note_fits(struct gb_series *series, const struct gb_compaction_series *one,
                      size_t number)
{
    const struct gb_compaction_fits *fits = &one->fits;
    for (size_t i = 0; i < fits->count; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        GString *line = g_string_new(NULL);
        if (!row->fitted) {
            g_string_append(line, row->refusal.text);
        } else {
            g_string_append_printf(line, "%s: dAICc %.1f, rms %.2g", row->equation->name,
                                   row->delta, row->all.rms);
        }
        for (size_t k = 0; row->fitted && k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            g_string_append_printf(line, ", %s = %.5g (%.5g to %.5g) %s", value.name,
                                   value.value.value, value.value.low, value.value.high,
                                   value.unit);
        }
        gb_series_note(series, "group %zu: %s", number, line->str);
        g_string_free(line, TRUE);
    }
}

/* Columns of the points; returns that of the pressures. */
static double *point_columns(struct gb_series *series,
                             const struct gb_compaction_series *one, size_t number,
                             double **density, double **error)
{
    const struct gb_equations_points *points = &one->data.points;
    double *pressure = gb_series_column(series, "p_%zu_MPa", number);
    *density = gb_series_column(series, "density_%zu", number);
    *error = gb_series_column(series, "se_%zu", number);
    for (size_t i = 0; i < points->count; i++) {
        pressure[i] = points->pressure[i];
        (*density)[i] = points->density[i];
        (*error)[i] = points->error != NULL ? points->error[i] : (double)NAN;
    }
    return pressure;
}

/* The curve of a fit and, below, its residuals. */
static void draw_equation(struct gb_series *series,
                          const struct gb_compaction_series *one, size_t number,
                          size_t index, const double *pressure, int style,
                          const char *label)
{
    const struct gb_equation_fit *fit = &one->fits.fit[index].all;
    const char *name = fit->equation->name;
    double *density = gb_series_column(series, "%s_%zu", name, number);
    double *residual = gb_series_column(series, "residual_%s_%zu_percent", name, number);
    for (size_t i = 0; i < one->data.points.count; i++) {
        density[i] = gb_compaction_fits_at(fit, pressure[i]);
        residual[i] = percent * (one->data.points.density[i] - density[i]);
    }
    gb_series_draw(series, pressure, density, NULL, GB_FIGURE_LINE, style, label);
    gb_series_draw(series, pressure, residual, NULL, GB_FIGURE_LINE, style, NULL)->below =
        true;
}

/* Points of a run are hollow beside their curves, measured ones are black. */
static void draw_points(struct gb_series *series, const struct gb_compaction_series *one,
                        const double *column[3], int style)
{
    const bool measured = one->data.curves == 0;
    gb_series_draw(series, column[0], column[1], column[2], GB_FIGURE_POINTS,
                   measured ? gb_figure_black(style) : style, one->label)
        ->open = !measured;
}

/* The zero line of the residuals, with the errors of the points. */
static void draw_zero(struct gb_series *series, const struct gb_compaction_series *one,
                      size_t number, const double *pressure, const double *error)
{
    double *zero = gb_series_column(series, "zero_%zu", number);
    double *band = gb_series_column(series, "se_%zu_percent", number);
    for (size_t i = 0; i < one->data.points.count; i++) {
        zero[i] = 0.0;
        band[i] = percent * error[i];
    }
    gb_series_draw(series, pressure, zero, band, GB_FIGURE_FAINT, 0, NULL)->below = true;
}

static void draw_powder(struct gb_series *series, const struct gb_compaction_series *one,
                        size_t number, size_t most)
{
    double *density = NULL;
    double *error = NULL;
    const int first = most > 1 ? 0 : (int)number - 1; /* style */
    double *pressure = point_columns(series, one, number, &density, &error);
    size_t drawn = 0;
    draw_zero(series, one, number, pressure, error);
    draw_points(series, one, (const double *[]){pressure, density, error}, first);
    for (size_t i = 0; i < one->fits.fitted && drawn < most; i++) {
        if (is_drawn(&one->fits, i)) {
            const struct gb_compaction_fit *row = &one->fits.fit[i];
            char *label =
                g_strdup_printf("%s, ΔAICc %.0f", title_of(row->equation), row->delta);
            drawn++;
            draw_equation(series, one, number, i, pressure, most > 1 ? (int)drawn : first,
                          most > 1 ? label : title_of(row->equation));
            g_free(label);
        }
    }
}

static size_t most_points(const struct gb_compaction_series *all, size_t count)
{
    size_t rows = 0;
    for (size_t k = 0; k < count; k++) {
        rows = MAX(rows, all[k].data.points.count);
    }
    return rows;
}

bool gb_compaction_series_fit(struct gb_series *series,
                              const struct gb_compaction_series *all, size_t count,
                              struct gb_error *err)
{
    (void)err;
    gb_series_init(series, most_points(all, count));
    gb_series_note(series, "equations of compaction, least squares in the density; 95 %% "
                           "intervals");
    for (size_t k = 0; k < count; k++) {
        note_fits(series, &all[k], k + 1);
    }
    for (size_t k = 0; k < count; k++) {
        draw_powder(series, &all[k], k + 1,
                    count == 1 ? GB_COMPACTION_SERIES_EQUATIONS : 1);
    }
    series->below_y.label = "residual (%)";
    gb_series_caption(series, count == 1 ? "Residuals in %% of theoretical density."
                                         : "The equation of the least AICc for each; "
                                           "residuals in %% of theoretical density.");
    return true;
}

/* The Heckel plot of one powder: all points, the line on its stretch. */
static bool draw_heckel(struct gb_series *series, const struct gb_compaction_series *one,
                        size_t number, struct gb_error *err)
{
    const struct gb_equations_points *points = &one->data.points;
    const struct gb_compaction_fits *fits = &one->fits;
    for (size_t i = 0; i < fits->count; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        if (row->equation == gb_equations_find("heckel") && !row->fitted) {
            return gb_error_set(err, row->refusal.code, "%s", row->refusal.text);
        }
    }
    double *pressure = gb_series_column(series, "p_%zu_MPa", number);
    double *y = gb_series_column(series, "log_%zu", number);
    double *error = gb_series_column(series, "se_%zu", number);
    double *line = gb_series_column(series, "heckel_%zu", number);
    const size_t end = fits->stretch.first + fits->stretch.count;
    for (size_t i = 0; i < points->count; i++) {
        pressure[i] = points->pressure[i];
        y[i] = -log(1.0 - points->density[i]);
        error[i] = points->error != NULL ? points->error[i] / (1.0 - points->density[i])
                                         : (double)NAN;
        if (i >= fits->stretch.first && i < end) {
            line[i] = fits->heckel.x[0] * pressure[i] + fits->heckel.x[1];
        }
    }
    char *label = g_strdup_printf("1/<i>K</i> = %.4g MPa (%.4g to %.4g)",
                                  fits->yield.value, fits->yield.low, fits->yield.high);
    gb_series_note(
        series, "group %zu: straightest stretch %.5g to %.5g MPa, %zu points, R2 %.6f",
        number, points->pressure[fits->stretch.first], points->pressure[end - 1],
        fits->stretch.count, fits->stretch.determination);
    const int style = (int)number - 1;
    draw_points(series, one, (const double *[]){pressure, y, error}, style);
    gb_series_draw(series, pressure, line, NULL, GB_FIGURE_LINE, style, label);
    g_free(label);
    return true;
}

bool gb_compaction_series_heckel(struct gb_series *series,
                                 const struct gb_compaction_series *all, size_t count,
                                 struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, most_points(all, count));
    for (size_t k = 0; k < count; k++) {
        note_fits(series, &all[k], k + 1);
    }
    for (size_t k = 0; k < count && good; k++) {
        good = draw_heckel(series, &all[k], k + 1, err);
    }
    gb_series_caption(series, "Lines: Heckel's equation on the straightest stretch, with "
                              "its mean yield pressure and the 95 %% interval.");
    return good;
}

static bool init_group(struct gb_compaction_series *one, const struct gb_runset *set,
                       size_t group, struct gb_error *err)
{
    const struct gb_compaction_window window = {.from = NAN, .to = NAN, .initial = NAN};
    struct gb_compaction_data data;
    if (!gb_compaction_data_runs(&data, set, group, &window, err)) {
        return false;
    }
    char *label = gb_series_group_label(set, group, NULL);
    const bool good = gb_compaction_series_init(one, &data, NULL, label, err);
    g_free(label);
    return good;
}

bool gb_compaction_series_runs(struct gb_series *series, const struct gb_runset *set,
                               gb_compaction_series_draw *draw, struct gb_error *err)
{
    struct gb_compaction_series *all = g_new0(struct gb_compaction_series, set->groups);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = init_group(&all[g], set, g, err);
    }
    good = good && draw(series, all, set->groups, err);
    if (good) {
        gb_series_note_groups(series, set);
    }
    for (size_t g = 0; g < set->groups; g++) {
        gb_compaction_series_finish(&all[g]);
    }
    g_free(all);
    return good;
}
