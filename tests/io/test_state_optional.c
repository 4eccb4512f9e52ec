/* Velocities, resultants, contact radii and numbers of pictures of a state: written, read back bit for bit, found
 * from the record of a run, refused when damaged. */
#include "io/state.h"

#include <math.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <hdf5.h>

enum { COUNT = 3, PAIRS = 2 };

static char *path;

/* Particles of diameters 1, 2 and 4. */
static struct gb_state *make_state(double die_radius)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_create(&state, COUNT, PAIRS, &err));
    state->die_radius = die_radius;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 10.0;
    }
    for (int i = 0; i < COUNT; i++) {
        state->position[3 * i] = 1.0 + 3.0 * i;
        state->radius[i] = 0.5 * (double)(1 << i);
    }
    for (int k = 0; k < PAIRS; k++) {
        state->pair[2 * k + 1] = k + 1;
        state->pair_force[3 * k] = state->pair_normal[k] = 1.0;
    }
    state->metre_per_length = 1e-8;
    state->pascal_per_stress = 4e11;
    return state;
}

static void fill(struct gb_state *state, double **member, int64_t size, double from)
{
    struct gb_error err = {0};
    g_assert_true(gb_state_optional_allocate(state, member, &err));
    for (int64_t k = 0; k < size; k++) {
        (*member)[k] = from + (double)k / 3.0;
    }
}

static struct gb_state *make_full(void)
{
    struct gb_state *state = make_state(0.0);
    fill(state, &state->velocity, 3 * COUNT, 1.0);
    fill(state, &state->spin, 3 * COUNT, -2.0);
    fill(state, &state->force, 3 * COUNT, 3.0);
    fill(state, &state->torque, 3 * COUNT, -4.0);
    fill(state, &state->contact_radius, PAIRS, 0.1);
    state->second_per_time = 1.5e-12;
    return state;
}

static struct gb_state *read_back(void)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    const bool read = gb_state_read(&state, path, &err);
    g_assert_cmpstr(err.text, ==, "");
    g_assert_true(read);
    return state;
}

static void write_file(const struct gb_state *state, const struct gb_record *record)
{
    struct gb_error err = {0};
    g_assert_true(gb_state_write(state, record, path, &err));
}

static void assert_same(const double *a, const double *b, size_t bytes)
{
    g_assert_nonnull(b);
    g_assert_cmpint(memcmp(a, b, bytes), ==, 0);
}

static void test_round_trip(void)
{
    struct gb_state *state = make_full();
    write_file(state, NULL);
    struct gb_state *back = read_back();
    assert_same(state->velocity, back->velocity, 72);
    assert_same(state->spin, back->spin, 72);
    assert_same(state->force, back->force, 72);
    assert_same(state->torque, back->torque, 72);
    assert_same(state->contact_radius, back->contact_radius, 16);
    g_assert_cmpfloat(back->second_per_time, ==, 1.5e-12);
    gb_state_destroy(back);
    gb_state_destroy(state);
}

static void test_none(void)
{
    struct gb_state *state = make_state(0.0);
    write_file(state, NULL);
    struct gb_state *back = read_back();
    g_assert_null(back->velocity);
    g_assert_null(back->force);
    g_assert_null(back->contact_radius);
    g_assert_true(isnan(back->second_per_time));
    gb_state_destroy(back);
    gb_state_destroy(state);
}

/* Numbers of pictures: written and read; out of range they are as in a new state. */
static void test_numbers(void)
{
    struct gb_state *state = make_state(2.0);
    state->pressed[0] = state->pressed[2] = 1.0;
    state->punch_height = 7.5;
    state->funnel_height = 6.0;
    state->funnel_outlet = 1.5;
    state->funnel_slope = 0.7;
    write_file(state, NULL);
    struct gb_state *back = read_back();
    assert_same(state->pressed, back->pressed, sizeof state->pressed);
    g_assert_cmpfloat(back->punch_height, ==, 7.5);
    g_assert_cmpfloat(back->funnel_height, ==, 6.0);
    g_assert_cmpfloat(back->funnel_outlet, ==, 1.5);
    g_assert_cmpfloat(back->funnel_slope, ==, 0.7);
    gb_state_destroy(back);
    state->pressed[1] = -1.0;
    state->punch_height = -1.0;
    state->funnel_height = INFINITY;
    state->funnel_outlet = (double)NAN;
    state->funnel_slope = 1e9;
    write_file(state, NULL);
    back = read_back();
    g_assert_cmpfloat(back->pressed[2], ==, 0.0);
    g_assert_true(isnan(back->punch_height));
    g_assert_cmpfloat(back->funnel_height, ==, 0.0);
    g_assert_cmpfloat(back->funnel_outlet, ==, 0.0);
    g_assert_cmpfloat(back->funnel_slope, ==, 0.0);
    gb_state_destroy(back);
    gb_state_destroy(state);
}

