#include "figures/figures_compute.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "figures/figures_label.h"
#include "measure/fit/average.h"

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
        char *label = load ? gb_figures_label(set, group, NULL) : NULL;
        good = branch_mean(set, group, branch, level, mean, error, err);
        gb_series_draw(series, level, mean, error, GB_FIGURE_LINE, (int)group, label);
        g_free(label);
    }
    return good;
}

/* P1 Fig. 11, 12. */
bool gb_figures_unloading(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    gb_series_init(series, LEVELS);
    double *level = gb_series_column(series, "p_MPa");
    if (!set_levels(set, level, err)) {
        return false;
    }
    gb_figures_label_note(series, set);
    GPtrArray *branches = list_branches(set);
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        good = draw_branches(series, set, g, level, branches, err);
    }
    g_ptr_array_unref(branches);
    return good;
}
