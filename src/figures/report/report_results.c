#include <math.h>
#include <string.h>

#include "figures/report/report.h"
#include "figures/report/report_conditions.h"
#include "figures/report/report_springback.h"
#include "figures/report/report_table.h"
#include "figures/runs/density_at_pressure.h"
#include "io/measured.h"
#include "many/die_summary.h"
#include "measure/cell_scatter.h"
#include "measure/fit/average.h"
#include "run/moduli/moduli_states.h"

/* Pressures of the first page, MPa. */
static const double levels[] = {10.0, 50.0, 100.0, 500.0};

static const double percent = 100.0;

/* A result of a group. */
struct result {
    const char *scene;
    size_t cells;
    double mean, error; /* error NaN: not known */
    const char *unit;
    int decimals;
};

/* Cells from which on the standard error of a mean needs no word on its own error. */
enum { CELLS_ENOUGH = 5 };

/* What the error of a mean is; that of few cells is uncertain by 1/sqrt(2 (n - 1)).  g_free. */
static char *basis_of(size_t cells)
{
    return cells < CELLS_ENOUGH
               ? g_strdup_printf("standard error of %zu cells, itself known to %.0f %%",
                                 cells, 100.0 / sqrt(2.0 * ((double)cells - 1.0)))
               : g_strdup("standard error of the cells");
}

/* basis: what the error is; NULL: the standard error of the cells, where it is known. */
static void put(struct gb_report_table *table, const struct result *result,
                const char *quantity, const char *basis)
{
    const bool known = isfinite(result->error) && result->error > 0.0;
    gb_report_table_put(table, "%s", result->scene);
    gb_report_table_put(table, "%s", quantity);
    gb_report_table_put_mean(table, result->mean, result->error, result->decimals);
    gb_report_table_put(table, "%s", result->unit);
    gb_report_table_put(table, "%zu", result->cells);
    char *of_cells = basis_of(MAX(result->cells, 2));
    gb_report_table_put(table, "%s",
                        basis != NULL                ? basis
                        : known && result->cells > 1 ? of_cells
                        : known                      ? "expected scatter of one cell"
                                                     : "");
    g_free(of_cells);
}

static void put_densities(struct gb_report_table *table, const struct gb_runset *set,
                          size_t group, const char *scene)
{
    for (size_t k = 0; k < G_N_ELEMENTS(levels); k++) {
        struct result result = {.scene = scene, .unit = "1", .decimals = 4};
        result.cells = gb_density_at_pressure(set, group, levels[k], &result.mean,
                                              &result.error, NULL);
        if (result.cells > 0) {
            char *quantity = g_strdup_printf("relative density at %g MPa", levels[k]);
            if (result.cells == 1) {
                result.error = gb_cell_scatter(&gb_runset_first(set, group)->params);
            }
            put(table, &result, quantity, NULL);
            g_free(quantity);
        }
    }
}

static void put_springback(struct gb_report_table *table, const struct gb_runset *set,
                           size_t group, const char *scene)
{
    const struct gb_params *params = &gb_runset_first(set, group)->params;
    for (int k = 0; k < params->unload_count; k++) {
        struct result result = {.scene = scene, .unit = "%", .decimals = 2};
        const double from_mpa = 1e-6 * params->unload_from_pa[k];
        result.cells =
            gb_report_springback(set, group, from_mpa, &result.mean, &result.error);
        if (result.cells > 0) {
            char *quantity =
                g_strdup_printf("springback by volume from %g MPa", from_mpa);
            put(table, &result, quantity, NULL);
            g_free(quantity);
        }
    }
}

static void put_die(struct gb_report_table *table, const struct gb_runset *set,
                    size_t group, const char *scene)
{
    static const char *const names[] = {"axial_in_die_percent", "axial_percent",
                                        "radial_percent"};
    for (const struct gb_die_summary_row *row = gb_die_summary_table(); row->name;
         row++) {
        for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
            struct result result = {.scene = scene, .unit = "%", .decimals = 2};
            if (strcmp(names[k], row->name) != 0) {
                continue;
            }
            result.cells =
                gb_die_summary_mean(row, set, group, &result.mean, &result.error);
            if (result.cells > 0) {
                put(table, &result, row->doc, NULL);
            }
        }
    }
}

/* The state is the last point of the run: moduli.csv may lack it, or end before it. */
static bool is_end(const struct gb_runset_run *run, const struct gb_moduli_state *state)
{
    const double *steps =
        run->table != NULL ? gb_table_column(run->table, "step", NULL) : NULL;
    const size_t rows = steps != NULL ? gb_table_rows(run->table) : 0;
    return rows > 0 &&
           steps[rows - 1] == gb_moduli_states_mean(state, gb_moduli_table_find("step"));
}

