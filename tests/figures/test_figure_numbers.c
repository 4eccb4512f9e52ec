/* Numbers of figures against those of the run directories. */
#include "figure_folder.h"
#include "figure_runs.h"

#include <math.h>
#include <string.h>

#include "io/state.h"

/* The cell of a column of the series as CSV; NaN when empty. */
static double csv_cell(const struct gb_series *series, const char *column, int row)
{
    GString *csv = gb_series_csv(series);
    char **lines = g_strsplit(csv->str, "\n", -1);
    int head = 0;
    guint k = 0;
    while (lines[head][0] == '#') {
        head++;
    }
    char **names = g_strsplit(lines[head], ",", -1);
    while (names[k] != NULL && strcmp(names[k], column) != 0) {
        k++;
    }
    g_assert_nonnull(names[k]);
    char **cells = g_strsplit(lines[head + 1 + row], ",", -1);
    const double value = cells[k][0] ? g_ascii_strtod(cells[k], NULL) : (double)NAN;
    g_strfreev(cells);
    g_strfreev(names);
    g_strfreev(lines);
    g_string_free(csv, TRUE);
    return value;
}

/* A column of spheres has density 2/3 in every band; one force on one band of the wall; the
 * force of ejection at its travel. */
static void test_die_numbers(void)
{
    static const char *const words[] = {"cycle1", "cycle2", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("die-axial", words, &series, &err));
    for (int k = 4; k < 16; k += 4) {
        double sum = 0.0;
        for (int i = 0; i < 4; i++) {
            sum += 0.25 * figure_folder_column(&series, "density_1")[k + i];
        }
        g_assert_cmpfloat_with_epsilon(sum, 2.0 / 3.0, k == 4 ? 0.02 : 1e-6);
    }
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("die-wall", words, &series, &err));
    const double area = 2.0 * M_PI * 0.5 * 4.0 / 12.0;
    for (int k = 0; k < 12; k++) {
        g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "wall_MPa_1")[k],
                                       k == 4 ? 1e3 * 0.002 / area : 0.0, 1e-9);
    }
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("die-ejection", words, &series, &err));
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "travel_um")[100], 3.0,
                                   1e-9);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "force_mN_1")[67], 1.98,
                                   1e-9);
    gb_series_finish(&series);
}

/* The ellipse and the points are those of the chosen offset; arrows of flow and normal have
 * one length and their directions. */
static void test_yield_numbers(void)
{
    static const char *const words[] = {"yield", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("yield", words, &series, &err));
    g_assert_true(series.equal_scales);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "ellipse_p_1_MPa")[0],
                                   50.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "ellipse_q_1_MPa")[45],
                                   20.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "q_1_MPa")[1], 20.0,
                                   1e-6);
    g_assert_true(isnan(figure_folder_column(&series, "q_1_MPa")[4]));
    const double *flow[2] = {figure_folder_column(&series, "flow_p_1_MPa"),
                             figure_folder_column(&series, "flow_q_1_MPa")};
    const double *normal[2] = {figure_folder_column(&series, "normal_p_1_MPa"),
                               figure_folder_column(&series, "normal_q_1_MPa")};
    const double length = flow[0][1] - flow[0][0];
    g_assert_cmpfloat(length, >, 1.0);
    for (int d = 0; d < 4; d++) {
        g_assert_cmpfloat_with_epsilon(flow[0][3 * d + 1] - flow[0][3 * d], length, 1e-9);
        g_assert_cmpfloat_with_epsilon(flow[1][3 * d + 1] - flow[1][3 * d], 0.0, 1e-9);
        g_assert_cmpfloat_with_epsilon(normal[0][3 * d + 1] - normal[0][3 * d],
                                       length * cos(M_PI_2 * d), 1e-6);
        g_assert_cmpfloat_with_epsilon(normal[1][3 * d + 1] - normal[1][3 * d],
                                       length * sin(M_PI_2 * d), 1e-6);
        g_assert_true(isnan(flow[0][3 * d + 2]));
    }
    gb_series_finish(&series);
}

/* Strengths against rising pressure, or against density where a compact was pressed to one;
 * means of curves over the strains that all cells have, of the compact of --at. */
static void test_strength_numbers(void)
{
    static const char *const one[] = {"strength", NULL};
    static const char *const two[] = {"strength", "strength-density", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("strength", one, &series, &err));
    g_assert_cmpstr(series.x.name, ==, "pressure_MPa");
    g_assert_cmpfloat(figure_folder_column(&series, "pressure_MPa_1")[0], ==, 50.0);
    g_assert_cmpfloat(figure_folder_column(&series, "tension_1_MPa")[0], ==, 24.0);
    g_assert_cmpfloat(figure_folder_column(&series, "compression_error_1_MPa")[1], ==,
                      2.0);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("strength", two, &series, &err));
    g_assert_cmpstr(series.x.name, ==, "density");
    g_assert_cmpfloat(figure_folder_column(&series, "density_1")[1], ==, 0.52);
    g_assert_cmpfloat(figure_folder_column(&series, "tension_2_MPa")[0], ==, 27.0);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("strength-curves", one, &series, &err));
    const double *strain = figure_folder_column(&series, "tension_strain_percent");
    const double *mean = figure_folder_column(&series, "tension_MPa");
    g_assert_cmpfloat(strain[1], ==, 1.0);
    g_assert_cmpfloat_with_epsilon(mean[1], 11.0, 1e-9); /* of 10 and 12 */
    g_assert_cmpfloat_with_epsilon(mean[2], 22.0, 1e-9);
    g_assert_true(isnan(mean[3])); /* one cell has broken */
    gb_series_finish(&series);
}

