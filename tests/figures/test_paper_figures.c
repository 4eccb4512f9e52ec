/* Figures and tables of the papers, from runs made here whose laws are known. */
#include "figure_folder.h"

#include <math.h>
#include <string.h>

#include "io/state.h"

/* Rates of P2, 1/s. */
static const double rates[5] = {6.8e8, 6.8e7, 6.8e6, 6.8e5, 6.8e4};
static const char *const rate_runs[] = {"v1", "v2", "v3", "v4", "v5", NULL};
static const double k_v = 21.5, rho0 = 0.5;

static double static_pressure(double rho)
{
    return 9000.0 * pow(rho - rho0, 2.0) + 100.0;
}

/* A run at a rate that obeys P2 (9) and (8); table 1: p1 e^(-t/tau1) + p2 e^(-t/tau2). */
static void write_rate(const char *directory, double rate, int seed, double offset,
                       const double decay[4])
{
    GString *text = g_string_new("branch,step,density,p_MPa,coordination,time_ns\n");
    for (int i = 0; i <= 90; i++) {
        const double rho = 0.5 + 0.005 * i;
        g_string_append_printf(text, "load,%d,%.6f,%.9f,%.6f,%.6f\n", i, rho,
                               offset + static_pressure(rho) +
                                   k_v * pow(rate, 0.25) * pow(rho - rho0, 3.0),
                               2.3 + 3.0 * rho * rho, 0.1 * i);
    }
    for (int i = 1; i <= 1500; i++) {
        const double t = 0.02 * i;
        g_string_append_printf(text, "hold,%d,0.95,%.9f,,%.6f\n", 90 + i,
                               2800.0 + decay[0] * exp(-t / decay[1]) +
                                   decay[2] * exp(-t / decay[3]) + 1e-3 * sin(1e4 * i),
                               9.0 + t);
    }
    figure_folder_write(directory, "curve.csv", text->str);
    g_string_printf(
        text,
        "[scene]\nkind = dynamic\ndimension = 2\n[structure]\ndensity = 0.5\nseed = %d\n"
        "[loading]\ngeometry = isotropic\nuntil = density = 0.95\n"
        "rate = %.9g 1/s\n",
        seed, rate);
    figure_folder_write(directory, "preset.ini", text->str);
    g_string_free(text, TRUE);
}

/* P2 table 1, but v5, whose slow fall alone is left. */
static void write_rates(void)
{
    static const double decay[5][4] = {{441.1, 0.0719, 35.3, 4.9304},
                                       {109.7, 0.1977, 72.0, 4.335},
                                       {13.3, 0.4486, 84.1, 9.2157},
                                       {49.8, 0.1515, 29.0, 10.0},
                                       {0.0, 1.0, 1.31, 10.0}};
    for (int k = 0; k < 5; k++) {
        write_rate(rate_runs[k], rates[k], 1, 0.0, decay[k]);
    }
    write_rate("still", 6.8e3, 1, 0.0, (const double[4]){0.0, 1.0, 0.0, 1.0});
}

/* What is left of the static pressure is k_v v^(1/4) (rho - rho0)^3: 200 MPa more at 1e8/s
 * and 0.95, as P2 says. */
static void test_rate_difference(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("rate-difference", rate_runs, &series, &err));
    const double *density = figure_folder_column(&series, "density");
    const double *rate = figure_folder_column(&series, "rate_per_s");
    const double *difference = figure_folder_column(&series, "difference_MPa");
    const double *p_stat = figure_folder_column(&series, "p_stat_MPa");
    for (int i = 0; i < 5 * 5; i++) {
        g_assert_cmpfloat_with_epsilon(
            difference[i], k_v * pow(rate[i], 0.25) * pow(density[i] - rho0, 3.0), 1e-3);
        g_assert_cmpfloat_with_epsilon(p_stat[i], static_pressure(density[i]), 1e-3);
    }
    const double *line_rate = figure_folder_column(&series, "line_rate_per_s");
    const double *line = figure_folder_column(&series, "P2_0.95_MPa");
    g_assert_cmpfloat_with_epsilon(line_rate[80], 1e8, 1.0);
    g_assert_cmpfloat_with_epsilon(line[80], 195.9, 0.1);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "fit_0.95_MPa")[80],
                                   line[80], 1e-3);
    g_assert_nonnull(strstr(series.notes->str, "k_v = 21.5 ("));
    gb_series_finish(&series);
}

