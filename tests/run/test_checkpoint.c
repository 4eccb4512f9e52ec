/* Stopped and resumed is as never stopped: every point and every bit of the state, over
 * scenes, relaxers, threads and the moments of the stop. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "common/scene.h"
#include "pack/cell/world.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/repeat_points.h"

static struct gb_experiment *create(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    return experiment;
}

static struct gb_experiment *resume(const struct gb_params *params,
                                    struct gb_record *record)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_resume(&experiment, params, record, &err)) {
        g_error("%s", err.text);
    }
    return experiment;
}

static void take(struct gb_experiment *experiment, struct gb_record *record)
{
    struct gb_error err = {0};
    if (!gb_checkpoint_take(experiment, record, &err)) {
        g_error("%s", err.text);
    }
}

/* Next point of the run; false at its end.  Events are taken as a run does. */
static bool step(struct gb_experiment *experiment, int64_t slice, GString *events)
{
    struct gb_error err = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE) {
        char text[GB_EVENT_TEXT];
        how = gb_experiment_advance(experiment, slice, &err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
            g_string_append_printf(events, "%s\n", text);
        }
    }
    if (how == GB_STEP_STOPPED) {
        g_string_append_printf(events, "stopped: %s\n", err.text);
    }
    return how == GB_STEP_POINT;
}

static void compare(const struct gb_record *a, const struct gb_record *b, int64_t at)
{
    int64_t row = 0;
    const char *name = gb_record_difference(a, b, &row);
    if (name != NULL) {
        g_error("point %lld: %s differs at row %lld", (long long)at, name,
                (long long)row);
    }
    g_assert_cmpuint(gb_record_hash(a), ==, gb_record_hash(b));
}

/* Pressures of both worlds are equal to the bit: the next step is decided by them. */
static void compare_pressures(const struct gb_world *one, const struct gb_world *other)
{
    double a[3][3], b[3][3];
    if (one == NULL) {
        return; /* a die */
    }
    gb_world_pressure(one, a);
    gb_world_pressure(other, b);
    g_assert_true(memcmp(a, b, sizeof a) == 0);
}

/* The record of an earlier point, computed up to the present one, is that of the present
 * one. */
static void check_repeated(const struct gb_params *params, struct gb_record *early,
                           const struct gb_record *now)
{
    struct gb_error err = {0};
    const int64_t from = gb_checkpoint_step(early), to = gb_checkpoint_step(now);
    g_assert_cmpint(from, <, to);
    if (!gb_repeat_points_record(early, params, to, &err)) {
        g_error("from %lld to %lld: %s", (long long)from, (long long)to, err.text);
    }
    compare(early, now, to);
}

/* Runs to the end twice, the second time stopped after every `every`-th point; threads
 * change at each stop. */
static void check(struct gb_params params, int every, int64_t least)
{
    struct gb_experiment *whole = create(&params);
    struct gb_experiment *broken = create(&params);
    struct gb_record one = {0}, other = {0}, early = {0};
    GString *events = g_string_new(NULL), *again = g_string_new(NULL);
    int64_t points = 0;
    bool more = true;
    while (more) {
        more = step(whole, 1000, events);
        g_assert_cmpint(step(broken, 37, again), ==, more);
        points += more;
        if (more) {
            take(whole, &one);
            take(broken, &other);
            compare(&one, &other, points);
            g_assert_cmpint(gb_checkpoint_step(&one), ==, points);
            if (early.count > 0 && points % every == every - 1) {
                check_repeated(&params, &early, &one);
            }
            if (points % every == 0) {
                take(whole, &early);
            }
        }
        if (more && points % every == 0) {
            gb_experiment_destroy(broken);
            params.threads = 1 + points % 3;
            broken = resume(&params, &other);
            compare_pressures(gb_experiment_world(whole), gb_experiment_world(broken));
        }
        const struct gb_world *a = gb_experiment_world(whole);
        g_assert_cmpuint(gb_world_hash(a), ==,
                         gb_world_hash(gb_experiment_world(broken)));
    }
    g_assert_cmpstr(events->str, ==, again->str);
    if (points < least) {
        g_error("only %lld points: %s", (long long)points, events->str);
    }
    gb_experiment_destroy(whole);
    gb_experiment_destroy(broken);
    gb_record_finish(&one);
    gb_record_finish(&other);
    gb_record_finish(&early);
    g_string_free(events, TRUE);
    g_string_free(again, TRUE);
}

