/* The elastic contact of P3: Hertz, its damping and time step, shear in increments. */
#include <math.h>

#include <glib.h>

#include "base/vec.h"
#include "common/exact.h"
#include "common/mindlin.h"
#include "law/law_hertz.h"

static const struct gb_elastic nial = {180e9, 0.30};
static const double yield_nial = 800e6;

static struct gb_law_hertz nial_pair(void)
{
    struct gb_law_hertz law;
    gb_law_hertz_init(&law, &nial, &nial);
    return law;
}

/* (3), (4), (13) as printed, for materials and sizes that differ. */
static void test_effective_values(void)
{
    const struct gb_elastic other = {382e9, 0.25};
    struct gb_law_hertz law, swapped;
    gb_law_hertz_init(&law, &nial, &other);
    gb_law_hertz_init(&swapped, &other, &nial);
    assert_close(1.0 / law.modulus, 0.91 / 180e9 + 0.9375 / 382e9, 1e-14);
    assert_close(1.0 / law.shear, 1.7 * 2.6 / 180e9 + 1.75 * 2.5 / 382e9, 1e-14);
    assert_close(swapped.modulus, law.modulus, 1e-15);
    assert_close(swapped.shear, law.shear, 1e-15);
    const struct gb_elastic rigid = {1e30, 0.0};
    gb_law_hertz_init(&law, &nial, &rigid);
    assert_close(law.modulus, 180e9 / 0.91, 1e-12);
    assert_close(gb_law_hertz_radius(10e-6, 2e-6), 1.0 / (1e5 + 5e5), 1e-15);
    g_assert_cmpfloat(gb_law_hertz_radius(3e-6, INFINITY), ==, 3e-6);
    g_assert_cmpfloat(gb_law_hertz_radius(INFINITY, 3e-6), ==, 3e-6);
    assert_close(gb_law_hertz_radius(3e-6, 1e6), 3e-6, 1e-11);
}

/* P3: h = 2.09e-9 m, F = 2.822e-5 N for two equal spheres of 10 um, (30). */
static void test_yield_of_pair(void)
{
    const struct gb_law_hertz law = nial_pair();
    const double r = 10e-6, radius = gb_law_hertz_radius(r, r);
    const double force = gb_law_hertz_yield_force(&law, radius, yield_nial);
    assert_close(force, 2.822e-5, 2e-3);
    assert_close(gb_law_hertz_overlap(&law, radius, force), 2.09e-9, 2e-3);
    const double printed = pow(1.61, 3) * pow(G_PI, 3) * r * r * 0.91 * 0.91 /
                           (6.0 * 180e9 * 180e9) * pow(yield_nial, 3);
    assert_close(force, printed, 1e-13);
    /* greatest pressure of Hertz' contact: (6 F E*^2 / (pi^3 R*^2))^(1/3) */
    const double small = gb_law_hertz_radius(10e-6, 2e-6);
    const double onset = gb_law_hertz_yield_force(&law, small, yield_nial);
    assert_close(
        cbrt(6.0 * onset * law.modulus * law.modulus / (pow(G_PI, 3) * small * small)),
        1.61 * yield_nial, 1e-13);
}

static const double radii[] = {5e-6, 1.6e-6, 18.5e-6};

struct at_radius {
    struct gb_law_hertz law;
    double radius;
};

static double energy(const void *at, double h)
{
    const struct at_radius *pair = at;
    return gb_law_hertz_energy(&pair->law, pair->radius, h);
}

static double force(const void *at, double h)
{
    const struct at_radius *pair = at;
    return gb_law_hertz_force(&pair->law, pair->radius, h);
}

static void test_force_is_slope_of_energy(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(radii); i++) {
        struct at_radius pair = {nial_pair(), radii[i]};
        const double modulus = pair.law.modulus;
        for (double h = 1e-12; h < radii[i]; h *= 1.7) {
            const double f = force(&pair, h), step = 1e-3 * h;
            const double k = gb_law_hertz_stiffness(&pair.law, radii[i], h);
            assert_close(exact_slope(energy, &pair, h, step), f, 1e-9);
            assert_close(exact_slope(force, &pair, h, step), k, 1e-9);
            assert_close(cbrt(6.0 * radii[i] * modulus * modulus * f), k,
                         1e-13); /* (10) */
            assert_close(gb_law_hertz_overlap(&pair.law, radii[i], f), h, 1e-14);
            assert_close(gb_law_hertz_shear_stiffness(&pair.law, radii[i], h) / k,
                         4.0 * pair.law.shear / modulus, 1e-14); /* (9), (12) */
        }
    }
}