/* A rate with one run takes the scatter of the others: of pressures 10 MPa above and below
 * those of v1, 10 sqrt 2 MPa for one run, 10 for the mean of two. */
static void test_rate_errors(void)
{
    static const char *const runs[] = {"high", "low", "v2", "v3", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    write_rate("high", rates[0], 1, 10.0, (const double[4]){0.0, 1.0, 0.0, 1.0});
    write_rate("low", rates[0], 2, -10.0, (const double[4]){0.0, 1.0, 0.0, 1.0});
    g_assert_true(figure_folder_named("rate-difference", runs, &series, &err));
    const double *error = figure_folder_column(&series, "se_MPa");
    g_assert_cmpfloat_with_epsilon(error[0], 10.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(error[1], 10.0 * sqrt(2.0), 1e-6);
    g_assert_cmpfloat_with_epsilon(error[2], 10.0 * sqrt(2.0), 1e-6);
    gb_series_finish(&series);
}

static void test_rate_difference_refusals(void)
{
    static const char *const one[] = {"v1", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_false(figure_folder_named("rate-difference", one, &series, &err));
    g_assert_nonnull(strstr(err.text, "two rates at one density"));
    gb_series_finish(&series);
}

/* Curves that obey (9) lie on its lines; the quasi-static line is the lowest. */
static void test_difference(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("difference", rate_runs, &series, &err));
    const double *density = figure_folder_column(&series, "density");
    const double *still = figure_folder_column(&series, "P2_quasistatic_MPa");
    for (int g = 1; g <= 5; g++) {
        if (g == 2) { /* the reference */
            continue;
        }
        char *names[] = {g_strdup_printf("difference_%d_MPa", g),
                         g_strdup_printf("P2_%d_MPa", g)};
        const double *difference = figure_folder_column(&series, names[0]);
        const double *law = figure_folder_column(&series, names[1]);
        for (size_t i = 0; i < series.rows; i++) {
            g_assert_cmpfloat_with_epsilon(difference[i], law[i], 1e-5);
            g_assert_cmpfloat(still[i], <=, law[i]);
        }
        g_free(names[0]);
        g_free(names[1]);
    }
    const size_t last = series.rows - 1;
    g_assert_cmpfloat_with_epsilon(density[last], 0.95, 1e-9);
    g_assert_cmpfloat_with_epsilon(still[last],
                                   -k_v * pow(rates[1], 0.25) * pow(0.45, 3.0), 1e-6);
    gb_series_finish(&series);
}

/* P2 (8) is drawn once, over the coordination of discs at a rate. */
static void test_coordination(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("coordination", rate_runs, &series, &err));
    const double *law = figure_folder_column(&series, "P2_8");
    const double *here = figure_folder_column(&series, "coordination_3");
    for (size_t i = 0; i < series.rows; i++) {
        g_assert_cmpfloat_with_epsilon(here[i], law[i], 1e-5);
    }
    g_assert_cmpuint(series.curves->len, ==, 5 + 1);
    gb_series_finish(&series);
}

/* The asymptote once, and one curve for each of five rates. */
static void test_densification(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("densification", rate_runs, &series, &err));
    g_assert_cmpuint(series.curves->len, ==, 5 + 1);
    gb_series_finish(&series);
}

/* Table 1, as times and as amplitudes; a rate whose pressure does not fall leaves empty cells
 * and the others their values. */