/* Loading with two branches of unloading. */
static struct gb_params quasistatic(const char *contact, const char *geometry,
                                    const char *relaxer)
{
    return scene_params("loading.until=30 MPa", "loading.unload_from=8 MPa; 20 MPa",
                        "loading.step=0.4 %", "numerics.tolerance=1e-2", contact,
                        geometry, relaxer, NULL);
}

/* The next point of the loading branch; false at the end of the run. */
static bool step_loading(struct gb_experiment *experiment, GString *events)
{
    bool more = step(experiment, 1000, events);
    while (more && gb_experiment_point(experiment)->branch > 0) {
        more = step(experiment, 1000, events);
    }
    return more;
}

/* Unloading leaves no trace: the loading branch has the same bits without branches. */
static void check_trace(struct gb_params params)
{
    struct gb_params plain = params;
    plain.unload_count = 0;
    struct gb_experiment *branched = create(&params), *straight = create(&plain);
    GString *events = g_string_new(NULL);
    while (step_loading(straight, events)) {
        g_assert_true(step_loading(branched, events));
        const struct gb_point *a = gb_experiment_point(branched);
        const struct gb_point *b = gb_experiment_point(straight);
        g_assert_cmpfloat(a->density, ==, b->density);
        g_assert_cmpfloat(a->p_pa, ==, b->p_pa);
        g_assert_cmpfloat(a->residual, ==, b->residual);
        g_assert_cmpint(a->evaluations, ==, b->evaluations);
        g_assert_cmpuint(gb_world_hash(gb_experiment_world(branched)), ==,
                         gb_world_hash(gb_experiment_world(straight)));
    }
    g_assert_false(step_loading(branched, events));
    g_assert_nonnull(strstr(events->str, "unloaded; loading continues"));
    g_string_free(events, TRUE);
    gb_experiment_destroy(branched);
    gb_experiment_destroy(straight);
}

static void test_trace(void)
{
    static const char *const relaxer[] = {"numerics.relaxer=predict",
                                          "numerics.relaxer=fire"};
    static const char *const precision[] = {"numerics.precision=single",
                                            "numerics.precision=double"};
    for (int k = 0; k < 4; k++) {
        check_trace(quasistatic("contact.mu=0.1", relaxer[k / 2], precision[k % 2]));
    }
    for (int k = 0; k < 4; k++) { /* the state that was unloaded is the last one */
        check_trace(scene_params("loading.until=8 MPa", "loading.unload_from=8 MPa",
                                 "loading.step=0.4 %", relaxer[k / 2], precision[k % 2],
                                 NULL));
    }
    check_trace(scene_params("loading.until=density=0.26", "loading.unload_from=2 kPa",
                             "loading.step=0.4 %", "numerics.relaxer=steepest", NULL));
}

static void test_bridges(void)
{
    check(quasistatic("contact.mu=0.1", "loading.geometry=uniaxial",
                      "numerics.relaxer=fire"),
          3, 60);
}

static void test_every_point(void)
{
    check(quasistatic("contact.mu=0.1", "loading.geometry=biaxial",
                      "numerics.relaxer=fire"),
          1, 30);
}

static void test_no_bridges(void)
{
    check(quasistatic("contact.bridge_length=1 d", "loading.geometry=isotropic",
                      "numerics.relaxer=fire"),
          4, 15);
}

/* Its memory of the last strain step is part of the state. */
static void test_predict(void)
{
    check(quasistatic("contact.mu=0.1", "loading.geometry=uniaxial",
                      "numerics.relaxer=predict"),
          2, 50);
}

static void test_steepest(void)
{
    struct gb_params params = scene_params(
        "particles.count=100", "loading.until=density = 0.25", "numerics.tolerance=1e-1",
        "loading.step=0.5 %", "numerics.relaxer=steepest", "structure.base=6 d", NULL);
    check(params, 2, 5);
}

