/* The library as its users see it: only the installed headers. */
#include <greenbody/greenbody.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static struct gb_parameters *parameters_of(const char *first, ...) G_GNUC_NULL_TERMINATED;

/* A small packing with changes, NULL at the end. */
static struct gb_parameters *parameters_of(const char *first, ...)
{
    static const char *const small[] = {"particles.count=200",
                                        "loading.unload_from=", "loading.until=30 MPa"};
    struct gb_parameters *parameters = NULL;
    struct gb_error err = {0};
    va_list more;
    g_assert_true(gb_parameters_create(&parameters, NULL, &err));
    for (size_t i = 0; i < G_N_ELEMENTS(small); i++) {
        g_assert_true(gb_parameters_set(parameters, small[i], &err));
    }
    va_start(more, first);
    for (const char *text = first; text; text = va_arg(more, const char *)) {
        if (!gb_parameters_set(parameters, text, &err)) {
            g_error("%s", err.text);
        }
    }
    va_end(more);
    return parameters;
}

static struct gb_simulation *simulation_of(struct gb_parameters *parameters)
{
    struct gb_simulation *simulation = NULL;
    struct gb_error err = {0};
    if (!gb_simulation_create(&simulation, parameters, &err)) {
        g_error("%s", err.text);
    }
    gb_parameters_destroy(parameters);
    return simulation;
}

static struct gb_array array_of(struct gb_simulation *simulation, const char *name)
{
    struct gb_array array = {.size = sizeof array};
    struct gb_error err = {0};
    if (!gb_simulation_array(simulation, name, &array, &err)) {
        g_error("%s", err.text);
    }
    return array;
}

static double at(const struct gb_array *array, int64_t row, int64_t column)
{
    const char *data = array->data;
    double value;
    g_assert_cmpint(array->type, ==, GB_ARRAY_DOUBLE);
    memcpy(&value, data + row * array->stride[0] + column * array->stride[1],
           sizeof value);
    return value;
}

static int whole(const struct gb_array *array, int64_t row, int64_t column)
{
    const char *data = array->data;
    int32_t value;
    g_assert_cmpint(array->type, ==, GB_ARRAY_INT32);
    memcpy(&value, data + row * array->stride[0] + column * array->stride[1],
           sizeof value);
    return value;
}

static bool equal(const char *one, const char *other, size_t count, char type)
{
    for (size_t k = 0; type == 'd' && k < count; k++) {
        double a, b;
        memcpy(&a, one + k * sizeof a, sizeof a);
        memcpy(&b, other + k * sizeof b, sizeof b);
        if (!(a == b || (isnan(a) && isnan(b)))) {
            return false;
        }
    }
    return type == 'd' || memcmp(one, other, type == 'i' ? sizeof(int) : 8) == 0;
}

/* Every member but the seconds, which depend on the machine. */
static void assert_same(const struct gb_point *one, const struct gb_point *other)
{
    const char *name = NULL;
    size_t offset = 0, count = 0;
    char type = 0;
    for (size_t k = 0; gb_library_point_member(k, &name, &offset, &count, &type); k++) {
        if (strcmp(name, "seconds") != 0 &&
            !equal((const char *)one + offset, (const char *)other + offset, count,
                   type)) {
            g_error("step %" G_GINT64_FORMAT ": %s differs", one->step, name);
        }
    }
}

static void assert_same_points(const struct gb_simulation *one,
                               const struct gb_simulation *other)
{
    const size_t points = gb_simulation_points(one);
    g_assert_cmpuint(points, ==, gb_simulation_points(other));
    for (size_t i = 0; i < points; i++) {
        assert_same(gb_simulation_point(one, i), gb_simulation_point(other, i));
    }
}

/* --- parameters ------------------------------------------------------------------- */

