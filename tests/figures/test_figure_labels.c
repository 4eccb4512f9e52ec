/* Axes, scales, labels and markers of figures. */
#include "figure_folder.h"
#include "figure_runs.h"

#include <glib/gstdio.h>
#include <string.h>

#include "figures/plotting.h"

/* Scales of both axes are equal where a figure asks for it. */
static void test_equal_scales(void)
{
    static const char *const words[] = {"yield", NULL};
    struct gb_figure figure;
    struct gb_figure_layout layout;
    struct gb_figure_curve *curves = NULL;
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("yield", words, &series, &err));
    for (int width = 500; width <= 1500; width += 500) {
        gb_series_figure(&series, &figure, &curves);
        g_assert_true(gb_figure_render(&image, &figure, width, 600, &layout, &err));
        const double x = (layout.x.to - layout.x.from) / (layout.x.high - layout.x.low);
        const double y = (layout.y.from - layout.y.to) / (layout.y.high - layout.y.low);
        g_assert_cmpfloat_with_epsilon(x / y, 1.0, 1e-6);
        g_assert_cmpfloat(layout.x.low, <, 10.0);
        g_assert_cmpfloat(layout.y.high, >, 20.0);
        gb_image_destroy(image);
        g_free(curves);
    }
    gb_series_finish(&series);
}

/* "pressure <i>p</i> (MPa)": the quantity in words of ISO, small letters, the unit of the
 * column in parentheses at the end. */
static void check_axis(const struct gb_series_axis *axis)
{
    static const char *const units[][2] = {
        {"_MPa", "(MPa)"},    {"_GPa", "(GPa)"},
        {"_ns", "(ns)"},      {"_nm", "(nm)"},
        {"_nN", "(nN)"},      {"_mN", "(mN)"},
        {"_um", "(\u00b5m)"}, {"_percent", "(%)"},
        {"_per_s", "(1/s)"},  {"_deg", "(\u00b0)"},
        {"_points", "(%"},    {"_s", "(s)"}}; /* longer ones before "_s" */
    bool found = false;
    static const char *const informal[] = {
        "share", "deviator ", "degrees", "rms", "[", "height over", "number of contacts"};
    if (axis->name == NULL || axis->label == NULL) {
        return;
    }
    g_test_message("%s: %s", axis->name, axis->label);
    for (size_t k = 0; k < G_N_ELEMENTS(informal); k++) {
        g_assert_null(strstr(axis->label, informal[k]));
    }
    for (size_t k = 0; k < G_N_ELEMENTS(units); k++) {
        if (!found && g_str_has_suffix(axis->name, units[k][0])) {
            found = true;
            const char *unit = strrchr(axis->label, '(');
            g_assert_nonnull(unit);
            g_assert_true(g_str_has_prefix(unit, units[k][1]));
        }
    }
    const char first = axis->label[0] == '<' ? axis->label[3] : axis->label[0];
    g_assert_false(g_ascii_isupper(first));
}

static void test_axes(void)
{
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        check_axis(&row->x);
        check_axis(&row->y);
    }
    g_assert_cmpstr(gb_figures_find("densification")->y.label, ==,
                    "pressure <i>p</i> (MPa)");
    g_assert_cmpstr(gb_figures_find("lateral")->y.label, ==,
                    "lateral-to-axial stress ratio <i>p<sub>x</sub></i> / "
                    "<i>p<sub>z</sub></i>");
}

/* Measured points are black and filled, one marker for each series, with their errors; runs
 * keep their colours. */
static void test_measured(void)
{
    static const char *const runs[] = {"a1", "a2", "b1", NULL};
    struct gb_series series = {0};
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    char *path = figure_folder_path("a1", "lab.csv");
    g_assert_true(g_file_set_contents(path,
                                      "density,p_MPa,p_MPa_error,series\n"
                                      "0.50,100,5,Lab\n0.52,150,6,Lab\n0.5,90,,Other\n",
                                      -1, NULL));
    g_assert_true(gb_table_read(&table, path, "series", &err));
    g_assert_true(figure_folder_named("densification", runs, &series, &err));
    const guint first = series.curves->len;
    g_assert_true(gb_plotting_data(&series, table, &err));
    g_assert_cmpuint(series.curves->len, ==, first + 2);
    for (guint k = 0; k < series.curves->len; k++) {
        const struct gb_series_curve *curve =
            &g_array_index(series.curves, struct gb_series_curve, k);
        g_assert_cmpint(curve->style, ==,
                        k < first ? (int)k : gb_figure_black((int)(k - first)));
        g_assert_false(curve->open);
    }
    const struct gb_series_curve *lab =
        &g_array_index(series.curves, struct gb_series_curve, first);
    const double *error = g_ptr_array_index(series.columns, (guint)lab->error);
    g_assert_cmpfloat(error[1], ==, 6.0);
    gb_table_destroy(table);
    gb_series_finish(&series);
    g_unlink(path);
    g_free(path);
}

/* No two curves of a series have one label. */
static void assert_labels_differ(const struct gb_series *series)
{
    for (guint i = 0; i < series->curves->len; i++) {
        const char *one = g_array_index(series->curves, struct gb_series_curve, i).label;
        for (guint k = 0; one != NULL && k < i; k++) {
            g_assert_cmpstr(
                one, !=, g_array_index(series->curves, struct gb_series_curve, k).label);
        }
        g_test_message("%s", one != NULL ? one : "-");
    }
}

/* Runs of one title with too many differences for a legend are told apart by their
 * directories, points by the word from a line of the same name. */
static void test_labels(void)
{
    static const char *const runs[] = {"first", "second", NULL};
    static const char *const keys[] = {
        "mu = 0.1\nalpha = 0.24\nbridge_length = 0.008 d\n[material]\n"
        "young = 382 GPa\npoisson = 0.25\nd0 = 0.392 nm\n",
        "mu = 0.2\nalpha = 0.34\nbridge_length = 0.009 d\n[material]\n"
        "young = 183 GPa\npoisson = 0.35\nd0 = 0.492 nm\n"};
    struct gb_series series = {0};
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    for (int k = 0; k < 2; k++) {
        char *preset = g_strdup_printf("[scene]\ntitle = one <powder>\n[contact]\n%s"
                                       "[loading]\ngeometry = uniaxial\n",
                                       keys[k]);
        figure_folder_write(runs[k], "preset.ini", preset);
        figure_runs_curve(runs[k], 0.0, "");
        g_free(preset);
    }
    g_assert_true(figure_folder_named("densification", runs, &series, &err));
    assert_labels_differ(&series);
    g_assert_cmpstr(g_array_index(series.curves, struct gb_series_curve, 0).label, ==,
                    "one &lt;powder&gt;: first");
    figure_folder_write("first", "lab.csv",
                        "density,p_MPa,series\n0.5,100,one <powder>: first\n");
    char *path = figure_folder_path("first", "lab.csv");
    g_assert_true(gb_table_read(&table, path, "series", &err));
    g_assert_true(gb_plotting_data(&series, table, &err));
    assert_labels_differ(&series);
    gb_table_destroy(table);
    gb_series_finish(&series);
    g_free(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    figure_runs_write();
    g_test_add_func("/figures/equal_scales", test_equal_scales);
    g_test_add_func("/figures/axes", test_axes);
    g_test_add_func("/figures/measured", test_measured);
    g_test_add_func("/figures/labels", test_labels);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
