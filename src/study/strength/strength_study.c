#include "study/strength/strength_study.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/table.h"
#include "scene/seed.h"
#include "study/compact/compact.h"
#include "study/compact/study_text.h"
#include "study/strength/strength_cell.h"

/* Peak of the curve of a test. */
static struct gb_strength_broken read_test(const struct gb_table *table, int test)
{
    const double *which = gb_table_column(table, "test", NULL);
    const double *strain = gb_table_column(table, "strain", NULL);
    const double *stress = gb_table_column(table, "stress_Pa", NULL);
    const double *density = gb_table_column(table, "density", NULL);
    const double *broken = gb_table_column(table, "broken", NULL);
    struct gb_strength_broken found = gb_strength_cell_unbroken();
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        if (which[i] == test) {
            gb_strength_cell_break(&found, strain[i], stress[i], density[i], broken[i]);
        }
    }
    return found;
}

static bool has_columns(const struct gb_table *table, struct gb_error *err)
{
    static const char *const names[] = {"test", "strain", "stress_Pa", "density",
                                        "broken"};
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        if (gb_table_column(table, names[k], err) == NULL) {
            return false;
        }
    }
    return true;
}

static double column_mean(const struct gb_strength_broken *broken, int cells,
                          size_t member, double *error)
{
    double value[GB_STRENGTH_REPLICAS_MAX], mean = NAN;
    for (int c = 0; c < cells; c++) {
        const char *at = (const char *)&broken[c] + member;
        value[c] = *(const double *)(const void *)at;
    }
    gb_average_values(value, (size_t)cells, &mean, error);
    return mean;
}

static void conclude_test(struct gb_strength_study *study,
                          const struct gb_keep_point *mark, int test,
                          const struct gb_strength_broken *broken, int cells)
{
    struct gb_error ignored = {0};
    double unused, strength[GB_STRENGTH_REPLICAS_MAX];
    struct gb_strength_result result = {
        .mark = *mark,
        .test = (enum gb_strength_test)test,
        .cells = cells,
        .weibull = {(double)NAN, (double)NAN, (double)NAN, (double)NAN}};
#define MEAN(member, error)                                                              \
    column_mean(broken, cells, offsetof(struct gb_strength_broken, member), error)
    result.density = MEAN(density, &unused);
    result.strength_pa = MEAN(strength, &result.strength_error_pa);
    result.strain = MEAN(strain, &result.strain_error);
    result.broken_at_peak = MEAN(at_peak, &result.broken_at_peak_error);
    result.broken_at_end = MEAN(at_end, &result.broken_at_end_error);
#undef MEAN
    for (int c = 0; c < cells; c++) {
        strength[c] = broken[c].strength;
    }
    gb_weibull_fit(&result.weibull, strength, (size_t)cells, &ignored);
    g_array_append_val(study->result, result);
}

static void add_curves(struct gb_strength_study *study, const struct gb_keep_point *mark,
                       int cell, const struct gb_table *table)
{
    const double *column[] = {gb_table_column(table, "strain", NULL),
                              gb_table_column(table, "stress_Pa", NULL),
                              gb_table_column(table, "broken", NULL)};
    const double *test = gb_table_column(table, "test", NULL);
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const double number[] = {mark->by_density ? (double)NAN : 1e-6 * mark->value,
                                 mark->by_density ? mark->value : (double)NAN,
                                 cell + 1.0,
                                 100.0 * column[0][i],
                                 1e-6 * column[1][i],
                                 100.0 * column[2][i]};
        g_string_append_printf(study->curves, "%s,",
                               gb_strength_options_tests[(int)test[i]].name);
        gb_study_text_numbers(study->curves, number, G_N_ELEMENTS(number));
    }
}

