/* Previous curves: which are kept, pinned, hidden and coloured, and their differences to the
 * run. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "tui/session/pressure_rows.h"
#include "tui/session/previous.h"
#include "tui/view/views.h"

/* A session with a run of 60 particles to 0.1 MPa. */
struct fixture {
    struct gb_preset *preset;
    struct gb_session session;
    struct gb_params params;
};

static void set_up(struct fixture *fixture)
{
    struct gb_error err = {0};
    g_assert_true(gb_preset_create(&fixture->preset, NULL));
    struct gb_params *params = gb_preset_params(fixture->preset);
    g_assert_true(gb_params_assign(params, "particles.count=60", &err));
    g_assert_true(gb_params_assign(params, "loading.until=0.1 MPa", &err));
    g_assert_true(gb_params_assign(params, "loading.unload_from=", &err));
    fixture->params = *params;
    gb_session_init(&fixture->session, fixture->preset);
    if (!gb_runner_create(&fixture->session.runner, params, &err)) {
        g_error("%s", err.text);
    }
    struct gb_runner *runner = fixture->session.runner;
    while (gb_runner_snapshot(runner, NULL)->state <= GB_RUN_PAUSED) {
        g_usleep(1000);
    }
    fixture->session.run_state = gb_runner_snapshot(runner, NULL)->state;
    fixture->session.points = gb_curve_count(gb_runner_curve(runner));
    g_assert_cmpuint(fixture->session.points, >=, 2);
}

static void tear_down(struct fixture *fixture)
{
    gb_session_finish(&fixture->session);
    gb_preset_destroy(fixture->preset);
}

/* The curve of the run as a previous one with another friction. */
static void keep(struct fixture *fixture, double mu, enum gb_session_cell cell)
{
    struct gb_params params = fixture->params;
    params.mu = mu;
    fixture->session.run_label = (struct gb_curve_label){.marker = '\0'};
    gb_previous_list_keep(&fixture->session, &params, fixture->session.runner, cell);
}

static int find(const struct gb_session *session, char marker)
{
    for (int i = 0; i < session->previous_count; i++) {
        if (session->previous[i].label.marker == marker) {
            return i;
        }
    }
    return -1;
}

/* Five curves have colours of their own; the oldest without a pin loses its one. */
static void assert_colours(const struct gb_session *session, int coloured)
{
    int seen = 0;
    for (int i = 0; i < session->previous_count; i++) {
        const struct gb_curve_label *label = &session->previous[i].label;
        if (!label->hidden && label->colour > 0) {
            g_assert_cmpint(label->colour, <=, GB_CURVE_COLOURS);
            g_assert_cmpint(seen & (1 << label->colour), ==, 0);
            seen |= 1 << label->colour;
            coloured--;
        }
    }
    g_assert_cmpint(coloured, ==, 0);
}

static void test_colours(void)
{
    struct fixture fixture;
    struct gb_session *session = &fixture.session;
    set_up(&fixture);
    for (int i = 0; i < 5; i++) {
        keep(&fixture, 0.2 + 0.1 * i, GB_SESSION_FULL_CELL);
    }
    assert_colours(session, 5);
    g_assert_cmpint(gb_previous_list_free_colour(session), ==, 0);
    g_assert_true(gb_previous_list_pin(session, find(session, 'a'), true));
    const int colour = session->previous[find(session, 'b')].label.colour;
    keep(&fixture, 0.7, GB_SESSION_FULL_CELL);
    g_assert_cmpint(session->previous[find(session, 'b')].label.colour, ==, 0);
    g_assert_cmpint(session->previous[find(session, 'f')].label.colour, ==, colour);
    assert_colours(session, 5);
    gb_previous_list_hide(session, find(session, 'f'), true);
    g_assert_cmpint(gb_previous_list_free_colour(session), ==, colour);
    gb_previous_list_hide(session, find(session, 'f'), false);
    g_assert_cmpint(session->previous[find(session, 'f')].label.colour, ==, colour);
    gb_previous_list_delete(session, find(session, 'c'));
    assert_colours(session, 4);
    tear_down(&fixture);
}

/* Pinned curves are not the ones that make room, and one place is always left. */
static void test_pins(void)
{
    struct fixture fixture;
    struct gb_session *session = &fixture.session;
    set_up(&fixture);
    keep(&fixture, 0.2, GB_SESSION_FULL_CELL);
    g_assert_true(gb_previous_list_pin(session, 0, true));
    g_strlcpy(session->previous[0].label.name, "reference", GB_CURVE_NAME);
    for (int i = 0; i < 2 * GB_SESSION_PREVIOUS; i++) {
        keep(&fixture, 0.3 + 0.01 * i, GB_SESSION_FULL_CELL);
    }
    g_assert_cmpint(session->previous_count, ==, GB_SESSION_PREVIOUS);
    g_assert_cmpint(find(session, 'a'), ==, 0);
    g_assert_cmpint(find(session, 'b'), ==, -1);
    g_assert_cmpstr(gb_previous_list_name(&session->previous[0]), ==, "reference");
    for (int i = 1; i < GB_PREVIOUS_PINNED; i++) {
        g_assert_true(gb_previous_list_pin(session, i, true));
    }
    g_assert_false(gb_previous_list_pin(session, GB_PREVIOUS_PINNED, true));
    g_assert_false(gb_previous_list_pin(session, -1, true)); /* the run */
    keep(&fixture, 0.9, GB_SESSION_FULL_CELL);
    for (int i = 0; i < GB_PREVIOUS_PINNED; i++) {
        g_assert_true(session->previous[i].label.pinned);
    }
    /* m leaves the pinned ones, the list hides one of these, too */
    struct gb_pressure_rows rows;
    gb_pressure_rows_list(&rows, session, false);
    g_assert_cmpint(rows.count, ==, 1 + GB_SESSION_PREVIOUS);
    gb_pressure_rows_list(&rows, session, true);
    g_assert_cmpint(rows.count, ==, 1 + GB_PREVIOUS_PINNED);
    gb_previous_list_hide(session, 0, true);
    gb_pressure_rows_list(&rows, session, true);
    g_assert_cmpint(rows.count, ==, GB_PREVIOUS_PINNED);
    tear_down(&fixture);
}

