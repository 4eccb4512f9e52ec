/* The figure table, the formats and the report on small run directories made here. */
#include "figure_folder.h"

#include <glib/gstdio.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "base/built_with.h"
#include "figures/output_formats.h"
#include "figures/plotting.h"
#include "figures/report/report.h"
#include "io/preset.h"
#include "io/state/state.h"
#include "pack/die/die.h"

/* Sixty-four particles of two sizes on a grid, neighbours along z in contact. */
static void write_state(const char *directory, uint64_t seed)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    char *path = figure_folder_path(directory, "state.h5");
    g_assert_true(gb_state_create(&state, 64, 64, &err));
    state->dimension = 3;
    state->seed = seed;
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 1e9;
    state->point.density = 0.6;
    state->point.p_pa = 1e8;
    g_strlcpy(state->preset, "grid", sizeof state->preset);
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 4.0 * 0.99;
    }
    for (int i = 0; i < 64; i++) {
        const int index[3] = {i % 4, i / 4 % 4, i / 16};
        for (int k = 0; k < 3; k++) {
            state->position[3 * i + k] = 0.99 * (index[k] + 0.5);
        }
        state->radius[i] = i % 2 ? 0.5 : 0.45;
        state->contacts[i] = 2;
        state->pair[2 * i] = i;
        state->pair[2 * i + 1] = (i + 16) % 64;
        state->pair_normal[i] = 0.01;
        state->pair_force[3 * i + 2] = -0.01;
    }
    g_assert_true(gb_state_write(state, NULL, path, &err));
    gb_state_destroy(state);
    g_free(path);
}

/* p = 100 (rho - 0.4)^2 GPa less `offset` MPa; lateral 0.5; unloading back to 0. */
static void write_curve(const char *directory, double offset, const char *more)
{
    GString *text = g_string_new("branch,step,density,p_MPa,px_MPa,pz_MPa,coordination,"
                                 "bridged,rattlers,time_ns\n");
    for (int i = 0; i <= 40; i++) {
        const double rho = 0.4 + 0.005 * i;
        const double p = 1e5 * (rho - 0.4) * (rho - 0.4) + offset;
        g_string_append_printf(text, "load,%d,%.6f,%.6f,%.6f,%.6f,%.6f,0.5,0.01,%d\n", i,
                               rho, p, 0.75 * p, 1.5 * p, 4.0 + 0.1 * i, i);
    }
    for (int i = 0; i <= 10; i++) {
        g_string_append_printf(text, "unload_1,%d,%.6f,%.6f,,,8,0.5,0.01,%d\n", 41 + i,
                               0.6 - 0.001 * i, 4000.0 - 400.0 * i, 41 + i);
    }
    g_string_append(text, more);
    figure_folder_write(directory, "curve.csv", text->str);
    g_string_free(text, TRUE);
}

static void write_quasistatic(const char *directory, int seed, const char *diameter,
                              double offset)
{
    char *preset = g_strdup_printf(
        "[scene]\ntitle = %s\n[particles]\ncount = 1000\ndiameter = %s\n[structure]\n"
        "seed = %d\n[loading]\ngeometry = uniaxial\n",
        directory, diameter, seed);
    figure_folder_write(directory, "preset.ini", preset);
    write_curve(directory, offset, "");
    write_state(directory, (uint64_t)seed);
    g_free(preset);
}

static void write_dynamic(const char *directory, const char *rate)
{
    GString *hold = g_string_new(NULL);
    char *preset = g_strdup_printf(
        "[scene]\ntitle = %s\nkind = dynamic\ndimension = 2\n[particles]\ncount = 1000\n"
        "[loading]\ngeometry = isotropic\nuntil = density = 0.6\nrate = %s\n",
        directory, rate);
    for (int i = 1; i <= 200; i++) {
        const double t = 0.2 * i;
        const double p =
            3000.0 + 800.0 * exp(-t / 0.7) + 200.0 * exp(-t / 9.0) + 1e-3 * sin(1e4 * i);
        g_string_append_printf(hold, "hold,%d,0.6,%.9f,,,,,,%.6f\n", 52 + i, p, 40.0 + t);
    }
    figure_folder_write(directory, "preset.ini", preset);
    write_curve(directory, 0.0, hold->str);
    write_state(directory, 1);
    g_string_free(hold, TRUE);
    g_free(preset);
}