static void test_relaxation(void)
{
    static const char *const runs[] = {"v1", "v2", "v3", "v5", "still", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_named("relaxation", runs, &series, &err));
    const struct {
        const char *name;
        double value[3], share;
    } table[] = {{"p0_MPa", {2800.0, 2800.0, 2800.0}, 1e-3},
                 {"p1_MPa", {441.1, 109.7, 13.3}, 0.02},
                 {"tau1_ns", {0.0719, 0.1977, 0.4486}, 0.02},
                 {"p2_MPa", {35.3, 72.0, 84.1}, 0.02},
                 {"tau2_ns", {4.9304, 4.335, 9.2157}, 0.02}};
    for (size_t k = 0; k < G_N_ELEMENTS(table); k++) {
        for (int g = 0; g < 3; g++) {
            g_assert_cmpfloat_with_epsilon(
                figure_folder_column(&series, table[k].name)[g], table[k].value[g],
                table[k].share * table[k].value[g]);
        }
    }
    const double *terms = figure_folder_column(&series, "exponentials");
    g_assert_cmpfloat(terms[0], ==, 2.0);
    g_assert_cmpfloat(terms[3], ==, 1.0);
    g_assert_true(isnan(figure_folder_column(&series, "tau1_ns")[4]));
    g_assert_true(isnan(figure_folder_column(&series, "p2_MPa")[3]));
    g_assert_cmpfloat(figure_folder_column(&series, "drawn_1_ns")[1], ==,
                      figure_folder_column(&series, "tau1_ns")[1]);
    gb_series_finish(&series);
    g_assert_true(figure_folder_named("relaxation-amplitude", runs, &series, &err));
    g_assert_cmpfloat(figure_folder_column(&series, "drawn_2_MPa")[1], ==,
                      figure_folder_column(&series, "p2_MPa")[1]);
    gb_series_finish(&series);
}

static double first(const struct gb_series *series, const char *name)
{
    return figure_folder_column(series, name)[0];
}

/* P3 Fig. 9: curves by the rule of P3 meet at the yield point, that of the printed 1480 MPa
 * passes 1480 (1/225)^0.05 = 1129 MPa there. */
static void test_hollomon(void)
{
    static const char *const curves[] = {"stress_m0_MPa", "stress_m0.05_MPa",
                                         "stress_m0.1_MPa", "stress_m0.2_MPa",
                                         "elastic_MPa"};
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_scene(gb_figures_find("hollomon"), &series, &err));
    int at = 0;
    while (figure_folder_column(&series, "strain_percent")[at] < 80.0 / 180.0 - 1e-9) {
        at++;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(curves); k++) {
        g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, curves[k])[at],
                                       800.0, 1e-3);
    }
    g_assert_cmpfloat_with_epsilon(
        figure_folder_column(&series, "stress_m0.05_printed_MPa")[at],
        1480.0 * pow(1.0 / 225.0, 0.05), 1e-6);
    g_assert_cmpfloat_with_epsilon(first(&series, "yield_strain_percent"), 80.0 / 180.0,
                                   1e-9);
    gb_series_finish(&series);
}

/* P3 Fig. 10: yield at 2.09 nm and 2.822e-5 N; 0.02 N is 50 MPa of F/4R^2, 0.83 % of h/2R by
 * Hertz; 1480 MPa are 1480/1049 of the force for m = 0.05. */
static void test_pair(void)
{
    struct gb_error err = {0};
    struct gb_series series = {0};
    g_assert_true(figure_folder_scene(gb_figures_find("pair"), &series, &err));
    g_assert_cmpfloat_with_epsilon(first(&series, "yield_h_nm"), 2.09, 0.005);
    g_assert_cmpfloat_with_epsilon(first(&series, "yield_force_mN"), 0.02822, 5e-6);
    g_assert_cmpfloat_with_epsilon(series.right.factor * 20.0, 50.0, 1e-9);
    int at = 0;
    while (figure_folder_column(&series, "force_mN_0")[at] < 20.0) {
        at++;
    }
    g_assert_cmpfloat_with_epsilon(
        series.top.factor * figure_folder_column(&series, "h_nm")[at], 0.83, 0.01);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "force_mN_5")[at] /
                                       figure_folder_column(&series, "force_mN_2")[at],
                                   1480.0 / (800.0 * pow(225.0, 0.05)), 1e-9);
    figure_folder_assert_drawn(gb_figures_find("pair"), &series);
    gb_series_finish(&series);
    g_assert_true(figure_folder_scene(gb_figures_find("line"), &series, &err));
    g_assert_null(series.right.label);
    g_assert_cmpfloat_with_epsilon(series.top.factor * 400.0, 10.0, 1e-9);
    gb_series_finish(&series);
}

