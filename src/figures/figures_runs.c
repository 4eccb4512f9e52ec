/* Figures of the loading paths of runs: unloading, continuum theory, fitted equations, stresses
 * of the legs, and comparisons of groups at one pressure (size effect, sweep). */
#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/units.h"
#include "figures/figures.h"
#include "figures/series.h"
#include "many/runset.h"
#include "measure/average.h"
#include "measure/theory.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"

/* Pressures at which densities are averaged. */
enum { LEVELS = 240 };

/* The branches of a table that are "load" or begin with "unload", in their order. */
static GPtrArray *list_branches(const struct gb_runset *set)
{
    GPtrArray *names = g_ptr_array_new();
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_table *table = set->run[i].table;
        for (size_t k = 0; table != NULL && k < gb_table_rows(table); k++) {
            const char *word = gb_table_word(table, k);
            const bool shown =
                strcmp(word, "load") == 0 || g_str_has_prefix(word, "unload");
            if (shown &&
                !g_ptr_array_find_with_equal_func(names, word, g_str_equal, NULL)) {
                g_ptr_array_add(names, (char *)(uintptr_t)word);
            }
        }
    }
    return names;
}

static bool has_branch(const struct gb_runset_run *run, const char *branch)
{
    for (size_t k = 0; k < gb_table_rows(run->table); k++) {
        if (strcmp(gb_table_word(run->table, k), branch) == 0) {
            return true;
        }
    }
    return false;
}

static void reverse(double *values, size_t count)
{
    for (size_t k = 0; k < count / 2; k++) {
        const double value = values[k];
        values[k] = values[count - 1 - k];
        values[count - 1 - k] = value;
    }
}

/* Density of a run at every level of pressure on one branch, where the branch first
 * reaches it from below. */
static bool read_densities(const struct gb_runset_run *run, const char *branch,
                           const double *level, double *density, struct gb_error *err)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    if (!gb_runset_points(run, branch, "p_MPa", "density", &x, &y, &count, err)) {
        return false;
    }
    if (strcmp(branch, "load") != 0) {
        reverse(x, count);
        reverse(y, count);
    }
    const struct gb_average_curve curve = {x, y, count};
    for (size_t k = 0; k < LEVELS; k++) {
        density[k] = gb_average_crossing(&curve, level[k], NULL);
    }
    gb_alloc_free(x);
    gb_alloc_free(y);
    return true;
}

static bool branch_mean(const struct gb_runset *set, size_t group, const char *branch,
                        const double *level, double *mean, double *error,
                        struct gb_error *err)
{
    const size_t members = gb_runset_members(set, group);
    double *rows = g_new(double, members *LEVELS);
    size_t filled = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        if (set->run[i].group == group && has_branch(&set->run[i], branch)) {
            good =
                read_densities(&set->run[i], branch, level, rows + filled * LEVELS, err);
            filled++;
        }
    }
    if (good && filled > 0) {
        gb_average_rows(rows, filled, LEVELS, GB_AVERAGE_ALL, mean, error);
    }
    g_free(rows);
    return good;
}

