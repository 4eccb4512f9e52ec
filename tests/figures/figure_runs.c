#include "figure_runs.h"

#include <math.h>
#include <string.h>

#include "figure_folder.h"
#include "io/state.h"
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

void figure_runs_curve(const char *directory, double offset, const char *more)
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

void figure_runs_quasistatic(const char *directory, int seed, const char *diameter,
                             double offset)
{
    char *preset = g_strdup_printf(
        "[scene]\ntitle = %s\n[particles]\ncount = 1000\ndiameter = %s\n[structure]\n"
        "seed = %d\n[loading]\ngeometry = uniaxial\n",
        directory, diameter, seed);
    figure_folder_write(directory, "preset.ini", preset);
    figure_runs_curve(directory, offset, "");
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
    figure_runs_curve(directory, 0.0, hold->str);
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
    figure_folder_write(
        "chart", "E.csv",
        "quantity,unit,reference,default,cost,value,error,error_95,half_interval,chosen\n"
        "E,GPa,1,0,4,8,,,0.4,0\n"
        "E,GPa,0,1,1,8.2,0.2,0.1,0.4,0\n"
        "E,GPa,0,0,2,8.1,0.1,0.1,0.4,1\n");
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

void figure_runs_write(void)
{
    figure_runs_quasistatic("a1", 1, "10 nm", 0.0);
    figure_runs_quasistatic("a2", 2, "10 nm", 2.0);
    figure_runs_quasistatic("b1", 1, "20 nm", 5.0);
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
}
