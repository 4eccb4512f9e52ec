#include "figures/figures_compute.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_statistics.h>
#include <math.h>

#include "base/alloc.h"
#include "base/number.h"
#include "figures/runs/runs_check.h"

/* Mean of P3's measurements, section 2. */
static const double published_density = 0.65;

/* A density of every poured bed. */
struct beds {
    const char *name;          /* of the columns, in curve.csv too */
    const char *label, *title; /* in the figure, at the head of a sentence */
    int style;
    double *value;
};

/* The value at rest before pressing: the last point of the branch relax. */
static bool read_bed(double *value, const struct gb_runset_run *run, const char *column,
                     struct gb_error *err)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    if (!gb_runset_points(run, "relax", "step", column, &x, &y, &count, err)) {
        return false;
    }
    *value = y[count - 1];
    gb_alloc_free(x);
    gb_alloc_free(y);
    return true;
}

/* Filling does not depend on the law of pressing: equal seed and density are one bed. */
static bool is_repeated(const struct gb_runset *set, const double *density, size_t i)
{
    for (size_t k = 0; k < i; k++) {
        if (set->run[k].params.seed == set->run[i].params.seed &&
            density[k] == density[i]) {
            return true;
        }
    }
    return false;
}

/* Returns the number of different beds, 0 and err on failure. */
static size_t read_beds(struct beds *whole, struct beds *central,
                        const struct gb_runset *set, struct gb_error *err)
{
    double *density = g_new0(double, 2 * set->count);
    size_t beds = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        good = read_bed(&density[i], &set->run[i], whole->name, err) &&
               read_bed(&density[set->count + i], &set->run[i], central->name, err);
        if (good && !is_repeated(set, density, i)) {
            whole->value[beds] = density[i];
            central->value[beds++] = density[set->count + i];
        }
    }
    g_free(density);
    return good ? beds : 0;
}

/* Table 1 of one density, in the first row of its columns, as a comment and in the caption;
 * a line at the mean with the standard deviation as its band. */
static void draw_statistics(struct gb_series *series, const struct beds *beds,
                            size_t count, const double *x)
{
    const double mean = gsl_stats_mean(beds->value, 1, count);
    const double deviation =
        count > 1 ? gsl_stats_sd_m(beds->value, 1, count, mean) : (double)NAN;
    const struct {
        const char *name;
        double value;
    } table[] = {{"mean", mean},
                 {"standard_deviation", deviation},
                 {"standard_error", deviation / sqrt((double)count)},
                 {"least", gsl_stats_min(beds->value, 1, count)},
                 {"largest", gsl_stats_max(beds->value, 1, count)}};
    GString *note = g_string_new(NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(table); k++) {
        gb_series_column(series, "%s_%s", beds->name, table[k].name)[0] = table[k].value;
        if (isfinite(table[k].value)) {
            g_string_append_printf(note, ", %s %.5g", table[k].name, table[k].value);
        }
    }
    gb_series_note(series, "%s: %zu bed%s%s", beds->name, count, count > 1 ? "s" : "",
                   note->str);
    g_string_free(note, TRUE);
    double *line = gb_series_column(series, "%s_line", beds->name);
    double *band = gb_series_column(series, "%s_band", beds->name);
    for (size_t i = 0; i < series->rows; i++) {
        line[i] = mean;
        band[i] = deviation;
    }
    gb_series_draw(series, x, line, band, GB_FIGURE_LINE, beds->style, NULL);
    char number[GB_NUMBER_ERROR_MAX];
    gb_series_caption(series, "%s: %s.", beds->title,
                      gb_number_error(mean, count > 1 ? deviation : (double)NAN, 2,
                                      " \xc2\xb1 ", number));
}

static void draw_beds(struct gb_series *series, const struct beds *beds, size_t count)
{
    double *bed = gb_series_column(series, "bed");
    double *edge = gb_series_column(series, "line_bed");
    double *published = gb_series_column(series, "P3_measured");
    for (size_t i = 0; i < series->rows; i++) {
        bed[i] = i < count ? (double)(i + 1) : (double)NAN;
        edge[i] = 0.5 + (double)i * (double)count / (double)(series->rows - 1);
        published[i] = published_density;
    }
    gb_series_caption(
        series,
        "Mean (line) and standard deviation (band) of poured powder before pressing.");
    for (int k = 0; k < 2; k++) {
        double *value = gb_series_column(series, "%s", beds[k].name);
        for (size_t i = 0; i < count; i++) {
            value[i] = beds[k].value[i];
        }
        gb_series_draw(series, bed, value, NULL, GB_FIGURE_POINTS, beds[k].style,
                       beds[k].label);
        draw_statistics(series, &beds[k], count, edge);
    }
    gb_series_draw(series, edge, published, NULL, GB_FIGURE_LINE,
                   gb_figure_black(1), "P3, measured mean");
    series->x.low = 0.5;
    series->x.high = 0.5 + (double)count;
}

/* P3 Fig. 4 and table 1. */
bool gb_figures_poured_density(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    double *values = g_new0(double, 2 * set->count);
    struct beds beds[2] = {
        {"density", "whole specimen", "Whole", 0, values},
        {"central_density", "central region", "Central", 1, values + set->count}};
    const size_t count = gb_runs_check_die(set, "poured-density", err)
                             ? read_beds(&beds[0], &beds[1], set, err)
                             : 0;
    if (count > 0) {
        gb_series_init(series, GSL_MAX(count, 2));
        gb_series_note(series, "relative densities of poured powder at rest, before "
                               "pressing; equal beds of several runs count once");
        draw_beds(series, beds, count);
    }
    g_free(values);
    return count > 0;
}