/* Levels up to the maximum pressure, denser at small ones. */
static bool set_levels(const struct gb_runset *set, double *level, struct gb_error *err)
{
    double max = 0.0;
    for (size_t i = 0; i < set->count; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (!gb_runset_points(&set->run[i], "load", "p_MPa", "density", &x, &y, &count,
                              err)) {
            return false;
        }
        for (size_t k = 0; k < count; k++) {
            max = fmax(max, x[k]);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    for (size_t k = 0; k < LEVELS; k++) {
        const double fraction = (double)k / (LEVELS - 1);
        level[k] = max * fraction * fraction;
    }
    return true;
}

static bool draw_branches(struct gb_series *series, const struct gb_runset *set,
                          size_t group, const double *level, const GPtrArray *branches,
                          struct gb_error *err)
{
    bool good = true;
    for (guint b = 0; b < branches->len && good; b++) {
        const char *branch = g_ptr_array_index(branches, b);
        const bool load = strcmp(branch, "load") == 0;
        double *mean = gb_series_column(series, "density_%zu_%s", group + 1, branch);
        double *error = gb_series_column(series, "se_%zu_%s", group + 1, branch);
        char *label = load ? gb_series_group_label(set, group, NULL) : NULL;
        good = branch_mean(set, group, branch, level, mean, error, err);
        gb_series_draw(series, level, mean, error, GB_FIGURE_LINE, (int)group, label);
        g_free(label);
    }
    return good;
}

/* P1 Fig. 11, 12. */
static bool compute_unloading(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    gb_series_init(series, LEVELS);
    double *level = gb_series_column(series, "p_MPa");
    if (!set_levels(set, level, err)) {
        return false;
    }
    gb_series_note_groups(series, set);
    GPtrArray *branches = list_branches(set);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = draw_branches(series, set, g, level, branches, err);
    }
    g_ptr_array_unref(branches);
    return good;
}

/* Points of a theoretical curve. */
enum { THEORY_POINTS = 400 };

/* Pressures of the densities in the notes, as in P1; MPa. */
static const double compared_mpa[] = {100.0, 200.0};

static const struct geometry {
    int geometry;
    const char *name;
} geometries[] = {{GB_GEOMETRY_UNIAXIAL, "uniaxial"},
                  {GB_GEOMETRY_BIAXIAL, "biaxial"},
                  {GB_GEOMETRY_ISOTROPIC, "isotropic"}};

/* First uniaxial group, the source of the hardening law. */
static bool find_uniaxial(const struct gb_runset *set, size_t *group,
                          struct gb_error *err)
{
    for (*group = 0; *group < set->groups; (*group)++) {
        if (gb_runset_first(set, *group)->params.geometry == GB_GEOMETRY_UNIAXIAL) {
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "continuum: the hardening law is taken from uniaxial pressing; "
                        "expected runs of which one has loading.geometry = uniaxial");
}

/* Hardening law from the mean curve of a group where it is defined. */
static bool fit_law(struct gb_hardening *law, const struct gb_series_sample *sample,
                    const struct gb_runset *set, size_t group, struct gb_error *err)
{
    double *density = g_new(double, sample->size + 1);
    double *pressure = g_new(double, sample->size + 1);
    double *error = g_new(double, sample->size + 1);
    size_t count = 0;
    bool good = gb_series_mean(sample, set, group, pressure, error, err);
    for (size_t i = 0; i < sample->size && good; i++) {
        if (isfinite(pressure[i])) {
            density[count] = sample->grid[i];
            pressure[count++] = 1e6 * pressure[i];
        }
    }
    good = good && gb_theory_hardening_init(law, GB_GEOMETRY_UNIAXIAL, density, pressure,
                                            count, err);
    g_free(density);
    g_free(pressure);
    g_free(error);
    return good;
}

/* Theoretical densities at the compared pressures. */
static void note_densities(struct gb_series *series, const char *name,
                           const double *density, const double *mpa)
{
    const struct gb_average_curve curve = {mpa, density, THEORY_POINTS};
    for (size_t k = 0; k < G_N_ELEMENTS(compared_mpa); k++) {
        const double at = gb_average_crossing(&curve, compared_mpa[k], NULL);
        if (isfinite(at)) {
            gb_series_note(series, "continuum theory, %s: density %.4f at %g MPa", name,
                           at, compared_mpa[k]);
        }
    }
}

static void draw_theory(struct gb_series *series, const struct gb_hardening *law,
                        size_t groups)
{
    for (size_t g = 0; g < G_N_ELEMENTS(geometries); g++) {
        const int geometry = geometries[g].geometry;
        const double end = gb_theory_hardening_density_max(law, geometry);
        double *density =
            gb_series_column(series, "density_theory_%s", geometries[g].name);
        double *mpa = gb_series_column(series, "theory_%s_MPa", geometries[g].name);
        for (size_t i = 0; i < THEORY_POINTS; i++) {
            density[i] =
                law->start + (end - law->start) * (double)i / (THEORY_POINTS - 1);
            mpa[i] = 1e-6 * gb_theory_hardening_pressure(law, geometry, density[i]);
        }
        note_densities(series, geometries[g].name, density, mpa);
        if (geometry == GB_GEOMETRY_UNIAXIAL) {
            continue; /* the source of the law */
        }
        char *label = g_strdup_printf("theory, %s", geometries[g].name);
        gb_series_draw(series, density, mpa, NULL, GB_FIGURE_LINE, (int)(groups + g),
                       label);
        g_free(label);
    }
}

static bool compute_continuum(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_series_sample sample;
    struct gb_hardening law = {0};
    size_t uniaxial = 0;
    if (!find_uniaxial(set, &uniaxial, err) ||
        !gb_series_sample(&sample, set, "load", "density", "p_MPa", err)) {
        return false;
    }
    gb_series_init(series, sample.size > THEORY_POINTS ? sample.size : THEORY_POINTS);
    gb_series_note_groups(series, set);
    gb_series_note(series, "continuum theory: P1 (18)-(23), hardening law of group %zu",
                   uniaxial + 1);
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    bool good = gb_series_means(series, &sample, set, grid, "mean", "_MPa", err) &&
                fit_law(&law, &sample, set, uniaxial, err);
    if (good) {
        draw_theory(series, &law, set->groups);
    }
    gb_theory_hardening_finish(&law);
    gb_series_sample_finish(&sample);
    return good;
}

static bool any_planar_dynamic(const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (gb_loading_kind_of(params)->given_rate && params->dimension == 2) {
            return true;
        }
    }
    return false;
}

/* P2 (8), of discs at any rate. */
static void draw_published(struct gb_series *series, const struct gb_runset *set,
                           const double *density)
{
    double *column = gb_series_column(series, "P2_8");
    for (size_t i = 0; i < series->rows; i++) {
        column[i] = gb_theory_coordination(density[i]);
    }
    gb_series_draw(series, density, column, NULL, GB_FIGURE_LINE, (int)set->groups,
                   "P2 (8)");
}

static bool add_published(struct gb_series *series, const struct gb_runset *set,
                          const double *density, struct gb_error *err)
{
    (void)err;
    if (any_planar_dynamic(set)) {
        draw_published(series, set, density);
    }
    return true;
}

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
    char *label = first ? gb_series_group_label(set, run->group, NULL) : NULL;
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

static bool draw_paths(struct gb_series *series, const struct gb_runset *set,
                       int component, struct gb_error *err)
{
    bool good = true;
    gb_series_init(series, most_rows(set));
    gb_series_list_groups(series, set);
    for (size_t i = 0; i < set->count && good; i++) {
        good = add_run(series, set, i, component, err);
    }
    return good;
}

static bool compute_legs_path(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    return draw_paths(series, input->set, -1, err);
}

/* All runs against the strain of the first one. */
static bool compute_legs_stress_strain(struct gb_series *series,
                                       const struct gb_figures_input *input,
                                       struct gb_error *err)
{
    static const char *const labels[GB_PATH_COMPONENTS] = {
        "axial strain <i>ε<sub>x</sub></i> (%)",
        "axial strain <i>ε<sub>y</sub></i> (%)",
        "axial strain <i>ε<sub>z</sub></i> (%)",
        "shear strain <i>γ<sub>xy</sub></i> (%)",
        "shear strain <i>γ<sub>xz</sub></i> (%)",
        "shear strain <i>γ<sub>yz</sub></i> (%)"};
    struct gb_path path;
    if (!read_path(&input->set->run[0], &path, err)) {
        return false;
    }
    const int component = gb_path_strained(&path);
    const bool good = draw_paths(series, input->set, component, err);
    series->x.name = "strain_percent";
    series->x.label = labels[component];
    return good;
}

static const double default_mpa = 100.0; /* densities are compared there in P1 */

/* First group of the same scene but for the diameter, and for how far and how finely it is
 * loaded. */
static size_t family_of(const struct gb_runset *set, size_t group)
{
    static const char *const may_differ[] = {
        "particles.diameter", "loading.until",  "loading.unload_from", "loading.step",
        "loading.record",     "structure.base", "numerics.",           NULL};
    for (size_t g = 0; g < group; g++) {
        if (gb_runset_difference(set, g, group, may_differ) == NULL) {
            return g;
        }
    }
    return group;
}

/* Order by family, then by diameter: no row of another family interrupts a line. */
static bool comes_before(const struct gb_runset *set, size_t a, size_t b)
{
    const size_t first = family_of(set, a);
    const size_t second = family_of(set, b);
    return first != second ? first < second
                           : gb_runset_first(set, a)->params.diameter_m <
                                 gb_runset_first(set, b)->params.diameter_m;
}

static void sort_groups(size_t *order, const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        size_t at = g;
        while (at > 0 && comes_before(set, g, order[at - 1])) {
            order[at] = order[at - 1];
            at--;
        }
        order[at] = g;
    }
}