static void test_no_contact(void)
{
    const struct gb_law_hertz law = nial_pair();
    static const double gaps[] = {0.0, -1e-9, -1.0};
    for (size_t i = 0; i < G_N_ELEMENTS(gaps); i++) {
        g_assert_cmpfloat(gb_law_hertz_force(&law, 5e-6, gaps[i]), ==, 0.0);
        g_assert_cmpfloat(gb_law_hertz_stiffness(&law, 5e-6, gaps[i]), ==, 0.0);
        g_assert_cmpfloat(gb_law_hertz_energy(&law, 5e-6, gaps[i]), ==, 0.0);
        g_assert_cmpfloat(gb_law_hertz_shear_stiffness(&law, 5e-6, gaps[i]), ==, 0.0);
    }
    g_assert_cmpfloat(gb_law_hertz_overlap(&law, 5e-6, 0.0), ==, 0.0);
    g_assert_cmpfloat(gb_law_hertz_overlap(&law, 5e-6, -1.0), ==, 0.0);
}

/* A pair that leaves with a push swings back below critical damping, and creeps back at
 * it: x'' = -(k/m*) x - (c/m*) x' in steps that are fine beside both times. */
static bool swings_over(double xi)
{
    const double stiffness = 3.0, mass = 0.7;
    const double c = gb_law_hertz_damping(stiffness, mass, xi);
    double x = 1.0, v = 0.0;
    for (int i = 0; i < 200000; i++) {
        v += 1e-4 * (-stiffness * x - c * v) / mass;
        x += 1e-4 * v;
        if (x < 0.0) {
            return true;
        }
    }
    return false;
}

static void test_damping(void)
{
    g_assert_true(swings_over(0.97));
    g_assert_false(swings_over(1.03));
    g_assert_cmpfloat(gb_law_hertz_damping(3.0, 0.7, 0.0), ==, 0.0);
    /* the whole normal force never pulls, and the dashpot only ever takes energy */
    for (double approach = -5.0; approach <= 5.0; approach += 0.25) {
        const double whole = gb_law_hertz_damped_force(2.0, 0.9, approach);
        g_assert_cmpfloat(whole, >=, 0.0);
        g_assert_cmpfloat((whole - 2.0) * approach, >=, 0.0);
    }
    g_assert_cmpfloat(gb_law_hertz_damped_force(2.0, 0.9, 1.0), ==, 2.9);
}

/* Greatest |x| of a damped spring in P3's explicit central differences, where the dashpot
 * sees the velocity half a step back. */
static double leapfrog(double stiffness, double mass, double xi, double dt)
{
    const double c = gb_law_hertz_damping(stiffness, mass, xi);
    double x = 1.0, v = 0.0, most = 0.0;
    for (int i = 0; i < 4000; i++) {
        v -= dt * (stiffness * x + c * v) / mass;
        x += dt * v;
        most = fmax(most, fabs(x));
    }
    return most;
}

static void test_critical_step(void)
{
    static const double shares[] = {0.0, 0.3, 0.9, 2.0};
    for (size_t i = 0; i < G_N_ELEMENTS(shares); i++) {
        const double xi = shares[i], critical = gb_law_hertz_critical_step(3.0, 0.7, xi);
        assert_close(critical, 2.0 * sqrt(0.7 / 3.0) * (sqrt(1.0 + xi * xi) - xi), 1e-13);
        g_assert_cmpfloat(leapfrog(3.0, 0.7, xi, 0.99 * critical), <, 10.0);
        g_assert_cmpfloat(leapfrog(3.0, 0.7, xi, 1.01 * critical), >, 1e9);
    }
    g_assert_true(isinf(gb_law_hertz_critical_step(0.0, 0.7, 0.9)));
}

/* Dashpots that are borne: what there is in a step that resolves them, and stable up to sqrt
 * 3/omega for any damping. */
