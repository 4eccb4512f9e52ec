/* Arrays, files and laws of the library. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "library_user.h"

/* --- arrays ------------------------------------------------------------------------ */

/* Forces on the particles are those of their contacts and, within the tolerance, none; the
 * overlap of each contact follows from positions and diameters. */
static void check_contacts(struct gb_simulation *simulation)
{
    const struct gb_array position = array_of(simulation, "position");
    const struct gb_array diameter = array_of(simulation, "diameter");
    const struct gb_array contact = array_of(simulation, "contact");
    const struct gb_array cell = array_of(simulation, "cell");
    const struct gb_array coordination = array_of(simulation, "coordination");
    int64_t ends = 0;
    g_assert_cmpint(contact.shape[0], >, 100);
    g_assert_cmpint(contact.shape[1], ==, 2);
    for (int64_t k = 0; k < contact.shape[0]; k++) {
        const int i = whole(&contact, k, 0), j = whole(&contact, k, 1);
        double square = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            const double edge = at(&cell, axis, 0);
            const double gap = at(&position, i, axis) - at(&position, j, axis);
            const double r = gap - edge * round(gap / edge);
            square += r * r;
        }
        g_assert_cmpfloat(sqrt(square), <,
                          0.5 * (at(&diameter, i, 0) + at(&diameter, j, 0)));
    }
    for (int64_t i = 0; i < coordination.shape[0]; i++) {
        ends += whole(&coordination, i, 0);
    }
    g_assert_cmpint(ends, ==, 2 * contact.shape[0]);
}

static void test_arrays(void)
{
    struct gb_error err = {0};
    struct gb_array array = {.size = sizeof array};
    struct gb_simulation *simulation = simulation_of(parameters_of(NULL, NULL));
    g_assert_false(gb_simulation_array(simulation, "position", &array, &err));
    g_assert_nonnull(strstr(err.text, "first advance"));
    g_assert_cmpint(gb_simulation_advance(simulation, 30, &err), ==, GB_RUN_OUTCOME_NONE);
    check_contacts(simulation);
    const struct gb_array force = array_of(simulation, "force");
    const struct gb_array normal = array_of(simulation, "contact_normal");
    double largest = 0.0, mean = 0.0;
    for (int64_t i = 0; i < force.shape[0]; i++) {
        largest = fmax(largest, fabs(at(&force, i, 0)));
    }
    for (int64_t k = 0; k < normal.shape[0]; k++) {
        mean += fabs(at(&normal, k, 0)) / (double)normal.shape[0];
    }
    g_assert_cmpfloat(largest, <, mean); /* in equilibrium */
    g_assert_cmpstr(normal.unit, ==, "E d^2");
    g_assert_cmpstr(normal.si_unit, ==, "N");
    g_assert_cmpfloat(normal.si, >, 0.0);
    /* no copy: the same memory at each call */
    g_assert_true(array_of(simulation, "position").data ==
                  array_of(simulation, "position").data);
    g_assert_true(array_of(simulation, "contact").data ==
                  array_of(simulation, "contact").data);
    for (size_t i = 0; gb_array_name(i); i++) {
        const char *name = gb_array_name(i);
        g_assert_nonnull(gb_array_doc(i));
        array.size = sizeof array;
        const bool there = gb_simulation_array(simulation, name, &array, &err);
        g_assert_true(there == (strcmp(name, "velocity") && strcmp(name, "spin") &&
                                strcmp(name, "contact_radius")));
    }
    array.size = 8;
    g_assert_false(gb_simulation_array(simulation, "position", &array, &err));
    array.size = sizeof array;
    g_assert_false(gb_simulation_array(simulation, "colour", &array, &err));
    g_assert_nonnull(strstr(err.text, "colour: no such array; must be one of position"));
    gb_simulation_destroy(simulation);
}