/* Columns of the figure; row k is group order[k]. */
struct rows {
    size_t *order;
    double *diameter, *density, *error;
};

/* Difference of the density of a family to that of its smallest diameter, % of theoretical
 * density. */
static void draw_family(struct gb_series *series, const struct gb_runset *set,
                        const struct rows *rows, size_t family, int style)
{
    size_t smallest = set->groups;
    double *value = gb_series_column(series, "difference_%d_points", style + 1);
    double *error = gb_series_column(series, "se_%d_points", style + 1);
    for (size_t k = 0; k < set->groups; k++) {
        if (family_of(set, rows->order[k]) != family) {
            continue;
        }
        smallest = smallest == set->groups ? k : smallest;
        value[k] = 100.0 * (rows->density[k] - rows->density[smallest]);
        error[k] =
            k == smallest ? NAN : 100.0 * hypot(rows->error[k], rows->error[smallest]);
    }
    char *label = gb_series_group_label(set, family, "particles.diameter");
    gb_series_draw(series, rows->diameter, value, error, GB_FIGURE_BOTH, style, label);
    g_free(label);
}

static bool one_diameter(const struct gb_runset *set)
{
    for (size_t g = 1; g < set->groups; g++) {
        if (gb_runset_first(set, g)->params.diameter_m !=
            gb_runset_first(set, 0)->params.diameter_m) {
            return false;
        }
    }
    return true;
}