/* A modulus of the last state of each run of a group, of those whose moduli.csv has it. */
static void put_modulus(struct gb_report_table *table, const struct gb_runset *set,
                        size_t group, const char *scene, const char *column,
                        const char *quantity)
{
    double *values = g_new(double, set->count);
    struct result result = {.scene = scene,
                            .unit = g_str_has_suffix(column, "_GPa") ? "GPa" : "1",
                            .decimals = 3};
    double own = NAN; /* error over the replicas of one table */
    for (size_t i = 0; i < set->count; i++) {
        GArray *states = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
        char *path = g_build_filename(set->run[i].directory, GB_MODULI_STATES_FILE, NULL);
        if (set->run[i].group == group && gb_moduli_states_read(states, path, NULL) &&
            states->len > 0) {
            gb_moduli_states_sort(states);
            const struct gb_moduli_state *last =
                &g_array_index(states, struct gb_moduli_state, states->len - 1);
            if (is_end(&set->run[i], last)) {
                values[result.cells++] =
                    gb_moduli_states_mean(last, gb_moduli_table_find(column));
                own = gb_moduli_states_error(last, gb_moduli_table_find(column));
            }
        }
        g_free(path);
        g_array_unref(states);
    }
    gb_average_values(values, result.cells, &result.mean, &result.error);
    if (result.cells > 0) {
        result.error = result.cells == 1 ? own : result.error;
        char *basis = basis_of(MAX(result.cells, 2));
        put(table, &result, quantity,
            result.cells > 1 && result.error > 0.0 ? basis
            : result.error > 0.0                   ? "standard error of the cells"
                                                   : "");
        g_free(basis);
    }
    g_free(values);
}

static void put_moduli(struct gb_report_table *table, const struct gb_runset *set,
                       size_t group, const char *scene)
{
    static const char *const moduli[][2] = {
        {"E_GPa", "Young's modulus of the last state"},
        {"K_GPa", "bulk modulus of the last state"},
        {"G_GPa", "shear modulus of the last state"},
        {"nu", "Poisson's ratio of the last state"}};
    for (size_t k = 0; k < G_N_ELEMENTS(moduli); k++) {
        put_modulus(table, set, group, scene, moduli[k][0], moduli[k][1]);
    }
}

static bool is_unloading(const struct gb_table *data, size_t row)
{
    return gb_table_words(data) != NULL && strcmp(gb_table_words(data), "branch") == 0 &&
           g_str_has_prefix(gb_table_word(data, row), "unload");
}

/* RMS of the density of the group less the measured one at the same pressure. */
static void put_misfit(struct gb_report_table *table, const struct gb_report *report,
                       size_t group, const char *scene)
{
    struct gb_measured *measured = NULL;
    double squares = 0.0;
    size_t points = 0;
    if (!gb_measured_take(&measured, report->data, false, NULL)) {
        return; /* a table of other quantities */
    }
    for (size_t i = 0; i < measured->count; i++) {
        double mean = NAN;
        double error = NAN;
        if (!is_unloading(report->data, i) &&
            gb_density_at_pressure(report->set, group, 1e-6 * measured->pressure_pa[i],
                                   &mean, &error, NULL) > 0) {
            squares += pow(mean - measured->density[i], 2.0);
            points++;
        }
    }
    if (points > 0) {
        const struct result result = {scene,
                                      gb_runset_members(report->set, group),
                                      percent * sqrt(squares / (double)points),
                                      NAN,
                                      "% of theoretical density",
                                      2};
        char *basis =
            g_strdup_printf("%zu of %zu measured points", points, measured->count);
        put(table, &result, "RMS misfit to the laboratory file", basis);
        g_free(basis);
    }
    gb_measured_destroy(measured);
}

static bool write_conditions(struct gb_report *report, struct gb_error *err)
{
    const char *heads[GB_REPORT_CONDITIONS + 2] = {"scene"};
    struct gb_report_table table;
    for (int k = 0; k < GB_REPORT_CONDITIONS; k++) {
        heads[k + 1] = gb_report_conditions_heads[k];
    }
    gb_report_table_begin(&table, heads);
    for (size_t g = 0; g < report->set->groups; g++) {
        char *scene = gb_report_table_scene(report->set, g);
        gb_report_table_put(&table, "%s", scene);
        for (int k = 0; k < GB_REPORT_CONDITIONS; k++) {
            char *value = gb_report_conditions_of(report->set, g, k);
            gb_report_table_put(&table, "%s", value);
            g_free(value);
        }
        g_free(scene);
    }
    return gb_report_table_end(report, &table, "conditions", "Conditions of the scenes.",
                               err);
}

bool gb_report_results(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "quantity", "value", "unit",
                                        "cells", "error",    NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    if (!write_conditions(report, err)) {
        return false;
    }
    gb_report_table_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        char *scene = gb_report_table_scene(set, g);
        put_densities(&table, set, g, scene);
        put_springback(&table, set, g, scene);
        put_die(&table, set, g, scene);
        put_moduli(&table, set, g, scene);
        if (report->data != NULL) {
            put_misfit(&table, report, g, scene);
        }
        g_free(scene);
    }
    char *caption = gb_report_caption(
        report,
        "Key results on loading, with errors. The scatter expected of one cell is "
        "the standard deviation from structure to structure, measured for 3D "
        "quasi-static cells (0.0064 for 1000 particles).");
    const bool good = gb_report_table_end(report, &table, "results", caption, err);
    g_free(caption);
    return good;
}