static void test_damping_borne(void)
{
    const double stiffness = 3.0, mass = 0.7, rates = stiffness / mass;
    const double omega = sqrt(rates);
    for (double xi = 0.01; xi < 300.0; xi *= 1.3) {
        const double damping = gb_law_hertz_damping(stiffness, mass, xi);
        const double small = 0.16 / (omega * xi), large = 0.17 / (omega * xi);
        g_assert_true(gb_law_hertz_damping_borne(damping, stiffness, rates, small) ==
                      damping);
        g_assert_true(gb_law_hertz_damping_borne(damping, stiffness, rates, large) <
                      damping);
        g_assert_true(gb_law_hertz_damping_borne(damping, stiffness, rates, 0.0) ==
                      damping);
        const double step = 0.99 * sqrt(3.0) / omega;
        const double borne = gb_law_hertz_damping_borne(damping, stiffness, rates, step);
        g_assert_cmpfloat(
            leapfrog(stiffness, mass, 0.5 * borne / sqrt(mass * stiffness), step), <,
            10.0);
    }
    g_assert_true(gb_law_hertz_damping_borne(0.0, 0.0, 0.0, 1.0) == 0.0);
}

static void test_rotate(void)
{
    GRand *random = g_rand_new_with_seed(4);
    for (int i = 0; i < 100; i++) {
        double force[3], normal[3];
        for (int k = 0; k < 3; k++) {
            force[k] = g_rand_double_range(random, -1.0, 1.0);
            normal[k] = g_rand_double_range(random, -1.0, 1.0);
        }
        gb_vec_scale(normal, 1.0 / gb_vec_length(normal));
        const double length = gb_vec_length(force);
        mindlin_rotate(force, normal);
        assert_close(gb_vec_length(force), length, 1e-14);
        g_assert_cmpfloat(fabs(gb_vec_dot(force, normal)), <, 1e-13 * length);
    }
    g_rand_free(random);
    double lost[3] = {0.0, 0.0, 2.0}, none[3] = {0.0, 0.0, 0.0};
    const double normal[3] = {0.0, 0.0, 1.0};
    mindlin_rotate(lost, normal);
    mindlin_rotate(none, normal);
    g_assert_cmpfloat(gb_vec_length(lost) + gb_vec_length(none), ==, 0.0);
}

/* What slides: nothing where a pair turns as one body, nothing where two spheres roll on
 * each other; a spin alone sweeps the contact point. */
static void test_slip(void)
{
    const double normal[3] = {0.6, 0.0, 0.8}, still[3] = {0.0, 0.0, 0.0};
    const double spin[3] = {0.3, -0.7, 0.2}, ri = 10e-6, rj = 2e-6;
    double slip[3], lever[3] = {0.0, 0.0, 0.0}, orbit[3];
    gb_vec_add(lever, ri + rj, normal);
    gb_vec_cross(spin, lever, orbit); /* velocity of i around j */
    mindlin_slip(normal, orbit, still, spin, spin, ri, rj, slip);
    g_assert_cmpfloat(gb_vec_length(slip), <, 1e-20);
    double counter[3] = {0.0, 0.0, 0.0};
    gb_vec_add(counter, -ri / rj, spin);
    mindlin_slip(normal, still, still, spin, counter, ri, rj, slip);
    g_assert_cmpfloat(gb_vec_length(slip), <, 1e-20);
    /* a ball above the ground (j below i, n up) that spins about y, its underside going
     * to -x */
    const double up[3] = {0.0, 0.0, 1.0}, about_y[3] = {0.0, 2.0, 0.0};
    mindlin_slip(up, still, still, about_y, still, ri, 0.0, slip);
    g_assert_cmpfloat_with_epsilon(slip[0], -2.0 * ri, 1e-20);
    /* the normal part of a velocity is no slip */
    const double away[3] = {1.0, 0.0, 5.0};
    mindlin_slip(up, away, still, still, still, ri, rj, slip);
    g_assert_cmpfloat(slip[0], ==, 1.0);
    g_assert_cmpfloat(slip[2], ==, 0.0);
}

/* Back and forth over a under constant load: a spring below the cap gives everything
 * back, a slider costs its loop, 4 cap (a - cap/k) once settled. */
static double cycle_cost(double amplitude, double stiffness, double cap, bool *slid)
{
    enum { STEPS = 20000 };
    double shear[3] = {0.0, 0.0, 0.0}, cost = 0.0;
    *slid = false;
    for (int i = 0; i < 2 * STEPS; i++) { /* the second round counts */
        const double phase = 4.0 * (double)(i % STEPS) / STEPS;
        const double sign = phase < 1.0 || phase >= 3.0 ? 1.0 : -1.0;
        const double slip[3] = {0.0, sign * 4.0 * amplitude, 0.0};
        const double before = shear[1];
        *slid |= mindlin_advance(shear, slip, stiffness, 1.0 / STEPS, 0.1, cap / 0.1);
        if (i >= STEPS) {
            cost -= 0.5 * (before + shear[1]) * slip[1] / STEPS;
        }
    }
    return cost;
}

