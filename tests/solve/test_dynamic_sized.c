/* Dynamic scenes of particles of unequal sizes, and compressed along one axis: motion of
 * a pair against exact results, one size against the scenes of one size, energies, bits,
 * and the quasi-static curve as the limit of slow pressing. */
#include <glib.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "measure/observe.h"
#include "scene/unequal_pair.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_dynamic.h"
#include "solve/verlet.h"

/* Spheres of 6 and 17 nm in a wide cell. */
struct duo {
    struct gb_model model;
    struct gb_law_unequal law;
    struct gb_world *world;
    struct gb_verlet verlet;
    double d[2], mass[2];
};

static struct gb_params duo_params(const char *a, const char *b, const char *c)
{
    return scene_params("scene.kind=dynamic", "loading.until=density = 0.6",
                        "particles.distribution=table",
                        "particles.table=number: 6 nm 0.5; 17 nm 0.5", a, b, c, NULL);
}

/* r: of the second from the first, in the distance at which they touch. */
static void meet(struct duo *duo, const struct gb_params *params, const double r[3])
{
    struct gb_error err = {0};
    duo->model = scene_model(params);
    duo->model.count = 2;
    duo->model.edges[0] = duo->model.edges[1] = duo->model.edges[2] = 14.0;
    double position[6] = {5.0, 7.0, 7.0, 5.0, 7.0, 7.0};
    g_assert_true(gb_verlet_init(&duo->verlet, &duo->model, &err));
    g_assert_true(gb_world_create(&duo->world, &duo->model, position, &err));
    for (int p = 0; p < 2; p++) {
        duo->d[p] = gb_world_diameter(duo->world, p);
        duo->mass[p] = pow(duo->d[p], 3.0);
    }
    g_assert_cmpfloat(fabs(duo->d[0] - duo->d[1]), >, 0.5);
    gb_unequal_pair_init(&duo->law, &duo->model, duo->d[0], duo->d[1]);
    const struct gb_bodies b = gb_world_bodies(duo->world);
    for (int k = 0; k < 3; k++) {
        b.position[3 + k] += duo->law.mean_diameter * r[k];
    }
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

/* h'' = -(f_e + A f_e' h') (1/m_i + 1/m_j), P2 (1), (3). */
static int collision(double time, const double y[], double dydt[], void *data)
{
    (void)time;
    const struct duo *duo = data;
    double slope = 0.0;
    const double force = gb_law_unequal_elastic(&duo->law, 0.0, fmax(y[0], 0.0), &slope);
    dydt[0] = y[1];
    dydt[1] = -(force + duo->model.dynamics.viscous * slope * y[1]) *
              (1.0 / duo->mass[0] + 1.0 / duo->mass[1]);
    return 0;
}

/* Overlap after a time, by an eighth-order method with step control. */
static double exact_overlap(struct duo *duo, double speed, double duration)
{
    gsl_odeiv2_system system = {collision, NULL, 2, duo};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-15, 1e-13);
    double y[2] = {0.0, speed}, time = 0.0;
    gsl_odeiv2_driver_apply(driver, &time, duration, y);
    gsl_odeiv2_driver_free(driver);
    return y[0];
}

/* A central blow: overlap near the middle and near the end of the contact. */
static void test_collision(void)
{
    const struct gb_params params =
        duo_params("material.epsilon=0 kB", "contact.bridge_length=1 d", "contact.mu=0");
    static const double touch[3] = {1.0, 0.0, 0.0};
    const double speed = 0.01, length = 1e-3;
    struct duo duo;
    meet(&duo, &params, touch);
    const double both = duo.mass[0] + duo.mass[1];
    duo.verlet.velocity[0] = speed * duo.mass[1] / both;
    duo.verlet.velocity[3] = -speed * duo.mass[0] / both;
    double most = 0.0;
    for (int i = 1; i <= 8000; i++) {
        step(&duo, length);
        const double *x = gb_world_position(duo.world);
        const double h = duo.law.mean_diameter - (x[3] - x[0]);
        most = fmax(most, h);
        if (i % 2000 == 0 && h > 0.0) {
            const double exact = exact_overlap(&duo, speed, i * length);
            g_test_message("t %g: h %.9f, exact %.9f", i * length, h, exact);
            g_assert_cmpfloat_with_epsilon(h, exact, 1e-5 * most);
        }
    }
    g_assert_cmpfloat(most, >, 0.005);
    part(&duo);
}

/* An oblique blow with friction, bridge and attraction: sum of m v, and of m x v + J w with
 * J = m d^2/10 and spins that are arcs. */
