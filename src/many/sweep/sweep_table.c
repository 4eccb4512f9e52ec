#include "many/sweep/sweep_table.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text/visible.h"
#include "base/units.h"
#include "many/sweep/sweep_readings.h"
#include "many/sweep/sweep_shortfall.h"
#include "measure/fit/average.h"

/* Default pressures reach from the first to the second, MPa. */
static const double least_mpa = 1.0;
static const double most_mpa = 1e5;

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort_pressures(struct gb_sweep_table_pressures *at)
{
    size_t kept = 0;
    qsort(at->pa, at->count, sizeof at->pa[0], compare_doubles);
    for (size_t i = 0; i < at->count; i++) {
        if (kept == 0 || at->pa[i] > at->pa[kept - 1] * (1.0 + 1e-9)) {
            at->pa[kept++] = at->pa[i];
        }
    }
    at->count = kept;
}

bool gb_sweep_table_parse(struct gb_sweep_table_pressures *at, const char *text,
                          struct gb_error *err)
{
    char **parts = g_strsplit(text, ";", GB_SWEEP_TABLE_PRESSURES + 1);
    const guint count = g_strv_length(parts);
    const char *unit = "";
    double number = 0.0;
    at->count = 0;
    if (count > 0 && gb_units_number(g_strstrip(parts[count - 1]), &unit, &number)) {
        unit += strspn(unit, " \t");
    }
    bool good = count > 0 && count <= GB_SWEEP_TABLE_PRESSURES;
    for (guint i = 0; i < count && good; i++) {
        const char *end = NULL;
        g_strstrip(parts[i]);
        const bool bare = gb_units_number(parts[i], &end, &number) && *end == '\0';
        char *whole = g_strconcat(parts[i], bare ? unit : "", NULL);
        double *to = &at->pa[at->count++];
        good = gb_units_parse(whole, GB_DIM_PRESSURE, to, NULL) && *to > 0.0;
        g_free(whole);
    }
    g_strfreev(parts);
    sort_pressures(at);
    return good ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.120s: accepted up to %d pressures above 0 separated by "
                        "';', as in 50;100;200 MPa",
                        text, GB_SWEEP_TABLE_PRESSURES);
}

void gb_sweep_table_default(struct gb_sweep_table_pressures *at,
                            const struct gb_params *params)
{
    static const double steps[] = {1.0, 2.0, 5.0};
    const double until = params->until_pressure_pa / 1e6;
    const double last = isfinite(until) ? fmin(until, most_mpa) : most_mpa;
    at->count = 0;
    for (double decade = least_mpa; decade <= last; decade *= 10.0) {
        for (size_t k = 0; k < G_N_ELEMENTS(steps) && decade * steps[k] <= last; k++) {
            at->pa[at->count++] = 1e6 * decade * steps[k];
        }
    }
    for (int i = 0; i < params->unload_count; i++) {
        at->pa[at->count++] = params->unload_from_pa[i];
    }
    if (isfinite(until)) {
        at->pa[at->count++] = params->until_pressure_pa;
    }
    sort_pressures(at);
}

static void append_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.12g", value);
    }
}

/* The varied values of a point as cells; numbers in the unit that the column names. */
static void append_values(GString *text, const struct gb_axes *axes, size_t point)
{
    for (size_t i = 0; i < axes->count; i++) {
        char cell[GB_PARAMS_VALUE_MAX];
        gb_axes_cell(axes, point, i, cell, sizeof cell);
        g_string_append_c(text, ',');
        gb_visible_add_cell(text, cell, true);
    }
}

