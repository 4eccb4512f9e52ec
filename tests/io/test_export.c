/* States as files of other programs, read back and compared. */
#include "io/export.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "io/state.h"
#include "io/state_forces.h"

/* Two pairs of particles in a tilted cell; the second touches across a boundary. */
static struct gb_state *make_state(void)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    static const double position[4][3] = {
        {1.0, 1.0, 1.0}, {1.0, 1.0, 1.9}, {3.0, 0.2, 2.0}, {3.5, 3.9, 2.0}};
    static const double force[2][3] = {{0.0, 0.0, -2e-3}, {1e-4, 1e-3, 0.0}};
    static const int32_t pair[4] = {0, 1, 2, 3};
    if (!gb_state_create(&state, 4, 2, &err)) {
        g_error("%s", err.text);
    }
    state->dimension = 3;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 4.0;
    }
    state->tilt[0] = 0.5; /* xy */
    memcpy(state->position, position, sizeof position);
    memcpy(state->pair_force, force, sizeof force);
    memcpy(state->pair, pair, sizeof pair);
    for (int i = 0; i < 4; i++) {
        state->radius[i] = 0.5;
        state->contacts[i] = 1;
    }
    state->pair_normal[0] = 2e-3;
    state->pair_normal[1] = -1e-3;
    state->pair_bridged[1] = 1;
    state->metre_per_length = 10e-9;
    state->pascal_per_stress = 400e9;
    state->point.step = 7;
    state->point.density = 0.25;
    state->point.p_pa = 20e6;
    state->seed = 3;
    g_strlcpy(state->preset, "a \"quoted\"\ntitle", sizeof state->preset);
    return state;
}

struct texts {
    GString *particles, *contacts;
};

static struct texts export_frames(const char *name, int frames)
{
    struct gb_error err = {0};
    struct texts texts = {g_string_new(NULL), g_string_new(NULL)};
    const struct gb_export_format *format = gb_export_find(name, &err);
    struct gb_state *state = make_state();
    for (int i = 0; i < frames; i++) {
        g_assert_true(gb_export_add(format, state, 3990.0, i, texts.particles,
                                    texts.contacts, &err));
    }
    gb_state_destroy(state);
    return texts;
}

static void finish(struct texts *texts)
{
    g_string_free(texts->particles, TRUE);
    g_string_free(texts->contacts, TRUE);
}

/* Word `word` of line `line`, both from 0. */
static double number_at(const char *text, const char *separator, int line, int word)
{
    char **lines = g_strsplit(text, "\n", 0);
    char **words = g_strsplit(lines[line], separator, 0);
    const double value = g_ascii_strtod(words[word], NULL);
    g_strfreev(words);
    g_strfreev(lines);
    return value;
}

/* Force and branch of the contact across the boundary, by hand: from the image of the
 * fourth particle at (3.5 - 0.5, 3.9 - 4, 2) to the third at (3, 0.2, 2). */
static void test_contacts(void)
{
    struct texts texts = export_frames("csv", 1);
    const char *row = texts.contacts->str;
    const double nn = 400e9 * 1e-16 * 1e9;
    static const double branch_nm[3] = {0.0, 3.0, 0.0};
    g_assert_cmpfloat(number_at(row, ",", 4, 1), ==, 3.0);
    g_assert_cmpfloat(number_at(row, ",", 4, 2), ==, 4.0);
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 4), nn * 1e-3, 1e-9);
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 6), -nn * 1e-3, 1e-9);
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 7 + k), branch_nm[k], 1e-9);
    }
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 10), 7.0, 1e-9); /* overlap */
    g_assert_cmpfloat(number_at(row, ",", 4, 11), ==, 1.0);
    finish(&texts);
}

/* The mean of the particle stresses, weighted by volume, is the sum of f r over the cell;
 * the mean stress is a third of the trace. */
