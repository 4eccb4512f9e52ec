/* The plastic contact of P3: Storakers with Hertz unloading, and its energy. */
#include <math.h>

#include <glib.h>

#include "common/exact.h"
#include "law/law_storakers.h"

static const double young = 180e9, yield_nial = 800e6;
static const double exponents[] = {0.0, 0.05, 0.1, 0.2};
/* Two equal spheres of 10 um, 10 um on 2 um, a wall. */
static const double radii[] = {5e-6, 1e-5 / 6.0, 10e-6};

static struct gb_law_storakers make(double sigma_i, double sigma_j, double m,
                                    bool printed)
{
    const struct gb_elastic nial = {young, 0.30};
    struct gb_law_storakers law;
    gb_law_storakers_init(&law, &nial, &nial, sigma_i, sigma_j, m, printed);
    return law;
}

static struct gb_law_storakers nial_law(double m, bool printed)
{
    const double sigma = gb_law_storakers_hollomon(yield_nial, young, m);
    return make(sigma, sigma, m, printed);
}

static double evaluate(const char *law, const char *words, const char *input)
{
    const double sigma = exact_number(words, "sigma0=", 800e6);
    const struct gb_law_storakers nial =
        make(sigma, sigma, exact_number(words, "m=", 0.0), true);
    const double radius = gb_law_hertz_radius(exact_number(words, "R1=", NAN),
                                              exact_number(words, "R2=", NAN));
    const double h = exact_number(input, "h=", NAN);
    if (strcmp(law, "nial_hertz") == 0) {
        return gb_law_hertz_force(&nial.hertz, radius, h);
    } else if (strcmp(law, "nial_storakers") == 0) {
        return gb_law_storakers_load(&nial, radius, h);
    }
    return NAN;
}

static void test_exact_values(void)
{
    g_assert_cmpint(exact_rows(GB_TEST_DIR "/exact_values_p3.csv", 1e-10, evaluate), ==,
                    30);
}

/* Contact radius and force are (15) to (17) with one c: c^(2+m) = 1.43 exp(-0.97 m) and
 * F = 3^(1-m) sigma_0 (a/2 R)^m pi a^2.  Elastic contacts have Hertz' radius. */
static void test_contact(void)
{
    static const double more[] = {0.0, 0.05, 0.1, 0.2, 0.3, 0.6};
    for (size_t i = 0; i < G_N_ELEMENTS(more); i++) {
        const double m = more[i];
        const struct gb_law_storakers law = make(2e9, 2e9, m, true);
        for (size_t r = 0; r < G_N_ELEMENTS(radii); r++) {
            const double h = 0.05 * radii[r];
            const double a = gb_law_storakers_contact(&law, radii[r], h);
            assert_close(pow(a / sqrt(2.0 * radii[r] * h), 2.0 + m),
                         1.43 * exp(-0.97 * m), 1e-13);
            assert_close(gb_law_storakers_plastic(&law, radii[r], h),
                         pow(3.0, 1.0 - m) * law.strength * pow(a / (2.0 * radii[r]), m) *
                             M_PI * a * a,
                         1e-13);
            const struct gb_law_storakers lesser = nial_law(m < 0.3 ? m : 0.1, false);
            const double border = gb_law_storakers_transition(&lesser, radii[r]);
            assert_close(gb_law_storakers_contact(&lesser, radii[r], 0.9 * border),
                         sqrt(0.9 * radii[r] * border), 1e-13);
            assert_close(gb_law_storakers_contact(&lesser, radii[r], 1.1 * border),
                         lesser.c * sqrt(2.2 * radii[r] * border), 1e-13);
        }
        g_assert_cmpfloat(gb_law_storakers_contact(&law, 1.0, -0.1), ==, 0.0);
    }
}