static void test_momentum(void)
{
    const struct gb_params params =
        duo_params("contact.mu=0.5", "contact.bridge_length=0.008 d", "structure.seed=1");
    static const double apart[3] = {0.9, 0.3, 0.5};
    static const double velocity[2][3] = {{0.03, 0.01, 0.02}, {-0.03, -0.01, -0.02}};
    static const double arc[2][3] = {{0.02, -0.03, 0.01}, {0.05, 0.02, -0.01}};
    struct duo duo;
    meet(&duo, &params, apart);
    double *v = duo.verlet.velocity, *w = duo.verlet.spin;
    double start[3], momentum[3], angular[3], most = 0.0;
    for (int k = 0; k < 6; k++) {
        v[k] = velocity[k / 3][k % 3] / duo.mass[k / 3];
        w[k] = arc[k / 3][k % 3];
    }
    for (int i = 0; i < 400; i++) { /* not as far as the edge of the cell */
        const double *x = gb_world_position(duo.world);
        memset(angular, 0, sizeof angular);
        memset(momentum, 0, sizeof momentum);
        for (int p = 0; p < 2; p++) {
            double moment[3];
            gb_vec_cross(x + 3 * p, v + 3 * p, moment);
            gb_vec_add(angular, duo.mass[p], moment);
            gb_vec_add(angular, duo.mass[p] * duo.d[p] / 10.0, w + 3 * p);
            gb_vec_add(momentum, duo.mass[p], v + 3 * p);
        }
        if (i == 0) {
            memcpy(start, angular, sizeof start);
        }
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(momentum[k], 0.0, 1e-13);
            g_assert_cmpfloat_with_epsilon(angular[k], start[k], 1e-12);
        }
        most = fmax(most, gb_world_tally(duo.world)->deepest);
        step(&duo, 0.05);
    }
    g_assert_cmpfloat(most, >, 0.01); /* they met */
    part(&duo);
}

/* Kinetic energy of tangential motion after 200 steps of this share of the critical one,
 * 2/omega with omega^2 = k_t/2 (1/m_i + 1/m_j) (1 + 1/(4 J)); frequency: the estimate over
 * omega. */
static double drift_after(double share, double *frequency)
{
    const struct gb_params params =
        duo_params("contact.mu=2", "contact.viscosity=0 Pa s", "structure.seed=1");
    struct duo duo;
    double scratch[2];
    static const double apart[3] = {1.02, 0.0, 0.0};
    meet(&duo, &params, apart);
    const double h = gb_law_unequal_equilibrium(&duo.law); /* no motion along x */
    const struct gb_bodies b = gb_world_bodies(duo.world);
    b.position[3] = b.position[0] + duo.law.mean_diameter - h;
    scene_evaluate(duo.world);
    const double a = gb_law_unequal_radius(&duo.law, h);
    const double shear = gb_law_slip_shear_stiffness(&duo.model.slip, a);
    const double omega = sqrt(0.5 * shear * (1.0 / duo.mass[0] + 1.0 / duo.mass[1]) *
                              (1.0 + 0.25 / duo.verlet.inertia));
    *frequency = gb_verlet_frequency(duo.world, scratch) / omega;
    duo.verlet.velocity[1] = 1e-7 / duo.mass[0];
    duo.verlet.velocity[4] = -1e-7 / duo.mass[1];
    const double before = gb_verlet_kinetic(&duo.verlet);
    for (int i = 0; i < 200; i++) {
        step(&duo, share * 2.0 / omega);
    }
    const double kinetic = gb_verlet_kinetic(&duo.verlet) / before;
    part(&duo);
    return kinetic;
}

/* The estimate halves the sum over contacts; a lone pair has one, so that it comes out
 * between sqrt(1/2) of the frequency and, by the bound of its row, a little more. */
static void test_critical(void)
{
    double frequency;
    g_assert_cmpfloat(drift_after(0.95, &frequency), <, 100.0);
    g_assert_cmpfloat(drift_after(1.05, &frequency), >, 1e4);
    g_test_message("estimate over the frequency of the pair: %.4f", frequency);
    g_assert_cmpfloat(frequency, >=, sqrt(0.5));
    g_assert_cmpfloat(frequency, <, 0.9);
}

struct outcome {
    double density, pressure, coordination;
    double balance; /* what is left of the work; this and the next two over the work */
    double dissipated_least; /* least increase of the dissipated energy */
    double dissipated;
    uint64_t hash;
    int points;
};