static bool fill(struct gb_series *series, const struct gb_runset *set,
                 const struct rows *rows, double pressure_mpa, struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < set->groups && good; k++) {
        rows->diameter[k] = 1e9 * gb_runset_first(set, rows->order[k])->params.diameter_m;
        good = gb_series_density_at_pressure(set, rows->order[k], pressure_mpa,
                                             &rows->density[k], &rows->error[k], err) > 0;
    }
    int style = 0;
    for (size_t g = 0; g < set->groups && good; g++) {
        if (family_of(set, g) == g) {
            draw_family(series, set, rows, g, style++);
        }
    }
    return good;
}

/* P1 Fig. 6. */
static bool compute_size_effect(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const double mpa = input->pressure_pa > 0.0 ? input->pressure_pa / 1e6 : default_mpa;
    if (one_diameter(set)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "size-effect: all runs have one diameter; expected runs of "
                            "several");
    }
    gb_series_init(series, set->groups);
    gb_series_note_groups(series, set);
    struct rows rows = {.order = g_new(size_t, set->groups)};
    rows.diameter = gb_series_column(series, "diameter_nm");
    rows.density = gb_series_column(series, "density");
    rows.error = gb_series_column(series, "se");
    sort_groups(rows.order, set);
    const bool good = fill(series, set, &rows, mpa, err);
    g_free(rows.order);
    gb_series_note(series, "density where loading first reaches %g MPa", mpa);
    gb_series_caption(
        series, "At %g MPa, relative to the smallest diameter of each series.", mpa);
    return good;
}

enum { UNIT_MAX = 16, NAME_MAX_BYTES = 96 };
/* More lines of one point each are the points of a design. */
enum { LINES_MOST = 8 };

/* Value of a key in a group as a preset writes it: number and unit.  False for words and
 * auto. */
static bool read_value(const struct gb_runset *set, size_t group,
                       const struct gb_field *field, double *value, char unit[UNIT_MAX])
{
    char text[GB_PARAMS_VALUE_MAX];
    const char *end = text;
    gb_params_format(&gb_runset_first(set, group)->params, field, text, sizeof text);
    if ((field->type != GB_FIELD_NUMBER && field->type != GB_FIELD_RELATIVE &&
         field->type != GB_FIELD_INTEGER) ||
        !gb_units_number(text, &end, value)) {
        return false;
    }
    g_strlcpy(unit, end + strspn(end, " \t"), UNIT_MAX);
    return true;
}

/* Number of different values of a key; 0 when it is not a number in some group, or has
 * several units. */
static size_t count_values(const struct gb_runset *set, const struct gb_field *field)
{
    size_t count = 0;
    char first[UNIT_MAX] = "";
    for (size_t g = 0; g < set->groups; g++) {
        double value = 0.0;
        char unit[UNIT_MAX];
        bool seen = false;
        if (!read_value(set, g, field, &value, unit) ||
            (g > 0 && strcmp(unit, first) != 0)) {
            return 0;
        }
        g_strlcpy(first, unit, sizeof first);
        for (size_t h = 0; h < g && !seen; h++) {
            double other = 0.0;
            seen = read_value(set, h, field, &other, unit) && other == value;
        }
        count += !seen;
    }
    return count;
}

