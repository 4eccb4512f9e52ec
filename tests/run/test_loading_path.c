/* Loading paths on small packings: held stresses are held, legs end where they should,
 * stopped and resumed is as never stopped, closed strain paths give the packing back, and
 * no path creates energy. */
#include <glib.h>
#include <math.h>

#include "common/scene.h"
#include "measure/observe.h"
#include "run/change.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "scene/field/changes.h"

static struct gb_experiment *create(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    return experiment;
}

static enum gb_step_outcome step(struct gb_experiment *experiment, GString *events)
{
    struct gb_error err = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE) {
        char text[GB_EVENT_TEXT];
        how = gb_experiment_advance(experiment, 1000, &err);
        while (events && gb_experiment_event(experiment, NULL, text, sizeof text)) {
            g_string_append_printf(events, "%s\n", text);
        }
    }
    return how;
}

/* A loose packing of system II, or of I (no bridges). */
static struct gb_params params_of(const char *system, const char *path, const char *more)
{
    return scene_params("loading.step=0.2 %", "structure.density=0.3",
                        strcmp(system, "I") == 0 ? "contact.bridge_length=1 d"
                                                 : "contact.bridge_length=0.008 d",
                        path, more, NULL);
}

/* Stresses of a point in the order of scene/path/path.h, Pa. */
static void stresses(const struct gb_point *point, double stress[6])
{
    const double values[6] = {point->px_pa,        point->py_pa,
                              point->pz_pa,        -point->shear_pa[0],
                              -point->shear_pa[1], -point->shear_pa[2]};
    memcpy(stress, values, sizeof values);
}

/* Every recorded point of a leg has these stresses within the promise: 0.5 % or 1e-3 of the
 * largest one of the leg. */
struct held {
    int leg, component;
    double pa;
    int of; /* -1, or pa is the share of this component */
};

static void check_held(const struct gb_params *params, const struct held *held, int count,
                       int64_t least)
{
    struct gb_experiment *experiment = create(params);
    GString *events = g_string_new(NULL);
    double largest[GB_PATH_LEGS_MAX + 1] = {0.0};
    int64_t points = 0;
    enum gb_step_outcome how = GB_STEP_POINT;
    for (how = step(experiment, events); how == GB_STEP_POINT;
         how = step(experiment, events)) {
        const struct gb_point *point = gb_experiment_point(experiment);
        double stress[6];
        if (isnan(point->leg)) {
            continue;
        }
        const int leg = (int)point->leg;
        stresses(point, stress);
        for (int k = 0; k < 6; k++) {
            largest[leg] = fmax(largest[leg], fabs(stress[k]));
        }
        for (int i = 0; i < count; i++) {
            const double want =
                held[i].of >= 0 ? held[i].pa * stress[held[i].of] : held[i].pa;
            const double room = fmax(5e-3 * fabs(want), 1e-3 * fmax(largest[leg], 2e6));
            if (held[i].leg == leg && fabs(stress[held[i].component] - want) > room) {
                g_error("step %ld: component %d is %g instead of %g", (long)point->step,
                        held[i].component, stress[held[i].component], want);
            }
            points += held[i].leg == leg;
        }
    }
    if (how != GB_STEP_DONE || points < least) {
        g_error("%ld points: %s", (long)points, events->str);
    }
    gb_experiment_destroy(experiment);
    g_string_free(events, TRUE);
}

