/* Views of the plot pane as text, from sessions made here. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "tui/view/views.h"

enum { ROWS = 20, COLS = 78 };

/* The view of a session as text; g_free. */
static char *draw(void (*view)(struct gb_panel_plot *, const struct gb_session *),
                  const struct gb_session *session, int rows, int cols)
{
    struct gb_panel_plot panel = {.view = gb_views_at(0), .utf8 = false};
    gb_plot_init(&panel.plot);
    g_assert_true(gb_plot_resize(&panel.plot, rows, cols, GB_PLOT_ASCII, NULL));
    view(&panel, session);
    char *text = gb_plot_dump(&panel.plot);
    gb_panel_plot_finish(&panel);
    return text;
}

static struct gb_chart_csv *read_chart(const char *rows)
{
    struct gb_chart_csv *chart = NULL;
    struct gb_error err = {0};
    char *folder = g_dir_make_tmp("greenbody-views-XXXXXX", NULL);
    char *path = g_build_filename(folder, "chart.csv", NULL);
    g_assert_true(g_file_set_contents(path, rows, -1, NULL));
    const bool read = gb_job_chart_csv_read(&chart, path, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(read);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return chart;
}

static int count_char(const char *text, char wanted)
{
    int count = 0;
    for (; *text != '\0'; text++) {
        count += *text == wanted;
    }
    return count;
}

/* Settings whose errors are noise are marked: 'x', once in the legend; the cheap small cell
 * is no better one than the front.  A table of earlier versions has no such column. */
static void test_chart_noise(void)
{
    static const char head[] = "relaxer,step,tolerance,cpu_s,bound,front,chosen";
    static const char rows[] = "fire,0.01,0.05,10,,0,0\n"
                               "predict,0.01,0.05,1,0.007,1,0\n"
                               "fire,0.01,0.03,2,0.02,0,0\n"
                               "predict,0.01,0.02,3,0.005,0,1\n"
                               "predict,0.001,0.05,0.3,0.015,0,0\n"
                               "predict,0.001,0.05,0.6,0.012,0,0\n";
    static const char noise[6] = {'0', '0', '0', '1', '1', '1'};
    GString *csv = g_string_new(head);
    g_string_append(csv, ",noise_limited\n");
    char **lines = g_strsplit(rows, "\n", -1);
    for (int i = 0; i < 6; i++) {
        g_string_append_printf(csv, "%s,%c\n", lines[i], noise[i]);
    }
    struct gb_session session = {.chart = read_chart(csv->str)};
    char *text = draw(gb_view_chart_draw, &session, ROWS, COLS);
    g_test_message("%s", text);
    g_assert_nonnull(strstr(text, "x error within its noise"));
    g_assert_cmpint(count_char(text, 'x'), ==, 2 + 1);
    g_assert_nonnull(strstr(text, "# predict, step 1 %, tolerance 0.02"));
    g_free(text);
    gb_job_chart_csv_destroy(session.chart);
    g_string_printf(csv, "%s\n%s", head, rows);
    session.chart = read_chart(csv->str);
    text = draw(gb_view_chart_draw, &session, ROWS, COLS);
    g_assert_null(strstr(text, "noise"));
    g_assert_nonnull(strstr(text, "o setting"));
    g_free(text);
    gb_job_chart_csv_destroy(session.chart);
    g_strfreev(lines);
    g_string_free(csv, TRUE);
}

/* The mean of replicas ends where its levels do: from 0.3 to 0.5, not at zero. */
static void test_replicas(void)
{
    struct gb_preset *preset = NULL;
    struct gb_session session;
    struct gb_runset_view_group group = {
        .members = 2, .mean = {0.3, 0.4, 0.5}, .error = {0.01, 0.01, 0.01}};
    g_assert_true(gb_preset_create(&preset, NULL));
    gb_session_init(&session, preset);
    session.replica_band.params = *gb_preset_params(preset);
    session.replica_band.directory = (char[]){"cells"};
    session.replica_band.runset = (struct gb_runset_view){
        .group = &group, .groups = 1, .level_pa = {1e7, 1e8, 1e9}, .levels = 3};
    char *text = draw(gb_view_curve_draw, &session, ROWS, COLS);
    g_test_message("%s", text);
    g_assert_nonnull(strstr(text, "0.3"));
    g_assert_null(strstr(text, "0.1"));
    g_free(text);
    session.replica_band = (struct gb_replica_band){0};
    gb_session_finish(&session);
    gb_preset_destroy(preset);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/views/chart-noise", test_chart_noise);
    g_test_add_func("/views/replicas", test_replicas);
    return g_test_run();
}
