#include "figures/figures_curve.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "figures/figures_label.h"
#include "measure/fit/average.h"

#define RHO "<i>\xcf\x81</i>"

/* Pressures at which densities are averaged. */
enum { LEVELS = 240 };

/* Below this share of the greatest axial pressure the ratio of two small numbers says
 * nothing. */
static const double least_share = 0.01;

static const double megapascal = 1e6;

bool gb_figures_curve_coordination(struct gb_series *series,
                                   const struct gb_figures_input *input,
                                   struct gb_error *err)
{
    struct gb_series_sample sample;
    const struct gb_runset *set = input->set;
    if (!gb_series_sample(&sample, set, "load", "density", "coordination", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_figures_label_note(series, set);
    gb_series_axes(series, "density", "relative density " RHO, "coordination",
                   "mean coordination number");
    const double *grid = gb_series_sample_grid(series, &sample, "density");
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        double *mean = gb_series_column(series, "coordination_%zu", g + 1);
        double *error = gb_series_column(series, "se_%zu", g + 1);
        char *label = gb_figures_label(set, g, NULL);
        good = gb_series_mean(&sample, set, g, mean, error, err);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
    }
    gb_series_sample_finish(&sample);
    return good;
}

/* p_x / p_z of every run in place of p_x. */
static void divide(struct gb_series_sample *lateral, const struct gb_series_sample *axial,
                   size_t runs)
{
    for (size_t i = 0; i < runs; i++) {
        double *x = lateral->rows + i * lateral->size;
        const double *z = axial->rows + i * axial->size;
        double most = 0.0;
        for (size_t k = 0; k < lateral->size; k++) {
            most = isnan(z[k]) ? most : fmax(most, z[k]);
        }
        bool large = true; /* from here to the end of loading */
        for (size_t k = lateral->size; k > 0; k--) {
            large = large && !(z[k - 1] <= least_share * most);
            x[k - 1] = large ? x[k - 1] / z[k - 1] : NAN;
        }
    }
}

bool gb_figures_curve_lateral(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_series_sample lateral;
    struct gb_series_sample axial = {0};
    const struct gb_runset *set = input->set;
    if (!gb_series_sample(&lateral, set, "load", "density", "px_MPa", err)) {
        return false;
    }
    bool good = gb_series_sample(&axial, set, "load", "density", "pz_MPa", err);
    if (good) {
        divide(&lateral, &axial, set->count);
        gb_series_init(series, lateral.size);
        gb_figures_label_note(series, set);
        gb_series_note(series, "left out below %g of the greatest pz", least_share);
        gb_series_axes(series, "density", "relative density " RHO, "ratio",
                       "lateral over axial pressure, <i>p<sub>x</sub></i> / "
                       "<i>p<sub>z</sub></i>");
    }
    const double *grid = good ? gb_series_sample_grid(series, &lateral, "density") : NULL;
    for (size_t g = 0; g < set->groups && good; g++) {
        double *mean = gb_series_column(series, "ratio_%zu", g + 1);
        double *error = gb_series_column(series, "se_%zu", g + 1);
        char *label = gb_figures_label(set, g, NULL);
        good = gb_series_mean(&lateral, set, g, mean, error, err);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
    }
    gb_series_sample_finish(&axial);
    gb_series_sample_finish(&lateral);
    return good;
}

/* The branches of a table that are "load" or begin with "unload", in their order. */
static GPtrArray *list_branches(const struct gb_runset *set)
{
    GPtrArray *names = g_ptr_array_new();
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_table *table = set->run[i].table;
        for (size_t k = 0; table != NULL && k < gb_table_rows(table); k++) {
            const char *word = gb_table_word(table, k);
            const bool wanted =
                strcmp(word, "load") == 0 || g_str_has_prefix(word, "unload");
            if (wanted &&
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
        const double kept = values[k];
        values[k] = values[count - 1 - k];
        values[count - 1 - k] = kept;
    }
}

/* Density of a run at every level of pressure of one branch, where it is first reached
 * from below. */
static bool densities(const struct gb_runset_run *run, const char *branch,
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
            good = densities(&set->run[i], branch, level, rows + filled * LEVELS, err);
            filled++;
        }
    }
    if (good && filled > 0) {
        gb_average_rows(rows, filled, LEVELS, true, mean, error);
    }
    g_free(rows);
    return good;
}

