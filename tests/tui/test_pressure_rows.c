/* Densities at a pressure of all that the plot shows, and their verdicts. */
#include <glib.h>
#include <math.h>

#include "measure/average.h"
#include "tui/session/pressure_rows.h"

enum { LAST = 6 };
static const double at_pa = 150e6;

/* Loading with an unloading branch from 100 MPa: 1 % denser every 50 MPa. */
static struct gb_curve *curve_of(double density)
{
    static const struct {
        double mpa, more;
        int branch;
    } row[LAST] = {{50.0, 0.0, 0}, {100.0, 0.01, 0},   {40.0, 0.009, 1},
                   {0.0, 0.0, 1},  {101.0, 0.0102, 0}, {201.0, 0.0302, 0}};
    struct gb_curve *curve = NULL;
    g_assert_true(gb_curve_create(&curve, NULL));
    for (int i = 0; i < LAST; i++) {
        const struct gb_point point = {.p_pa = 1e6 * row[i].mpa,
                                       .density = density + row[i].more,
                                       .branch = row[i].branch};
        g_assert_true(gb_curve_append(curve, &point, NULL));
    }
    return curve;
}

static void add_previous(struct gb_session *session, const struct gb_params *params,
                         double density, bool quick)
{
    struct gb_curve *curve = curve_of(density);
    struct gb_previous_curve *previous = &session->previous[session->previous_count++];
    g_assert_true(gb_previous_curve_copy(previous, params, curve, LAST));
    previous->label.marker = (char)('a' + session->previous_count - 1);
    previous->quick = quick;
    gb_curve_destroy(curve);
}

static struct gb_measured *measured_of(void)
{
    struct gb_measured *measured = g_new0(struct gb_measured, 1);
    static double all[] = {0.5, 0.3, 200e6, 50e6, 0.02, 0.01, NAN, NAN};
    measured->count = 2;
    measured->density = all;
    measured->pressure_pa = all + 2;
    measured->density_error = all + 4;
    measured->pressure_error_pa = all + 6;
    return measured;
}

static void test_rows(void)
{
    struct gb_preset *preset = NULL;
    struct gb_session session;
    struct gb_pressure_rows rows;
    g_assert_true(gb_preset_create(&preset, NULL));
    gb_session_init(&session, preset);
    gb_pressure_rows_list(&rows, &session, false);
    g_assert_cmpint(rows.count, ==, 0);
    struct gb_params params = *gb_preset_params(preset);
    params.count = 8000;
    add_previous(&session, &params, 0.30, false);
    add_previous(&session, &params, 0.31, true);
    session.measured = measured_of();
    session.measured_dimension = params.dimension;
    gb_pressure_rows_list(&rows, &session, false);
    g_assert_cmpint(rows.count, ==, 3);
    const struct gb_pressure_row *measured = &rows.row[0];
    const struct gb_pressure_row *quick = &rows.row[1]; /* the newest curve first */
    const struct gb_pressure_row *full = &rows.row[2];
    g_assert_cmpint(measured->kind, ==, GB_PRESSURE_ROW_MEASURED);
    g_assert_cmpstr(full->brief, ==, "a");
    /* the unloading between 100 and 101 MPa is none of loading */
    struct gb_pressure_value value = gb_pressure_rows_at(&session, full, 100.5e6);
    g_assert_cmpfloat_with_epsilon(value.density, 0.3101, 1e-12);
    value = gb_pressure_rows_at(&session, full, at_pa);
    g_assert_cmpfloat_with_epsilon(value.density, 0.3102 + 0.0200 * 0.49, 1e-12);
    g_assert_cmpfloat_with_epsilon(value.error, 0.0028, 1e-4);
    /* a quick cell of 8000 has 1000 */
    struct gb_pressure_value other = gb_pressure_rows_at(&session, quick, at_pa);
    g_assert_cmpfloat_with_epsilon(other.error, 0.0064, 1e-12);
    g_assert_cmpint(gb_pressure_rows_verdict(quick, other, full, value), ==,
                    GB_PRESSURE_VERDICT_NONE);
    g_assert_true(isnan(gb_pressure_rows_at(&session, full, 1e9).density));
    /* measured points in any order, between them in the logarithm of the pressure */
    other = gb_pressure_rows_at(&session, measured, 100e6);
    g_assert_cmpfloat_with_epsilon(other.density, 0.4, 1e-12);
    g_assert_cmpfloat_with_epsilon(other.error, 0.015, 1e-12);
    g_assert_true(isnan(gb_pressure_rows_at(&session, measured, 201e6).density));
    gb_pressure_rows_list(&rows, &session, true);
    g_assert_cmpint(rows.count, ==, 1);
    g_clear_pointer(&session.measured, g_free);
    gb_session_finish(&session);
    gb_preset_destroy(preset);
}

/* Two standard deviations of the difference of two cells. */
static void test_verdict(void)
{
    const struct gb_pressure_row row = {.kind = GB_PRESSURE_ROW_PREVIOUS};
    const struct gb_pressure_value base = {0.4, 0.003};
    const double limit = 2.0 * hypot(0.003, 0.004);
    g_assert_cmpint(
        gb_pressure_rows_verdict(
            &row, (struct gb_pressure_value){0.4 - 0.99 * limit, 0.004}, &row, base),
        ==, GB_PRESSURE_VERDICT_WITHIN);
    g_assert_cmpint(
        gb_pressure_rows_verdict(
            &row, (struct gb_pressure_value){0.4 + 1.01 * limit, 0.004}, &row, base),
        ==, GB_PRESSURE_VERDICT_BEYOND);
    g_assert_cmpint(
        gb_pressure_rows_verdict(&row, (struct gb_pressure_value){0.9, NAN}, &row, base),
        ==, GB_PRESSURE_VERDICT_NONE);
}

/* What docs/accuracy.md lists; nothing where nothing was measured. */
static void test_scatter(void)
{
    struct gb_params params;
    gb_params_init(&params);
    const double listed[][2] = {{250, 0.011}, {1000, 0.006}, {8000, 0.003}};
    for (size_t i = 0; i < G_N_ELEMENTS(listed); i++) {
        params.count = (int64_t)listed[i][0];
        g_assert_cmpfloat_with_epsilon(gb_average_cell_scatter(&params), listed[i][1],
                                       0.0005);
    }
    struct gb_params other = params;
    other.dimension = 2;
    g_assert_true(isnan(gb_average_cell_scatter(&other)));
    other = params;
    other.structure = GB_STRUCTURE_FCC;
    g_assert_true(isnan(gb_average_cell_scatter(&other)));
    other = params;
    other.kind = GB_KIND_DIE;
    g_assert_true(isnan(gb_average_cell_scatter(&other)));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/pressure-rows/rows", test_rows);
    g_test_add_func("/tui/pressure-rows/verdict", test_verdict);
    g_test_add_func("/tui/pressure-rows/scatter", test_scatter);
    return g_test_run();
}
