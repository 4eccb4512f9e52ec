#include <float.h>
#include <math.h>

#include <glib.h>

#include "common/cases.h"
#include "common/exact.h"
#include "law/law_dispersion.h"
#include "law/law_hertz.h"
#include "law/law_rod.h"
#include "law/law_storakers.h"
#include "law/law_unequal.h"

/* Every normal law with an energy, at random parameters: the force is the slope of the
 * energy and the stiffness that of the force, within the error of the difference itself. */

typedef double curve(const void *law, double x);

/* An integral and what it is the integral of. */
struct integral {
    const char *name;
    curve *whole, *slope;
    double magnitude; /* of the summands of `whole`, which round */
    double condition; /* relative change of the slope over that of x; 0: about 1 */
};

/* Central difference of eighth order; those of sixth and fourth order from the same values
 * tell what the series leaves out.  Where the sixth agrees by chance, a share of the fourth
 * remains. */
static double slope_of(curve *f, const void *law, double x, double step, double *left_out)
{
    double odd[5] = {0.0};
    for (int k = 1; k <= 4; k++) {
        odd[k] = f(law, x + k * step) - f(law, x - k * step);
    }
    const double fourth = (8.0 * odd[1] - odd[2]) / (12.0 * step);
    const double sixth = (45.0 * odd[1] - 9.0 * odd[2] + odd[3]) / (60.0 * step);
    const double eighth =
        (672.0 * odd[1] - 168.0 * odd[2] + 32.0 * odd[3] - 3.0 * odd[4]) / (840.0 * step);
    *left_out = fabs(eighth - sixth) + fabs(sixth - fourth) / 64.0;
    return eighth;
}

/* Digits of the functions in units of the last place of their summands, and largest share
 * of the slope, or of the mean slope from 0, that the error bound may be: a wider one would
 * prove nothing. */
static const double last_digits = 8.0, widest = 2e-6;

/* At x, where the law is smooth over `room` to both sides. */
static void check_slope(const struct integral *integral, const void *law, double x,
                        double room)
{
    const double step = room / 32.0;
    double left_out;
    const double got = slope_of(integral->whole, law, x, step, &left_out);
    const double want = integral->slope(law, x);
    const double bound = left_out + last_digits * DBL_EPSILON *
                                        (integral->magnitude / step +
                                         (1.0 + integral->condition) * fabs(want));
    if (!(bound <= widest * (fabs(want) + integral->magnitude / x)) ||
        !(fabs(got - want) <= bound)) {
        g_test_message("%s at %.17g: slope %.17g, want %.17g within %.3g", integral->name,
                       x, got, want, bound);
        g_test_fail();
    }
}

static double rod_energy(const void *law, double h)
{
    return gb_law_rod_energy(law, h);
}

static double rod_force(const void *law, double h)
{
    return gb_law_rod_force(law, h);
}

static double rod_stiffness(const void *law, double h)
{
    return gb_law_rod_stiffness(law, h);
}

static void check_rod(GRand *random)
{
    struct gb_law_rod rod;
    gb_law_rod_init(&rod, cases_between(random, 0.0, 0.49));
    for (int k = 0; k < 50; k++) {
        const double h = cases_scale(random, 1e-5, 0.95), room = fmin(h, 1.0 - h);
        /* above 1/16 the logarithm is taken, of which little is left */
        const double terms = h + 4.0 * room > 0.0625 ? 2.0 * rod.rod * h : 0.0;
        const struct integral force = {"rod force", rod_energy, rod_force,
                                       rod_energy(&rod, h + 0.3 * room) + terms, 0.0};
        const struct integral stiffness = {"rod stiffness", rod_force, rod_stiffness,
                                           rod_force(&rod, h + 0.3 * room) + terms, 0.0};
        check_slope(&force, &rod, h, room);
        check_slope(&stiffness, &rod, h, room);
    }
}

static double dispersion_energy(const void *law, double r)
{
    return gb_law_dispersion_energy(law, r);
}