/* The pressures: closer where they are small. */
static bool set_levels(const struct gb_runset *set, double *level, struct gb_error *err)
{
    double most = 0.0;
    for (size_t i = 0; i < set->count; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (!gb_runset_points(&set->run[i], "load", "p_MPa", "density", &x, &y, &count,
                              err)) {
            return false;
        }
        for (size_t k = 0; k < count; k++) {
            most = fmax(most, x[k]);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    for (size_t k = 0; k < LEVELS; k++) {
        const double share = (double)k / (LEVELS - 1);
        level[k] = most * share * share;
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
        char *label = load ? gb_figures_label(set, group, NULL) : NULL;
        good = branch_mean(set, group, branch, level, mean, error, err);
        gb_series_draw(series, level, mean, error, GB_FIGURE_LINE, (int)group, label);
        g_free(label);
    }
    return good;
}

bool gb_figures_curve_unloading(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    gb_series_init(series, LEVELS);
    double *level = gb_series_column(series, "p_MPa");
    if (!set_levels(set, level, err)) {
        return false;
    }
    gb_figures_label_note(series, set);
    gb_series_axes(series, "p_MPa", "pressure <i>p</i> (MPa)", "density",
                   "relative density " RHO);
    GPtrArray *branches = list_branches(set);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = draw_branches(series, set, g, level, branches, err);
    }
    g_ptr_array_unref(branches);
    return good;
}

bool gb_figures_curve_density(const struct gb_runset *set, size_t group,
                              double pressure_mpa, double *mean, double *error,
                              struct gb_error *err)
{
    double *values = g_new(double, set->count);
    size_t members = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        double *x = NULL;
        double *y = NULL;
        size_t count = 0;
        if (set->run[i].group != group) {
            continue;
        }
        good = gb_runset_points(&set->run[i], "load", "p_MPa", "density", &x, &y, &count,
                                err);
        if (good) {
            const struct gb_average_curve curve = {x, y, count};
            values[members++] = gb_average_crossing(&curve, pressure_mpa, NULL);
        }
        gb_alloc_free(x);
        gb_alloc_free(y);
    }
    const size_t used = gb_average_values(values, members, mean, error);
    g_free(values);
    return good && (used > 0 ||
                    gb_error_set(err, GB_ERR_INPUT, "%.300s: never reaches %g MPa",
                                 gb_runset_first(set, group)->directory, pressure_mpa));
}

/* Groups that differ in nothing but the diameter, and in how far and how finely they are
 * pressed, are one family; another geometry or rate of loading is another one. */
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

/* Family by family, in the order of their diameters: lines join neighbours, and rows of
 * others leave no gap in them. */
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

/* One family: difference of density in points to its smallest diameter.  Row k is group
 * order[k]. */
static void draw_family(struct gb_series *series, const struct gb_runset *set,
                        const size_t *order, size_t family, int style,
                        const double *diameter, const double *density,
                        const double *spread)
{
    size_t least = set->groups;
    double *value = gb_series_column(series, "difference_%d_points", style + 1);
    double *error = gb_series_column(series, "se_%d_points", style + 1);
    for (size_t k = 0; k < set->groups; k++) {
        if (family_of(set, order[k]) != family) {
            continue;
        }
        least = least == set->groups ? k : least;
        value[k] = 100.0 * (density[k] - density[least]);
        error[k] = k == least ? NAN : 100.0 * hypot(spread[k], spread[least]);
    }
    char *label = gb_figures_label(set, family, "particles.diameter");
    gb_series_draw(series, diameter, value, error, GB_FIGURE_BOTH, style, label);
    g_free(label);
}

bool gb_figures_curve_size(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const double pressure_mpa =
        input->pressure_pa > 0.0 ? input->pressure_pa / megapascal : 100.0;
    size_t *order = g_new(size_t, set->groups);
    sort_groups(order, set);
    if (gb_runset_first(set, order[0])->params.diameter_m ==
        gb_runset_first(set, order[set->groups - 1])->params.diameter_m) {
        g_free(order);
        return gb_error_set(err, GB_ERR_INPUT,
                            "size-effect: all runs have one diameter; accepted runs of "
                            "several");
    }
    gb_series_init(series, set->groups);
    gb_figures_label_note(series, set);
    double *diameter = gb_series_column(series, "diameter_nm");
    double *density = gb_series_column(series, "density");
    double *spread = gb_series_column(series, "se");
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        diameter[g] = 1e9 * gb_runset_first(set, order[g])->params.diameter_m;
        good = gb_figures_curve_density(set, order[g], pressure_mpa, &density[g],
                                        &spread[g], err);
    }
    int style = 0;
    for (size_t g = 0; g < set->groups && good; g++) {
        if (family_of(set, g) == g) {
            draw_family(series, set, order, g, style++, diameter, density, spread);
        }
    }
    g_free(order);
    gb_series_note(series, "density where loading first reaches %g MPa", pressure_mpa);
    gb_series_say(series, "At %g MPa, against the smallest particles of each series.",
                  pressure_mpa);
    gb_series_axes(series, "diameter_nm", "particle diameter <i>d</i> (nm)",
                   "difference_points", "density difference \xce\x94" RHO " (points)");
    return good;
}