static void test_die(void)
{
    struct gb_error err = {0};
    struct gb_parameters *parameters = NULL;
    g_assert_true(gb_parameters_create(&parameters, "p3-hertz-mu0", &err));
    g_assert_true(gb_parameters_set(parameters, "particles.count=60", &err));
    g_assert_true(gb_parameters_set(parameters, "die.diameter=60 um", &err));
    struct gb_simulation *simulation = simulation_of(parameters);
    const enum gb_run_outcome outcome = gb_simulation_advance(simulation, 2, &err);
    g_test_message("%d %s", (int)outcome, err.text);
    const struct gb_array position = array_of(simulation, "position");
    const struct gb_array velocity = array_of(simulation, "velocity");
    const struct gb_array diameter = array_of(simulation, "diameter");
    g_assert_cmpint(position.shape[0], ==, velocity.shape[0]);
    g_assert_cmpint(position.stride[0], ==, 4 * (int64_t)sizeof(double));
    g_assert_cmpstr(velocity.si_unit, ==, "m/s");
    g_assert_cmpfloat(velocity.si, >, 0.0);
    for (int64_t i = 0; i < diameter.shape[0]; i++) {
        /* radius beside the position, in the same row */
        const char *row = (const char *)position.data + i * position.stride[0];
        g_assert_cmpfloat(at(&diameter, i, 0), ==,
                          2.0 * ((const double *)(const void *)row)[3]);
    }
    g_assert_cmpint(array_of(simulation, "wall").shape[0], >, 0);
    gb_simulation_destroy(simulation);
}

/* --- files --------------------------------------------------------------------------- */

struct folder {
    char *path, *run, *state;
};

static struct folder folder_make(void)
{
    struct folder folder = {.path = g_dir_make_tmp("greenbody-test-XXXXXX", NULL)};
    folder.run = g_build_filename(folder.path, "run", NULL);
    folder.state = g_build_filename(folder.path, "mine.h5", NULL);
    return folder;
}

static void remove_all(const char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    const char *name;
    while (dir && (name = g_dir_read_name(dir)) != NULL) {
        char *inner = g_build_filename(path, name, NULL);
        remove_all(inner);
        g_free(inner);
    }
    if (dir) {
        g_dir_close(dir);
    }
    g_remove(path);
}

static void folder_finish(struct folder *folder)
{
    remove_all(folder->path);
    g_free(folder->path);
    g_free(folder->run);
    g_free(folder->state);
}

