/* The table of figures and the formats, on small run directories made here. */
#include "figure_folder.h"
#include "figure_runs.h"

#include <string.h>

#include "base/built_with.h"
#include "figures/plotting.h"

/* Directories that a figure is drawn from, by what it takes, unless it has a row of its
 * own below. */
static const char *const usual[][3] = {
    [GB_FIGURES_RUNS] = {"a1", "a2"},
    [GB_FIGURES_STATES] = {"a1"},
    [GB_FIGURES_TABLE] = {"chart"},
};

/* Figures that take other runs. */
static const struct source {
    const char *figure;
    const char *words[5];
} sources[] = {
    {"densification", {"a1", "a2", "b1"}},
    {"difference", {"a1", "a2", "b1"}},
    {"rate", {"fast", "slow"}},
    {"rate-difference", {"fast", "slow"}},
    {"relaxation", {"fast", "slow"}},
    {"relaxation-amplitude", {"fast", "slow"}},
    {"decay", {"fast", "slow"}},
    {"fit", {"a1", "a2", "b1"}},
    {"heckel", {"a1", "a2", "b1"}},
    {"coordination", {"a1", "b1"}},
    {"path", {"legs"}},
    {"stress-strain", {"legs"}},
    {"size-effect", {"a1", "a2", "b1"}},
    {"sweep", {"a1", "a2", "b1"}},
    {"rdf", {"a1", "a2"}},
    {"poured-density", {"die"}},
    {"die-section", {"cycle1"}},
    {"die-height", {"die"}},
    {"die-density", {"die"}},
    {"die-cycle", {"cycle1", "cycle2"}},
    {"die-ejection", {"cycle1", "cycle2"}},
    {"die-wall", {"cycle1", "cycle2"}},
    {"die-axial", {"cycle1", "cycle2"}},
    {"die-radial", {"cycle1"}},
    {"die-map", {"cycle1", "cycle2"}},
    {"chart-quantity", {"chart/E.csv"}},
    {"card", {"card"}},
    {"card-uniaxial", {"card"}},
    {"yield", {"yield"}},
    {"strength", {"strength"}},
    {"strength-curves", {"strength"}},
    {"moduli", {"moduli"}},
    {"moduli-axial", {"moduli", "plane"}},
};

static const char *const *words_of(const struct gb_figures_row *row)
{
    for (size_t k = 0; k < G_N_ELEMENTS(sources); k++) {
        if (strcmp(sources[k].figure, row->name) == 0) {
            return sources[k].words;
        }
    }
    return usual[row->takes];
}

/* Every row draws. */
static void test_rows(void)
{
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        struct gb_series series = {0};
        struct gb_error err = {0};
        const bool done = row->takes == GB_FIGURES_SCENE
                              ? figure_folder_scene(row, &series, &err)
                              : figure_folder_run(row, words_of(row), &series, &err);
        g_test_message("%s: %s", row->name, err.text);
        g_assert_true(done);
        figure_folder_assert_drawn(row, &series);
        gb_series_finish(&series);
    }
}

/* A run without curve and state gives one line for every figure of runs. */
static void test_errors(void)
{
    static const char *const empty[] = {"empty", NULL};
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        struct gb_series series = {0};
        struct gb_error err = {0};
        if (row->takes == GB_FIGURES_SCENE) {
            continue;
        }
        g_assert_false(figure_folder_run(row, empty, &series, &err));
        g_test_message("%s: %s", row->name, err.text);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_cmpstr(err.text, !=, "");
        g_assert_null(strchr(err.text, '\n'));
        gb_series_finish(&series);
    }
}

static void test_table(void)
{
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        struct gb_error err = {0};
        char *text = gb_figures_describe(row);
        g_assert_cmpuint(strlen(text), <=, 90);
        g_assert_true(gb_figures_find(row->name) == row);
        g_assert_true(row->compute != NULL || row->mean.y != NULL);
        g_assert_true((row->takes == GB_FIGURES_SCENE) == (row->preset != NULL));
        g_assert_true(gb_figures_check_options(row, row->options, &err));
        g_free(text);
    }
    g_assert_null(gb_figures_find("pie"));
}