static bool read_cell(struct gb_strength_study *study, const struct gb_cells *cells,
                      const struct gb_cells_item *item, const struct gb_keep_point *mark,
                      int cell, struct gb_strength_broken broken[GB_STRENGTH_TESTS],
                      struct gb_error *err)
{
    char *file = g_strconcat(item->name, ".csv", NULL);
    char *path = g_build_filename(cells->directory, file, NULL);
    struct gb_table *table = NULL;
    const bool good = gb_table_read(&table, path, NULL, err) && has_columns(table, err);
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        broken[t] = read_test(table, t);
    }
    if (good) {
        add_curves(study, mark, cell, table);
    }
    gb_table_destroy(table);
    g_free(path);
    g_free(file);
    return good;
}

/* Results of a mark, from the cells that have an answer. */
static bool conclude_mark(struct gb_strength_study *study, const struct gb_cells *cells,
                          int mark, struct gb_error *err)
{
    const int replicas = study->options.replicas;
    const struct gb_keep_point *at = &study->options.marks.point[mark];
    struct gb_strength_broken *broken =
        g_new(struct gb_strength_broken, GB_STRENGTH_TESTS * (gsize)replicas);
    struct gb_strength_broken found[GB_STRENGTH_TESTS];
    int there = 0;
    bool good = true;
    for (int c = 0; c < replicas && good; c++) {
        const struct gb_cells_item *item = g_ptr_array_index(
            cells->list, (guint)(c * study->options.marks.count + mark));
        if (item->done && (good = read_cell(study, cells, item, at, c, found, err))) {
            for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
                broken[t * replicas + there] = found[t];
            }
            there++;
        }
    }
    good = good && (there > 0 || gb_cells_check(cells, err));
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        conclude_test(study, at, t, broken + t * replicas, there);
    }
    g_free(broken);
    return good;
}

static bool conclude(struct gb_strength_study *study, const struct gb_cells *cells,
                     struct gb_error *err)
{
    for (int m = 0; m < study->options.marks.count; m++) {
        if (!conclude_mark(study, cells, m, err)) {
            return false;
        }
    }
    for (guint i = 0; i < cells->list->len; i++) {
        const struct gb_cells_item *item = g_ptr_array_index(cells->list, i);
        study->failed += !item->done;
    }
    gb_cells_check(cells, &study->why);
    return true;
}

static void add_cells(struct gb_cells *cells, const struct gb_params *params,
                      const struct gb_strength_options *options)
{
    struct gb_params own = *params;
    own.threads = 1;
    own.on_collapse = GB_COLLAPSE_STOP;
    for (int c = 0; c < options->replicas; c++) {
        own.seed = params->seed + (uint64_t)c;
        for (int m = 0; m < options->marks.count; m++) {
            const struct gb_keep_point *mark = &options->marks.point[m];
            GString *text = g_string_new("study=strength\n");
            gb_strength_options_write(options, mark, text);
            gb_cells_add(cells, &own, gb_cells_name(mark, c), text->str);
            g_string_free(text, TRUE);
        }
    }
}

bool gb_strength_study_run(struct gb_strength_study *study,
                           const struct gb_params *preset,
                           const struct gb_strength_options *options,
                           const char *directory, int jobs,
                           const struct gb_cells_callbacks *callbacks,
                           struct gb_error *err)
{
    struct gb_cells cells = {0};
    struct gb_params params;
    *study = (struct gb_strength_study){
        .options = *options,
        .result = g_array_new(FALSE, FALSE, sizeof(struct gb_strength_result)),
        .curves = g_string_new(NULL)};
    if (!gb_strength_options_check(options, err) ||
        !gb_seed_check_cells(preset, (size_t)options->replicas, err) ||
        !gb_compact_params(&params, preset, err) ||
        !gb_cells_init(&cells, directory, err)) {
        gb_cells_finish(&cells);
        return false;
    }
    add_cells(&cells, &params, options);
    const bool good =
        gb_cells_work(&cells, jobs, gb_strength_cell_work, callbacks, err) &&
        conclude(study, &cells, err);
    gb_cells_finish(&cells);
    return good;
}

void gb_strength_study_finish(struct gb_strength_study *study)
{
    if (study->result != NULL) {
        g_array_unref(study->result);
        g_string_free(study->curves, TRUE);
    }
    memset(study, 0, sizeof *study);
}

