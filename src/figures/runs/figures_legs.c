#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "scene/path/path.h"

/* Figures of runs with legs: the path in the plane of mean pressure and deviatoric stress,
 * and deviatoric stress against strain.  Runs are drawn one by one: legs end at different
 * strains. */

static const char *const strain_columns[GB_PATH_COMPONENTS] = {"exx", "eyy", "ezz",
                                                               "gxy", "gxz", "gyz"};

/* Reads the legs of a run.  Errors: GB_ERR_INPUT for a run without. */
static bool read_path(const struct gb_runset_run *run, struct gb_path *path,
                      struct gb_error *err)
{
    return (run->table != NULL && run->params.path[0] != '\0')
               ? gb_path_parse(path, run->params.path, run->params.dimension, err)
               : gb_error_set(err, GB_ERR_INPUT,
                              "%.300s: must be a run with legs (loading.path)",
                              run->directory);
}

/* Leg of a row, from 1; 0: a row of no leg. */
static int leg_of(const struct gb_table *table, size_t row)
{
    const char *word = gb_table_word(table, row);
    return strcmp(word, "load") == 0        ? 1
           : g_str_has_prefix(word, "leg:") ? atoi(word + strlen("leg:"))
                                            : 0;
}

static const double *column(const struct gb_runset_run *run, const char *name,
                            struct gb_error *err)
{
    return gb_table_column(run->table, name, err);
}

/* MPa; two axes in 2D, whose py is empty. */
static bool write_mean(const struct gb_runset_run *run, double *x, struct gb_error *err)
{
    const double *px = column(run, "px_MPa", err);
    const double *py = px != NULL ? column(run, "py_MPa", err) : NULL;
    const double *pz = py != NULL ? column(run, "pz_MPa", err) : NULL;
    for (size_t k = 0; pz != NULL && k < gb_table_rows(run->table); k++) {
        x[k] = isnan(py[k]) ? 0.5 * (px[k] + pz[k]) : (px[k] + py[k] + pz[k]) / 3.0;
    }
    return pz != NULL;
}

static bool write_strain(const struct gb_runset_run *run, int component, double *x,
                         struct gb_error *err)
{
    const double *strain = column(run, strain_columns[component], err);
    for (size_t k = 0; strain != NULL && k < gb_table_rows(run->table); k++) {
        x[k] = 100.0 * strain[k];
    }
    return strain != NULL;
}

/* Number of a leg at its end. */
static void annotate(struct gb_series *series, double x, double y, int leg)
{
    static const char *const number[] = {
        "",   "1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",  "9",  "10", "11", "12",
        "13", "14", "15", "16", "17", "18", "19", "20", "21", "22", "23", "24"};
    _Static_assert(sizeof number / sizeof number[0] == GB_PATH_LEGS_MAX + 1,
                   "a number for each leg");
    const struct gb_figure_annotation note = {
        x, y, number[CLAMP(leg, 0, GB_PATH_LEGS_MAX)], GB_FIGURE_ABOVE_RIGHT};
    g_array_append_val(series->annotations, note);
}

/* A single run: each leg in a style of its own, from the end of the one before. */
static void draw_legs(struct gb_series *series, const struct gb_runset_run *run,
                      const struct gb_path *path, const double *x, const double *y)
{
    const size_t rows = gb_table_rows(run->table);
    size_t from = 0;
    for (size_t k = 0; k < rows; k++) {
        const int leg = leg_of(run->table, k);
        if (k + 1 < rows && leg_of(run->table, k + 1) == leg) {
            continue;
        }
        char *text = leg > 0 && leg <= path->count
                         ? g_markup_printf_escaped("%d: %s", leg, path->leg[leg - 1].text)
                         : NULL;
        struct gb_series_curve *curve =
            gb_series_draw(series, x, y, NULL, GB_FIGURE_LINE, MAX(leg - 1, 0), text);
        curve->from = from;
        curve->rows = k + 1 - from;
        annotate(series, x[k], y[k], leg);
        from = k;
        g_free(text);
    }
}

/* One of several runs: the whole path in the style of its group. */
static void draw_run(struct gb_series *series, const struct gb_runset *set, size_t at,
                     const double *x, const double *y)
{
    const struct gb_runset_run *run = &set->run[at];
    const bool first = gb_runset_first(set, run->group) == run;
    char *label = first ? gb_figures_label(set, run->group, NULL) : NULL;
    gb_series_draw(series, x, y, NULL, GB_FIGURE_LINE, (int)run->group, label);
    g_free(label);
}

static size_t most_rows(const struct gb_runset *set)
{
    size_t rows = 0;
    for (size_t i = 0; i < set->count; i++) {
        rows = set->run[i].table != NULL ? MAX(rows, gb_table_rows(set->run[i].table))
                                         : rows;
    }
    return rows;
}

/* component: of the strain on the x axis; -1: the mean pressure stands there. */
static bool add_run(struct gb_series *series, const struct gb_runset *set, size_t at,
                    int component, struct gb_error *err)
{
    const struct gb_runset_run *run = &set->run[at];
    struct gb_path path;
    if (!read_path(run, &path, err)) {
        return false;
    }
    const double *q = column(run, "q_MPa", err);
    gb_series_note(series, "run %zu: %s, group %zu, %s", at + 1, run->directory,
                   run->group + 1, run->params.path);
    double *x = gb_series_column(
        series, component < 0 ? "p_%zu_MPa" : "strain_%zu_percent", at + 1);
    double *y = gb_series_column(series, "q_%zu_MPa", at + 1);
    const bool good = q != NULL && (component < 0 ? write_mean(run, x, err)
                                                  : write_strain(run, component, x, err));
    if (good) {
        memcpy(y, q, gb_table_rows(run->table) * sizeof *y);
        set->count == 1 ? draw_legs(series, run, &path, x, y)
                        : draw_run(series, set, at, x, y);
    }
    return good;
}

static bool draw(struct gb_series *series, const struct gb_runset *set, int component,
                 struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, most_rows(set));
    gb_figures_label_groups(series, set);
    for (size_t i = 0; i < set->count && good; i++) {
        good = add_run(series, set, i, component, err);
    }
    return good;
}

bool gb_figures_legs_path(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    return draw(series, input->set, -1, err);
}

/* All runs against the strain of the first one. */
bool gb_figures_legs_stress_strain(struct gb_series *series,
                                   const struct gb_figures_input *input,
                                   struct gb_error *err)
{
    static const char *const labels[GB_PATH_COMPONENTS] = {
        "axial strain <i>\xce\xb5<sub>x</sub></i> (%)",
        "axial strain <i>\xce\xb5<sub>y</sub></i> (%)",
        "axial strain <i>\xce\xb5<sub>z</sub></i> (%)",
        "shear strain <i>\xce\xb3<sub>xy</sub></i> (%)",
        "shear strain <i>\xce\xb3<sub>xz</sub></i> (%)",
        "shear strain <i>\xce\xb3<sub>yz</sub></i> (%)"};
    struct gb_path path;
    if (!read_path(&input->set->run[0], &path, err)) {
        return false;
    }
    const int component = gb_path_strained(&path);
    const bool good = draw(series, input->set, component, err);
    series->x.name = "strain_percent";
    series->x.label = labels[component];
    return good;
}
