/* The report: its parts, files, numbered captions. */
#include "figure_folder.h"
#include "figure_runs.h"

#include <stdlib.h>
#include <string.h>

#include "figures/report.h"
#include "run/moduli_table.h"

/* Captions are numbered from 1 on, and name the conditions of the runs where they show
 * data. */
static void assert_numbered(const char *page, const char *before)
{
    int number = 0;
    const bool figures = strstr(before, "Figure") != NULL;
    for (const char *at = strstr(page, before); at != NULL; at = strstr(at + 1, before)) {
        g_assert_cmpint(atoi(at + strlen(before)), ==, ++number);
        const char *end = strchr(at + strlen(before), '<');
        char *caption = g_strndup(at, (gsize)(end - at));
        if (figures) {
            g_assert_nonnull(strstr(caption, "Conditions: alumina; "));
            g_assert_nonnull(strstr(caption, "fidelity "));
        }
        g_free(caption);
    }
    g_assert_cmpint(number, >, 3);
}

/* Every part of the report has its heading and its files. */
static void test_report(void)
{
    static const char *const files[] = {
        "index.html",       "report.md",       "preset.ini",       "tables/density.csv",
        "tables/ends.csv",  "tables/runs.csv", "figures/time.svg", "figures/rdf.csv",
        "runs/2-curve.csv", "tables/fits.csv", "figures/fit.svg",  "figures/heckel.csv"};
    struct gb_runset set = {0};
    struct gb_error err = {0};
    char *paths[] = {figure_folder_path("a1", NULL), figure_folder_path("b1", NULL)};
    char *output = figure_folder_path("report", NULL);
    char *page = NULL;
    g_assert_true(gb_runset_read(&set, paths, 2, &err));
    g_assert_true(gb_report_write(&set, NULL, output, &err));
    for (size_t k = 0; k < G_N_ELEMENTS(files); k++) {
        char *file = g_build_filename(output, files[k], NULL);
        g_test_message("%s", files[k]);
        g_assert_true(g_file_test(file, G_FILE_TEST_EXISTS));
        g_free(file);
    }
    char *html = g_build_filename(output, "index.html", NULL);
    g_assert_true(g_file_get_contents(html, &page, NULL, NULL));
    for (const struct gb_report_part *part = gb_report_parts(); part->name; part++) {
        char *heading = g_strdup_printf("<h2>%s</h2>", part->heading);
        g_assert_nonnull(strstr(page, heading));
        g_free(heading);
    }
    g_assert_null(strstr(page, "die-height")); /* no figure without data */
    g_assert_null(strstr(page, "Left out"));
    assert_numbered(page, "<caption>Table ");
    assert_numbered(page, "<figcaption>Figure ");
    g_assert_false(gb_report_write(&set, NULL, output, &err));
    g_assert_nonnull(strstr(err.text, "exists"));
    gb_runset_finish(&set);
    g_free(page);
    g_free(html);
    g_free(output);
    g_free(paths[0]);
    g_free(paths[1]);
}

/* moduli.csv of a run whose last row is the state after `step`; E in GPa. */
static void write_moduli(const char *directory, double step, double young)
{
    GArray *states = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
    struct gb_moduli_table_row row = {0};
    struct gb_moduli_state state = {0};
    row.value[gb_moduli_table_find("step")] = step;
    row.value[gb_moduli_table_find("E_GPa")] = young;
    gb_moduli_table_add(&state, &row);
    g_array_append_val(states, state);
    GString *text = gb_listing_end(gb_moduli_table_listing(states, NULL), GB_LISTING_CSV);
    figure_folder_write(directory, GB_MODULI_STATES_FILE, text->str);
    g_string_free(text, TRUE);
    g_array_unref(states);
}

/* Moduli "of the last state" leave out a run whose last state was not probed. */
static void test_moduli_of_ends(void)
{
    struct gb_runset set = {0};
    struct gb_error err = {0};
    figure_runs_quasistatic("m1", 31, "10 nm", 0.0);
    figure_runs_quasistatic("m2", 32, "10 nm", 0.0);
    char *paths[] = {figure_folder_path("m1", NULL), figure_folder_path("m2", NULL)};
    char *output = figure_folder_path("moduli-report", NULL), *page = NULL;
    g_assert_true(gb_runset_read(&set, paths, 2, &err));
    const double *steps = gb_table_column(set.run[0].table, "step", &err);
    const double last = steps[gb_table_rows(set.run[0].table) - 1];
    write_moduli("m1", last, 17.25);
    write_moduli("m2", last - 3.0, 5.5);
    g_assert_true(gb_report_write(&set, NULL, output, &err));
    char *markdown = g_build_filename(output, "report.md", NULL);
    g_assert_true(g_file_get_contents(markdown, &page, NULL, NULL));
    const char *line = strstr(page, "Young's modulus of the last state");
    g_assert_nonnull(line);
    char *row = g_strndup(line, strcspn(line, "\n"));
    g_test_message("%s", row);
    g_assert_nonnull(strstr(row, "17.25"));
    gb_runset_finish(&set);
    g_free(row);
    g_free(markdown);
    g_free(page);
    g_free(output);
    g_free(paths[0]);
    g_free(paths[1]);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    figure_runs_write();
    g_test_add_func("/figures/report", test_report);
    g_test_add_func("/figures/report-moduli", test_moduli_of_ends);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