/* A run recorded, left, resumed: the points of a run at once; and read again. */
static void test_record(void)
{
    struct folder folder = folder_make();
    struct gb_error err = {0};
    struct gb_simulation *plain = simulation_of(parameters_of(NULL, NULL)), *again = NULL;
    struct gb_simulation *recorded =
        simulation_of(parameters_of("output.snapshots_at=every 10", NULL));
    (void)gb_simulation_advance(plain, INT64_MAX, NULL);
    g_assert_true(gb_simulation_record(recorded, folder.run, false, &err));
    g_assert_cmpint(gb_simulation_advance(recorded, 15, &err), ==, GB_RUN_OUTCOME_NONE);
    g_assert_false(gb_simulation_record(recorded, folder.state, false, &err));
    gb_simulation_destroy(recorded);
    recorded = simulation_of(parameters_of(NULL, NULL));
    g_assert_false(gb_simulation_record(recorded, folder.run, false, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_simulation_destroy(recorded);
    g_assert_true(gb_simulation_resume(&again, folder.run, &err));
    g_assert_cmpuint(gb_simulation_points(again), ==, 15);
    g_assert_cmpint(gb_simulation_advance(again, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    gb_simulation_leave(again);
    g_assert_cmpint(gb_simulation_advance(again, 1, &err), ==, GB_RUN_OUTCOME_DONE);
    const size_t points = gb_simulation_points(plain);
    g_assert_cmpuint(gb_simulation_points(again), ==, points);
    for (size_t i = 15; i < points;
         i++) { /* those before it have the digits of the file */
        assert_same(gb_simulation_point(plain, i), gb_simulation_point(again, i));
    }
    gb_simulation_destroy(again);
    struct gb_recorded_run *run = NULL;
    struct gb_parameters *parameters = NULL;
    struct gb_saved_state *saved = NULL;
    g_assert_true(gb_recorded_run_open(&run, folder.run, &err));
    g_assert_cmpstr(gb_recorded_run_state(run), ==, "done");
    g_assert_cmpstr(gb_recorded_run_reason(run), ==, "");
    g_assert_cmpuint(gb_recorded_run_points(run), ==, points);
    g_assert_cmpfloat(fabs(gb_recorded_run_point(run, points - 1)->density /
                               gb_simulation_point(plain, points - 1)->density -
                           1.0),
                      <, 1e-8);
    g_assert_true(gb_recorded_run_parameters(run, &parameters, &err));
    size_t kept = 0;
    int64_t step = -1;
    for (; gb_recorded_run_saved(run, kept); kept++) {
        g_assert_true(
            gb_saved_state_load(&saved, gb_recorded_run_saved(run, kept), &err));
        g_assert_cmpint(gb_saved_state_point(saved)->step, >=, step);
        step = gb_saved_state_point(saved)->step;
        gb_saved_state_destroy(saved);
    }
    g_assert_cmpuint(kept, ==, (points - 1) / 10 + 2);
    gb_recorded_run_destroy(run);
    gb_parameters_destroy(parameters);
    gb_simulation_destroy(plain);
    folder_finish(&folder);
}

/* From a saved state the same points follow. */
static void test_save_and_load(void)
{
    struct folder folder = folder_make();
    struct gb_error err = {0};
    struct gb_simulation *plain = simulation_of(parameters_of("title=mine", NULL));
    struct gb_simulation *loaded = NULL;
    struct gb_parameters *parameters = NULL;
    g_assert_false(gb_simulation_save(plain, folder.state, &err));
    (void)gb_simulation_advance(plain, 10, NULL);
    g_assert_true(gb_simulation_save(plain, folder.state, &err));
    (void)gb_simulation_advance(plain, INT64_MAX, NULL);
    g_assert_true(gb_simulation_parameters(plain, &parameters, &err));
    g_assert_true(gb_simulation_load(&loaded, parameters, folder.state, &err));
    struct gb_saved_state *now = NULL;
    g_assert_true(gb_simulation_state(loaded, &now, &err));
    g_assert_false(gb_simulation_record(loaded, folder.run, false, &err));
    g_assert_cmpint(gb_simulation_advance(loaded, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    const size_t points = gb_simulation_points(plain);
    g_assert_cmpuint(gb_simulation_points(loaded) + 9, ==, points);
    for (size_t i = 9; i < points; i++) {
        assert_same(gb_simulation_point(plain, i), gb_simulation_point(loaded, i - 9));
    }
    struct gb_saved_state *saved = NULL;
    struct gb_array array = {.size = sizeof array};
    g_assert_true(gb_saved_state_load(&saved, folder.state, &err));
    g_assert_cmpuint(gb_saved_state_seed(saved), ==, 1);
    g_assert_cmpstr(gb_saved_state_title(saved), ==, "mine");
    g_assert_true(gb_saved_state_array(saved, "contact_force", &array, &err));
    g_assert_cmpint(array.shape[1], ==, 3);
    /* the state taken of the simulation then is that of the file */
    struct gb_array taken = {.size = sizeof taken};
    g_assert_true(gb_saved_state_array(now, "contact_force", &taken, &err));
    g_assert_cmpint(taken.shape[0], ==, array.shape[0]);
    g_assert_cmpint(
        memcmp(taken.data, array.data, (size_t)(3 * array.shape[0]) * sizeof(double)), ==,
        0);
    gb_saved_state_destroy(now);
    g_assert_false(gb_saved_state_array(saved, "velocity", &array, &err));
    gb_saved_state_destroy(saved);
    g_assert_false(gb_saved_state_load(&saved, "/nowhere.h5", &err));
    gb_simulation_destroy(plain);
    gb_simulation_destroy(loaded);
    gb_parameters_destroy(parameters);
    folder_finish(&folder);
}

static void assert_equal(const struct gb_array *a, const struct gb_array *b)
{
    g_assert_cmpint(a->shape[0], ==, b->shape[0]);
    g_assert_cmpfloat(a->si, ==, b->si);
    for (int64_t i = 0; i < a->shape[0]; i++) {
        for (int64_t k = 0; k < 3; k++) {
            g_assert_cmpfloat(at(a, i, k), ==, at(b, i, k));
        }
    }
}

/* Velocities, spins and resultants of unequal particles under way, of the state taken then,
 * and of the file written then. */
static void test_motion(void)
{
    static const char *const names[] = {"velocity", "spin", "force", "torque"};
    struct gb_error err = {0};
    struct gb_parameters *parameters = NULL;
    struct folder folder = folder_make();
    g_assert_true(gb_parameters_create(&parameters, "p2-3d-v1", &err));
    g_assert_true(gb_parameters_set(parameters, "particles.count=1000", &err));
    g_assert_true(
        gb_parameters_set(parameters, "particles.distribution=lognormal", &err));
    struct gb_simulation *simulation = simulation_of(parameters);
    g_assert_cmpint(gb_simulation_advance(simulation, 3, &err), ==, GB_RUN_OUTCOME_NONE);
    struct gb_saved_state *now = NULL, *file = NULL;
    g_assert_true(gb_simulation_state(simulation, &now, &err));
    g_assert_true(gb_simulation_save(simulation, folder.state, &err));
    g_assert_true(gb_saved_state_load(&file, folder.state, &err));
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        const struct gb_array live = array_of(simulation, names[k]);
        struct gb_array taken = {.size = sizeof taken}, read = {.size = sizeof read};
        g_assert_true(gb_saved_state_array(now, names[k], &taken, &err));
        g_assert_true(gb_saved_state_array(file, names[k], &read, &err));
        g_assert_true(isfinite(live.si) && live.si > 0.0);
        g_assert_cmpfloat(fabs(at(&live, 0, 0)), >, 0.0);
        assert_equal(&live, &taken);
        assert_equal(&live, &read);
    }
    struct gb_array radius = {.size = sizeof radius};
    g_assert_true(gb_saved_state_array(file, "contact_radius", &radius, &err));
    g_assert_cmpint(radius.shape[0], ==, array_of(simulation, "contact").shape[0]);
    gb_saved_state_destroy(now);
    gb_saved_state_destroy(file);
    gb_simulation_destroy(simulation);
    folder_finish(&folder);
}

/* --- laws ----------------------------------------------------------------------------- */

static void test_laws(void)
{
    struct gb_error err = {0};
    struct gb_parameters *parameters = parameters_of(NULL, NULL);
    static const double h[] = {0.0, 0.01, 0.02};
    double out[2 + 2 * 200 * 4];
    struct gb_contact_law_request request = {
        .size = sizeof request, .law = "rod", .x = h, .count = 3, .h_min = (double)NAN};
    g_assert_cmpstr(gb_contact_law_variable("rod"), ==, "h");
    g_assert_cmpuint(gb_contact_law_rows(&request), ==, 3);
    g_assert_true(gb_contact_law_compute(&request, parameters, out, 12, &err));
    g_assert_cmpfloat(out[0], ==, 0.0);
    g_assert_false(gb_contact_law_compute(&request, parameters, out, 5, &err));
    request.law = "normal";
    request.history = GB_CONTACT_LAW_PATH;
    g_assert_cmpuint(gb_contact_law_rows(&request), ==, 401);
    request.law = "magic";
    g_assert_false(gb_contact_law_compute(&request, parameters, out, 12, &err));
    g_assert_nonnull(strstr(err.text, "law magic: expected "));
    size_t laws = 0;
    for (; gb_contact_law_name(laws); laws++) {
        g_assert_nonnull(gb_contact_law_doc(laws));
        g_assert_nonnull(gb_contact_law_columns(gb_contact_law_name(laws)));
    }
    g_assert_cmpuint(laws, >, 5);
    gb_parameters_destroy(parameters);
}

static void test_library(void)
{
    const char *name = NULL;
    size_t offset = 0, count = 0, bytes = 0, index = 0;
    char type = 0;
    for (; gb_library_point_member(index, &name, &offset, &count, &type); index++) {
        bytes += count * (type == 'i' ? sizeof(int) : 8);
        g_assert_cmpuint(offset + count * (type == 'i' ? sizeof(int) : 8), <=,
                         sizeof(struct gb_point));
    }
    g_assert_cmpuint(bytes + sizeof(int), ==,
                     sizeof(struct gb_point)); /* no member is missing */
    g_assert_cmpuint(strlen(gb_library_version()), >, 4);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/api/arrays/cell", test_arrays);
    g_test_add_func("/api/arrays/die", test_die);
    g_test_add_func("/api/arrays/motion", test_motion);
    g_test_add_func("/api/files/record", test_record);
    g_test_add_func("/api/files/state", test_save_and_load);
    g_test_add_func("/api/laws", test_laws);
    g_test_add_func("/api/library", test_library);
    return g_test_run();
}