/* sigma_0 = 800, 1049, 1375, 2363 MPa; (18) as printed, and its limit. */
static void test_strengths(void)
{
    static const double printed[] = {800e6, 1049e6, 1375e6, 2363e6};
    for (size_t i = 0; i < G_N_ELEMENTS(exponents); i++) {
        const double sigma = gb_law_storakers_hollomon(yield_nial, young, exponents[i]);
        g_assert_cmpfloat_with_epsilon(sigma, printed[i], 0.5e6);
    }
    const double a = 800e6, b = 1200e6, m = 0.2;
    assert_close(gb_law_storakers_strength(a, b, m),
                 pow(pow(a, -1.0 / m) + pow(b, -1.0 / m), -m), 1e-13);
    g_assert_cmpfloat(gb_law_storakers_strength(b, a, m), ==,
                      gb_law_storakers_strength(a, b, m));
    g_assert_cmpfloat(gb_law_storakers_strength(b, a, 0.0), ==, a);
    assert_close(gb_law_storakers_strength(a, b, 1e-6), a, 1e-12);
    assert_close(gb_law_storakers_strength(a, a, 1e-3), a * pow(2.0, -1e-3), 1e-13);
    assert_close(gb_law_storakers_strength(a, INFINITY, m), a, 1e-15); /* rigid wall */
}

/* P3: all curves meet at h/2R = 0.0024742; overlap/2R at 0.02 N, by (16) alone (at m =
 * 0.2 and 0.02 N the spheres are still elastic). */
static void test_published_pair(void)
{
    static const double at_20_mN[] = {0.93, 0.90, 0.87, 0.82};
    const double r = 10e-6, meeting = 2.0 * r * 0.0024742;
    const struct gb_law_storakers rigid = nial_law(0.0, true);
    assert_close(gb_law_hertz_overlap(&rigid.hertz, 0.5 * r, 0.02) / (2.0 * r), 0.83e-2,
                 0.005 / 0.83);
    for (size_t i = 0; i < G_N_ELEMENTS(exponents); i++) {
        const struct gb_law_storakers law = nial_law(exponents[i], true);
        assert_close(gb_law_storakers_load(&law, 0.5 * r, meeting),
                     gb_law_storakers_load(&rigid, 0.5 * r, meeting), 1e-6);
        const double low = (at_20_mN[i] - 0.005) * 2e-2 * r;
        const double high = (at_20_mN[i] + 0.005) * 2e-2 * r;
        g_assert_cmpfloat(gb_law_storakers_load(&law, 0.5 * r, low), <, 0.02);
        g_assert_cmpfloat(gb_law_storakers_load(&law, 0.5 * r, high), >, 0.02);
        /* 0.4 to 0.5 um "between spheres of 10 and 2 um": the overlap of one contact of
         * the line, not of both */
        const double small = gb_law_hertz_radius(r, 2e-6);
        g_assert_cmpfloat(gb_law_storakers_load(&law, small, 0.40e-6), <, 0.02);
        g_assert_cmpfloat(gb_law_storakers_load(&law, small, 0.56e-6), >, 0.02);
    }
}

struct contact {
    struct gb_law_storakers law;
    double radius, deepest;
};

static double work(const void *at, double h)
{
    const struct contact *c = at;
    return gb_law_storakers_loading_work(&c->law, c->radius, h);
}

static double load(const void *at, double h)
{
    const struct contact *c = at;
    return gb_law_storakers_load(&c->law, c->radius, h);
}

static double returned(const void *at, double h)
{
    const struct contact *c = at;
    return gb_law_storakers_unloading_energy(&c->law, c->radius, c->deepest, h);
}

/* Along the deepest of the contact as it is, without going on from there. */
static struct gb_law_branch below(const struct contact *c, double h)
{
    double deepest = c->deepest;
    return gb_law_storakers_update(&c->law, c->radius, h, &deepest);
}

static double unload(const void *at, double h)
{
    return below(at, h).force;
}

static void check_slopes(struct contact *c, double h)
{
    const double step = 1e-3 * h;
    const double meeting = gb_law_storakers_transition(&c->law, c->radius);
    if (c->law.printed || fabs(h - meeting) > 3.0 * step) {
        const struct gb_law_branch branch =
            gb_law_storakers_loading(&c->law, c->radius, h);
        assert_close(exact_slope(work, c, h, step), branch.force, 1e-8);
        assert_close(exact_slope(load, c, h, step), branch.stiffness, 1e-8);
    }
    c->deepest = h;
    const double rebound = gb_law_storakers_recovery(&c->law, c->radius, h);
    const double now = h - 0.3 * fmin(rebound, h), small = 1e-3 * fmin(rebound, h);
    const struct gb_law_branch back = below(c, now);
    assert_close(exact_slope(returned, c, now, small), back.force, 1e-8);
    assert_close(exact_slope(unload, c, now, small), back.stiffness, 1e-8);
}