/* A poured and pressed bed: densities at rest, then under pressure. */
static void write_bed(const char *directory, int seed, double mu, double density,
                      double central)
{
    char *text =
        g_strdup_printf("branch,step,p_MPa,density,central_density\nrelax,0,0,0.1,0.1\n"
                        "relax,0,0,%.6f,%.6f\nload,1,50,0.7,0.7\n",
                        density, central);
    figure_folder_write(directory, "curve.csv", text);
    g_free(text);
    text = g_strdup_printf(
        "[scene]\nkind = die\n[contact]\nnormal = hertz\nmu = %g\n[loading]\n"
        "geometry = die\n[structure]\nseed = %d\n[die]\n"
        "central = 1 um\n",
        mu, seed);
    figure_folder_write(directory, "preset.ini", text);
    g_free(text);
}

/* P3 table 1: mean and standard deviation over different beds; one seed pressed by two
 * laws is one bed. */
static void test_poured_density(void)
{
    static const char *const beds[] = {"bed1", "bed2", "bed3", "bed3-again", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    write_bed("bed1", 1, 0.0, 0.62, 0.66);
    write_bed("bed2", 2, 0.0, 0.63, 0.66);
    write_bed("bed3", 3, 0.0, 0.61, 0.69);
    write_bed("bed3-again", 3, 0.05, 0.61, 0.69);
    g_assert_true(figure_folder_named("poured-density", beds, &series, &err));
    g_assert_cmpfloat_with_epsilon(first(&series, "density_mean"), 0.62, 1e-12);
    g_assert_cmpfloat_with_epsilon(first(&series, "density_standard_deviation"), 0.01,
                                   1e-12);
    g_assert_cmpfloat_with_epsilon(first(&series, "density_standard_error"),
                                   0.01 / sqrt(3.0), 1e-12);
    g_assert_cmpfloat(first(&series, "density_least"), ==, 0.61);
    g_assert_cmpfloat(first(&series, "density_largest"), ==, 0.63);
    g_assert_cmpfloat_with_epsilon(first(&series, "central_density_mean"), 0.67, 1e-12);
    g_assert_cmpfloat(figure_folder_column(&series, "bed")[2], ==, 3.0);
    g_assert_cmpuint(series.rows, ==, 3);
    gb_series_finish(&series);
}

/* Spheres of 1 um stacked on the axis of a bore as wide: a sphere as wide in the middle of
 * the stack holds two caps, 5/16 of its volume each; the plane cuts three particles of 1 um
 * and one beside it in a circle of 0.8 um. */
static void test_die_section(void)
{
    static const char *const words[] = {"section", NULL};
    static const char *const two[] = {"section", "bed2", NULL};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    struct gb_series series = {0};
    write_bed("section", 1, 0.0, 0.6, 0.6);
    char *path = figure_folder_path("section", "state.h5");
    g_assert_true(gb_state_create(&state, 4, 0, &err));
    state->metre_per_length = 1e-6;
    state->pascal_per_stress = 1e9;
    state->die_radius = 0.5;
    state->cell[0] = state->cell[1] = 1.0;
    state->cell[2] = 4.0;
    for (int i = 0; i < 4; i++) {
        state->position[3 * i] = 0.5;
        state->position[3 * i + 1] = i == 3 ? 0.8 : 0.5;
        state->position[3 * i + 2] = 0.5 + i;
        state->radius[i] = 0.5;
    }
    g_assert_true(gb_state_write(state, NULL, path, &err));
    g_assert_true(figure_folder_named("die-section", words, &series, &err));
    g_assert_cmpfloat_with_epsilon(first(&series, "density"), 2.0 / 3.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(first(&series, "central_density"), 5.0 / 8.0, 1e-12);
    const double *x = figure_folder_column(&series, "particle_x_um");
    double widest[4] = {0.0};
    for (size_t k = 0, circle = 0; k < series.rows && circle < 4; k++) {
        widest[circle] = fmax(widest[circle], isnan(x[k]) ? 0.0 : x[k]);
        circle += isnan(x[k]) ? 1 : 0;
    }
    g_assert_cmpfloat_with_epsilon(widest[0], 0.5, 1e-12);
    g_assert_cmpfloat_with_epsilon(widest[3], 0.4, 1e-12);
    g_assert_true(series.equal_scales);
    gb_series_finish(&series);
    /* a recorded density counts up to the punch, which particles enter */
    state->point.density = 0.7;
    g_assert_true(gb_state_write(state, NULL, path, &err));
    g_assert_true(figure_folder_named("die-section", words, &series, &err));
    g_assert_cmpfloat_with_epsilon(first(&series, "density"), 0.7, 1e-12);
    gb_series_finish(&series);
    g_assert_false(figure_folder_named("die-section", two, &series, &err));
    g_assert_nonnull(strstr(err.text, "expected one run"));
    gb_state_destroy(state);
    g_free(path);
}

/* Twenty particles, of which `tens` have 10 contacts, one 20, the others 6. */
static void write_contacts(const char *directory, int seed, int tens)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    char *preset =
        g_strdup_printf("[particles]\ncount = 1000\n[structure]\nseed = %d\n", seed);
    figure_folder_write(directory, "preset.ini", preset);
    figure_folder_write(directory, "curve.csv",
                        "branch,step,density,p_MPa\nload,0,0.5,1\n");
    char *path = figure_folder_path(directory, "state.h5");
    g_assert_true(gb_state_create(&state, 20, 0, &err));
    state->dimension = 3;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9;
    for (int i = 0; i < 20; i++) {
        state->radius[i] = 0.5;
        state->contacts[i] = i < tens ? 10 : i == 19 ? 20 : 6;
    }
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 5.0;
    }
    g_assert_true(gb_state_write(state, NULL, path, &err));
    gb_state_destroy(state);
    g_free(path);
    g_free(preset);
}