static void write_die(void)
{
    figure_folder_write("die", "preset.ini",
                        "[scene]\nkind = die\n[contact]\nnormal = hertz\n"
                        "[loading]\ngeometry = die\n");
    figure_folder_write(
        "die", "curve.csv",
        "branch,step,p_MPa,wanted_MPa,density,central_density,height_change\n"
        "relax,0,0,0,0.59,0.64,0\n"
        "load,1,1.1,1,0.6,0.65,-0.01\nload,2,2.1,2,0.62,0.67,-0.02\n");
}

/* A full cycle, with a state of four stacked spheres on the axis, one of them on the wall. */
static void write_cycle(const char *directory, uint64_t seed)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    char *preset =
        g_strdup_printf("[scene]\nkind = die\n[contact]\nnormal = hertz\n"
                        "[structure]\nseed = %d\n[die]\ncycle = full\ncentral = 1 um\n"
                        "[loading]\ngeometry = die\n",
                        (int)seed);
    char *path = figure_folder_path(directory, "state.h5");
    figure_folder_write(directory, "preset.ini", preset);
    figure_folder_write(
        directory, "curve.csv",
        "branch,time_ns,p_MPa,density,wall_friction_mN,axial_springback_percent\n"
        "load,1000,50,0.65,-2,\nunload,2000,20,0.64,-1,0.5\n"
        "in-die,3000,0,0.63,0.1,1\neject,4000,0,0.63,3,1.1\n"
        "eject,5000,0,0.63,2,1.2\neject,6000,0,0.63,0,1.3\n"
        "ejected,7000,0,0.625,0,1.5\n");
    g_assert_true(gb_state_create(&state, 4, 0, &err));
    g_assert_true(gb_state_allocate_walls(state, 1, &err));
    state->seed = seed;
    state->metre_per_length = 1e-6;
    state->pascal_per_stress = 1e9;
    state->die_radius = 0.5;
    state->cell[0] = state->cell[1] = 1.0;
    state->cell[2] = 4.0;
    for (int i = 0; i < 4; i++) {
        state->position[3 * i] = 0.5 + (i == 1 ? 0.01 : 0.0);
        state->position[3 * i + 1] = 0.5;
        state->position[3 * i + 2] = 0.5 + i;
        state->radius[i] = 0.5;
    }
    state->wall[0] = 1;
    state->wall[1] = GB_DIE_SIDE;
    state->wall_force[0] = -0.002;
    g_assert_true(gb_state_write(state, NULL, path, &err));
    gb_state_destroy(state);
    g_free(path);
    g_free(preset);
}

/* Isotropic to 50 MPa, then sheared: q rises to 40 MPa at half the final strain. */
static void write_legs(void)
{
    GString *text =
        g_string_new("branch,step,density,px_MPa,py_MPa,pz_MPa,p_MPa,q_MPa,exx,eyy,ezz,"
                     "gxy,gxz,gyz\n");
    for (int i = 0; i <= 10; i++) {
        g_string_append_printf(text, "load,%d,0.4,%d,%d,%d,%d,1,0,0,0,0,0,0\n", i, 5 * i,
                               5 * i, 5 * i, 5 * i);
    }
    for (int i = 1; i <= 10; i++) {
        g_string_append_printf(text, "leg:2,%d,0.4,47,53,50,50,%d,0,0,0,0,%g,0\n", 10 + i,
                               MIN(8 * i, 40), 0.02 * i);
    }
    figure_folder_write(
        "legs", "preset.ini",
        "[loading]\npath = isotropic to 50 MPa; shear xz to 20 % at z = 50 MPa\n");
    figure_folder_write("legs", "curve.csv", text->str);
    write_state("legs", 1);
    g_string_free(text, TRUE);
}

static void write_chart(void)
{
    figure_folder_write(
        "chart", "chart.csv",
        "relaxer,particles,reference,seeds,evaluations,cpu_s,bound,front,chosen,"
        "error_5MPa,error_se_5MPa,scatter_5MPa\n"
        "fire,1000,1,3,900,9,,0,0,0,0,0.003\n"
        "fire,1000,0,3,200,2,0.01,1,0,0.008,0.002,0.005\n"
        "fire,1000,0,3,100,1,0.02,1,1,-0.02,0.001,0.004\n");
}

static void write_card(void)
{
    figure_folder_write("card", "card.csv",
                        "density,d_MPa,beta_deg,R,p_a_MPa,transition\n"
                        "0.4,40,45,1,10,0.03\n0.5,60,40,1.3,50,0.03\n");
    figure_folder_write("card", "card_points.csv",
                        "density,p_MPa,q_MPa,q_MPa_error,side\n"
                        "0.4,10,48,2,cap\n0.4,-5,-36,2,shear\n0.5,60,110,3,cap\n");
    figure_folder_write(
        "card", "card_uniaxial.csv",
        "density,ratio,ratio_low,ratio_high,card_ratio,card_ratio_low,"
        "card_ratio_high\n"
        "0.42,0.4,0.38,0.42,0.7,0.65,0.75\n0.5,0.5,0.48,0.52,0.8,0.75,0.85\n");
}