static void test_force_is_slope_of_energy(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(exponents) * G_N_ELEMENTS(radii) * 2; i++) {
        struct contact c = {nial_law(exponents[i % 4], i >= 12), radii[i / 4 % 3], 0.0};
        for (double h = 1e-5 * c.radius; h < 0.5 * c.radius; h *= 1.3) {
            check_slopes(&c, h);
        }
    }
}

/* Force and, off the corners, nothing else jumps where a branch hands over. */
static void test_continuity(void)
{
    const double eps = 1e-12;
    for (size_t i = 0; i < G_N_ELEMENTS(exponents) * G_N_ELEMENTS(radii); i++) {
        struct contact c = {nial_law(exponents[i % 4], false), radii[i / 4], 0.0};
        const double meeting = gb_law_storakers_transition(&c.law, c.radius);
        assert_close(gb_law_hertz_force(&c.law.hertz, c.radius, meeting),
                     gb_law_storakers_plastic(&c.law, c.radius, meeting), 1e-12);
        assert_close(load(&c, meeting * (1.0 + eps)), load(&c, meeting * (1.0 - eps)),
                     1e-11);
        c.deepest =
            meeting * (1.0 + eps); /* the first plastic state springs back whole */
        assert_close(unload(&c, 0.5 * meeting),
                     gb_law_hertz_force(&c.law.hertz, c.radius, 0.5 * meeting), 1e-10);
        for (double h = 0.1 * meeting; h < 100.0 * meeting; h *= 2.0) {
            c.deepest = h;
            assert_close(unload(&c, h * (1.0 - eps)), load(&c, h), 1e-9);
            const double left = h - gb_law_storakers_recovery(&c.law, c.radius, h);
            g_assert_cmpfloat(left, >=, 0.0);
            g_assert_cmpfloat(unload(&c, left), <, 1e-12 * load(&c, h));
            g_assert_cmpfloat(unload(&c, 0.9 * left), ==, 0.0);
        }
    }
}

/* Goes to overlap `to`; adds what the contact takes on the way, Simpson in steps that end
 * where the loading branch begins. */
static double go(struct contact *c, double from, double to, double *taken)
{
    enum { STEPS = 400 };
    const double border = c->deepest;
    if ((from - border) * (to - border) < 0.0 && border > 0.0) {
        go(c, from, border, taken);
        return go(c, border, to, taken);
    }
    double last = from, force = below(c, from).force;
    const bool fresh = to > from && from >= border;
    for (int i = 1; i <= STEPS; i++) {
        const double h = i == STEPS ? to : from + (to - from) * i / STEPS;
        const double middle = 0.5 * (last + h);
        const double half = fresh ? load(c, middle) : below(c, middle).force;
        const struct gb_law_branch now =
            gb_law_storakers_update(&c->law, c->radius, h, &c->deepest);
        *taken += (h - last) * (force + 4.0 * half + now.force) / 6.0;
        last = h;
        force = now.force;
    }
    return force;
}

/* A closed elastic cycle loses nothing, a plastic one its loop. */
static void test_cycles(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(exponents) * G_N_ELEMENTS(radii); i++) {
        struct contact c = {nial_law(exponents[i % 4], false), radii[i / 4], 0.0};
        const double meeting = gb_law_storakers_transition(&c.law, c.radius);
        double taken = 0.0;
        for (double h = 0.0; h <= 1.0; h += 0.125) { /* in and out along one line */
            const double in = load(&c, 0.999 * meeting * h);
            c.deepest = 0.999 * meeting;
            g_assert_cmpfloat(unload(&c, 0.999 * meeting * h), ==, in);
        }
        c.deepest = 0.0;
        go(&c, 0.0, 0.999 * meeting, &taken);
        const double put = taken;
        go(&c, 0.999 * meeting, 0.0, &taken);
        g_assert_cmpfloat(fabs(taken), <, 1e-7 * put);
        g_assert_cmpfloat(work(&c, 0.999 * meeting), ==,
                          gb_law_storakers_unloading_energy(
                              &c.law, c.radius, 0.999 * meeting, 0.999 * meeting));
        const double far = 8.0 * meeting;
        taken = 0.0;
        go(&c, 0.0, meeting, &taken);
        go(&c, meeting, far, &taken);
        assert_close(taken, work(&c, far), 1e-6);
        const double loop =
            work(&c, far) - gb_law_storakers_unloading_energy(&c.law, c.radius, far, far);
        /* out to a partial unloading and back in: no loss; then open */
        go(&c, far, 0.9 * far, &taken);
        g_assert_cmpfloat(go(&c, 0.9 * far, far, &taken), ==, load(&c, far));
        assert_close(taken, work(&c, far), 1e-6);
        go(&c, far, -0.1 * far, &taken);
        g_assert_cmpfloat(loop, >, 0.3 * work(&c, far));
        assert_close(taken, loop, 1e-5);
        g_assert_cmpfloat(c.deepest, ==, 0.0); /* and nothing is remembered */
    }
}

