#include <glib.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "common/scene.h"
#include "pack/cell/world.h"
#include "run/checkpoint.h"
#include "run/experiment.h"

static struct gb_experiment *create(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    return experiment;
}

struct trace {
    GArray *points; /* struct gb_point */
    GString *events;
    enum gb_step_outcome end;
    struct gb_error err;
    uint64_t hash;
};

static void take_events(struct trace *trace, struct gb_experiment *experiment)
{
    int64_t step = 0;
    char text[GB_EVENT_TEXT];
    while (gb_experiment_event(experiment, &step, text, sizeof text)) {
        g_string_append_printf(trace->events, "step %" PRId64 ": %s\n", step, text);
    }
}

/* When events are taken: the run command does it after each slice, a caller may do it at the end. */
enum taking { AFTER_EACH_SLICE, AT_THE_END };

static struct trace run_taking(const struct gb_params *params, int64_t slice,
                               enum taking taking)
{
    struct trace trace = {.points = g_array_new(FALSE, FALSE, sizeof(struct gb_point)),
                          .events = g_string_new(NULL)};
    struct gb_experiment *experiment = create(params);
    do {
        trace.end = gb_experiment_advance(experiment, slice, &trace.err);
        if (trace.end == GB_STEP_POINT) {
            g_array_append_vals(trace.points, gb_experiment_point(experiment), 1);
        }
        if (taking == AFTER_EACH_SLICE) {
            take_events(&trace, experiment);
        }
    } while (trace.end == GB_STEP_MORE || trace.end == GB_STEP_POINT);
    take_events(&trace, experiment);
    trace.hash = gb_world_hash(gb_experiment_world(experiment));
    gb_experiment_destroy(experiment);
    return trace;
}

static struct trace run(const struct gb_params *params, int64_t slice)
{
    return run_taking(params, slice, AFTER_EACH_SLICE);
}

static void drop(struct trace *trace)
{
    g_array_free(trace->points, TRUE);
    g_string_free(trace->events, TRUE);
}

static const struct gb_point *at(const struct trace *trace, guint i)
{
    return &g_array_index(trace->points, struct gb_point, i);
}

/* The density rises on loading; unloading ends near zero pressure; loading continues near
 * the pressure where unloading began. */
static void test_branches(void)
{
    const struct gb_params params =
        scene_params("loading.until=40 MPa", "loading.unload_from=20 MPa",
                     "loading.step=0.4 %", "numerics.tolerance=1e-2", NULL);
    struct trace trace = run(&params, 1000);
    g_assert_cmpint(trace.end, ==, GB_STEP_DONE);
    g_assert_cmpint(at(&trace, 0)->branch, ==, -1);
    double top = 0.0, after = NAN, unloaded = NAN, density = 0.0;
    for (guint i = 1; i < trace.points->len; i++) {
        const struct gb_point *p = at(&trace, i);
        g_assert_cmpfloat(p->residual, <=, 1e-2);
        g_assert_cmpint(p->evaluations, >, 0);
        g_assert_cmpint(p->step, ==, i);
        g_assert_cmpfloat_with_epsilon(p->p_pa, p->pz_pa, 1e-6);
        if (p->branch == 1) {
            g_assert_cmpfloat(p->branch_from_pa, ==, 20e6);
            top = fmax(top, p->density);
            unloaded = p->p_pa;
        } else {
            g_assert_cmpfloat(p->density, >, density);
            if (isfinite(unloaded) && isnan(after)) {
                after = p->p_pa;
            }
            density = p->density;
        }
    }
    g_assert_cmpfloat(fabs(unloaded), <, 2e6);
    g_assert_cmpfloat(after, >, 15e6);
    g_assert_cmpfloat(at(&trace, trace.points->len - 1)->p_pa, >=, 40e6);
    g_assert_nonnull(strstr(trace.events->str, "unloading from"));
    drop(&trace);
}

/* Same parameters, same bits: again, in other slices, on other threads. */
static void test_repeat(void)
{
    const char *threads[] = {"numerics.threads=1", "numerics.threads=1",
                             "numerics.threads=3", "numerics.threads=8"};
    const int64_t slice[] = {100000, 3, 17, 1000};
    uint64_t hash[4];
    for (int i = 0; i < 4; i++) {
        const struct gb_params params = scene_params(
            threads[i], "particles.count=400", "loading.until=density = 0.27",
            "numerics.tolerance=1e-2", "loading.step=0.5 %", NULL);
        struct trace trace = run(&params, slice[i]);
        g_assert_cmpint(trace.end, ==, GB_STEP_DONE);
        hash[i] = trace.hash;
        drop(&trace);
    }
    for (int i = 1; i < 4; i++) {
        g_assert_cmpuint(hash[i], ==, hash[0]);
    }
}