/* Four points on a circle about (30, 0) MPa of radius 20, at the chosen offset; another
 * radius at half and double of it.  Flow along +p everywhere. */
static void write_yield(void)
{
    GString *points =
        g_string_new("density,offset_percent,direction_deg,cells,p_MPa,p_error_MPa,q_MPa,"
                     "q_error_MPa,flow_volume,flow_shear\n");
    GString *fit = g_string_new("quantity,density,offset_percent,value,error,unit\n");
    for (int o = 0; o < 3; o++) {
        const double offset = 0.05 * (1 << o), radius = 10.0 * (o == 1 ? 2 : 1);
        for (int d = 0; d < 4; d++) {
            g_string_append_printf(points, "0.5,%g,%d,8,%.9g,0.4,%.9g,0.3,0.002,0\n",
                                   offset, 90 * d, 30.0 + radius * cos(M_PI_2 * d),
                                   radius * sin(M_PI_2 * d));
        }
        g_string_append_printf(
            fit,
            "centre_p,0.5,%g,30,1,MPa\ncentre_q,0.5,%g,0,1,MPa\n"
            "half_axis_p,0.5,%g,%g,1,MPa\nhalf_axis_q,0.5,%g,%g,1,MPa\n"
            "shift,0.5,%g,2,1,1\n",
            offset, offset, offset, radius, offset, radius, offset);
    }
    figure_folder_write("yield", "yield.csv", points->str);
    figure_folder_write("yield", "yield_fit.csv", fit->str);
    g_string_free(points, TRUE);
    g_string_free(fit, TRUE);
}

static void write_strength(void)
{
    figure_folder_write(
        "strength", "strength.csv",
        "test,pressure_MPa,pressed_density,density,strength_MPa,strength_error_MPa\n"
        "tension,100,,0.52,30,1\ncompression,100,,0.52,55,2\nshear,100,,0.52,25,\n"
        "tension,50,,0.47,24,1\ncompression,50,,0.47,41,2\nshear,50,,0.47,18,\n");
    figure_folder_write(
        "strength-density", "strength.csv",
        "test,pressure_MPa,pressed_density,density,strength_MPa,strength_error_MPa\n"
        "tension,,0.5,0.49,27,1\n");
    figure_folder_write(
        "strength", "strength_curves.csv",
        "test,pressure_MPa,pressed_density,cell,strain_percent,stress_MPa\n"
        "tension,50,,1,0,0\ntension,50,,1,1,9\n"
        "tension,100,,1,-0,0\ntension,100,,1,0,0.1\ntension,100,,1,2,20\n"
        "tension,100,,2,0,0\ntension,100,,2,1,12\ntension,100,,2,2,24\n"
        "tension,100,,2,3,10\n"
        "compression,100,,1,0,0\ncompression,100,,1,1,40\n"
        "shear,100,,1,0,0\nshear,100,,1,1,15\n");
}

/* Two states with errors, and a plane, which has axial constants alone. */
static void write_moduli(void)
{
    figure_folder_write(
        "moduli", "moduli.csv",
        "density,K_GPa,G_GPa,E_GPa,nu,axial_C11_GPa,axial_C12_GPa,axial_C13_GPa,"
        "axial_C33_GPa,axial_C44_GPa,error_density,error_E_GPa,error_K_GPa\n"
        "0.4,5,4,9,0.1,8,2,2,10,3,0.01,0.5,0.25\n"
        "0.5,10,8,19,0.15,16,4,4,20,6,0.02,1,0.75\n");
    figure_folder_write(
        "plane", "moduli.csv",
        "density,K_GPa,G_GPa,E_GPa,nu,axial_C11_GPa,axial_C12_GPa,axial_C13_GPa,"
        "axial_C33_GPa,axial_C44_GPa\n0.8,,,,,8,,2,10,3\n");
    figure_folder_write("nothing", "moduli.csv", "density,K_GPa\n");
}

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
    g_assert_nonnull(strstr(err.text, "accepted 50, 100"));
    gb_series_finish(&series);
    g_free(path);
}