static void test_strength_at(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    char *path = figure_folder_path("strength", NULL);
    char *words[] = {path, NULL};
    struct gb_figures_input input = {.words = words, .at = "50 MPa"};
    const struct gb_figures_row *row = gb_figures_find("strength-curves");
    g_assert_true(gb_figures_run(row, &series, &input, &err));
    g_assert_cmpfloat(figure_folder_column(&series, "tension_1_MPa")[1], ==, 9.0);
    gb_series_finish(&series);
    input.at = "70 MPa";
    g_assert_false(gb_figures_run(row, &series, &input, &err));
    g_assert_nonnull(strstr(err.text, "expected 50, 100"));
    gb_series_finish(&series);
    g_free(path);
}

/* Numbers of the CSV against the curves written above. */
static void test_series(void)
{
    static const char *const runs[] = {"a1", "a2", "b1", NULL};
    struct gb_series series = {0};
    struct gb_error err = {0};
    g_assert_true(figure_folder_named("densification", runs, &series, &err));
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "density", 20), 0.5, 1e-9);
    /* offsets 0 and 2 MPa: mean 1, standard error 1 */
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "mean_1_MPa", 20), 1001.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "se_1_MPa", 20), 1.0, 1e-6);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("lateral", runs, &series, &err));
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "ratio_1", 20), 0.5, 1e-6);
    g_assert_true(isnan(csv_cell(&series, "ratio_1", 0)));
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("unloading", runs, &series, &err));
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "density_1_unload_1", 0), 0.59,
                                   1e-9);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("force-angle", runs, &series, &err));
    /* all contacts along z: 0.01 E d^2 = 0.01 * 1e9 Pa * (1e-8 m)^2 = 1 nN */
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "force_nN_1", 0), 1.0, 1e-9);
    g_assert_true(isnan(csv_cell(&series, "force_nN_1", 17)));
    gb_series_finish(&series);
}

/* Forces between grains of 50 um are in mN: 0.01 * 1e9 Pa * (5e-5 m)^2 = 25 mN. */
static void test_force_unit(void)
{
    static const char *const runs[] = {"coarse", NULL};
    struct gb_series series = {0};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    figure_runs_quasistatic("coarse", 1, "50 um", 0.0);
    char *path = figure_folder_path("coarse", "state.h5");
    g_assert_true(gb_state_read(&state, path, &err));
    state->metre_per_length = 5e-5;
    g_assert_true(gb_state_write(state, NULL, path, &err));
    g_assert_true(figure_folder_named("force-angle", runs, &series, &err));
    g_assert_cmpfloat_with_epsilon(csv_cell(&series, "force_mN_1", 0), 25.0, 1e-9);
    g_assert_cmpstr(series.y.name, ==, "force_mN");
    g_assert_true(g_str_has_suffix(series.y.label, "(mN)"));
    gb_series_finish(&series);
    gb_state_destroy(state);
    g_free(path);
}

/* Points, curve and residuals agree; the panel below lies under the frame. */
static void test_fit(void)
{
    static const char *const runs[] = {"a1", "a2", NULL};
    struct gb_series series = {0};
    struct gb_figure figure;
    struct gb_figure_layout layout;
    struct gb_figure_curve *curves = NULL;
    struct gb_image *image = NULL;
    struct gb_error err = {0};
    g_assert_true(figure_folder_named("fit", runs, &series, &err));
    for (int row = 0; row < 30; row += 10) {
        const double p = csv_cell(&series, "p_1_MPa", row);
        const double rho = csv_cell(&series, "density_1", row);
        /* p = 100 (rho - 0.4)^2 GPa less 1 MPa, between points of the curve */
        g_assert_cmpfloat_with_epsilon(rho, 0.4 + sqrt((p - 1.0) / 1e5), 1e-3);
        g_assert_cmpfloat_with_epsilon(
            csv_cell(&series, "residual_shapiro-konopicky_1_percent", row),
            100.0 * (rho - csv_cell(&series, "shapiro-konopicky_1", row)), 1e-6);
    }
    gb_series_figure(&series, &figure, &curves);
    g_assert_cmpuint(figure.count + figure.below_count, ==, series.curves->len);
    g_assert_cmpuint(figure.below_count, >, 1);
    g_assert_true(gb_figure_render(&image, &figure, 800, 600, &layout, &err));
    g_assert_cmpfloat(layout.below[0], ==, layout.frame[0]);
    g_assert_cmpfloat(layout.below[2], ==, layout.frame[2]);
    g_assert_cmpfloat(layout.below[1], >, layout.frame[3]);
    g_assert_cmpfloat(layout.below[3], >, layout.below[1] + 40.0);
    gb_image_destroy(image);
    g_free(curves);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("heckel", runs, &series, &err));
    g_assert_cmpfloat_with_epsilon(
        csv_cell(&series, "log_1", 9),
        -log(1.0 - 0.4 - sqrt((csv_cell(&series, "p_1_MPa", 9) - 1.0) / 1e5)), 2e-3);
    gb_series_finish(&series);
}