static void test_set_and_get(void)
{
    struct gb_error err = {0};
    char value[GB_PARAMETERS_VALUE];
    struct gb_parameters *parameters = parameters_of("mu=0.25", NULL), *copy = NULL;
    g_assert_true(gb_parameters_get(parameters, "contact.mu", value, sizeof value, &err));
    g_assert_cmpstr(value, ==, "0.25");
    g_assert_true(gb_parameters_get(parameters, "until", value, sizeof value, &err));
    g_assert_cmpstr(value, ==, "30 MPa");
    g_assert_true(gb_parameters_copy(&copy, parameters, &err));
    g_assert_true(gb_parameters_set(copy, "contact.mu=0.5", &err));
    g_assert_true(gb_parameters_get(parameters, "mu", value, sizeof value, &err));
    g_assert_cmpstr(value, ==, "0.25");
    g_assert_true(gb_parameters_check(parameters, &err));
    gb_parameters_destroy(copy);
    gb_parameters_destroy(parameters);
    gb_parameters_destroy(NULL);
}

/* The messages of the command line, and nothing is changed. */
static void test_refused(void)
{
    static const char *const refused[][2] = {
        {"contact.muu=1", "contact.muu: no such key; must be one of normal"},
        {"contact.mu=-1", "contact.mu = -1: must be between 0 and"},
        {"diameter=1 nm", "must be one of particles.diameter, die.diameter"},
        {"loading.until=3 kg", "units"},
        {"x", "must be group.key=value"}};
    char value[GB_PARAMETERS_VALUE];
    struct gb_parameters *parameters = parameters_of("mu=0.25", NULL), *none = NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(refused); i++) {
        struct gb_error err = {0};
        g_assert_false(gb_parameters_set(parameters, refused[i][0], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_test_message("%s", err.text);
        g_assert_nonnull(strstr(err.text, refused[i][1]));
        g_assert_null(strchr(err.text, '\n'));
    }
    g_assert_true(gb_parameters_get(parameters, "mu", value, sizeof value, NULL));
    g_assert_cmpstr(value, ==, "0.25");
    g_assert_false(gb_parameters_get(parameters, "nu", value, sizeof value, NULL));
    g_assert_false(gb_parameters_create(&none, "/nowhere/x.ini", NULL));
    g_assert_null(none);
    gb_parameters_destroy(parameters);
}

/* Every row of the table has its texts, and its default is accepted. */
static void test_table(void)
{
    size_t rows = 0;
    char key[128], text[GB_PARAMETERS_VALUE], range[512];
    struct gb_parameters *parameters = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_parameters_create(&parameters, NULL, &err));
    while (gb_parameters_text(rows, GB_PARAMETERS_KEY, key, sizeof key)) {
        g_assert_nonnull(strchr(key, '.'));
        g_assert_true(gb_parameters_text(rows, GB_PARAMETERS_DOC, text, sizeof text));
        g_assert_cmpuint(strlen(text), >, 5);
        g_assert_true(gb_parameters_text(rows, GB_PARAMETERS_RANGE, range, sizeof range));
        g_assert_true(gb_parameters_text(rows, GB_PARAMETERS_DEFAULT, text, sizeof text));
        char *assignment = g_strconcat(key, "=", text, NULL);
        if (!gb_parameters_set(parameters, assignment, &err)) {
            g_error("%s", err.text);
        }
        g_free(assignment);
        rows++;
    }
    g_assert_cmpuint(rows, >, 60);
    g_assert_false(gb_parameters_text(rows, GB_PARAMETERS_DOC, text, sizeof text));
    g_assert_true(gb_parameters_text(1, GB_PARAMETERS_KEY, text, sizeof text));
    g_assert_cmpstr(text, ==, "scene.kind");
    g_assert_true(gb_parameters_text(1, GB_PARAMETERS_CHOICES, text, sizeof text));
    g_assert_cmpstr(text, ==, "quasistatic;dynamic;die");
    g_assert_true(gb_parameters_text(1, GB_PARAMETERS_TYPE, text, sizeof text));
    g_assert_cmpstr(text, ==, "choice");
    gb_parameters_destroy(parameters);
}