static void test_held(void)
{
    static const struct held triaxial[] = {{2, 0, 20e6, -1}, {2, 1, 20e6, -1}};
    static const struct held shear[] = {{2, 2, 20e6, -1}};
    static const struct held radial[] = {{1, 0, 0.5, 2}, {1, 1, 0.5, 2}};
    static const struct held six[] = {{2, 0, 20e6, -1},
                                      {2, 1, 20e6, -1},
                                      {2, 2, 20e6, -1},
                                      {2, 3, 0.0, -1},
                                      {2, 5, 0.0, -1}};
    static const char *const systems[] = {"I", "II"};
    for (int s = 0; s < 2; s++) {
        struct gb_params params = params_of(
            systems[s], "loading.path=isotropic to 20 MPa; triaxial to 6 % at 20 MPa",
            "numerics.precision=auto");
        check_held(&params, triaxial, 2, 60);
        params = params_of(systems[s],
                           "loading.path=isotropic to 20 MPa; shear xz to 8 % at z = 20 "
                           "MPa",
                           "numerics.relaxer=fire");
        check_held(&params, shear, 1, 40);
        params = params_of(systems[s], "loading.path=radial 0.5 to z = 40 MPa",
                           "numerics.precision=double");
        check_held(&params, radial, 2, 40);
        params = params_of(systems[s],
                           "loading.path=isotropic to 20 MPa; shear xz to 4 % at x = y = "
                           "z = 20 MPa, xy = yz = 0 MPa",
                           "numerics.relaxer=predict");
        check_held(&params, six, 5, 100);
        params = params_of(systems[s],
                           "loading.path=isotropic to 20 MPa; cycle 3 times triaxial "
                           "between z = 15 MPa and z = 25 MPa at x = y = 20 MPa",
                           "numerics.precision=auto");
        check_held(&params, triaxial, 2, 20);
    }
}

/* The last point of each leg: where it was to end. */
static void test_ends(void)
{
    const struct gb_params params = params_of(
        "II",
        "loading.path=isotropic to density 0.36; isotropic to 60 MPa; triaxial to q/p = "
        "0.6; unload; uniaxial to 1 %; shear xz to -2 %",
        "numerics.precision=double");
    struct gb_experiment *experiment = create(&params);
    struct gb_point last[8] = {{0}};
    while (step(experiment, NULL) == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        if (isfinite(point->leg)) {
            last[(int)point->leg] = *point;
        }
    }
    g_assert_cmpfloat_with_epsilon(last[1].density, 0.36, 1e-8);
    const double mean = (last[2].px_pa + last[2].py_pa + last[2].pz_pa) / 3.0;
    g_assert_cmpfloat_with_epsilon(mean, 60e6, 0.02 * 60e6);
    const double p = (last[3].px_pa + last[3].py_pa + last[3].pz_pa) / 3.0;
    g_assert_cmpfloat_with_epsilon(last[3].q_pa / p, 0.6, 0.02);
    g_assert_cmpfloat(fabs(last[4].pz_pa), <, 0.02 * 60e6);
    g_assert_cmpfloat_with_epsilon(last[5].strain[2] - last[4].strain[2], 0.01, 1e-9);
    g_assert_cmpfloat(last[5].strain[0], ==, last[4].strain[0]);
    g_assert_cmpfloat_with_epsilon(last[6].strain[4], -0.02, 1e-9);
    g_assert_cmpint(last[1].branch, ==, GB_BRANCH_LOAD);
    g_assert_cmpint(last[6].branch, ==, GB_BRANCH_LEG - 6);
    gb_experiment_destroy(experiment);
}

static void take(struct gb_experiment *experiment, struct gb_record *record)
{
    struct gb_error err = {0};
    if (!gb_checkpoint_take(experiment, record, &err)) {
        g_error("%s", err.text);
    }
}

/* Stopped after every third point, on another number of threads each time. */
static void test_resume(void)
{
    struct gb_params params = params_of(
        "II",
        "loading.path=isotropic to 10 MPa; shear xz to 2 % at z = 12 MPa; cycle 2 times "
        "uniaxial between z = 4 MPa and z = 12 MPa; unload",
        "numerics.relaxer=predict");
    struct gb_experiment *whole = create(&params), *broken = create(&params);
    struct gb_record one = {0}, other = {0};
    struct gb_error err = {0};
    int64_t points = 0;
    while (step(whole, NULL) == GB_STEP_POINT) {
        g_assert_cmpint(step(broken, NULL), ==, GB_STEP_POINT);
        take(whole, &one);
        take(broken, &other);
        int64_t row = 0;
        g_assert_cmpstr(gb_record_difference(&one, &other, &row), ==, NULL);
        if (++points % 3 == 0) {
            gb_experiment_destroy(broken);
            params.threads = 1 + points % 2;
            g_assert_true(gb_experiment_resume(&broken, &params, &other, &err));
        }
    }
    g_assert_cmpint(points, >, 40);
    gb_experiment_destroy(whole);
    gb_experiment_destroy(broken);
    gb_record_finish(&one);
    gb_record_finish(&other);
}