/* The step of an event is the one that was computed when it happened: in any slices, and
 * whenever the event is taken. */
static void test_event_steps(void)
{
    const int64_t slice[] = {100000, 7, 100000};
    struct trace trace[3];
    for (int i = 0; i < 3; i++) {
        const struct gb_params params =
            scene_params("loading.until=20 MPa", "loading.unload_from=10 MPa",
                         "loading.step=1 %", "numerics.strain_part=1 %",
                         "numerics.tolerance=1e-2", "numerics.max_evaluations=120", NULL);
        trace[i] = run_taking(&params, slice[i], i == 2 ? AT_THE_END : AFTER_EACH_SLICE);
        g_assert_cmpint(trace[i].end, ==, GB_STEP_DONE);
        g_assert_cmpstr(trace[i].events->str, ==, trace[0].events->str);
    }
    g_assert_nonnull(strstr(trace[0].events->str, "not fully relaxed"));
    g_assert_nonnull(strstr(trace[0].events->str, "unloading from"));
    g_assert_null(strstr(trace[0].events->str, "step -1"));
    for (int i = 0; i < 3; i++) {
        drop(&trace[i]);
    }
}

/* Every loading geometry, with and without bridges, in 3D and 2D, ends in order. */
static void test_scenes(void)
{
    const char *scene[][2] = {
        {"loading.geometry=uniaxial", "contact.bridge_length=1 d"},
        {"loading.geometry=biaxial", "contact.bridge_length=0.008 d"},
        {"loading.geometry=isotropic", "contact.mu=0"},
        {"scene.dimension=2", "loading.geometry=isotropic"},
        {"scene.dimension=2", "loading.geometry=uniaxial"},
        {"material.epsilon=0 kB", "loading.geometry=isotropic"},
    };
    for (size_t s = 0; s < G_N_ELEMENTS(scene); s++) {
        const struct gb_params params =
            scene_params(scene[s][0], scene[s][1], "loading.until=10 MPa",
                         "loading.step=0.5 %", "numerics.tolerance=2e-2", NULL);
        struct trace trace = run(&params, 1000);
        if (trace.end != GB_STEP_DONE) {
            g_error("%s %s: %s", scene[s][0], scene[s][1], trace.err.text);
        }
        const struct gb_point *last = at(&trace, trace.points->len - 1);
        g_assert_cmpfloat(last->p_pa, >=, 10e6);
        g_assert_true(isfinite(last->px_pa));
        g_assert_true((params.dimension == 2) == (bool)isnan(last->py_pa));
        drop(&trace);
    }
}

/* A cell that becomes too small stops the run with the last good state kept. */
static void test_stop(void)
{
    const struct gb_params params = scene_params(
        "particles.count=40", "loading.geometry=isotropic", "loading.until=1 GPa",
        "contact.bridge_length=1 d", "particles.diameter=38 nm", "loading.step=2 %",
        "numerics.tolerance=3e-2", NULL);
    struct trace trace = run(&params, 1000);
    g_assert_cmpint(trace.end, ==, GB_STEP_STOPPED);
    g_assert_cmpint(trace.err.code, ==, GB_ERR_GUARD);
    g_assert_nonnull(strstr(trace.err.text, "cell has shrunk"));
    g_assert_nonnull(strstr(trace.events->str, "halved"));
    g_assert_cmpuint(trace.points->len, >, 3);
    g_assert_true(isfinite(at(&trace, trace.points->len - 1)->p_pa));
    drop(&trace);
}

/* Parts of a strain step change the way, not what is recorded: the same densities, one
 * point a step, all evaluations counted. */