static void add(struct gb_record *record, const char *name, int columns)
{
    struct gb_error err = {0};
    double values[4 * COUNT];
    for (int k = 0; k < columns * COUNT; k++) {
        values[k] = 1.0 + k;
    }
    g_assert_true(gb_record_array(record, name, GB_RECORD_DOUBLE, COUNT, columns, "1",
                                  values, &err));
}

static void take(struct gb_state *state, struct gb_record *record)
{
    struct gb_error err = {0};
    g_assert_true(gb_state_optional_take(state, record, &err));
    gb_record_finish(record);
    g_free(record);
}

/* Arcs of a periodic cell become angles by the diameters 1, 2, 4. */
static void test_cell_record(void)
{
    struct gb_state *state = make_state(0.0);
    struct gb_record *record = g_new0(struct gb_record, 1);
    add(record, "motion/velocity", 3);
    add(record, "motion/spin", 3);
    add(record, "world/force", 3);
    add(record, "world/torque", 3);
    take(state, record);
    g_assert_cmpfloat(state->velocity[7], ==, 8.0);
    g_assert_cmpfloat(state->force[8], ==, 9.0);
    g_assert_cmpfloat(state->spin[0], ==, 1.0);
    g_assert_cmpfloat(state->spin[4], ==, 5.0 / 2.0);
    g_assert_cmpfloat(state->spin[8], ==, 9.0 / 4.0);
    g_assert_cmpfloat(state->torque[0], ==, 1.0);
    g_assert_cmpfloat(state->torque[4], ==, 5.0 * 2.0);
    g_assert_cmpfloat(state->torque[8], ==, 9.0 * 4.0);
    gb_state_destroy(state);
}

/* Rows of four, arcs by the radii 0.5, 1, 2. */
static void test_die_record(void)
{
    struct gb_state *state = make_state(5.0);
    struct gb_record *record = g_new0(struct gb_record, 1);
    add(record, "bed/speed", 4);
    add(record, "bed/roll", 4);
    add(record, "bed/moment", 4);
    take(state, record);
    g_assert_cmpfloat(state->velocity[3], ==, 5.0);
    g_assert_cmpfloat(state->spin[0], ==, 2.0);
    g_assert_cmpfloat(state->spin[8], ==, 5.5);
    g_assert_cmpfloat(state->torque[0], ==, 0.5);
    g_assert_cmpfloat(state->torque[8], ==, 22.0);
    g_assert_null(state->force);
    gb_state_destroy(state);
}

static void refuse(const char *part)
{
    struct gb_state *back = NULL;
    struct gb_error err = {0};
    g_assert_false(gb_state_read(&back, path, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, part));
}

static void test_damaged(void)
{
    struct gb_state *state = make_full();
    write_file(state, NULL);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, "/force", H5P_DEFAULT);
    g_assert_cmpint(
        H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, state->torque),
        >=, 0);
    H5Dclose(set);
    H5Fclose(file);
    refuse("sha256_optional");
    write_file(state, NULL);
    file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    g_assert_cmpint(H5Ldelete(file, "/spin", H5P_DEFAULT), >=, 0);
    H5Fclose(file);
    refuse("sha256_optional");
    state->velocity[4] = (double)NAN;
    write_file(state, NULL);
    refuse("/velocity: row 1");
    gb_state_destroy(state);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    char *folder = g_dir_make_tmp("greenbody-optional-XXXXXX", NULL);
    path = g_build_filename(folder, "state.h5", NULL);
    g_test_add_func("/io/state-optional/round-trip", test_round_trip);
    g_test_add_func("/io/state-optional/none", test_none);
    g_test_add_func("/io/state-optional/numbers", test_numbers);
    g_test_add_func("/io/state-optional/cell-record", test_cell_record);
    g_test_add_func("/io/state-optional/die-record", test_die_record);
    g_test_add_func("/io/state-optional/damaged", test_damaged);
    const int failed = g_test_run();
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return failed;
}