static void test_stress(void)
{
    struct gb_state *state = make_state();
    const struct gb_state_gaps none = {0};
    double stress[4 * 6], mean[4], sum[6] = {0.0};
    gb_state_forces_stress_tensor(state, &none, stress);
    gb_state_forces_stress_mean(state, &none, mean);
    for (int i = 0; i < 4; i++) {
        for (int c = 0; c < 6; c++) {
            sum[c] += stress[6 * i + c] / 4.0;
        }
        g_assert_cmpfloat_with_epsilon(
            mean[i], (stress[6 * i] + stress[6 * i + 1] + stress[6 * i + 2]) / 3.0, 1e-3);
    }
    /* -2e-3 * -0.9 along z; 1e-3 * 0.3 along y; xy: 1e-4 * 0.3 / 2 */
    const double want[6] = {0.0, 3e-4, 1.8e-3, 1.5e-5, 0.0, 0.0};
    for (int c = 0; c < 6; c++) {
        g_assert_cmpfloat_with_epsilon(sum[c], 400e9 * want[c] / 64.0, 1e-2);
    }
    gb_state_destroy(state);
}

/* Force (1e-4, 1e-3, 0) on a branch along y: 1e-4 across; a = 0.2 d = 2 nm. */
static void test_contact_radius(void)
{
    struct gb_error err = {0};
    const double nn = 400e9 * 1e-16 * 1e9;
    struct gb_state *state = make_state();
    state->pair_normal[1] = 1e-3;
    g_assert_true(gb_state_optional_allocate(state, &state->contact_radius, &err));
    state->contact_radius[0] = 0.1;
    state->contact_radius[1] = 0.2;
    struct texts texts = {g_string_new(NULL), g_string_new(NULL)};
    g_assert_true(gb_export_add(gb_export_find("csv", &err), state, NAN, 0,
                                texts.particles, texts.contacts, &err));
    const char *row = texts.contacts->str;
    g_assert_nonnull(
        strstr(row, ",bridged,shear_nN,radius_nm,area_nm2,bridge_radius_nm\n"));
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 12), nn * 1e-4, 1e-12);
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 13), 2.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 14), 4.0 * G_PI, 1e-12);
    g_assert_cmpfloat_with_epsilon(number_at(row, ",", 4, 15), 2.0, 1e-12);
    g_assert_cmpfloat(number_at(row, ",", 3, 12), ==, 0.0);
    g_assert_cmpfloat(number_at(row, ",", 3, 15), ==, 0.0); /* no bridge */
    gb_state_destroy(state);
    finish(&texts);
}

/* d = 10 nm, T = 2 ps: 1 d/T is 5000 m/s, 1/T 500 per ns; 1 E d^2 is 4e4 nN, E d^3 4e5
 * nN nm; a dump has pN. */
static void test_vectors(void)
{
    struct gb_error err = {0};
    struct gb_state *state = make_state();
    double **members[] = {&state->velocity, &state->spin, &state->force, &state->torque};
    static const double unit[] = {5000.0, 500.0, 4e4, 4e5};
    state->second_per_time = 2e-12;
    for (int k = 0; k < 4; k++) {
        g_assert_true(gb_state_optional_allocate(state, members[k], &err));
        (*members[k])[3 * 2 + 1] = k + 1; /* y of the third */
    }
    struct texts csv = {g_string_new(NULL), NULL}, lammps = {g_string_new(NULL), NULL};
    g_assert_true(gb_export_add(gb_export_find("csv", &err), state, NAN, 0, csv.particles,
                                NULL, &err));
    g_assert_true(gb_export_add(gb_export_find("lammps-dump", &err), state, NAN, 0,
                                lammps.particles, NULL, &err));
    for (int k = 0; k < 4; k++) {
        const double value = unit[k] * (k + 1);
        g_assert_cmpfloat_with_epsilon(
            number_at(csv.particles->str, ",", 5, 12 + 3 * k + 1), value, 1e-9 * value);
        g_assert_cmpfloat_with_epsilon(
            number_at(lammps.particles->str, " ", 13, 13 + 3 * k + 1),
            (k < 2 ? 1.0 : 1e3) * value, 1e-6 * value);
    }
    state->second_per_time = (double)NAN; /* and no density: no time */
    g_string_truncate(csv.particles, 0);
    g_assert_true(gb_export_add(gb_export_find("csv", &err), state, NAN, 0, csv.particles,
                                NULL, &err));
    g_assert_null(strstr(csv.particles->str, "vx_m_per_s"));
    g_assert_nonnull(strstr(csv.particles->str, ",fx_nN,"));
    g_string_free(csv.particles, TRUE);
    g_string_free(lammps.particles, TRUE);
    gb_state_destroy(state);
}

