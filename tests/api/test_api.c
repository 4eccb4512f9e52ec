/* Parameters and simulations of the library. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "library_user.h"

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
        {"contact.muu=1", "contact.muu: no such key; did you mean contact.mu? must be one of normal"},
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
    return g_test_run();
}
