/* What-ifs: a run goes on from a point with other values, and does so again to the same
 * bits. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/patience.h"
#include "common/scene.h"
#include "pack/cell/world.h"
#include "run/checkpoint.h"
#include "runner/runner.h"
#include "scene/field/changes.h"

enum { BEFORE = 100, BEHIND = 20 };

static struct gb_params scene(const char *change)
{
    struct gb_params params =
        scene_params("particles.count=120", "loading.until=density = 0.32",
                     "numerics.fidelity=fast", "contact.mu=0.1", NULL);
    if (change != NULL) {
        g_assert_true(gb_params_assign(&params, change, NULL));
    }
    return params;
}

static void go_on(struct gb_experiment *experiment, int points)
{
    struct gb_error err = {0};
    while (points > 0) {
        char text[GB_EVENT_TEXT];
        const enum gb_step_outcome how = gb_experiment_advance(experiment, 1000, &err);
        if (how == GB_STEP_DONE || how == GB_STEP_STOPPED) {
            g_error("the run ends too early: %s", err.text);
        }
        points -= how == GB_STEP_POINT;
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        }
    }
}

/* A run that changes on its own behind point BEFORE - 1, its step; NULL: not at all. */
static struct gb_experiment *run(const char *change, int64_t threads, int behind)
{
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    struct gb_params params = scene(NULL);
    params.threads = threads;
    if (change != NULL && !gb_changes_add(&params, BEFORE - 1, change, &err)) {
        g_error("%s", err.text);
    }
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    go_on(experiment, BEFORE + behind);
    return experiment;
}

/* The same as a what-if: the state of a run that knows nothing of the change goes on with
 * it, and is stopped and resumed once more behind it. */
static struct gb_experiment *what_if(const char *change, int behind)
{
    struct gb_error err = {0};
    struct gb_record record = {0};
    struct gb_experiment *experiment = run(NULL, 1, 0);
    struct gb_experiment *branched = NULL;
    struct gb_params params = scene(NULL);
    g_assert_true(gb_changes_add(&params, BEFORE - 1, change, &err));
    for (int part = 0; part < 2; part++) {
        g_assert_true(gb_checkpoint_take(experiment, &record, &err));
        if (!gb_experiment_resume(&branched, &params, &record, &err)) {
            g_error("%s", err.text);
        }
        gb_experiment_destroy(experiment);
        experiment = branched;
        go_on(experiment, part == 0 ? behind / 2 : behind - behind / 2);
    }
    gb_record_finish(&record);
    return experiment;
}

static uint64_t hash_of(struct gb_experiment *experiment)
{
    const uint64_t hash = gb_world_hash(gb_experiment_world(experiment));
    gb_experiment_destroy(experiment);
    return hash;
}

static void test_repeats(void)
{
    static const char *const changes[] = {"mu=0.4",
                                          "alpha=0.37",
                                          "contact.bridge_length=0.004 d",
                                          "geometry=isotropic",
                                          "loading.step=0.2 %",
                                          "mu=0.3; geometry=biaxial"};
    const uint64_t plain = hash_of(run(NULL, 1, BEHIND));
    for (size_t i = 0; i < G_N_ELEMENTS(changes); i++) {
        const uint64_t once = hash_of(run(changes[i], 1, BEHIND));
        if (once != hash_of(run(changes[i], 2, BEHIND))) {
            g_error("%s does not repeat", changes[i]);
        }
        if (once != hash_of(what_if(changes[i], BEHIND))) {
            g_error("%s as a what-if is another run", changes[i]);
        }
        if (once == plain) {
            g_error("%s changes nothing", changes[i]);
        }
    }
}

/* The very next strain step obeys. */
static void test_next_step(void)
{
    struct gb_experiment *one = run("geometry=isotropic", 1, 1);
    struct gb_experiment *none = run(NULL, 1, 1);
    const double *a = gb_world_cell(gb_experiment_world(one))->edge;
    const double *b = gb_world_cell(gb_experiment_world(none))->edge;
    g_assert_cmpfloat(a[0], <, b[0]);
    g_assert_cmpfloat(a[1], <, b[1]);
    /* as far as rounding goes: along more axes a step is taken in more parts */
    g_assert_cmpfloat_with_epsilon(a[2], b[2], 1e-12);
    gb_experiment_destroy(one);
    gb_experiment_destroy(none);
}

