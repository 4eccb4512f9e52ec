#include <glib.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "measure/observe.h"
#include "solve/loading/loading_dynamic.h"
#include "solve/verlet.h"

/* Two particles in a wide cell, without attraction unless asked for. */
struct duo {
    struct gb_params params;
    struct gb_model model;
    struct gb_world *world;
    struct gb_verlet verlet;
};

static void meet(struct duo *duo, const struct gb_params *params, const double r[3])
{
    struct gb_error err = {0};
    duo->model = scene_model(params);
    duo->model.count = 2;
    duo->model.edges[0] = duo->model.edges[1] = duo->model.edges[2] = 8.0;
    double position[6] = {3.0, 4.0, 4.0, 3.0, 4.0, 4.0};
    for (int k = 0; k < 3; k++) {
        position[3 + k] += r[k];
    }
    g_assert_true(gb_world_create(&duo->world, &duo->model, position, &err));
    g_assert_true(gb_verlet_init(&duo->verlet, &duo->model, &err));
    gb_world_set_step(duo->world, 1.0);
    scene_evaluate(duo->world);
}

static void part(struct duo *duo)
{
    gb_verlet_finish(&duo->verlet);
    gb_world_destroy(duo->world);
}

static void step(struct duo *duo, double length)
{
    static const double still[3] = {1.0, 1.0, 1.0};
    struct gb_error err = {0};
    if (!gb_verlet_step(&duo->verlet, duo->world, length, still, &err)) {
        g_error("%s", err.text);
    }
}

static struct gb_params dynamic_params(const char *a, const char *b, const char *c)
{
    return scene_params("scene.kind=dynamic", "loading.until=density = 0.6", a, b, c,
                        NULL);
}

/* h'' = -2 (f_e + A f_e' h') of two unit masses, P2 (1), (3). */
static int collision(double time, const double y[], double dydt[], void *data)
{
    (void)time;
    const struct gb_model *model = data;
    dydt[0] = y[1];
    dydt[1] =
        -2.0 * (gb_law_rod_force(&model->rod, y[0]) +
                model->dynamics.viscous * gb_law_rod_stiffness(&model->rod, y[0]) * y[1]);
    return 0;
}

/* Speed after over speed before, by an eighth-order method with step control, until h =
 * 0. */
static double exact_restitution(const struct gb_model *model, double speed)
{
    gsl_odeiv2_system system = {collision, NULL, 2, (void *)(uintptr_t)model};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-15, 1e-13);
    double y[2] = {0.0, speed}, time = 0.0, before[2] = {0}, last = 0.0;
    while (y[0] >= 0.0) {
        last = time;
        memcpy(before, y, sizeof y);
        gsl_odeiv2_driver_apply(driver, &time, time + 0.05, y);
    }
    double low = 0.0, high = time - last;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        double z[2] = {before[0], before[1]}, from = last;
        gsl_odeiv2_driver_reset(driver);
        gsl_odeiv2_driver_apply(driver, &from, last + middle, z);
        if (z[0] >= 0.0) {
            low = middle;
        } else {
            high = middle;
        }
        memcpy(y, z, sizeof y);
    }
    gsl_odeiv2_driver_free(driver);
    return -y[1] / speed;
}

/* Restitution against velocity agrees with the exact solution. */
static void test_restitution(void)
{
    const struct gb_params params = dynamic_params(
        "material.epsilon=0 kB", "contact.bridge_length=1 d", "contact.mu=0");
    for (double speed = 1e-3; speed < 0.05; speed *= 3.0) {
        struct duo duo;
        const double apart[3] = {1.0 + 1e-9, 0.0, 0.0};
        meet(&duo, &params, apart);
        duo.verlet.velocity[0] = 0.5 * speed;
        duo.verlet.velocity[3] = -0.5 * speed;
        bool touched = false;
        for (int i = 0; i < 2000000; i++) {
            step(&duo, 1e-3);
            const bool touching = gb_world_tally(duo.world)->contacts > 0;
            if (touched && !touching) {
                break;
            }
            touched = touching;
        }
        const double out = duo.verlet.velocity[3] - duo.verlet.velocity[0];
        const double exact = exact_restitution(&duo.model, speed);
        g_test_message("speed %g: restitution %.8f, exact %.8f", speed, out / speed,
                       exact);
        g_assert_cmpfloat(exact, <, 1.0 - 1e-4);
        g_assert_cmpfloat_with_epsilon(out / speed, exact, 1e-6);
        part(&duo);
    }
}