/* Shares of each packing, then their mean and standard error. */
static void test_contacts(void)
{
    static const char *const words[] = {"contacts1", "contacts2", NULL};
    struct gb_error err = {0};
    struct gb_series series = {0};
    write_contacts("contacts1", 1, 1);
    write_contacts("contacts2", 2, 3);
    g_assert_true(figure_folder_named("contacts", words, &series, &err));
    const double *share = figure_folder_column(&series, "share_percent_1");
    g_assert_cmpfloat_with_epsilon(share[10], 10.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(share[6], 85.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(share[15], 5.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(share[12], 0.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(figure_folder_column(&series, "se_1")[10], 5.0, 1e-12);
    g_assert_nonnull(strstr(series.notes->str, "group 1: 10 contacts: 10 +- 5 %\n"));
    gb_series_finish(&series);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    write_rates();
    g_test_add_func("/papers/rate_difference", test_rate_difference);
    g_test_add_func("/papers/rate_errors", test_rate_errors);
    g_test_add_func("/papers/rate_difference_refusals", test_rate_difference_refusals);
    g_test_add_func("/papers/difference", test_difference);
    g_test_add_func("/papers/coordination", test_coordination);
    g_test_add_func("/papers/densification", test_densification);
    g_test_add_func("/papers/relaxation", test_relaxation);
    g_test_add_func("/papers/hollomon", test_hollomon);
    g_test_add_func("/papers/pair", test_pair);
    g_test_add_func("/papers/poured_density", test_poured_density);
    g_test_add_func("/papers/die_section", test_die_section);
    g_test_add_func("/papers/contacts", test_contacts);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