/* The stiffness that the rule measures displacements with is not part of the state. */
static void test_scales(void)
{
    check(scene_params("particles.count=100", "loading.until=density = 0.28",
                       "loading.unload_from=4 MPa", "numerics.tolerance=1e-2",
                       "loading.step=0.5 %", "numerics.relaxer=steepest",
                       "structure.base=6 d", "numerics.tolerance_scale=displacement",
                       NULL),
          2, 25);
    check(scene_params("loading.until=60 MPa", "loading.unload_from=30 MPa",
                       "numerics.tolerance=3e-2", "loading.step=0.4 %",
                       "numerics.tolerance_scale=attraction", NULL),
          2, 25);
}

static void test_planar(void)
{
    check(scene_params("scene.dimension=2", "particles.count=300",
                       "loading.geometry=isotropic", "loading.until=density = 0.6",
                       "numerics.tolerance=1e-2", "loading.step=0.5 %", NULL),
          2, 10);
}

/* Stages of a dynamic run. */
static void test_dynamic(void)
{
    check(scene_params("scene.kind=dynamic", "scene.dimension=2", "particles.count=200",
                       "contact.mu=0.5", "loading.geometry=isotropic",
                       "loading.rate=6.8e9 1/s", "loading.relax=0.004 ns",
                       "loading.hold=0.004 ns", "loading.record_time=0.001 ns",
                       "loading.record=1 %", "loading.until=density = 0.58", NULL),
          3, 20);
}

static struct gb_params collapse(const char *friction, const char *rate)
{
    return scene_params("scene.kind=dynamic", "loading.geometry=uniaxial", friction, rate,
                        "loading.relax=0.004 ns", "loading.hold=0.004 ns",
                        "loading.record_time=0.001 ns", "loading.record=1 %",
                        "loading.until=density = 0.28", NULL);
}

static void test_dynamic_solid(void)
{
    check(collapse("contact.mu=0.5", "loading.rate=3e9 1/s"), 2, 15);
}

/* Unequal sizes in motion: spheres, and discs compressed along z alone. */
static void test_dynamic_sizes(void)
{
    check(scene_params("scene.kind=dynamic", "particles.distribution=lognormal",
                       "particles.sigma=0.25", "particles.largest=20 nm",
                       "loading.geometry=biaxial", "contact.mu=0.5",
                       "loading.rate=6.8e9 1/s", "loading.relax=0.004 ns",
                       "loading.hold=0.004 ns", "loading.record_time=0.001 ns",
                       "loading.record=1 %", "loading.until=density = 0.28", NULL),
          2, 15);
    check(scene_params(
              "scene.kind=dynamic", "scene.dimension=2", "particles.distribution=table",
              "particles.table=number: 6 nm 0.5; 17 nm 0.5", "loading.geometry=uniaxial",
              "contact.mu=0.5", "loading.rate=6.8e9 1/s", "loading.relax=0.004 ns",
              "loading.hold=0.004 ns", "loading.record_time=0.001 ns",
              "loading.record=1 %", "loading.until=density = 0.58", NULL),
          3, 15);
}

/* Discs of unequal sizes, quasi-static. */
static void test_planar_sizes(void)
{
    check(scene_params("scene.dimension=2", "particles.count=200",
                       "particles.distribution=lognormal", "particles.sigma=0.25",
                       "particles.largest=20 nm", "loading.until=density = 0.56",
                       "numerics.tolerance=1e-2", "loading.step=0.5 %", NULL),
          2, 10);
}

/* A guard that halves the time step again and again, and gives up. */
static void test_guard(void)
{
    check(collapse("contact.mu=0.1", "loading.rate=6.8e9 1/s"), 2, 5);
}