static void test_presets(void)
{
    char *names = g_malloc(1);
    const size_t size = gb_parameters_presets(names, 1);
    names = g_realloc(names, size);
    g_assert_cmpuint(gb_parameters_presets(names, size), ==, size);
    g_assert_nonnull(strstr(names, "p1-set2-9.7nm"));
    g_free(names);
    struct gb_parameters *parameters = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_parameters_create(&parameters, "p1-set2-9.7nm", &err));
    char *folder = g_dir_make_tmp("greenbody-test-XXXXXX", NULL);
    char *path = g_build_filename(folder, "mine.ini", NULL), value[64];
    g_assert_true(gb_parameters_set(parameters, "contact.mu=0.125", &err));
    g_assert_true(gb_parameters_save(parameters, path, &err));
    gb_parameters_destroy(parameters);
    g_assert_true(gb_parameters_create(&parameters, path, &err));
    g_assert_true(gb_parameters_get(parameters, "mu", value, sizeof value, &err));
    g_assert_cmpstr(value, ==, "0.125");
    gb_parameters_destroy(parameters);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

/* --- simulations ------------------------------------------------------------------- */

struct seen {
    size_t points, events, progress;
    double share;
};

static void see_point(void *data, struct gb_simulation *simulation,
                      const struct gb_point *point)
{
    struct seen *seen = data;
    seen->points++;
    g_assert_cmpuint(seen->points, ==, gb_simulation_points(simulation));
    const struct gb_point *last = gb_simulation_point(simulation, seen->points - 1);
    g_assert_cmpint(last->step, ==, point->step);
    g_assert_cmpint(array_of(simulation, "position").shape[0], ==, 200);
}

static void see_event(void *data, struct gb_simulation *simulation, int64_t step,
                      const char *text)
{
    struct seen *seen = data;
    (void)simulation;
    g_assert_cmpint(step, >=, 0);
    g_assert_cmpuint(strlen(text), >, 0);
    seen->events++;
}

static void see_progress(void *data, struct gb_simulation *simulation, double share)
{
    struct seen *seen = data;
    (void)simulation;
    g_assert_cmpfloat(share, >=, 0.0);
    g_assert_cmpfloat(share, <=, 1.0);
    seen->share = share;
    seen->progress++;
}