/* Random ways in and out: at no moment has the contact given back more than it took. */
static double least_balance(GRand *random, const struct gb_law_storakers *law,
                            double radius)
{
    struct contact c = {*law, radius, 0.0};
    const double deep = radius * pow(10.0, g_rand_double_range(random, -4.0, -0.5));
    double h = 0.0, taken = 0.0, least = 0.0;
    for (int leg = 0; leg < 20; leg++) {
        const double to = leg == 19 ? 0.0 : deep * g_rand_double_range(random, -0.1, 1.0);
        go(&c, fmax(h, 0.0), fmax(to, 0.0), &taken);
        h = to;
        least = fmin(least, taken / gb_law_storakers_loading_work(law, radius, deep));
    }
    return least;
}

static void test_no_energy_from_nothing(void)
{
    GRand *random = g_rand_new_with_seed(1);
    double worst_printed = 0.0;
    for (int i = 0; i < 300; i++) {
        const double m = g_rand_double_range(random, 0.0, 0.5);
        const double radius = radii[i % 3];
        const double sigma_i = gb_law_storakers_hollomon(yield_nial, young, m);
        const double sigma_j = sigma_i * g_rand_double_range(random, 0.5, 3.0);
        struct gb_law_storakers law = make(sigma_i, sigma_j, m, false);
        g_assert_cmpfloat(least_balance(random, &law, radius), >, -1e-5);
        law.printed = true;
        worst_printed = fmin(worst_printed, least_balance(random, &law, radius));
    }
    g_rand_free(random);
    g_assert_cmpfloat(worst_printed, <, -0.2); /* the printed law does */
    /* 1.28 times at h/2R = 0.001, m = 0 */
    const struct gb_law_storakers printed = nial_law(0.0, true);
    const double h = 0.001 * 20e-6;
    struct contact c = {printed, 5e-6, 0.0};
    double taken = 0.0;
    go(&c, 0.0, h, &taken);
    const double put = taken;
    go(&c, h, 1e-9 * h, &taken);
    g_assert_cmpfloat_with_epsilon((put - taken) / put, 1.28, 0.005);
    assert_close(gb_law_storakers_unloading_energy(&printed, 5e-6, h, h) / work(&c, h),
                 (put - taken) / put, 1e-5);
}

/* A wall is a sphere of infinite radius: what a very large sphere does. */
static void test_wall(void)
{
    const struct gb_law_storakers law = nial_law(0.1, false);
    const double wall = gb_law_hertz_radius(3e-6, INFINITY);
    const double large = gb_law_hertz_radius(3e-6, 3.0);
    for (double h = 1e-10; h < 1e-6; h *= 3.0) {
        double deep = 2.0 * h, deeper = 2.0 * h;
        assert_close(gb_law_storakers_load(&law, wall, h),
                     gb_law_storakers_load(&law, large, h), 2e-6);
        assert_close(gb_law_storakers_update(&law, wall, 1.99 * h, &deep).force,
                     gb_law_storakers_update(&law, large, 1.99 * h, &deeper).force, 1e-4);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/storakers/contact", test_contact);
    g_test_add_func("/storakers/exact-values", test_exact_values);
    g_test_add_func("/storakers/strengths", test_strengths);
    g_test_add_func("/storakers/published-pair", test_published_pair);
    g_test_add_func("/storakers/force-is-slope-of-energy", test_force_is_slope_of_energy);
    g_test_add_func("/storakers/continuity", test_continuity);
    g_test_add_func("/storakers/cycles", test_cycles);
    g_test_add_func("/storakers/no-energy-from-nothing", test_no_energy_from_nothing);
    g_test_add_func("/storakers/wall", test_wall);
    return g_test_run();
}