/* All stages on a small scene. */
static struct outcome press(const struct gb_params *params, int64_t slice)
{
    const struct gb_model model = scene_model(params);
    struct gb_world *world = scene_world(&model);
    struct gb_dynamic *motion = NULL;
    struct gb_error err = {0};
    struct outcome out = {0};
    struct gb_contact_counts counts;
    char text[500];
    enum gb_step_outcome end;
    double dissipated = 0.0, work = 0.0, pressure[3][3];
    gb_world_set_step(world, 1.0);
    scene_evaluate(world);
    const double stored = gb_observe_elastic(world);
    g_assert_true(gb_loading_dynamic_create(&motion, world, &err));
    do {
        end = gb_loading_dynamic_advance(motion, world, slice, text, sizeof text, &err);
        if (end == GB_STEP_POINT) {
            const struct gb_loading_dynamic_report report =
                gb_loading_dynamic_report(motion);
            const double lost = report.absorbed - (gb_observe_elastic(world) - stored);
            out.points++;
            work = report.work;
            out.balance = fabs(report.work - report.kinetic - report.absorbed);
            out.dissipated_least = fmin(out.dissipated_least, lost - dissipated);
            dissipated = lost;
        }
    } while (end == GB_STEP_MORE || end == GB_STEP_POINT);
    g_assert_cmpint(end, ==, GB_STEP_DONE);
    g_assert_cmpfloat(work, >, 0.0);
    out.balance /= work;
    out.dissipated_least /= work;
    out.dissipated = dissipated / work;
    out.density = gb_observe_density(world);
    gb_observe_pressure(world, pressure);
    out.pressure = pressure[2][2];
    gb_observe_contacts(world, &counts, NULL, 0, NULL);
    out.coordination = counts.coordination;
    out.hash = gb_world_hash(world);
    gb_loading_dynamic_destroy(motion);
    gb_world_destroy(world);
    return out;
}

/* Short stages at v1: discs or spheres, compressed along all axes or one. */
static struct gb_params scene(int dimension, const char *geometry, const char *sizes,
                              const char *table)
{
    const bool plane = dimension == 2;
    struct gb_params params = scene_params(
        "scene.kind=dynamic", plane ? "scene.dimension=2" : "scene.dimension=3",
        "contact.mu=0.5", geometry, plane ? "particles.count=100" : "particles.count=300",
        plane ? "loading.until=density = 0.8" : "loading.until=density = 0.4",
        "loading.rate=6.8e8 1/s", "loading.relax=10 ps", "loading.hold=20 ps", sizes,
        table, NULL);
    return params;
}

static struct gb_params unequal(int dimension, const char *geometry)
{
    struct gb_params params = scene(dimension, geometry, "particles.sigma=0.25", NULL);
    struct gb_error err = {0};
    g_assert_true(gb_params_assign(&params, "particles.distribution=lognormal", &err) &&
                  gb_params_assign(&params, "particles.largest=20 nm", &err));
    return params;
}

static const char *const geometries[] = {"loading.geometry=isotropic",
                                         "loading.geometry=uniaxial",
                                         "loading.geometry=biaxial"};

/* Dimension and geometry of all scenes; discs have two axes. */
static const int scenes[][2] = {{3, 0}, {3, 1}, {3, 2}, {2, 0}, {2, 1}};

/* work = kinetic + absorbed, absorbed = elastic + dissipated, which only grows. */
static void check_energy(const struct gb_params *params)
{
    const struct outcome out = press(params, 1000);
    g_test_message("balance %.2e, least increase %.2e, dissipated %.3f of the work",
                   out.balance, out.dissipated_least, out.dissipated);
    g_assert_cmpfloat_with_epsilon(out.density, params->until_density, 1e-9);
    g_assert_cmpfloat(out.balance, <, 1e-3);
    g_assert_cmpfloat(out.dissipated_least, >, -1e-3);
    g_assert_cmpfloat(out.dissipated, >, 0.2);
    g_assert_cmpfloat(out.dissipated, <, 1.2); /* attraction gives some of it */
    g_assert_cmpint(out.points, >, 300);
}

static void test_energy(void)
{
    for (size_t s = 0; s < G_N_ELEMENTS(scenes); s++) {
        const char *geometry = geometries[scenes[s][1]];
        g_test_message("%dD, %s", scenes[s][0], geometry);
        const struct gb_params sized = unequal(scenes[s][0], geometry);
        const struct gb_params equal = scene(scenes[s][0], geometry, NULL, NULL);
        check_energy(&sized);
        check_energy(&equal);
    }
}

/* A table of one size: as the scenes of one size, whose sweeps are other code, with each
 * choice of the viscous forces. */