static void test_parts(void)
{
    struct trace trace[2];
    for (int i = 0; i < 2; i++) {
        const struct gb_params params = scene_params(
            "loading.step=0.4 %", "loading.until=density = 0.3",
            "loading.unload_from=", "numerics.tolerance=2e-2",
            i == 0 ? "numerics.strain_part=0.4 %" : "numerics.strain_part=0.15 %", NULL);
        trace[i] = run(&params, 1000);
        g_assert_cmpint(trace[i].end, ==, GB_STEP_DONE);
        g_assert_cmpuint(trace[i].points->len, >, 50);
    }
    int64_t evaluations[2] = {0};
    int compared = 0;
    for (guint k = 0; k < trace[0].points->len && k < trace[1].points->len; k++) {
        const struct gb_point *whole = at(&trace[0], k), *parted = at(&trace[1], k);
        g_assert_cmpfloat_with_epsilon(whole->density, parted->density, 1e-12);
        evaluations[0] += whole->evaluations;
        evaluations[1] += parted->evaluations;
        compared++;
    }
    g_assert_cmpint(compared, >, 50);
    g_assert_cmpint(evaluations[1], >, evaluations[0]);
    drop(&trace[0]);
    drop(&trace[1]);
}

/* Strain steps so long that particles pass contacts by: told, halved, and the run goes
 * on. Not every packing has such a step. */
static void test_nonaffine(void)
{
    int tripped = 0;
    for (int seed = 1; seed <= 4; seed++) {
        char text[32];
        g_snprintf(text, sizeof text, "structure.seed=%d", seed);
        const struct gb_params params =
            scene_params("particles.count=300", "contact.bridge_length=1 d",
                         "loading.step=2 %", "loading.until=20 MPa",
                         "numerics.tolerance=1e-5", "numerics.relaxer=fire", text, NULL);
        struct trace trace = run(&params, 1000);
        g_assert_cmpint(trace.end, ==, GB_STEP_DONE);
        if (strstr(trace.events->str, "may pass contacts by; strain step halved")) {
            tripped++;
        }
        drop(&trace);
    }
    g_test_message("%d of 4 packings", tripped);
    g_assert_cmpint(tripped, >, 0);
}

static bool cancel_at_once(void *data)
{
    (void)data;
    return true;
}

