#include "figures/report/report_tables.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "figures/figures_curve.h"
#include "measure/fit/average.h"

/* Pressures at which densities are told, MPa. */
static const double levels[] = {10.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0};

/* A table under way: heads, cells, and the file. */
struct table {
    const char *heads[12];
    guint columns;
    GPtrArray *cells;
};

static void begin(struct table *table, const char *const *heads)
{
    table->columns = 0;
    for (int k = 0; heads[k] != NULL; k++) {
        table->heads[table->columns++] = heads[k];
    }
    table->cells = g_ptr_array_new_with_free_func(g_free);
}

static void put(struct table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void put(struct table *table, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    g_ptr_array_add(table->cells, g_strdup_vprintf(format, arguments));
    va_end(arguments);
}

/* Mean and standard error as people write them. */
static void put_value(struct table *table, double mean, double error, int decimals)
{
    if (fabs(mean) < 0.5 * pow(10.0, -decimals)) {
        mean = 0.0; /* no minus before a zero */
    }
    if (!isfinite(mean)) {
        put(table, "%s", "");
    } else if (isfinite(error)) {
        put(table, "%.*f \xc2\xb1 %.*f", decimals, mean, decimals, error);
    } else {
        put(table, "%.*f", decimals, mean);
    }
}

static void append_csv(GString *text, const char *const *cells, guint columns)
{
    for (guint k = 0; k < columns; k++) {
        char **parts = g_strsplit(cells[k], "\"", -1);
        char *quoted = g_strjoinv("\"\"", parts);
        g_string_append_printf(text, "%s\"%s\"", k > 0 ? "," : "", quoted);
        g_free(quoted);
        g_strfreev(parts);
    }
    g_string_append_c(text, '\n');
}

/* Into the page and the folder; frees the table. */
static bool finish(struct gb_report *report, struct table *table, const char *name,
                   const char *caption, struct gb_error *err)
{
    char *file = g_strdup_printf("tables/%s.csv", name);
    char *path = g_build_filename(report->folder, file, NULL);
    GString *text = g_string_new(NULL);
    append_csv(text, table->heads, table->columns);
    for (guint k = 0; k + table->columns <= table->cells->len; k += table->columns) {
        append_csv(text, (const char *const *)table->cells->pdata + k, table->columns);
    }
    const bool good = gb_file_replace(path, text->str, text->len, err);
    gb_page_table(&report->page, caption, file, table->heads, table->columns,
                  table->cells);
    g_string_free(text, TRUE);
    g_free(path);
    g_free(file);
    g_ptr_array_unref(table->cells);
    return good;
}

/* What a group is called in tables: what tells it from the others, or its title. */
static char *name_of(const struct gb_runset *set, size_t group)
{
    char *label = gb_runset_label(set, group);
    if (*label != '\0' && strlen(label) < 120) {
        return label;
    }
    g_free(label);
    return g_strdup(gb_runset_first(set, group)->params.title);
}

static bool density_table(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"experiment", "runs", "pressure (MPa)", "density",
                                        NULL};
    const struct gb_runset *set = report->set;
    struct table table;
    begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        char *name = name_of(set, g);
        for (size_t k = 0; k < G_N_ELEMENTS(levels); k++) {
            double mean = NAN;
            double error = NAN;
            if (gb_figures_curve_density(set, g, levels[k], &mean, &error, NULL)) {
                put(&table, "%s", name);
                put(&table, "%zu", gb_runset_members(set, g));
                put(&table, "%g", levels[k]);
                put_value(&table, mean, error, 4);
            }
        }
        g_free(name);
    }
    return finish(report, &table, "density",
                  "Density where loading first reaches a pressure; mean and standard "
                  "error over the runs.",
                  err);
}

/* Last row of a branch in a table; rows when there is none. */
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

static void put_mean(struct table *table, const struct gb_runset *set, size_t group,
                     const char *branch, const char *column, int decimals)
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
    put_value(table, mean, error, decimals);
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
        "experiment",   "branch",        "density",  "p (MPa)",
        "coordination", "bridged share", "rattlers", NULL};
    const struct gb_runset *set = report->set;
    struct table table;
    begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        GPtrArray *branches = branches_of(gb_runset_first(set, g));
        char *name = name_of(set, g);
        for (guint b = 0; b < branches->len; b++) {
            const char *branch = g_ptr_array_index(branches, b);
            put(&table, "%s", name);
            put(&table, "%s", branch);
            put_mean(&table, set, g, branch, "density", 4);
            put_mean(&table, set, g, branch, "p_MPa", 1);
            put_mean(&table, set, g, branch, "coordination", 3);
            put_mean(&table, set, g, branch, "bridged", 3);
            put_mean(&table, set, g, branch, "rattlers", 4);
        }
        g_free(name);
        g_ptr_array_unref(branches);
    }
    return finish(report, &table, "ends",
                  "Last point of each branch; mean and standard error over the runs.",
                  err);
}

bool gb_report_tables(struct gb_report *report, struct gb_error *err)
{
    return density_table(report, err) && ends_table(report, err);
}

/* Copies a file of a run; *sum becomes its SHA-256, "" when the run has no such file. */
static bool copy_file(const struct gb_report *report, size_t run, const char *name,
                      char **sum, struct gb_error *err)
{
    char *text = NULL;
    gsize size = 0;
    char *from = g_build_filename(report->set->run[run].directory, name, NULL);
    char *to = g_strdup_printf("%s/runs/%zu-%s", report->folder, run + 1, name);
    bool good = true;
    *sum = g_strdup("");
    if (g_file_get_contents(from, &text, &size, NULL)) {
        g_free(*sum);
        *sum = g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, size);
        good = gb_file_replace(to, text, size, err);
    }
    g_free(text);
    g_free(to);
    g_free(from);
    return good;
}

bool gb_report_tables_runs(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"run",
                                        "directory",
                                        "title",
                                        "particles",
                                        "seed",
                                        "points",
                                        "SHA-256 of curve.csv",
                                        NULL};
    const struct gb_runset *set = report->set;
    struct table table;
    bool good = true;
    begin(&table, heads);
    for (size_t i = 0; i < set->count && good; i++) {
        const struct gb_runset_run *run = &set->run[i];
        char *preset = NULL;
        char *curve = NULL;
        good = copy_file(report, i, "preset.ini", &preset, err) &&
               copy_file(report, i, "curve.csv", &curve, err);
        put(&table, "%zu", i + 1);
        put(&table, "%s", run->directory);
        put(&table, "%s", run->params.title);
        put(&table, "%" G_GINT64_FORMAT, run->params.count);
        put(&table, "%" G_GUINT64_FORMAT, run->params.seed);
        put(&table, "%zu", run->table != NULL ? gb_table_rows(run->table) : 0);
        put(&table, "%.16s", curve != NULL ? curve : "");
        g_free(preset);
        g_free(curve);
    }
    return finish(
               report, &table, "runs",
               "Runs; their presets and curves are in the folder runs as "
               "NUMBER-preset.ini and NUMBER-curve.csv. greenbody run NUMBER-preset.ini "
               "makes a run again, to the last bit.",
               err) &&
           good;
}