/* Energy that two bridged particles lose in 200 steps of shear or of rolling, over what
 * they began with. */
static double lost(const char *forces, bool rolling)
{
    const struct gb_params params =
        dynamic_params("contact.bridge_length=0.008 d", "contact.mu=2", forces);
    struct duo duo;
    static const double apart[3] = {1.02, 0.0, 0.0};
    meet(&duo, &params, apart);
    const struct gb_bodies b = gb_world_bodies(duo.world);
    b.position[3] = b.position[0] + 1.0 - duo.model.h_eq;
    scene_evaluate(duo.world);
    scene_evaluate(duo.world); /* at rest: no viscous force */
    duo.verlet.velocity[1] = rolling ? 0.0 : 1e-6;
    duo.verlet.velocity[4] = rolling ? 0.0 : -1e-6;
    duo.verlet.spin[2] = rolling ? 1e-6 : 0.0;
    duo.verlet.spin[5] = rolling ? -1e-6 : 0.0;
    const double before = gb_verlet_kinetic(&duo.verlet);
    const double stored = gb_observe_elastic(duo.world);
    gb_world_set_step(duo.world, 0.01);
    for (int i = 0; i < 200; i++) {
        step(&duo, 0.01);
    }
    const double after = gb_verlet_kinetic(&duo.verlet);
    const double loss = before - after - (gb_observe_elastic(duo.world) - stored);
    part(&duo);
    return loss / before;
}

/* contact.viscous_forces names the springs that lose energy: shear, rolling. */
static void test_viscous_forces(void)
{
    static const struct {
        const char *set;
        bool shear, rolling;
    } cases[] = {{"contact.viscous_forces=all", true, true},
                 {"contact.viscous_forces=translation", true, false},
                 {"contact.viscous_forces=normal", false, false}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        const double shear = lost(cases[i].set, false);
        const double rolling = lost(cases[i].set, true);
        g_test_message("%s: lost %.3e in shear, %.3e in rolling", cases[i].set, shear,
                       rolling);
        g_assert_true(cases[i].shear ? shear > 1e-4 : fabs(shear) < 1e-5);
        g_assert_true(cases[i].rolling ? rolling > 1e-5 : fabs(rolling) < 1e-7);
    }
}

/* An oblique blow with friction, bridge and attraction keeps linear and angular momentum.
 */
static void test_momentum(void)
{
    const struct gb_params params = dynamic_params(
        "contact.mu=0.5", "contact.bridge_length=0.008 d", "structure.seed=1");
    struct duo duo;
    const double apart[3] = {0.9, 0.3, 0.5};
    meet(&duo, &params, apart);
    double *v = duo.verlet.velocity, *w = duo.verlet.spin;
    const double start_v[6] = {0.03, 0.01, 0.02, -0.03, -0.01, -0.02};
    const double start_w[6] = {0.02, -0.03, 0.01, 0.05, 0.02, -0.01};
    memcpy(v, start_v, sizeof start_v);
    memcpy(w, start_w, sizeof start_w);
    double first[3] = {0}, momentum[3], angular[3];
    for (int i = 0; i < 1200; i++) { /* not as far as the edge of the cell */
        const double *x = gb_world_position(duo.world);
        for (int k = 0; k < 3; k++) {
            momentum[k] = v[k] + v[3 + k];
            angular[k] = duo.verlet.inertia * (w[k] + w[3 + k]);
        }
        for (int p = 0; p < 2; p++) {
            double moment[3];
            gb_vec_cross(x + 3 * p, v + 3 * p, moment);
            gb_vec_add(angular, 1.0, moment);
        }
        if (i == 0) {
            memcpy(first, angular, sizeof first);
        }
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(momentum[k], 0.0, 1e-14);
            g_assert_cmpfloat_with_epsilon(angular[k], first[k], 1e-13);
        }
        step(&duo, 0.05);
    }
    part(&duo);
}