static GString *table(const struct gb_strength_study *study, const char *comment)
{
    GString *text = g_string_new(NULL);
    gb_study_text_comment(text, comment);
    g_string_append(text, "test,pressure_MPa,pressed_density,cells,density,strength_MPa,"
                          "strength_error_MPa,strain_percent,strain_error_percent,"
                          "broken_at_peak_percent,broken_at_end_percent,weibull_modulus,"
                          "weibull_low,weibull_high,weibull_scale_MPa,"
                          "broken_at_peak_error_percent,broken_at_end_error_percent\n");
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const double number[] = {r->mark.by_density ? (double)NAN : 1e-6 * r->mark.value,
                                 r->mark.by_density ? r->mark.value : (double)NAN,
                                 r->cells,
                                 r->density,
                                 1e-6 * r->strength_pa,
                                 1e-6 * r->strength_error_pa,
                                 100.0 * r->strain,
                                 100.0 * r->strain_error,
                                 100.0 * r->broken_at_peak,
                                 100.0 * r->broken_at_end,
                                 r->weibull.modulus,
                                 r->weibull.modulus_low,
                                 r->weibull.modulus_high,
                                 1e-6 * r->weibull.scale,
                                 100.0 * r->broken_at_peak_error,
                                 100.0 * r->broken_at_end_error};
        g_string_append_printf(text, "%s,", gb_strength_options_tests[r->test].name);
        gb_study_text_numbers(text, number, G_N_ELEMENTS(number));
    }
    return text;
}

static GString *page(const struct gb_strength_study *study, const char *title,
                     const char *command)
{
    GString *text = g_string_new(NULL);
    g_string_append_printf(
        text,
        "# Strength after unloading: %s\n\n`%s`\n\n%d cells. Each compact is pressed, its "
        "stresses are taken away, and copies are broken. Standard errors over the cells; "
        "Weibull modulus by maximum likelihood with its 95 %% interval.\n\n"
        "| pressed to | test | strength (MPa) | strain (%%) | bridges broken at the peak "
        "(%%) | Weibull modulus |\n|---|---|---|---|---|---|\n",
        title, command, study->options.replicas);
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const struct gb_fit_value strength = {.value = r->strength_pa,
                                              .error = r->strength_error_pa};
        const struct gb_fit_value strain = {.value = r->strain, .error = r->strain_error};
        const struct gb_fit_value broken = {.value = r->broken_at_peak,
                                            .error = r->broken_at_peak_error};
        const struct gb_fit_value modulus = {.value = r->weibull.modulus,
                                             .low = r->weibull.modulus_low,
                                             .high = r->weibull.modulus_high};
        g_string_append_printf(text, "| %g%s | %s",
                               r->mark.by_density ? r->mark.value : 1e-6 * r->mark.value,
                               r->mark.by_density ? "" : " MPa",
                               gb_strength_options_tests[r->test].name);
        gb_study_text_value(text, " | ", &strength, 1e-6);
        gb_study_text_value(text, " | ", &strain, 100.0);
        gb_study_text_value(text, " | ", &broken, 100.0);
        gb_study_text_interval(text, " | ", "%.2g", &modulus, 1.0);
        g_string_append(text, " |\n");
    }
    if (study->failed > 0) {
        g_string_append_printf(text, "\nIncomplete: %s\n", study->why.text);
    }
    return text;
}

bool gb_strength_study_write(const struct gb_strength_study *study, const char *directory,
                             const char *title, const char *command, struct gb_error *err)
{
    char *comment = g_strdup_printf("preset: %s\ncommand: %s", title, command);
    GString *curves = g_string_new(NULL);
    gb_study_text_comment(curves, comment);
    g_string_append(curves, "test,pressure_MPa,pressed_density,cell,strain_percent,"
                            "stress_MPa,broken_percent\n");
    g_string_append(curves, study->curves->str);
    const struct gb_study_text_file file[] = {
        {"strength.csv", table(study, comment)},
        {"strength_curves.csv", curves},
        {"strength.md", page(study, title, command)}};
    g_free(comment);
    return gb_study_text_write(file, G_N_ELEMENTS(file), directory, err);
}