static void append_rows(GString *text, const struct gb_sweep_readings *readings,
                        const struct gb_axes *axes, size_t point,
                        const struct gb_sweep_table_pressures *at)
{
    for (size_t b = 0; b < GB_SWEEP_BRANCHES; b++) {
        for (size_t p = 0; p < at->count; p++) {
            double mean = NAN;
            double error = NAN;
            const size_t runs = gb_average_values(
                gb_sweep_readings_at(readings, b, p, GB_READING_DENSITY), readings->runs,
                &mean, &error);
            if (runs == 0) {
                continue;
            }
            g_string_append_printf(text, "%zu", point + 1);
            append_values(text, axes, point);
            g_string_append_printf(text, ",%s,%.12g,%zu", gb_sweep_readings_branch(b),
                                   at->pa[p] / 1e6, runs);
            for (size_t q = 0; q < GB_READING_QUANTITIES; q++) {
                gb_average_values(gb_sweep_readings_at(readings, b, p, q), readings->runs,
                                  &mean, &error);
                append_number(text, mean);
                append_number(text, error);
            }
            g_string_append_c(text, '\n');
        }
    }
}

/* Runs that count although they fell short. */
static void append_shortfalls(GString *text, const struct gb_ensemble *ensemble)
{
    const size_t runs = gb_sweep_shortfall_runs(ensemble);
    if (runs > 0) {
        g_string_append_printf(text,
                               "# runs that missed a goal or have points that are not "
                               "in equilibrium: %zu (runs.csv)\n",
                               runs);
    }
}

static void append_header(GString *text, const struct gb_axes *axes,
                          const struct gb_ensemble *ensemble)
{
    g_string_append(
        text,
        "# greenbody " GB_VERSION "\n"
        "# means over the runs of a point and their standard errors (se_); load: where "
        "the mean\n# pressure over the compressed axes first reaches p_MPa; unload: "
        "after unloading from it\n");
    append_shortfalls(text, ensemble);
    g_string_append(text, "point");
    for (size_t i = 0; i < axes->count; i++) {
        char *name = gb_axes_column(axes, i);
        g_string_append_printf(text, ",%s", name);
        g_free(name);
    }
    g_string_append(text, ",branch,p_MPa,runs");
    for (int q = 0; q < GB_READING_QUANTITIES; q++) {
        const char *name = gb_reading_name((enum gb_reading_quantity)q);
        g_string_append_printf(text, ",%s,se_%s", name, name);
    }
    g_string_append_c(text, '\n');
}

GString *gb_sweep_table_means(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                              const struct gb_sweep_table_pressures *at)
{
    GString *text = g_string_new(NULL);
    append_header(text, axes, ensemble);
    for (size_t point = 0; point < ensemble->points; point++) {
        struct gb_sweep_readings readings;
        gb_sweep_readings_init(&readings, ensemble, point, at);
        append_rows(text, &readings, axes, point, at);
        gb_sweep_readings_finish(&readings);
    }
    return text;
}

/* Text as one cell, with the quotes of CSV. */
static void append_quoted(GString *text, const char *word)
{
    g_string_append_c(text, '"');
    for (const char *c = word; *c != '\0'; c++) {
        g_string_append(text, *c == '"' ? "\"" : "");
        g_string_append_c(text, *c);
    }
    g_string_append_c(text, '"');
}

GString *gb_sweep_table_runs(const struct gb_ensemble *ensemble)
{
    GString *text = g_string_new("run,point,seed,state,error\n");
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        const struct gb_ensemble_run *run = &ensemble->run[i];
        const bool used = run->replica < gb_ensemble_used(ensemble, run->point);
        if (!run->ended && !used) {
            continue;
        }
        char *name = g_path_get_basename(run->directory);
        g_string_append_printf(text, "%s,%zu,%" PRIu64 ",%s,", name, run->point + 1,
                               run->params.seed,
                               !run->ended                ? "missing"
                               : run->error.code != GB_OK ? "failed"
                               : used                     ? "done"
                                                          : "spare");
        char *shortfall = gb_sweep_shortfall_text(run);
        if (run->error.code != GB_OK || shortfall != NULL) {
            append_quoted(text, shortfall != NULL ? shortfall : run->error.text);
        }
        g_free(shortfall);
        g_string_append_c(text, '\n');
        g_free(name);
    }
    return text;
}