static void test_stick_and_slide(void)
{
    bool slid = false;
    g_assert_cmpfloat(fabs(cycle_cost(1e-3, 50.0, 0.2, &slid)), <, 1e-12);
    g_assert_false(slid);
    assert_close(cycle_cost(1e-2, 50.0, 0.2, &slid), 4.0 * 0.2 * (1e-2 - 0.2 / 50.0),
                 1e-3);
    g_assert_true(slid);
    /* opposes the slip, is cut to mu F_n whatever its sign, goes without friction */
    double shear[3] = {0.0, 0.0, 0.0};
    const double slip[3] = {3.0, 4.0, 0.0};
    g_assert_false(mindlin_advance(shear, slip, 2.0, 0.1, 0.5, 10.0));
    assert_close(shear[0], -0.6, 1e-14);
    assert_close(shear[1], -0.8, 1e-14);
    g_assert_true(mindlin_advance(shear, slip, 2.0, 0.1, 0.5, 1.0));
    assert_close(gb_vec_length(shear), 0.5, 1e-14);
    g_assert_true(mindlin_advance(shear, slip, 2.0, 0.1, 0.0, 1.0));
    g_assert_cmpfloat(gb_vec_length(shear), ==, 0.0);
}

/* Sheared at overlap deep, up to the cap at overlap shallow; turned back there: what is
 * gained, over the normal energy at shallow. */
static double shear_gain(double deep, double shallow, double mu)
{
    enum { STEPS = 2000 };
    const struct gb_law_hertz law = nial_pair();
    const double overlaps[] = {deep, shallow}, radius = 5e-6;
    const double most = mu * gb_law_hertz_force(&law, radius, shallow);
    const double reach =
        0.999999 * most / gb_law_hertz_shear_stiffness(&law, radius, deep);
    double shear[3] = {0.0, 0.0, 0.0}, taken = 0.0;
    for (int leg = 0; leg < 2; leg++) {
        const double normal = gb_law_hertz_force(&law, radius, overlaps[leg]);
        const double stiffness =
            gb_law_hertz_shear_stiffness(&law, radius, overlaps[leg]);
        const double slip[3] = {leg == 0 ? reach : -reach, 0.0, 0.0};
        for (int i = 0; i < STEPS; i++) {
            const double before = shear[0];
            g_assert_false(
                mindlin_advance(shear, slip, stiffness, 1.0 / STEPS, mu, normal));
            taken -= 0.5 * (before + shear[0]) * slip[0] / STEPS;
        }
    }
    return -taken / gb_law_hertz_energy(&law, radius, shallow);
}

/* The known weakness of (11), and its bound. */
static void test_shear_energy(void)
{
    double greatest = 0.0;
    for (double share = 0.02; share <= 1.0; share += 0.02) {
        greatest = fmax(greatest, shear_gain(1e-7, share * 1e-7, 0.05));
        g_assert_cmpfloat(shear_gain(1e-7, share * 1e-7, 0.05), >, -1e-12);
    }
    assert_close(greatest, 0.25 * 0.05 * 0.05, 0.05);
    assert_close(shear_gain(1e-7, 0.25e-7, 0.02), 0.25 * 0.02 * 0.02, 0.05);
    g_assert_cmpfloat(fabs(shear_gain(1e-7, 1e-7, 0.05)), <, 1e-12); /* h held: none */
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/hertz/effective-values", test_effective_values);
    g_test_add_func("/hertz/yield-of-pair", test_yield_of_pair);
    g_test_add_func("/hertz/force-is-slope-of-energy", test_force_is_slope_of_energy);
    g_test_add_func("/hertz/no-contact", test_no_contact);
    g_test_add_func("/hertz/damping", test_damping);
    g_test_add_func("/hertz/critical-step", test_critical_step);
    g_test_add_func("/hertz/damping-borne", test_damping_borne);
    g_test_add_func("/mindlin/rotate", test_rotate);
    g_test_add_func("/mindlin/slip", test_slip);
    g_test_add_func("/mindlin/stick-and-slide", test_stick_and_slide);
    g_test_add_func("/mindlin/shear-energy", test_shear_energy);
    return g_test_run();
}