static void test_refused(void)
{
    static const char *const bad[] = {"particles.count=160", "mu", "mu=-1", "mu=a b",
                                      "until=1 GPa; count=3"};
    static const char *const reason[][2] = {
        {"friction=0.2", "friction: no such key; did you mean contact.mu? "},
        {"contact.muu=1", "contact.muu: no such key; did you mean contact.mu? "},
        {"mu", "mu: missing \"=value\""},
        {"count=3", "count=3: cannot change during a run; keys that can: contact.alpha"},
        {"mu=a", "contact.mu"},
    };
    struct gb_error err = {0};
    struct gb_params params = scene(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(reason); i++) {
        g_assert_false(gb_changes_add(&params, 10, reason[i][0], &err));
        if (!g_str_has_prefix(err.text, reason[i][1])) {
            g_error("%s: \"%s\"", reason[i][0], err.text);
        }
    }
    g_assert_true(gb_params_assign(&params, "loading.changes=10 mu=0.3", &err));
    g_assert_true(gb_changes_check(&params, &err));
    g_assert_true(gb_params_assign(&params, "loading.changes=", &err));
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        g_assert_false(gb_changes_add(&params, 10, bad[i], &err));
        g_assert_null(strchr(err.text, '\n'));
        g_assert_cmpstr(params.changes, ==, "");
    }
    g_assert_true(gb_changes_add(&params, 10, " mu = 0.3 ;", &err));
    g_assert_true(gb_changes_add(&params, 12, "mu=0.4", &err));
    g_assert_cmpstr(params.changes, ==, "10 contact.mu=0.3; 12 contact.mu=0.4");
    g_assert_false(gb_changes_add(&params, 11, "mu=0.5", &err));
    g_assert_true(gb_changes_due(&params, 12) && !gb_changes_due(&params, 11));
    struct gb_params effective;
    gb_changes_effective(&params, 11, &effective);
    g_assert_cmpfloat(effective.mu, ==, 0.3);
    gb_changes_effective(&params, 9, &effective);
    g_assert_cmpfloat(effective.mu, ==, 0.1);
}

/* Bridges that were not there have no histories: told before the packing is built, also of a
 * change after others. */
static void test_terms(void)
{
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    struct gb_params params = scene("contact.bridge_length=1 d");
    g_assert_true(gb_changes_add(&params, 2, "mu=0.2", &err));
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    gb_experiment_destroy(experiment);
    experiment = NULL;
    g_assert_true(gb_changes_add(&params, 3, "bridge_length=0.008 d", &err));
    g_assert_false(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    g_assert_null(experiment);
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "from the start"));
}

static bool has_ended(void *runner)
{
    return gb_runner_snapshot(runner, NULL)->state >= GB_RUN_DONE;
}

static bool has_forked_or_ended(void *runner)
{
    return gb_runner_forked(runner, NULL) || has_ended(runner);
}

/* A run that has handed over its state.  It is begun anew where it was over before this
 * thread could ask. */
static struct gb_runner *start_parent(const struct gb_params *params)
{
    struct gb_error err = {0};
    struct gb_runner *parent = NULL;
    struct gb_runner *child = NULL;
    for (;;) {
        g_assert_true(gb_runner_create(&parent, params, &err));
        g_assert_false(gb_runner_create_fork(&child, "mu=0.4", parent, NULL, &err));
        g_assert_true(gb_runner_send(parent, GB_COMMAND_FORK));
        patience_wait(has_forked_or_ended, parent, "the state that was asked for");
        if (gb_runner_forked(parent, NULL)) {
            return parent;
        }
        gb_runner_destroy(parent);
    }
}

static const struct gb_point *last_point(const struct gb_runner *runner)
{
    const struct gb_curve *curve = gb_runner_curve(runner);
    return gb_curve_at(curve, gb_curve_count(curve) - 1);
}

/* Through the engine's thread: the curve begins with the parent's points, and ends where
 * the same change by hand ends. */
static void test_runner(void)
{
    struct gb_error err = {0};
    const struct gb_params params = scene(NULL);
    struct gb_runner *parent = start_parent(&params);
    struct gb_runner *child = NULL;
    int64_t step = -1;
    g_assert_true(gb_runner_forked(parent, &step));
    if (!gb_runner_create_fork(&child, "mu=0.4", parent, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_false(gb_runner_forked(parent, NULL));
    g_assert_cmpint((int64_t)gb_curve_count(gb_runner_curve(child)), >, step);
    gb_runner_destroy(parent);
    patience_wait(has_ended, child, "the end of the run");
    g_assert_cmpint(gb_runner_snapshot(child, NULL)->state, ==, GB_RUN_DONE);
    g_assert_cmpfloat_with_epsilon(last_point(child)->density, 0.32, 1e-6);
    g_assert_cmpint(gb_curve_at(gb_runner_curve(child), 0)->step, ==, 0);
    const struct gb_params again = *gb_runner_params(child);
    const struct gb_point end = *last_point(child);
    gb_runner_destroy(child);
    /* the child's parameters alone repeat it */
    struct gb_experiment *experiment = NULL;
    g_assert_true(gb_experiment_create(&experiment, &again, NULL, NULL, &err));
    while (gb_experiment_advance(experiment, 1000, &err) != GB_STEP_DONE) {
    }
    g_assert_cmpfloat(gb_experiment_point(experiment)->density, ==, end.density);
    g_assert_cmpfloat(gb_experiment_point(experiment)->pz_pa, ==, end.pz_pa);
    g_assert_cmpint(gb_experiment_point(experiment)->step, ==, end.step);
    gb_experiment_destroy(experiment);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/run/change/repeats", test_repeats);
    g_test_add_func("/run/change/next-step", test_next_step);
    g_test_add_func("/run/change/refused", test_refused);
    g_test_add_func("/run/change/terms", test_terms);
    g_test_add_func("/run/change/runner", test_runner);
    return g_test_run();
}