static double dispersion_force(const void *law, double r)
{
    return gb_law_dispersion_force(law, r);
}

static double dispersion_slope(const void *law, double r)
{
    return gb_law_dispersion_slope(law, r);
}

/* s^2 - 1 next to contact, and sums far away, cancel. */
static void check_attraction(const struct gb_law_dispersion *law, double r, double room)
{
    const double s = fmax(r - 0.3 * room, 1.0) + law->shift, q = s * s - 1.0;
    const struct integral force = {
        "attraction", dispersion_energy, dispersion_force,
        law->strength * 2.0 / q * (1.0 + 1.0 / q) + law->contact, 4.0 / q};
    const struct integral slope = {
        "slope of the attraction", dispersion_force, dispersion_slope,
        dispersion_force(law, r - 0.3 * room) * 4.0 / q, 4.0 / q};
    check_slope(&force, law, r, room);
    if (r > 1.0) {
        check_slope(&slope, law, r, room);
    }
}

static void check_dispersion(GRand *random)
{
    struct gb_law_dispersion law;
    gb_law_dispersion_init(
        &law, cases_between(random, 0.1, 10.0), cases_scale(random, 1e-8, 1e-2),
        cases_between(random, 0.05, 2.0), cases_scale(random, 1e-3, 0.2));
    for (int k = 0; k < 50; k++) {
        const double gap = cases_scale(random, 1e-4, 1.0), r = 1.0 + gap;
        check_attraction(&law, r, gap);
        /* where they touch it is constant */
        const double inside = cases_between(random, 0.3, 0.9);
        check_attraction(&law, inside, 1.0 - inside);
    }
}

/* A pair of Hertz' or Storakers' law. */
struct pair {
    struct gb_law_storakers law;
    double radius, deepest;
};

static double hertz_energy(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_hertz_energy(&pair->law.hertz, pair->radius, h);
}

static double hertz_force(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_hertz_force(&pair->law.hertz, pair->radius, h);
}

static double hertz_stiffness(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_hertz_stiffness(&pair->law.hertz, pair->radius, h);
}

static double loading_work(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_storakers_loading_work(&pair->law, pair->radius, h);
}

static double loading_force(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_storakers_load(&pair->law, pair->radius, h);
}

static double loading_stiffness(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_storakers_loading(&pair->law, pair->radius, h).stiffness;
}

static double unloading_energy(const void *data, double h)
{
    const struct pair *pair = data;
    return gb_law_storakers_unloading_energy(&pair->law, pair->radius, pair->deepest, h);
}

static struct gb_law_branch unloading(const struct pair *pair, double h)
{
    double deepest = pair->deepest;
    return gb_law_storakers_update(&pair->law, pair->radius, h, &deepest);
}

static double unloading_force(const void *data, double h)
{
    return unloading(data, h).force;
}

static double unloading_stiffness(const void *data, double h)
{
    return unloading(data, h).stiffness;
}

/* SI: two spheres of ceramic or metal, or a sphere and a wall. */
static struct pair random_pair(GRand *random)
{
    struct pair pair;
    struct gb_elastic body[2];
    double strength[2];
    const double exponent = cases_between(random, 0.0, 0.5);
    for (int i = 0; i < 2; i++) {
        body[i] = (struct gb_elastic){cases_scale(random, 1e9, 1e12),
                                      cases_between(random, 0.0, 0.49)};
        strength[i] = cases_scale(random, 1e-3, 1e-2) * body[i].young;
    }
    gb_law_storakers_init(&pair.law, &body[0], &body[1], strength[0], strength[1],
                          exponent, cases_choice(random, 2) == 1);
    const double radius = cases_scale(random, 1e-9, 1e-4);
    pair.radius = gb_law_hertz_radius(
        radius, cases_choice(random, 3) == 0 ? (double)INFINITY
                                             : radius * cases_scale(random, 0.2, 5.0));
    pair.deepest = 0.0;
    return pair;
}