/* Name and pin of a run are those of its curve; a pinned quick cell is not lost when its
 * parameters are shown again. */
static void test_labels(void)
{
    struct fixture fixture;
    struct gb_session *session = &fixture.session;
    set_up(&fixture);
    g_strlcpy(gb_previous_list_label(session, -1)->name, "dense", GB_CURVE_NAME);
    gb_previous_list_keep(session, &fixture.params, session->runner,
                          GB_SESSION_FULL_CELL);
    g_assert_cmpstr(session->previous[0].label.name, ==, "dense");
    g_assert_cmpint(session->run_label.marker, ==, 'a');
    gb_previous_list_forget(session, &fixture.params, false);
    g_assert_cmpint(session->previous_count, ==, 0);
    keep(&fixture, 0.5, GB_SESSION_QUICK_CELL);
    keep(&fixture, 0.6, GB_SESSION_QUICK_CELL);
    g_assert_true(gb_previous_list_pin(session, 0, true));
    for (int i = 0; i < 2; i++) {
        struct gb_params params = session->previous[0].params;
        gb_previous_list_forget(session, &params, true);
    }
    g_assert_cmpint(session->previous_count, ==, 2);
    keep(&fixture, 0.5, GB_SESSION_QUICK_CELL);
    g_assert_cmpint(session->previous_count, ==, 2);
    g_assert_true(session->previous[1].label.pinned);
    struct gb_params params = session->previous[0].params;
    gb_previous_list_forget(session, &params, true);
    g_assert_cmpint(session->previous_count, ==, 1);
    tear_down(&fixture);
}

/* The misfit in the table is that of the message line. */
static void test_misfit(void)
{
    struct fixture fixture;
    struct gb_session *session = &fixture.session;
    set_up(&fixture);
    struct gb_measured *measured = g_new0(struct gb_measured, 1);
    static double all[] = {0.3,  0.25, 0.4,  3e4, 6e4, 1e9,
                           0.01, 0.01, 0.01, NAN, NAN, NAN};
    measured->count = 3;
    measured->density = all;
    measured->pressure_pa = all + 3;
    measured->density_error = all + 6;
    measured->pressure_error_pa = all + 9;
    session->measured = measured;
    session->measured_dimension = 3;
    struct gb_measured_misfit misfit;
    gb_session_misfit(session, &misfit);
    g_assert_cmpuint(misfit.reached, ==, 2);
    keep(&fixture, 0.2, GB_SESSION_FULL_CELL);
    const struct gb_pressure_row rows[] = {gb_pressure_rows_run(session),
                                           gb_pressure_rows_previous(session, 0)};
    for (size_t i = 0; i < 2; i++) {
        g_assert_cmpfloat_with_epsilon(gb_pressure_rows_misfit(session, &rows[i]),
                                       misfit.rms, 1e-12);
    }
    const struct gb_pressure_row itself = {.kind = GB_PRESSURE_ROW_MEASURED};
    g_assert_true(isnan(gb_pressure_rows_misfit(session, &itself)));
    g_clear_pointer(&session->measured, g_free);
    tear_down(&fixture);
}

static char *draw_differences(const struct gb_session *session, bool hide)
{
    struct gb_panel_plot panel = {
        .view = gb_views_find("K"), .hide_previous = hide, .at_pa = 5e4};
    gb_plot_init(&panel.plot);
    g_assert_true(gb_plot_resize(&panel.plot, 20, 78, GB_PLOT_ASCII, NULL));
    gb_view_difference_draw(&panel, session);
    char *text = gb_plot_dump(&panel.plot);
    g_test_message("%s", text);
    gb_panel_plot_finish(&panel);
    return text;
}

/* The same curve 0.1 denser is beyond the band of two cells of 60, itself within. */
static void test_difference(void)
{
    struct fixture fixture;
    struct gb_session *session = &fixture.session;
    set_up(&fixture);
    char *text = draw_differences(session, false);
    g_assert_nonnull(strstr(text, "no other curve"));
    g_free(text);
    keep(&fixture, 0.2, GB_SESSION_FULL_CELL);
    keep(&fixture, 0.3, GB_SESSION_FULL_CELL);
    for (size_t i = 0; i < session->previous[1].count; i++) {
        session->previous[1].density[i] += 0.1;
    }
    gb_previous_list_describe(session, &fixture.params);
    text = draw_differences(session, false);
    g_assert_nonnull(strstr(text, "a +0.0000~ mu 0.2"));
    g_assert_nonnull(strstr(text, "b +0.1000! mu 0.3"));
    g_assert_nonnull(strstr(text, "band: +- 0.0558 (2 sd)"));
    g_assert_nonnull(strstr(text, "at 50 kPa"));
    g_free(text);
    text = draw_differences(session, true);
    g_assert_nonnull(strstr(text, "no other curve"));
    g_free(text);
    tear_down(&fixture);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/curves/colours", test_colours);
    g_test_add_func("/tui/curves/pins", test_pins);
    g_test_add_func("/tui/curves/labels", test_labels);
    g_test_add_func("/tui/curves/misfit", test_misfit);
    g_test_add_func("/tui/curves/difference", test_difference);
    return g_test_run();
}