/* Every row draws. */
static void test_rows(void)
{
    for (const struct gb_figures_row *row = gb_figures_table(); row->name; row++) {
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
    for (const struct gb_figures_row *row = gb_figures_table(); row->name; row++) {
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
    for (const struct gb_figures_row *row = gb_figures_table(); row->name; row++) {
        struct gb_error err = {0};
        char *text = gb_figures_describe(row);
        g_assert_cmpuint(strlen(text), <=, 90);
        g_assert_true(gb_figures_find(row->name) == row);
        g_assert_nonnull(row->compute);
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
    for (const struct gb_figures_row *row = gb_figures_table(); row->name; row++) {
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

/* Forces between grains of 50 um are in mN: 0.01 * 1e9 Pa * (5e-5 m)^2 = 25 mN. */
static void test_force_unit(void)
{
    static const char *const runs[] = {"coarse", NULL};
    struct gb_series series = {0};
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    write_quasistatic("coarse", 1, "50 um", 0.0);
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
        write_curve(runs[k], 0.0, "");
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
            csv_cell(&series, "residual_secondi_1_percent", row),
            100.0 * (rho - csv_cell(&series, "secondi_1", row)), 1e-6);
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

static void test_formats(void)
{
    static const char *const runs[] = {"a1", NULL};
    struct gb_series series = {0};
    struct gb_error err = {0};
    const struct gb_plotting_page page = {400, 300, "time", NULL, NULL, GB_PLOTTING_KEEP,
                                          0};
    g_assert_true(figure_folder_named("time", runs, &series, &err));
    for (const struct gb_output_formats_row *row = gb_output_formats_table();
         row->extension; row++) {
        char *name = g_strconcat("out", row->extension, NULL);
        char *path = figure_folder_path(name, NULL);
        const bool figure = (row->uses & GB_OUTPUT_FORMATS_FIGURE) != 0;
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
    char *names = gb_output_formats_names(GB_OUTPUT_FORMATS_FIGURE);
    char *pattern = gb_output_formats_pattern(GB_OUTPUT_FORMATS_FIGURE);
    g_assert_true(g_str_has_prefix(names, ".png, "));
    g_assert_true(g_str_has_prefix(pattern, "FILE.png|"));
    for (const struct gb_output_formats_row *row = gb_output_formats_table();
         row->extension; row++) {
        const bool figure = (row->uses & GB_OUTPUT_FORMATS_FIGURE) != 0;
        g_assert_true((strstr(names, row->extension) != NULL) == figure);
        g_assert_true((strstr(pattern, row->extension + 1) != NULL) == figure);
        g_assert_true(figure || row->frames != NULL || !GB_WITH_PICTURES);
    }
    g_free(pattern);
    g_free(names);
    char *pictures = gb_output_formats_names(GB_OUTPUT_FORMATS_PICTURE);
    g_assert_cmpstr(pictures, ==, ".png");
    g_free(pictures);
}

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

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    figure_folder_init();
    write_quasistatic("a1", 1, "10 nm", 0.0);
    write_quasistatic("a2", 2, "10 nm", 2.0);
    write_quasistatic("b1", 1, "20 nm", 5.0);
    write_dynamic("fast", "100 1/us");
    write_dynamic("slow", "10 1/us");
    write_die();
    write_legs();
    write_cycle("cycle1", 1);
    write_cycle("cycle2", 2);
    write_moduli();
    write_card();
    write_yield();
    write_strength();
    write_chart();
    figure_folder_write("empty", "preset.ini", "[scene]\ntitle = empty\n");
    g_test_add_func("/figures/table", test_table);
    g_test_add_func("/figures/options", test_options);
    g_test_add_func("/figures/rows", test_rows);
    g_test_add_func("/figures/die_numbers", test_die_numbers);
    g_test_add_func("/figures/yield_numbers", test_yield_numbers);
    g_test_add_func("/figures/equal_scales", test_equal_scales);
    g_test_add_func("/figures/strength_numbers", test_strength_numbers);
    g_test_add_func("/figures/strength_at", test_strength_at);
    g_test_add_func("/figures/errors", test_errors);
    g_test_add_func("/figures/series", test_series);
    g_test_add_func("/figures/axes", test_axes);
    g_test_add_func("/figures/measured", test_measured);
    g_test_add_func("/figures/force-unit", test_force_unit);
    g_test_add_func("/figures/labels", test_labels);
    g_test_add_func("/figures/fit", test_fit);
    g_test_add_func("/figures/moduli", test_moduli);
    g_test_add_func("/figures/formats", test_formats);
    g_test_add_func("/figures/report", test_report);
    const int status = g_test_run();
    figure_folder_finish();
    return status;
}