static void check_both(const char *name, curve *energy, curve *force, curve *stiffness,
                       const struct pair *pair, double h, double room)
{
    /* the overlap of an unloading contact is known to the last place of the deepest */
    const double far = h + 0.3 * room, known = pair->deepest;
    const struct integral first = {name, energy, force,
                                   energy(pair, far) + known * force(pair, far), 0.0};
    const struct integral second = {name, force, stiffness,
                                    force(pair, far) + known * stiffness(pair, far), 0.0};
    check_slope(&first, pair, h, room);
    check_slope(&second, pair, h, room);
}

static void check_hertz(GRand *random)
{
    const struct pair pair = random_pair(random);
    for (int k = 0; k < 50; k++) {
        const double h = pair.radius * cases_scale(random, 1e-7, 0.5);
        check_both("Hertz", hertz_energy, hertz_force, hertz_stiffness, &pair, h, h);
    }
}

/* Loading has a kink where flow begins, unloading ends where the contact opens. */
static void check_storakers(GRand *random)
{
    struct pair pair = random_pair(random);
    const double kink = gb_law_storakers_transition(&pair.law, pair.radius);
    for (int k = 0; k < 50; k++) {
        const double h = kink * cases_scale(random, 1e-2, 1e2);
        const double room = pair.law.printed ? h : fmin(h, fabs(h - kink));
        if (room > 0.05 * h) {
            check_both("loading", loading_work, loading_force, loading_stiffness, &pair,
                       h, room);
        }
        pair.deepest = h;
        const double recovery =
            gb_law_storakers_recovery(&pair.law, pair.radius, pair.deepest);
        const double spring = fmin(recovery, h), share = cases_between(random, 0.1, 0.9);
        check_both("unloading", unloading_energy, unloading_force, unloading_stiffness,
                   &pair, h - share * spring, fmin(share, 1.0 - share) * spring);
    }
}

/* Two unequal spheres, and a bridge with its deepest overlap. */
struct unequal {
    struct gb_law_unequal law;
    double deepest;
};

static double unequal_energy(const void *data, double h)
{
    const struct unequal *pair = data;
    return gb_law_unequal_elastic_energy(&pair->law, pair->deepest, h);
}

static double unequal_force(const void *data, double h)
{
    const struct unequal *pair = data;
    return gb_law_unequal_elastic(&pair->law, pair->deepest, h, NULL);
}

static double unequal_stiffness(const void *data, double h)
{
    const struct unequal *pair = data;
    double stiffness;
    (void)gb_law_unequal_elastic(&pair->law, pair->deepest, h, &stiffness);
    return stiffness;
}

static double attraction_energy(const void *data, double r)
{
    const struct unequal *pair = data;
    return gb_law_unequal_attraction_energy(&pair->law, r);
}

static double attraction(const void *data, double r)
{
    const struct unequal *pair = data;
    return gb_law_unequal_attraction(&pair->law, r);
}

static void check_elastic(const struct unequal *pair, const char *name, double h,
                          double room)
{
    const double mean = pair->law.mean_diameter, rod = pair->law.rod.rod,
                 far = fmax(pair->deepest, h + 0.3 * room), x = far / mean;
    /* what cancels at 1/16, and in the line of a bridge */
    const double terms = x > 0.05 ? 2.0 * rod * mean * mean * x : 0.0;
    struct unequal loaded = *pair;
    loaded.deepest = 0.0;
    const struct integral force = {name, unequal_energy, unequal_force,
                                   4.0 * mean * terms + unequal_energy(&loaded, far) +
                                       2.0 * far * unequal_force(&loaded, far),
                                   0.0};
    const struct integral stiffness = {name, unequal_force, unequal_stiffness,
                                       4.0 * terms + unequal_force(&loaded, far) +
                                           2.0 * far * unequal_stiffness(&loaded, far),
                                       0.0};
    check_slope(&force, pair, h, room);
    check_slope(&stiffness, pair, h, room);
}

