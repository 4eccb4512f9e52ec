#include "figures/report/report.h"

#include <math.h>
#include <string.h>

#include "figures/report/report_table.h"
#include "figures/runs/density_at_pressure.h"
#include "measure/fit/average.h"

/* Pressures of the table of densities, MPa. */
static const double levels[] = {10.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0};

/* With the conditions behind its caption. */
static bool end_table(struct gb_report *report, struct gb_report_table *table,
                      const char *name, const char *text, struct gb_error *err)
{
    char *caption = gb_report_caption(report, text);
    const bool good = gb_report_table_end(report, table, name, caption, err);
    g_free(caption);
    return good;
}

static bool density_table(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "runs", "p (MPa)", "relative density",
                                        NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    gb_report_table_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        char *name = gb_report_table_scene(set, g);
        for (size_t k = 0; k < G_N_ELEMENTS(levels); k++) {
            double mean = NAN;
            double error = NAN;
            const size_t cells =
                gb_density_at_pressure(set, g, levels[k], &mean, &error, NULL);
            if (cells > 0) {
                gb_report_table_put(&table, "%s", name);
                gb_report_table_put(&table, "%zu", cells);
                gb_report_table_put(&table, "%g", levels[k]);
                gb_report_table_put_mean(&table, mean, error, 4);
            }
        }
        g_free(name);
    }
    return end_table(report, &table, "density",
                     "Relative density where loading first reaches a pressure; mean and "
                     "standard error over the runs.",
                     err);
}

/* Last row of a branch; the number of rows when there is none. */
static size_t last_row(const struct gb_table *table, const char *branch)
{
    size_t found = gb_table_rows(table);
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        if (strcmp(gb_table_word(table, k), branch) == 0) {
            found = k;
        }
    }
    return found;
}

static void put_mean(struct gb_report_table *table, const struct gb_runset *set,
                     size_t group, const char *branch, const char *column, int decimals)
{
    double *values = g_new(double, set->count + 1);
    size_t filled = 0;
    double mean = NAN;
    double error = NAN;
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        const double *cells =
            run->table != NULL ? gb_table_column(run->table, column, NULL) : NULL;
        if (run->group == group && cells != NULL) {
            const size_t row = last_row(run->table, branch);
            if (row < gb_table_rows(run->table)) {
                values[filled++] = cells[row];
            }
        }
    }
    gb_average_values(values, filled, &mean, &error);
    gb_report_table_put_mean(table, mean, error, decimals);
    g_free(values);
}

/* Branches of the first run of a group, in their order. */
static GPtrArray *branches_of(const struct gb_runset_run *run)
{
    GPtrArray *names = g_ptr_array_new();
    for (size_t k = 0; run->table != NULL && k < gb_table_rows(run->table); k++) {
        const char *word = gb_table_word(run->table, k);
        if (!g_ptr_array_find_with_equal_func(names, word, g_str_equal, NULL)) {
            g_ptr_array_add(names, (char *)(uintptr_t)word);
        }
    }
    return names;
}

static bool ends_table(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {
        "scene",        "branch",           "relative density", "p (MPa)",
        "coordination", "bridged fraction", "rattlers",         NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    gb_report_table_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        GPtrArray *branches = branches_of(gb_runset_first(set, g));
        char *name = gb_report_table_scene(set, g);
        for (guint b = 0; b < branches->len; b++) {
            const char *branch = g_ptr_array_index(branches, b);
            gb_report_table_put(&table, "%s", name);
            gb_report_table_put(&table, "%s", branch);
            put_mean(&table, set, g, branch, "density", 4);
            put_mean(&table, set, g, branch, "p_MPa", 1);
            put_mean(&table, set, g, branch, "coordination", 3);
            put_mean(&table, set, g, branch, "bridged", 3);
            put_mean(&table, set, g, branch, "rattlers", 4);
        }
        g_free(name);
        g_ptr_array_unref(branches);
    }
    return end_table(report, &table, "ends",
                     "Last point of each branch; mean and standard error over the runs.",
                     err);
}

bool gb_report_tables(struct gb_report *report, struct gb_error *err)
{
    return density_table(report, err) && ends_table(report, err);
}