/* A stress beyond what the packing carries: the run says so and stops, or goes on. */
static void test_collapse(void)
{
    struct gb_params params = params_of(
        "I", "loading.path=isotropic to 20 MPa; uniaxial extension to z = -200 MPa",
        "loading.on_collapse=stop");
    struct gb_experiment *experiment = create(&params);
    GString *events = g_string_new(NULL);
    enum gb_step_outcome how = GB_STEP_POINT;
    while (how == GB_STEP_POINT) {
        how = step(experiment, events);
        g_assert_cmpfloat(gb_experiment_point(experiment)->pz_pa, >, -200e6);
    }
    g_assert_cmpint(how, ==, GB_STEP_STOPPED);
    g_assert_nonnull(strstr(events->str, "leg 2 (uniaxial extension to z = -200 MPa): z "
                                         "does not reach -200 MPa"));
    gb_experiment_destroy(experiment);
    params.on_collapse = GB_COLLAPSE_STRAIN;
    experiment = create(&params);
    while ((how = step(experiment, events)) == GB_STEP_POINT) {
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    gb_experiment_destroy(experiment);
    g_string_free(events, TRUE);
}

/* Work done on the packing since the first of these points, per volume, by the trapezoid
 * rule. */
static double work_between(const struct gb_point *a, const struct gb_point *b)
{
    double from[6], to[6], work = 0.0;
    stresses(a, from);
    stresses(b, to);
    for (int k = 0; k < 6; k++) {
        work += 0.5 * (from[k] + to[k]) * (b->strain[k] - a->strain[k]);
    }
    return work / b->density;
}

/* A closed strain path below the elastic range gives the stresses back. */
static void test_elastic_cycle(void)
{
    const struct gb_params params = scene_params(
        "loading.step=0.0005 %", "structure.density=0.3", "numerics.tolerance=1e-7",
        "numerics.relaxer=fire", "numerics.precision=double",
        "loading.path=uniaxial to 0.0005 %; strain xz = 1, z = 1 to 0.001 %; "
        "strain "
        "xz = 1, z = 1 to -0.001 %",
        NULL);
    struct gb_experiment *experiment = create(&params);
    struct gb_point before = {0}, after = {0};
    while (step(experiment, NULL) == GB_STEP_POINT) {
        const struct gb_point *point = gb_experiment_point(experiment);
        before = point->leg == 1.0 ? *point : before;
        after = *point;
    }
    double one[6], other[6];
    stresses(&before, one);
    stresses(&after, other);
    g_assert_cmpfloat(after.leg, ==, 3.0);
    for (int k = 0; k < 6; k++) {
        g_assert_cmpfloat_with_epsilon(one[k], other[k],
                                       2e-3 * fabs(before.pz_pa) + 200.0);
    }
    gb_experiment_destroy(experiment);
}

/* Closed strain paths with sliding and breaking bridges: the work of the cycle is what the
 * elastic energy has gained and what is lost; it is not below the gain. */
static void test_no_energy_created(void)
{
    static const char *const systems[] = {"I", "II"};
    for (int s = 0; s < 2; s++) {
        const struct gb_params params = params_of(
            systems[s],
            "loading.path=isotropic to 30 MPa; cycle 4 times shear xz between 1.5 % and "
            "-1.5 %; shear xz to 0 %; cycle 3 times uniaxial between -0.5 % and 0.3 %",
            "numerics.tolerance=1e-3");
        struct gb_experiment *experiment = create(&params);
        struct gb_point last = {0};
        double work = 0.0, start = NAN, most = 0.0;
        while (step(experiment, NULL) == GB_STEP_POINT) {
            const struct gb_point *point = gb_experiment_point(experiment);
            const struct gb_model *model = gb_experiment_model(experiment);
            const double elastic = gb_observe_elastic(gb_experiment_world(experiment)) /
                                   ((double)model->count * M_PI / 6.0) *
                                   model->pascal_per_stress;
            if (point->leg >= 2.0 && isfinite(start)) {
                work += work_between(&last, point);
                most = fmax(most, point->pz_pa);
                /* what went in is at least what is stored, within the trapezoid rule */
                g_assert_cmpfloat(work - (elastic - start), >, -2e-4 * most);
            }
            if (point->leg == 1.0) {
                start = elastic;
            }
            last = *point;
        }
        g_assert_cmpfloat(work, >, 0.0);
        gb_experiment_destroy(experiment);
    }
}

/* Another path from a recorded step on; a path with shear needs double precision from the
 * start. */
static void test_what_if(void)
{
    struct gb_params params =
        params_of("II", "loading.path=isotropic to 10 MPa; triaxial to 2 %",
                  "loading.changes=10 loading.path=uniaxial to z = 15 MPa then unload");
    struct gb_experiment *experiment = create(&params);
    GString *events = g_string_new(NULL);
    struct gb_point last = {0};
    while (step(experiment, events) == GB_STEP_POINT) {
        last = *gb_experiment_point(experiment);
    }
    g_assert_nonnull(strstr(events->str, "changed after step 10"));
    g_assert_cmpfloat(last.leg, ==, 2.0);
    g_assert_cmpfloat(fabs(last.pz_pa), <, 0.3e6);
    gb_experiment_destroy(experiment);
    g_string_free(events, TRUE);
}

/* A shear asked of a run that began in single precision, as a what-if and as a change that
 * the preset itself has. */
static void test_what_if_precision(void)
{
    struct gb_error err = {0};
    struct gb_params params = params_of(
        "II", "loading.path=isotropic to 10 MPa; triaxial to 2 %", "scene.title=a");
    struct gb_params changed = params;
    g_assert_true(gb_changes_add(&changed, 10, "path=uniaxial to z = 15 MPa", &err));
    g_assert_true(gb_change_allowed(&params, &changed, 10, &err));
    changed = params;
    g_assert_true(
        gb_changes_add(&changed, 10, "path=shear xz to 2 % at z = 10 MPa", &err));
    g_assert_false(gb_change_allowed(&params, &changed, 10, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "numerics.precision = double"));
    struct gb_experiment *experiment = NULL;
    struct gb_error why = {0};
    g_assert_false(gb_experiment_create(&experiment, &changed, NULL, NULL, &why));
    g_assert_cmpint(why.code, ==, GB_ERR_INPUT);
    g_assert_cmpstr(why.text, ==, err.text);
    g_assert_true(gb_params_assign(&params, "numerics.precision=double", NULL));
    changed = params;
    g_assert_true(
        gb_changes_add(&changed, 10, "path=shear xz to 2 % at z = 10 MPa", &err));
    g_assert_true(gb_change_allowed(&params, &changed, 10, &err));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/loading-path/held", test_held);
    g_test_add_func("/loading-path/ends", test_ends);
    g_test_add_func("/loading-path/resume", test_resume);
    g_test_add_func("/loading-path/collapse", test_collapse);
    g_test_add_func("/loading-path/elastic-cycle", test_elastic_cycle);
    g_test_add_func("/loading-path/no-energy-created", test_no_energy_created);
    g_test_add_func("/loading-path/what-if", test_what_if);
    g_test_add_func("/loading-path/what-if-precision", test_what_if_precision);
    return g_test_run();
}