/* In steps or at once: the same points, each told once. */
static void test_advance(void)
{
    struct seen seen = {0};
    struct gb_error err = {0};
    struct gb_simulation *whole_run =
        simulation_of(parameters_of("loading.unload_from=20 MPa", NULL));
    struct gb_simulation *steps =
        simulation_of(parameters_of("loading.unload_from=20 MPa", NULL));
    g_assert_cmpint(gb_simulation_advance(whole_run, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    gb_simulation_on_point(steps, see_point, &seen);
    gb_simulation_on_event(steps, see_event, &seen);
    gb_simulation_on_progress(steps, see_progress, &seen, 0.0);
    enum gb_run_outcome outcome;
    int64_t taken = 0;
    while ((outcome = gb_simulation_advance(steps, 7, &err)) == GB_RUN_OUTCOME_NONE) {
        taken += 7;
        g_assert_cmpuint(gb_simulation_points(steps), ==, (size_t)taken);
    }
    g_assert_cmpint(outcome, ==, GB_RUN_OUTCOME_DONE);
    g_assert_cmpint(gb_simulation_advance(steps, 7, &err), ==, GB_RUN_OUTCOME_DONE);
    g_assert_cmpint(err.code, ==, GB_OK);
    g_assert_cmpuint(seen.points, ==, gb_simulation_points(steps));
    g_assert_cmpuint(seen.events, >, 0);
    g_assert_cmpuint(seen.progress, >, 10);
    g_assert_cmpfloat(gb_simulation_progress(steps), ==, 1.0);
    assert_same_points(whole_run, steps);
    gb_simulation_destroy(whole_run);
    gb_simulation_destroy(steps);
}

static void cancel_at_20(void *data, struct gb_simulation *simulation,
                         const struct gb_point *point)
{
    (void)data;
    if (point->step == 20) {
        gb_simulation_cancel(simulation, "far enough");
    }
}

static void test_cancel_and_go_on(void)
{
    struct gb_error err = {0};
    struct gb_simulation *plain = simulation_of(parameters_of(NULL, NULL));
    struct gb_simulation *broken = simulation_of(parameters_of(NULL, NULL));
    (void)gb_simulation_advance(plain, INT64_MAX, NULL);
    gb_simulation_on_point(broken, cancel_at_20, NULL);
    g_assert_cmpint(gb_simulation_advance(broken, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_CANCELLED);
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    g_assert_cmpstr(err.text, ==, "far enough");
    g_assert_cmpuint(gb_simulation_points(broken), ==, 21);
    gb_simulation_cancel(broken, NULL);
    g_assert_cmpint(gb_simulation_advance(broken, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_CANCELLED);
    g_assert_cmpstr(err.text, ==, "cancelled");
    g_assert_cmpint(gb_simulation_advance(broken, INT64_MAX, &err), ==,
                    GB_RUN_OUTCOME_DONE);
    assert_same_points(plain, broken);
    gb_simulation_destroy(plain);
    gb_simulation_destroy(broken);
}

static void *run_in_thread(void *data)
{
    (void)gb_simulation_advance(data, INT64_MAX, NULL);
    return NULL;
}

/* While one thread builds or runs, another cancels and reads points. */
static void test_two_threads(void)
{
    static const char *const friction[] = {"contact.mu=0.1", "contact.mu=0.5"};
    struct gb_simulation *together[2], *alone[2];
    GThread *thread[2];
    for (int k = 0; k < 2; k++) {
        together[k] = simulation_of(parameters_of(friction[k], NULL));
        alone[k] = simulation_of(parameters_of(friction[k], NULL));
        (void)gb_simulation_advance(alone[k], INT64_MAX, NULL);
    }
    for (int k = 0; k < 2; k++) {
        thread[k] = g_thread_new("run", run_in_thread, together[k]);
    }
    for (int k = 0; k < 2; k++) {
        g_thread_join(thread[k]);
        assert_same_points(together[k], alone[k]);
        gb_simulation_destroy(together[k]);
        gb_simulation_destroy(alone[k]);
    }
    struct gb_simulation *endless =
        simulation_of(parameters_of("particles.count=3000", "loading.until=1 GPa", NULL));
    thread[0] = g_thread_new("run", run_in_thread, endless);
    while (gb_simulation_points(endless) < 2) {
        g_usleep(1000);
    }
    gb_simulation_cancel(endless, NULL);
    g_thread_join(thread[0]);
    const size_t points = gb_simulation_points(endless);
    g_assert_cmpfloat(gb_simulation_point(endless, points - 1)->p_pa, <, 1e9);
    gb_simulation_destroy(endless);
}

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
        g_assert_true(there == (strcmp(name, "velocity") && strcmp(name, "spin")));
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
    g_assert_false(gb_saved_state_array(saved, "velocity", &array, &err));
    gb_saved_state_destroy(saved);
    g_assert_false(gb_saved_state_load(&saved, "/nowhere.h5", &err));
    gb_simulation_destroy(plain);
    gb_simulation_destroy(loaded);
    gb_parameters_destroy(parameters);
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
    g_assert_nonnull(strstr(err.text, "law magic: accepted "));
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
    g_test_add_func("/api/keys/set-and-get", test_set_and_get);
    g_test_add_func("/api/keys/refused", test_refused);
    g_test_add_func("/api/keys/table", test_table);
    g_test_add_func("/api/keys/presets", test_presets);
    g_test_add_func("/api/simulation/advance", test_advance);
    g_test_add_func("/api/simulation/cancel", test_cancel_and_go_on);
    g_test_add_func("/api/simulation/threads", test_two_threads);
    g_test_add_func("/api/arrays/cell", test_arrays);
    g_test_add_func("/api/arrays/die", test_die);
    g_test_add_func("/api/files/record", test_record);
    g_test_add_func("/api/files/state", test_save_and_load);
    g_test_add_func("/api/laws", test_laws);
    g_test_add_func("/api/library", test_library);
    return g_test_run();
}