static void test_options(void)
{
    struct gb_error err = {0};
    const struct gb_figures_row *time = gb_figures_find("time");
    g_assert_false(gb_figures_check_options(time, GB_FIGURES_DENSITY, &err));
    g_assert_cmpstr(err.text, ==, "--density is for the figures rate, rate-difference");
    g_assert_false(gb_figures_check_options(time, GB_FIGURES_PRESSURE, &err));
    char *names = gb_figures_names(GB_FIGURES_PRESSURE);
    g_assert_true(g_str_has_prefix(names, "size-effect, sweep"));
    g_assert_true(g_str_has_prefix(err.text, "--pressure is for the figures "));
    g_assert_true(g_str_has_suffix(err.text, names));
    g_free(names);
    g_assert_false(gb_figures_check_options(gb_figures_find("difference"), 0, &err));
    g_assert_cmpstr(err.text, ==, "the figure difference needs --reference DIR");
}

/* Curves without a single value would be empty axes: one value, or a map, is drawn. */
static void test_empty(void)
{
    for (int with_value = 0; with_value < 2; with_value++) {
        struct gb_series series;
        struct gb_error err = {0};
        gb_series_init(&series, 3);
        double *x = gb_series_column(&series, "x"), *y = gb_series_column(&series, "y");
        x[0] = x[1] = 1.0;
        gb_series_axes(&series, "x", "x", "y", "y");
        gb_series_draw(&series, x, y, NULL, GB_FIGURE_LINE, 0, NULL);
        if (with_value) {
            y[1] = 2.0;
        }
        g_assert_true(gb_series_check_drawable(&series, "pie", &err) == with_value);
        g_assert_cmpstr(err.text, ==,
                        with_value
                            ? ""
                            : "pie: there is no value to draw; a CSV has the empty "
                              "table");
        series.x.several = true;
        g_assert_false(gb_series_check_drawable(&series, "pie", &err));
        if (with_value) {
            g_assert_true(g_str_has_prefix(err.text, "pie: all points have x = 1; "));
        }
        gb_series_finish(&series);
    }
}

static void test_formats(void)
{
    static const char *const runs[] = {"a1", NULL};
    struct gb_series series = {0};
    struct gb_error err = {0};
    const struct gb_plotting_page page = {400, 300, "time", NULL, NULL, GB_PLOTTING_KEEP,
                                          0};
    g_assert_true(figure_folder_named("time", runs, &series, &err));
    for (const struct gb_plotting_format *row = gb_plotting_formats(); row->extension;
         row++) {
        char *name = g_strconcat("out", row->extension, NULL);
        char *path = figure_folder_path(name, NULL);
        const bool figure = (row->uses & GB_PLOTTING_FIGURE) != 0;
        g_assert_true(gb_plotting_check(path, GB_PLOTTING_REPLACE, &err) == figure);
        if (figure) {
            g_assert_true(gb_plotting_write(&series, &page, path, &err));
            g_assert_true(g_file_test(path, G_FILE_TEST_EXISTS));
            g_assert_false(gb_plotting_check(path, GB_PLOTTING_KEEP, &err));
            g_assert_nonnull(strstr(err.text, "exists"));
        }
        g_free(path);
        g_free(name);
    }
    gb_series_finish(&series);
    char *names = gb_plotting_format_names(GB_PLOTTING_FIGURE);
    char *pattern = gb_plotting_pattern(GB_PLOTTING_FIGURE);
    g_assert_true(g_str_has_prefix(names, ".png, "));
    g_assert_true(g_str_has_prefix(pattern, "FILE.png|"));
    for (const struct gb_plotting_format *row = gb_plotting_formats(); row->extension;
         row++) {
        const bool figure = (row->uses & GB_PLOTTING_FIGURE) != 0;
        g_assert_true((strstr(names, row->extension) != NULL) == figure);
        g_assert_true((strstr(pattern, row->extension + 1) != NULL) == figure);
        g_assert_true(figure || row->frames != NULL || !GB_WITH_PICTURES);
    }
    g_free(pattern);
    g_free(names);
    char *pictures = gb_plotting_format_names(GB_PLOTTING_PICTURE);
    g_assert_cmpstr(pictures, ==, ".png");
    g_free(pictures);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    figure_runs_write();
    g_test_add_func("/figures/table", test_table);
    g_test_add_func("/figures/options", test_options);
    g_test_add_func("/figures/rows", test_rows);
    g_test_add_func("/figures/errors", test_errors);
    g_test_add_func("/figures/empty", test_empty);
    g_test_add_func("/figures/formats", test_formats);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