static void test_extxyz(void)
{
    struct texts texts = export_frames("extxyz", 2);
    const char *text = texts.particles->str;
    g_assert_true(g_str_has_prefix(text, "4\nLattice=\"40 0 0 5 40 0 0 0 40\" "));
    g_assert_nonnull(strstr(text, "pbc=\"T T T\""));
    g_assert_nonnull(strstr(text, "preset a ?quoted??title"));
    g_assert_cmpfloat(number_at(text, " ", 5, 2), ==, 39.0); /* y of the fourth, nm */
    g_assert_cmpfloat(number_at(text, " ", 5, 4), ==, 4.0);  /* id */
    g_assert_cmpfloat(number_at(text, " ", 5, 5), ==, 5.0);  /* radius */
    g_assert_cmpfloat(number_at(text, " ", 6, 0), ==, 4.0);  /* the second frame */
    g_assert_cmpfloat(number_at(text, " ", 11, 2), ==, 39.0);
    finish(&texts);
}

static void test_lammps(void)
{
    struct texts texts = export_frames("lammps-dump", 2);
    const char *text = texts.particles->str;
    g_assert_nonnull(
        strstr(text, "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 45 5\n0 40 0\n"));
    g_assert_cmpfloat(number_at(text, " ", 11, 5), ==, 5.0); /* radius of the first */
    g_assert_cmpfloat(number_at(text, " ", 14, 3), ==, 39.0);
    char **frames = g_strsplit(text, "ITEM: TIMESTEP\n7\n", 0);
    g_assert_cmpuint(g_strv_length(frames), ==, 3); /* one head, two frames */
    g_strfreev(frames);
    g_assert_nonnull(strstr(texts.contacts->str, "ITEM: NUMBER OF ENTRIES\n2\n"));
    finish(&texts);
    texts = export_frames("lammps-data", 1);
    g_assert_nonnull(strstr(texts.particles->str, "\n4 atoms\n1 atom types\n"));
    g_assert_nonnull(strstr(texts.particles->str, "\n5 0 0 xy xz yz\n"));
    g_assert_nonnull(strstr(texts.particles->str, "\n4 1 10 0.00399 35 39 20\n"));
    finish(&texts);
}

/* Equal states make equal files, whenever they are written. */
static void test_same_bytes(void)
{
    struct texts one = export_frames("vtkhdf", 1);
    g_usleep(1100000); /* times in HDF5 have seconds */
    struct texts two = export_frames("vtkhdf", 1);
    g_assert_cmpuint(one.particles->len, >, 1000);
    g_assert_true(g_string_equal(one.particles, two.particles));
    g_assert_true(g_string_equal(one.contacts, two.contacts));
    finish(&one);
    finish(&two);
}

static void test_unknown(void)
{
    struct gb_error err = {0};
    g_assert_null(gb_export_find("xyz", &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "expected extxyz, lammps-dump"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/export/contacts", test_contacts);
    g_test_add_func("/export/stress", test_stress);
    g_test_add_func("/export/contact-radius", test_contact_radius);
    g_test_add_func("/export/vectors", test_vectors);
    g_test_add_func("/export/extxyz", test_extxyz);
    g_test_add_func("/export/lammps", test_lammps);
    g_test_add_func("/export/same-bytes", test_same_bytes);
    g_test_add_func("/export/unknown", test_unknown);
    return g_test_run();
}