/* Values and their errors in the twin; tables that lack them. */
static void test_moduli(void)
{
    static const char *const one[] = {"moduli", NULL};
    static const char *const two[] = {"moduli", "plane", NULL};
    static const char *const refused[][4] = {
        {"plane"}, {"nothing"}, {"a1"}, {"moduli", "plane", "moduli"}};
    static const char *const reason[] = {"planes have no averages", "no states",
                                         "no moduli.csv", "take 1 to 2 folders"};
    struct gb_series series = {0};
    struct gb_error err = {0};
    g_assert_true(figure_folder_named("moduli", one, &series, &err));
    g_assert_cmpuint(series.curves->len, ==, 4);
    g_assert_cmpfloat(csv_cell(&series, "density_1", 1), ==, 0.5);
    g_assert_cmpfloat(csv_cell(&series, "error_density_1", 1), ==, 0.02);
    g_assert_cmpfloat(csv_cell(&series, "E_GPa_1", 1), ==, 19.0);
    g_assert_cmpfloat(csv_cell(&series, "error_E_GPa_1", 0), ==, 0.5);
    g_assert_cmpfloat(csv_cell(&series, "error_K_GPa_1", 1), ==, 0.75);
    g_assert_true(isnan(csv_cell(&series, "error_G_GPa_1", 0)));
    g_assert_cmpfloat(csv_cell(&series, "nu_1", 0), ==, 0.1);
    for (guint k = 0; k < series.curves->len; k++) {
        const struct gb_series_curve *curve =
            &g_array_index(series.curves, struct gb_series_curve, k);
        g_assert_cmpstr(g_ptr_array_index(series.names, (guint)curve->x_error), ==,
                        "error_density_1");
        g_assert_true(curve->below == (k == 3));
    }
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("moduli-axial", two, &series, &err));
    g_assert_cmpuint(series.curves->len, ==, 5 + 4);
    g_assert_cmpfloat(csv_cell(&series, "axial_C33_GPa_1", 1), ==, 20.0);
    g_assert_cmpfloat(csv_cell(&series, "axial_C33_GPa_2", 0), ==, 10.0);
    gb_series_finish(&series);
    for (size_t k = 0; k < G_N_ELEMENTS(refused); k++) {
        g_assert_false(figure_folder_named("moduli", refused[k], &series, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_nonnull(strstr(err.text, reason[k]));
        gb_series_finish(&series);
        series = (struct gb_series){0};
    }
}

/* g(r) of a tilted cell ends at half its least height, not at half an edge. */
static void test_tilted_distances(void)
{
    static const char *const words[] = {"tilted", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    struct gb_state *state = NULL;
    figure_runs_quasistatic("tilted", 7, "10 nm", 0.0);
    char *path = figure_folder_path("tilted", "state.h5");
    g_assert_true(gb_state_read(&state, path, &err));
    state->tilt[0] = 0.45 * state->cell[0];
    state->tilt[1] = -0.5 * state->cell[0];
    struct gb_cell cell = gb_state_cell(state);
    for (int64_t i = 0; i < state->count; i++) {
        gb_cell_wrap(&cell, &state->position[3 * i]);
    }
    g_assert_true(gb_state_write(state, NULL, path, &err));
    g_assert_true(figure_folder_named("rdf", words, &series, &err));
    const double last = figure_folder_column(&series, "r")[series.rows - 1];
    g_assert_cmpfloat(fabs(last - 0.5 * gb_cell_shortest(&cell)), <, 0.05);
    g_assert_cmpfloat(last, <, 0.9 * 0.5 * state->cell[0]);
    gb_series_finish(&series);
    gb_state_destroy(state);
    g_free(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    figure_runs_write();
    g_test_add_func("/figures/die_numbers", test_die_numbers);
    g_test_add_func("/figures/yield_numbers", test_yield_numbers);
    g_test_add_func("/figures/strength_numbers", test_strength_numbers);
    g_test_add_func("/figures/strength_at", test_strength_at);
    g_test_add_func("/figures/series", test_series);
    g_test_add_func("/figures/tilted-distances", test_tilted_distances);
    g_test_add_func("/figures/force-unit", test_force_unit);
    g_test_add_func("/figures/fit", test_fit);
    g_test_add_func("/figures/moduli", test_moduli);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