struct outcome {
    enum gb_step_outcome end;
    double density, residual, residual_most, kinetic_least, dissipated_least;
    int points, guards;
    char first[200]; /* what the first guard said */
    uint64_t hash;
};

/* All stages on a small scene. */
static struct outcome press(const struct gb_params *params, int64_t slice)
{
    struct gb_model model = scene_model(params);
    struct gb_world *world = scene_world(&model);
    struct gb_dynamic *motion = NULL;
    struct gb_error err = {0};
    struct outcome out = {0};
    char text[500];
    gb_world_set_step(world, 1.0);
    scene_evaluate(world);
    const double stored = gb_observe_elastic(world);
    double dissipated = 0.0;
    g_assert_true(gb_loading_dynamic_create(&motion, world, &err));
    do {
        out.end =
            gb_loading_dynamic_advance(motion, world, slice, text, sizeof text, &err);
        if (text[0] != '\0' && out.guards++ == 0) {
            g_strlcpy(out.first, text, sizeof out.first);
        }
        if (out.end == GB_STEP_POINT) {
            const struct gb_loading_dynamic_report report =
                gb_loading_dynamic_report(motion);
            out.points++;
            out.residual = fabs(report.work - report.kinetic - report.absorbed) /
                           fmax(fabs(report.work), 1e-30);
            out.residual_most =
                fmax(out.residual_most, report.work != 0.0 ? out.residual : 0.0);
            const double lost = report.absorbed - (gb_observe_elastic(world) - stored);
            out.dissipated_least = fmin(out.dissipated_least, lost - dissipated);
            dissipated = lost;
        }
    } while (out.end == GB_STEP_MORE || out.end == GB_STEP_POINT);
    out.density = gb_observe_density(world);
    out.hash = gb_world_hash(world);
    gb_loading_dynamic_destroy(motion);
    gb_world_destroy(world);
    return out;
}

static struct gb_params planar(const char *time_step, const char *more)
{
    return scene_params("scene.kind=dynamic", "scene.dimension=2", "particles.count=250",
                        "contact.mu=0.5", "loading.geometry=isotropic",
                        "loading.until=density = 0.95", "loading.relax=0.2 ns",
                        "loading.hold=0.2 ns", "loading.rate=6.8e8 1/s", time_step, more,
                        NULL);
}