static void test_cancel(void)
{
    const struct gb_params params = scene_params("particles.count=20000", NULL);
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    g_assert_false(
        gb_experiment_create(&experiment, &params, cancel_at_once, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
}

/* The k-th allocation fails, for every k until creation and ten points pass. */
static void test_memory(void)
{
    const struct gb_params params =
        scene_params("loading.step=1 %", "numerics.tolerance=3e-2", NULL);
    const size_t before = gb_alloc_bytes();
    bool passed = false;
    int k = 0;
    while (!passed) {
        struct gb_experiment *experiment = NULL;
        struct gb_error err = {0};
        gb_alloc_fail_after(++k);
        passed = gb_experiment_create(&experiment, &params, NULL, NULL, &err);
        for (int i = 0; i < 10 && passed; i++) {
            const enum gb_step_outcome result =
                gb_experiment_advance(experiment, 1000, &err);
            passed = result != GB_STEP_STOPPED;
        }
        gb_alloc_fail_after(0);
        g_assert_true(passed || err.code == GB_ERR_MEMORY);
        gb_experiment_destroy(experiment);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_cmpint(k, >, 20);
}

/* The state that pictures are made of agrees with the point. */
static void test_state(void)
{
    const struct gb_params params =
        scene_params("loading.until=5 MPa", "loading.step=0.5 %", NULL);
    struct gb_experiment *experiment = create(&params);
    struct gb_error err = {0};
    while (gb_experiment_advance(experiment, 1000, &err) != GB_STEP_DONE) {
        g_assert_cmpint(err.code, ==, GB_OK);
    }
    struct gb_state *state = NULL;
    g_assert_true(gb_experiment_state(experiment, &state, &err));
    const struct gb_point *point = gb_experiment_point(experiment);
    int64_t contacts = 0;
    double virial = 0.0;
    for (int64_t i = 0; i < state->count; i++) {
        contacts += state->contacts[i];
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(state->position[3 * i + k], >=, 0.0);
            g_assert_cmpfloat(state->position[3 * i + k], <, state->cell[k]);
        }
    }
    for (int64_t p = 0; p < state->pair_count; p++) {
        virial += state->pair_normal[p];
    }
    g_assert_true(isfinite(virial));
    g_assert_cmpint(contacts, ==, 2 * state->pair_count);
    g_assert_cmpfloat_with_epsilon(point->coordination,
                                   (double)contacts / (double)state->count, 1e-12);
    g_assert_cmpfloat_with_epsilon(point->density, state->point.density, 1e-12);
    gb_state_destroy(state);
    gb_experiment_destroy(experiment);
}

/* To the end; stop > 0: a checkpoint is taken after so many points, and another experiment
 * continues from it.  What was missed goes into text. */
static bool missed(const struct gb_params *params, int stop, char *text, size_t size)
{
    struct gb_experiment *experiment = create(params);
    struct gb_error err = {0};
    int points = 0;
    for (enum gb_step_outcome how = GB_STEP_MORE; how != GB_STEP_DONE;) {
        how = gb_experiment_advance(experiment, 1000, &err);
        g_assert_true(how != GB_STEP_STOPPED);
        points += how == GB_STEP_POINT;
        if (how == GB_STEP_POINT && points == stop) {
            struct gb_record *record = g_new0(struct gb_record, 1);
            struct gb_experiment *next = NULL;
            g_assert_true(gb_checkpoint_take(experiment, record, &err));
            g_assert_true(gb_experiment_resume(&next, params, record, &err));
            gb_experiment_destroy(experiment);
            experiment = next;
            gb_record_finish(record);
            g_free(record);
        }
    }
    g_assert_true(stop < points);
    const bool result = gb_experiment_missed(experiment, text, size);
    gb_experiment_destroy(experiment);
    return result;
}

/* Goals that are exceeded are named, also after a resumption; within the tolerance none is. */
static void test_exceeded(void)
{
    static const struct {
        const char *text; /* NULL: nothing is missed */
        int stop;
        const char *keys[4];
    } rows[] = {
        {"exceeded: loading.until = 1 MPa by ",
         0,
         {"loading.until=1 MPa", "loading.step=2 %"}},
        {"exceeded: loading.until = 10 MPa by ",
         3,
         {"loading.until=10 MPa", "loading.step=2 %"}},
        {"exceeded: loading.unload_from = 1 MPa by ",
         8,
         {"loading.until=density=0.3", "loading.unload_from=1 MPa; 20 MPa",
          "loading.step=2 %"}},
        {"not reached: loading.unload_from = 400 MPa; exceeded: loading.unload_from = 1 MPa",
         8,
         {"loading.until=density=0.3", "loading.unload_from=1 MPa; 400 MPa",
          "loading.step=2 %"}},
        {"exceeded: leg 1 (uniaxial z to z = 1 MPa) ends at z = ",
         10,
         {"loading.path=uniaxial z to z = 1 MPa; uniaxial z to density 0.28",
          "loading.step=0.5 %", "structure.seed=8"}},
        {NULL, 5, {"loading.until=20 MPa", "loading.unload_from=10 MPa"}},
        {NULL, 5, {"loading.until=density=0.27"}},
        {NULL, 5, {"loading.path=isotropic to 10 MPa; unload to 2 MPa"}},
        {NULL,
         5,
         {"loading.path=isotropic to 20 MPa; cycle 2 times triaxial between 0.2 % and 0 "
          "%"}},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        struct gb_params params =
            scene_params("particles.count=150", "numerics.fidelity=fast", NULL);
        struct gb_error err = {0};
        char text[GB_EVENT_TEXT];
        for (int i = 0; rows[k].keys[i] != NULL; i++) {
            if (!gb_params_assign(&params, rows[k].keys[i], &err)) {
                g_error("%s", err.text);
            }
        }
        for (int resumed = 0; resumed < 2; resumed++) {
            const bool any =
                missed(&params, resumed ? rows[k].stop : 0, text, sizeof text);
            g_test_message("%s: %s", rows[k].keys[0], text);
            g_assert_true(any == (rows[k].text != NULL));
            g_assert_true(!any || g_str_has_prefix(text, rows[k].text));
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/experiment/branches", test_branches);
    g_test_add_func("/experiment/repeat", test_repeat);
    g_test_add_func("/experiment/event-steps", test_event_steps);
    g_test_add_func("/experiment/scenes", test_scenes);
    g_test_add_func("/experiment/stop", test_stop);
    g_test_add_func("/experiment/parts", test_parts);
    g_test_add_func("/experiment/nonaffine", test_nonaffine);
    g_test_add_func("/experiment/cancel", test_cancel);
    g_test_add_func("/experiment/memory", test_memory);
    g_test_add_func("/experiment/state", test_state);
    g_test_add_func("/experiment/exceeded", test_exceeded);
    return g_test_run();
}