/* The key with the most values, of those that follow from the material or of the others. */
static const struct gb_field *most_values(const struct gb_runset *set, bool follows)
{
    size_t rows = 0;
    size_t max = 1;
    const struct gb_field *fields = gb_params_fields(&rows);
    const struct gb_field *found = NULL;
    for (size_t i = 0; i < rows; i++) {
        const bool other = gb_runset_bookkeeping(&fields[i]) ||
                           gb_runset_follows_material(set, &fields[i]) != follows;
        const size_t values = other ? 0 : count_values(set, &fields[i]);
        if (values > max) {
            max = values;
            found = &fields[i];
        }
    }
    return found;
}

static const struct gb_field *find_key(const struct gb_runset *set, struct gb_error *err)
{
    const struct gb_field *found = most_values(set, false);
    found = found != NULL ? found : most_values(set, true);
    if (found == NULL) {
        gb_error_set(err, GB_ERR_INPUT,
                     "sweep: no number differs between the runs; expected runs that "
                     "differ in a key with numbers");
    }
    return found;
}

/* First group that differs in nothing but the key. */
static size_t family_of_key(const struct gb_runset *set, size_t group, const char *key)
{
    const char *const may_differ[] = {key, NULL};
    for (size_t g = 0; g < group; g++) {
        if (gb_runset_difference(set, g, group, may_differ) == NULL) {
            return g;
        }
    }
    return group;
}

struct point {
    size_t group, family;
    double x;
};

/* Order by family, then by the key: no row of another family interrupts a line. */
static int compare_points(const void *a, const void *b)
{
    const struct point *one = a;
    const struct point *two = b;
    return one->family != two->family
               ? (one->family > two->family) - (one->family < two->family)
               : (one->x > two->x) - (one->x < two->x);
}

/* All groups in the order of their lines.  g_free. */
static struct point *sort_by_value(const struct gb_runset *set,
                                   const struct gb_field *field, const char *key,
                                   char unit[UNIT_MAX])
{
    struct point *point = g_new0(struct point, set->groups);
    for (size_t g = 0; g < set->groups; g++) {
        point[g].group = g;
        point[g].family = family_of_key(set, g, key);
        (void)read_value(set, g, field, &point[g].x, unit);
    }
    qsort(point, set->groups, sizeof *point, compare_points);
    return point;
}

static void draw_key_family(struct gb_series *series, const struct gb_runset *set,
                            const struct point *point, size_t family, const char *key,
                            int style, const double *const from[3])
{
    double *value = gb_series_column(series, "density_%d", style + 1);
    double *error = gb_series_column(series, "se_%d", style + 1);
    for (size_t k = 0; k < set->groups; k++) {
        if (point[k].family == family) {
            value[k] = from[1][k];
            error[k] = from[2][k];
        }
    }
    char *label = gb_series_group_label(set, family, key);
    gb_series_draw(series, from[0], value, error, GB_FIGURE_BOTH, style,
                   *label ? label : NULL);
    g_free(label);
}

static size_t count_families(const struct gb_runset *set, const char *key)
{
    size_t count = 0;
    for (size_t g = 0; g < set->groups; g++) {
        count += family_of_key(set, g, key) == g;
    }
    return count;
}

/* A line for each value of the other keys, or the points of a design as one series. */
static void draw_families(struct gb_series *series, const struct gb_runset *set,
                          const struct point *point, const char *key,
                          const double *const from[3])
{
    const size_t families = count_families(set, key);
    int style = 0;
    if (families == set->groups && families > LINES_MOST) {
        gb_series_draw(series, from[0], from[1], from[2], GB_FIGURE_POINTS, 0, NULL);
        gb_series_caption(series, "Other keys differ from point to point.");
        return;
    }
    for (size_t g = 0; g < set->groups; g++) {
        if (family_of_key(set, g, key) == g) {
            draw_key_family(series, set, point, g, key, style++, from);
        }
    }
}

/* Density where loading first reaches a pressure, against the key with the most values; a
 * line for each value of the others. */