static void test_energy(void)
{
    const struct gb_params params =
        planar("numerics.time_step=0.04 T", "structure.seed=2");
    const struct outcome out = press(&params, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpfloat_with_epsilon(out.density, 0.95, 1e-9);
    g_test_message("energy residual %.2e of the work", out.residual);
    g_assert_cmpfloat(out.residual, <, 1e-3);
    g_assert_cmpint(out.points, >, 500);
    g_assert_cmpint(out.guards, ==, 0);
}

/* However fast the pressing, no automatic step strains the cell so much that the work of
 * its forces is unknown. */
static void test_fast(void)
{
    const struct gb_params params = scene_params(
        "scene.kind=dynamic", "structure.density=0.3", "loading.rate=1e12 1/s",
        "loading.until=density = 0.36", "loading.record=1 %", "loading.relax=0.01 ns",
        "loading.hold=0 ns", NULL);
    const struct outcome out = press(&params, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_test_message("energy residual at most %.2e, at the end %.2e of the work",
                   out.residual_most, out.residual);
    g_assert_cmpfloat(out.residual_most, <, 0.015);
    g_assert_cmpfloat(out.residual, <, 5e-4);
}

/* Without attraction no contact bounds the step of a packing before the first collisions,
 * nor between two of them. */
static void test_free(void)
{
    const struct gb_params params = scene_params(
        "scene.kind=dynamic", "scene.dimension=2", "particles.count=140",
        "material.epsilon=0 kB", "contact.mu=0.5", "structure.density=0.5",
        "loading.rate=6.8e7 1/s", "loading.until=density = 0.52", "loading.record=0.2 %",
        "loading.relax=1 ns", "loading.hold=1 ns", "loading.record_time=0.5 ns", NULL);
    const struct outcome out = press(&params, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_test_message("energy residual at most %.2e, at the end %.2e of the work",
                   out.residual_most, out.residual);
    g_assert_cmpfloat(out.residual_most, <, 5e-3);
}

/* Slices of any length, threads in any number: same bits. */
static void test_repeat(void)
{
    const struct gb_params one = planar("numerics.time_step=0.3 T", "numerics.threads=1");
    const struct gb_params three =
        planar("numerics.time_step=0.3 T", "numerics.threads=3");
    const struct outcome a = press(&one, 1), b = press(&one, 17), c = press(&three, 1000);
    g_assert_cmpuint(a.hash, ==, b.hash);
    g_assert_cmpuint(a.hash, ==, c.hash);
}

/* Half a T passes unguarded; a step above the critical one is cut and told, and the run
 * ends as it should; auto needs no guard. */
static void test_guards(void)
{
    const struct gb_params half = planar("numerics.time_step=0.5 T", "structure.seed=2");
    const struct gb_params whole =
        planar("numerics.time_step=1 T", "contact.relative_motion=full");
    const struct gb_params wild = planar("numerics.time_step=3 T", "structure.seed=2");
    const struct gb_params automatic =
        planar("numerics.time_step=auto", "structure.seed=2");
    struct outcome out = press(&half, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpint(out.guards, ==, 0);
    out = press(&whole, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpint(out.guards, >, 0);
    out = press(&wild, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpint(out.guards, >, 0);
    g_assert_cmpfloat(out.residual, <, 2e-2);
    out = press(&automatic, 1000);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpint(out.guards, ==, 0);
    g_assert_cmpfloat(out.residual, <, 2e-3);
}

/* Full relative motion at v2: at 1 T friction caps hide that the step is about to become
 * unstable; half a T passes.  The sliding contacts show it at about the density where the
 * estimate of the critical step says so: which guard is first is decided by rounding, in
 * each packing: this one in about a third of them (27 of 88).  Either halves the step; of
 * 18 packings one at least shows this one at work (all but one time in a thousand). */
static void test_sliding(void)
{
    int slid = 0;
    for (int seed = 5; seed <= 10 || (slid == 0 && seed <= 22); seed++) {
        char assignment[32];
        snprintf(assignment, sizeof assignment, "structure.seed=%d", seed);
        struct gb_params params = planar("numerics.time_step=0.5 T", assignment);
        params.relative_motion = GB_MOTION_FULL;
        params.rate_per_s = 6.8e7;
        params.record_density = 0.02;
        struct outcome out = press(&params, 1000);
        g_assert_cmpint(out.end, ==, GB_STEP_DONE);
        g_assert_cmpint(out.guards, ==, 0);
        params.time_step.value = 1.0;
        out = press(&params, 1000);
        g_test_message("%s", out.first);
        g_assert_cmpint(out.end, ==, GB_STEP_DONE);
        g_assert_cmpint(out.guards, >=, 1);
        const bool by_sliding = strstr(out.first, "of the contacts slide; time step "
                                                  "halved to 0.5 T") != NULL;
        g_assert_true(by_sliding || strstr(out.first, "above the critical") != NULL);
        slid += by_sliding;
    }
    g_assert_cmpint(slid, >=, 1);
}

/* Little friction and no bridges: many contacts slide at any step.  The guard tries half
 * the step, sees that it is not the cause, and the run goes on as ordered. */
static void test_slippery(void)
{
    struct gb_params params = planar("numerics.time_step=0.3 T", "contact.mu=0.05");
    params.bridge_length = (struct gb_relative){1.0, true};
    const struct outcome out = press(&params, 1000);
    g_test_message("%d lines, first: %s", out.guards, out.first);
    g_assert_cmpint(out.end, ==, GB_STEP_DONE);
    g_assert_cmpfloat_with_epsilon(out.density, 0.95, 1e-9);
    g_assert_cmpint(out.guards, >=, 2); /* halved, and given back */
    g_assert_cmpint(out.guards, <=, 8);
}

/* The estimate of the highest frequency against the pair whose modes are known: shear and
 * rotation together, omega^2 = k_t/2 (2 + 1/(2 J)); and what happens on both sides of
 * 2/omega. */
static double drift_after(double share, double *frequency)
{
    const struct gb_params params =
        dynamic_params("contact.mu=2", "contact.viscosity=0 Pa s", "contact.alpha=0.24");
    struct duo duo;
    double scratch[2];
    const double h = 0.0157, apart[3] = {1.0 - h, 0.0, 0.0};
    meet(&duo, &params, apart);
    const double shear = gb_law_slip_shear_stiffness(&duo.model.slip, 0.5 * sqrt(h));
    const double omega = sqrt(0.5 * shear * (2.0 + 0.5 / duo.model.dynamics.inertia));
    *frequency = gb_verlet_frequency(duo.world, scratch) / omega;
    duo.verlet.velocity[1] = 1e-7;
    duo.verlet.velocity[4] = -1e-7;
    for (int i = 0; i < 200; i++) {
        step(&duo, share * 2.0 / omega);
    }
    const double kinetic = gb_verlet_kinetic(&duo.verlet) / 1e-14;
    part(&duo);
    return kinetic;
}

static void test_critical(void)
{
    double frequency;
    g_assert_cmpfloat(drift_after(0.95, &frequency), <, 100.0);
    g_assert_cmpfloat(drift_after(1.05, &frequency), >, 1e4);
    /* the estimate halves the sum over contacts; a lone pair has one */
    g_assert_cmpfloat_with_epsilon(frequency, sqrt(0.5), 1e-9);
}

/* Time step of holding over that of loading, and the pressure 20 ps after the end of
 * loading, which has the usual error of a step; the hold has the given one. */
static double hold(double step_error, double *pressure)
{
    const struct gb_params params = planar("numerics.time_step=auto", "structure.seed=2");
    struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_dynamic *motion = NULL;
    struct gb_error err = {0};
    char text[500];
    double loading = 0.0, holding = 0.0, tensor[3][3];
    gb_world_set_step(world, 1.0);
    scene_evaluate(world);
    g_assert_true(gb_loading_dynamic_create(&motion, world, &err));
    for (int points = 0; points < 1;) {
        const enum gb_step_outcome outcome =
            gb_loading_dynamic_advance(motion, world, 1000, text, sizeof text, &err);
        g_assert_true(outcome == GB_STEP_POINT || outcome == GB_STEP_MORE);
        const struct gb_loading_dynamic_report report = gb_loading_dynamic_report(motion);
        const bool holds = report.stage == GB_DYNAMIC_HOLD;
        *(holds ? &holding : &loading) = report.time_step;
        points += holds && outcome == GB_STEP_POINT;
        if (gb_observe_density(world) >= model.until_density - 1e-9) {
            model.dynamics.step_error = step_error;
        }
    }
    gb_observe_pressure(world, tensor);
    *pressure = tensor[0][0] + tensor[2][2];
    gb_loading_dynamic_destroy(motion);
    gb_world_destroy(world);
    return holding / loading;
}

/* Nothing is driven while the packing is held: the usual error allows the step of
 * stability there, and gives the pressure of a ten times shorter one. */
static void test_hold(void)
{
    double usual, exact;
    const double longer = hold(1e-3, &usual), shorter = hold(1e-6, &exact);
    g_test_message("steps %.2f and %.2f of those of loading: p differs by %.1e", longer,
                   shorter, usual / exact - 1.0);
    g_assert_cmpfloat(longer, >, 3.0);
    g_assert_cmpfloat(shorter, <, 0.2 * longer);
    g_assert_cmpfloat(fabs(usual / exact - 1.0), <, 5e-4);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/motion/restitution", test_restitution);
    g_test_add_func("/motion/viscous-forces", test_viscous_forces);
    g_test_add_func("/motion/momentum", test_momentum);
    g_test_add_func("/motion/energy", test_energy);
    g_test_add_func("/motion/fast", test_fast);
    g_test_add_func("/motion/free", test_free);
    g_test_add_func("/motion/repeat", test_repeat);
    g_test_add_func("/motion/guards", test_guards);
    g_test_add_func("/motion/sliding", test_sliding);
    g_test_add_func("/motion/slippery", test_slippery);
    g_test_add_func("/motion/critical", test_critical);
    g_test_add_func("/motion/hold", test_hold);
    return g_test_run();
}