static void check_unequal_attraction(const struct unequal *pair, double gap)
{
    const struct gb_law_unequal *law = &pair->law;
    const double mean = law->mean_diameter;
    const double s = 1.0 + 0.7 * gap / mean + law->shift, q = s * s - 1.0,
                 c = law->diameter_ratio;
    const struct integral force = {"unequal attraction", attraction_energy, attraction,
                                   mean * mean * mean * law->strength * 2.0 /
                                       (c * c * q) * (1.0 + 1.0 / q),
                                   4.0 / q};
    check_slope(&force, pair, mean + gap, gap);
}

static void check_unequal(GRand *random)
{
    struct gb_law_rod rod;
    struct gb_law_dispersion dispersion;
    gb_law_rod_init(&rod, cases_between(random, 0.0, 0.49));
    gb_law_dispersion_init(
        &dispersion, cases_between(random, 0.1, 10.0), cases_scale(random, 1e-8, 1e-2),
        cases_between(random, 0.05, 2.0), cases_scale(random, 1e-3, 0.2));
    const struct gb_law_bridge bridge = {.length = cases_between(random, 0.001, 0.05)};
    struct unequal pair = {.deepest = 0.0};
    gb_law_unequal_init(&pair.law, &rod, &bridge, &dispersion,
                        cases_scale(random, 0.3, 3.0), cases_scale(random, 0.3, 3.0));
    const double mean = pair.law.mean_diameter;
    for (int k = 0; k < 50; k++) {
        const double x = cases_scale(random, 1e-4, 0.5), h = x * mean;
        pair.deepest = 0.0;
        check_elastic(&pair, "unequal rods", h, fmin(h, mean - h));
        pair.deepest = h;
        const double pulled = cases_between(random, 0.05, 0.7);
        check_elastic(&pair, "bridge line", (1.0 - pulled) * h, pulled * h);
        check_unequal_attraction(&pair, mean * cases_scale(random, 1e-3, 0.5));
    }
}

/* The line of a bridge between equal spheres has the energy of that of two unequal ones. */
static double line_force(const void *data, double h)
{
    const struct unequal *pair = data;
    return gb_law_bridge_force(&pair->law.rod, pair->deepest, h);
}

static void check_line(GRand *random)
{
    struct gb_law_rod rod;
    const struct gb_law_dispersion none = {0};
    const struct gb_law_bridge bridge = {.length = 0.01};
    gb_law_rod_init(&rod, cases_between(random, 0.0, 0.49));
    struct unequal pair;
    gb_law_unequal_init(&pair.law, &rod, &bridge, &none, 1.0, 1.0);
    for (int k = 0; k < 50; k++) {
        const double h = pair.deepest = cases_scale(random, 1e-4, 0.5);
        const double pulled = cases_between(random, 0.05, 0.7);
        const double terms = h > 0.05 ? 8.0 * rod.rod * h : 0.0;
        const struct integral line = {"line of equal spheres", unequal_energy, line_force,
                                      terms + 3.0 * h * rod_force(&rod, h), 0.0};
        check_slope(&line, &pair, (1.0 - pulled) * h, pulled * h);
    }
}

static void test_rod(void)
{
    cases_run(200, 4000, check_rod);
}

static void test_dispersion(void)
{
    cases_run(200, 4000, check_dispersion);
}

static void test_hertz(void)
{
    cases_run(200, 4000, check_hertz);
}

static void test_storakers(void)
{
    cases_run(200, 4000, check_storakers);
}

static void test_unequal(void)
{
    cases_run(200, 4000, check_unequal);
}

static void test_line(void)
{
    cases_run(200, 4000, check_line);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/potentials/rod", test_rod);
    g_test_add_func("/potentials/dispersion", test_dispersion);
    g_test_add_func("/potentials/hertz", test_hertz);
    g_test_add_func("/potentials/storakers", test_storakers);
    g_test_add_func("/potentials/unequal", test_unequal);
    g_test_add_func("/potentials/bridge_line", test_line);
    return g_test_run();
}