static bool compute_sweep(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const double mpa = input->pressure_pa > 0.0 ? input->pressure_pa / 1e6 : default_mpa;
    char unit[UNIT_MAX] = "";
    char key[NAME_MAX_BYTES];
    const struct gb_field *field = find_key(set, err);
    if (field == NULL) {
        return false;
    }
    snprintf(key, sizeof key, "%s.%s", field->group, field->key);
    struct point *point = sort_by_value(set, field, key, unit);
    gb_series_init(series, set->groups);
    gb_series_note_groups(series, set);
    double *x = gb_series_column(series, "%s%s%s", key, *unit ? "_" : "", unit);
    double *density = gb_series_column(series, "density");
    double *error = gb_series_column(series, "se");
    bool good = true;
    for (size_t k = 0; k < set->groups && good; k++) {
        x[k] = point[k].x;
        good = gb_series_density_at_pressure(set, point[k].group, mpa, &density[k],
                                             &error[k], err) > 0;
    }
    const double *const columns[3] = {x, density, error};
    if (good) {
        draw_families(series, set, point, key, columns);
    }
    g_free(point);
    gb_series_note(series, "density where loading first reaches %g MPa", mpa);
    gb_series_caption(series, "At %g MPa.", mpa);
    const char *name = g_ptr_array_index(series->names, 0); /* lives as the series */
    char *axis = gb_series_key_label(key, unit);
    series->x.name = name;
    series->x.label = g_intern_string(axis);
    g_free(axis);
    return good;
}

static bool compute_fit(struct gb_series *series, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    return gb_series_powder_runs(series, input->set, gb_series_powder_fit, err);
}

static bool compute_heckel(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    return gb_series_powder_runs(series, input->set, gb_series_powder_heckel, err);
}

const struct gb_figures_row gb_figures_runs_rows[] = {
    {"unloading", "density against pressure, loading and unloading", "P1 Fig. 11, 12",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = GB_FIGURES_PRESSURE_AXIS,
     .y = GB_FIGURES_DENSITY_AXIS, .compute = compute_unloading},
    {"continuum", "pressure against density, with continuum theory for three geometries",
     "P1 Fig. 12", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = GB_FIGURES_DENSITY_AXIS,
     .y = GB_FIGURES_PRESSURE_AXIS, .compute = compute_continuum},
    {"fit", "density against pressure with fitted equations of compaction, residuals", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = gb_figures_after_loading,
     .x = {.name = "p_MPa", .label = "pressure <i>p</i> (MPa)", .log = true},
     .y = GB_FIGURES_DENSITY_AXIS, .compute = compute_fit},
    {"heckel", "Heckel plot with its straightest stretch and the yield pressure",
     "Heckel 1961", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .ignored_keys = gb_figures_after_loading, .x = GB_FIGURES_PRESSURE_AXIS,
     .y = {.name = "log_porosity", .label = "ln(1 / (1 − <i>ρ</i>))"},
     .compute = compute_heckel},
    {"coordination", "mean coordination number against density", "P1 Fig. 8, P2 (8)",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = gb_figures_after_loading,
     .x = GB_FIGURES_DENSITY_AXIS,
     .y = {.name = "coordination", .label = "mean coordination number"},
     .mean = {"load", "density", "coordination", .column = "coordination", .unit = "",
              .unrelaxed = true, .more = add_published}},
    {"lateral", "lateral-to-axial stress ratio against density", "P1 Fig. 13",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = gb_figures_after_loading,
     .x = GB_FIGURES_DENSITY_AXIS,
     .y = {.name = "ratio",
           .label = "lateral-to-axial stress ratio <i>p<sub>x</sub></i> / "
                    "<i>p<sub>z</sub></i>"},
     .mean = {"load", "density", "px_MPa", .over = "pz_MPa", .column = "ratio",
              .unit = ""}},
    {"path", "deviatoric stress against mean pressure, leg by leg", "", GB_FIGURES_RUNS,
     GB_FIGURES_IN_REPORT,
     .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = compute_legs_path},
    {"stress-strain", "deviatoric stress against the strain of the legs", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = compute_legs_stress_strain},
    {"size-effect", "density difference at one pressure against particle diameter",
     "P1 Fig. 6", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, GB_FIGURES_PRESSURE,
     .x = {.name = "diameter_nm", .label = "particle diameter <i>d</i> (nm)"},
     .y = {.name = "difference_points",
           .label = "difference of relative density Δ<i>ρ</i> (%)"},
     .compute = compute_size_effect},
    {"sweep",
     "density at one pressure against a varied key, one line per value of others", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, GB_FIGURES_PRESSURE,
     .y = GB_FIGURES_DENSITY_AXIS, .compute = compute_sweep},
    {0},
};