/* What does not fit is told by name and never loaded. */
static void test_foreign(void)
{
    const struct gb_params params = scene_params("loading.until=5 MPa", NULL);
    struct gb_experiment *experiment = create(&params), *loaded = NULL;
    struct gb_record record = {0};
    struct gb_error err = {0};
    GString *events = g_string_new(NULL);
    g_assert_true(step(experiment, 1000, events));
    take(experiment, &record);
    struct gb_params more = params;
    more.count = 300;
    g_assert_false(gb_experiment_resume(&loaded, &more, &record, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "world/position: has 200 rows instead of 300"));
    for (int k = 0; k < record.count; k++) {
        char kept[GB_RECORD_NAME];
        if (strcmp(record.item[k].name, "world/pair_force") == 0) {
            continue; /* in single precision for pictures only */
        }
        if (strcmp(record.item[k].name, "point/unrelaxed") == 0 ||
            strcmp(record.item[k].name, "shown/unrelaxed") == 0) {
            continue; /* scenes of other kinds have none */
        }
        g_strlcpy(kept, record.item[k].name, sizeof kept);
        record.item[k].name[0] = 'X';
        g_assert_false(gb_experiment_resume(&loaded, &params, &record, &err));
        g_assert_nonnull(strstr(err.text, kept));
        g_strlcpy(record.item[k].name, kept, sizeof kept);
    }
    int64_t *steps = gb_record_find(&record, "run/step")->data;
    const int64_t wrong[] = {INT64_MIN, -1, INT64_MAX}, right = *steps;
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        *steps = wrong[k];
        g_assert_false(gb_experiment_resume(&loaded, &params, &record, &err));
        g_assert_nonnull(strstr(err.text, "run/step"));
    }
    *steps = right;
    int32_t *pair = gb_record_find(&record, "world/pair")->data;
    pair[1] = 200;
    g_assert_false(gb_experiment_resume(&loaded, &params, &record, &err));
    g_assert_nonnull(strstr(err.text, "world/pair"));
    gb_experiment_destroy(experiment);
    gb_record_finish(&record);
    g_string_free(events, TRUE);
}

/* No memory at the k-th allocation, for every k: an error, and nothing is lost. */
static void test_memory(void)
{
    const struct gb_params params = scene_params("loading.until=5 MPa", NULL);
    struct gb_experiment *experiment = create(&params);
    GString *events = g_string_new(NULL);
    g_assert_true(step(experiment, 1000, events));
    const size_t before = gb_alloc_bytes();
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        struct gb_record record = {0};
        struct gb_experiment *loaded = NULL;
        struct gb_error err = {0};
        gb_alloc_fail_after(k);
        done = gb_checkpoint_take(experiment, &record, &err) &&
               gb_experiment_resume(&loaded, &params, &record, &err);
        gb_alloc_fail_after(0);
        g_assert_cmpint(err.code, ==, done ? GB_OK : GB_ERR_MEMORY);
        gb_experiment_destroy(loaded);
        gb_record_finish(&record);
    }
    g_assert_cmpint(k, >, 40);
    /* the world keeps the list it writes histories down in */
    g_assert_cmpuint(gb_alloc_bytes(), >=, before);
    gb_experiment_destroy(experiment);
    g_string_free(events, TRUE);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/checkpoint/trace", test_trace);
    g_test_add_func("/checkpoint/bridges", test_bridges);
    g_test_add_func("/checkpoint/every point", test_every_point);
    g_test_add_func("/checkpoint/no bridges", test_no_bridges);
    g_test_add_func("/checkpoint/predict", test_predict);
    g_test_add_func("/checkpoint/steepest", test_steepest);
    g_test_add_func("/checkpoint/tolerance-scales", test_scales);
    g_test_add_func("/checkpoint/planar", test_planar);
    g_test_add_func("/checkpoint/dynamic", test_dynamic);
    g_test_add_func("/checkpoint/dynamic solid", test_dynamic_solid);
    g_test_add_func("/checkpoint/dynamic sizes", test_dynamic_sizes);
    g_test_add_func("/checkpoint/planar sizes", test_planar_sizes);
    g_test_add_func("/checkpoint/guard", test_guard);
    g_test_add_func("/checkpoint/foreign", test_foreign);
    g_test_add_func("/checkpoint/memory", test_memory);
    return g_test_run();
}