static void test_one_size(void)
{
    for (size_t s = 0; s < G_N_ELEMENTS(scenes); s++) {
        const char *geometry = geometries[scenes[s][1]];
        struct gb_params plain = scene(scenes[s][0], geometry, NULL, NULL);
        struct gb_params table =
            scene(scenes[s][0], geometry, "particles.distribution=table",
                  "particles.table=number: 9.7 nm 1");
        plain.viscous_forces = table.viscous_forces = (int)s % 3;
        plain.time_step = table.time_step = (struct gb_relative){0.2, true};
        plain.until_density = table.until_density = scenes[s][0] == 2 ? 0.6 : 0.3;
        const struct outcome one = press(&plain, 1000), many = press(&table, 1000);
        g_test_message("%dD, %s: %.12g, %.12g", scenes[s][0], geometry, one.pressure,
                       many.pressure);
        g_assert_cmpfloat_with_epsilon(one.pressure, many.pressure,
                                       1e-6 * fabs(one.pressure));
        g_assert_cmpfloat_with_epsilon(one.dissipated, many.dissipated, 1e-4);
        g_assert_cmpfloat(one.coordination, ==, many.coordination);
    }
}

/* Slices of any length, threads in any number: same bits. */
static void test_repeat(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        struct gb_params params = unequal(dimension, "loading.geometry=uniaxial");
        params.until_density = dimension == 2 ? 0.54 : 0.26;
        params.relax_s = params.hold_s = 2e-12;
        params.threads = 1;
        const struct outcome a = press(&params, 1), b = press(&params, 17);
        params.threads = 2;
        const struct outcome c = press(&params, 1000);
        g_assert_cmpuint(a.hash, ==, b.hash);
        g_assert_cmpuint(a.hash, ==, c.hash);
    }
}

/* Mean of p_z over the density from 0.55 on, of a scene of either kind. */
static double mean_pressure(const struct gb_params *params)
{
    const struct gb_model model = scene_model(params);
    struct gb_loading *loading = NULL;
    struct gb_error err = {0};
    struct gb_event_queue events = {0};
    enum gb_step_outcome outcome = GB_STEP_MORE;
    double before = NAN, sum = 0.0, range = 0.0;
    g_assert_true(gb_loading_create(&loading, params, &model, NULL, NULL, &err));
    while (outcome == GB_STEP_MORE) {
        outcome = loading->mode->advance(loading, 1000, &events, &err);
        if (outcome == GB_STEP_POINT) {
            double pressure[3][3];
            const double density = gb_observe_density(loading->world);
            gb_observe_pressure(loading->world, pressure);
            if (before >= 0.55) {
                sum += pressure[2][2] * (density - before);
                range += density - before;
            }
            before = density;
            outcome = loading->mode->after_point(loading, &events, &err);
        }
    }
    g_assert_cmpint(outcome, ==, GB_STEP_DONE);
    gb_loading_destroy(loading);
    return sum / range;
}

/* Discs compressed along z, of one size and of several: slow pressing needs the pressure of
 * the quasi-static scene within the scatter of small cells, fast pressing far more. */
static void check_slow(const char *distribution)
{
    static const double rates[] = {6.8e7, 6.8e9};
    double still = 0.0, moving[2] = {0.0, 0.0};
    for (int seed = 1; seed <= 2; seed++) {
        struct gb_params params = scene_params(
            "scene.dimension=2", "particles.count=100", "contact.mu=0.5", distribution,
            "particles.sigma=0.25", "particles.largest=20 nm",
            "loading.until=density=0.75", "loading.relax=0.5 ns", "loading.hold=0 s",
            "loading.step=0.2 %", "loading.record=0.2 %", NULL);
        params.seed = (uint64_t)seed;
        still += mean_pressure(&params);
        params.kind = GB_KIND_DYNAMIC;
        for (int r = 0; r < 2; r++) {
            params.rate_per_s = rates[r];
            moving[r] += mean_pressure(&params);
        }
    }
    g_test_message(
        "%s: p_z over the quasi-static one: %.3f at 6.8e7 1/s, %.3f at 6.8e9 1/s",
        distribution, moving[0] / still, moving[1] / still);
    g_assert_cmpfloat(still, >, 0.0);
    g_assert_cmpfloat_with_epsilon(moving[0], still, 0.4 * still);
    g_assert_cmpfloat(moving[1], >, 2.0 * still);
}

static void test_slow(void)
{
    check_slow("particles.distribution=mono");
    check_slow("particles.distribution=lognormal");
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/motion/sized/collision", test_collision);
    g_test_add_func("/motion/sized/momentum", test_momentum);
    g_test_add_func("/motion/sized/critical", test_critical);
    g_test_add_func("/motion/sized/energy", test_energy);
    g_test_add_func("/motion/sized/one-size", test_one_size);
    g_test_add_func("/motion/sized/repeat", test_repeat);
    g_test_add_func("/motion/sized/slow", test_slow);
    return g_test_run();
}
