#include "measure/ball.h"

#include <gsl/gsl_integration.h>
#include <math.h>

#include <glib.h>

enum { INTERVALS = 200 };

static void close_to(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected))) {
        g_error("%.17g, expected %.17g, off by %.2e", value, expected,
                fabs(value / expected - 1.0));
    }
}

/* Area of the shell of radius x about the second centre that lies in the first sphere:
 * another way to cut the common volume than the planes of the formula. */
struct shells {
    double a, distance;
};

static double shell(double x, void *data)
{
    const struct shells *s = data;
    const double inner = (s->a - s->distance) + x, outer = (s->a + s->distance) - x;
    return M_PI * x / s->distance * inner * outer;
}

static double quadrature(double (*f)(double x, void *data), void *data, double from,
                         double to)
{
    static gsl_integration_workspace *work;
    work = work ? work : gsl_integration_workspace_alloc(INTERVALS);
    gsl_function function = {f, data};
    double value = 0.0, error = 0.0;
    if (to > from) {
        gsl_integration_qag(&function, from, to, 0.0, 1e-13, INTERVALS, GSL_INTEG_GAUSS31,
                            work, &value, &error);
    }
    return value;
}

/* a >= b > 0, distance > 0. */
static double shared_by_shells(double a, double b, double distance)
{
    struct shells data = {a, distance};
    const double whole = distance < a ? fmin(a - distance, b) : 0.0;
    const double from = fabs(distance - a);
    return 4.0 * M_PI / 3.0 * whole * whole * whole + quadrature(shell, &data, from, b);
}

static double log_uniform(double low, double high)
{
    return low * pow(high / low, g_test_rand_double());
}

static void test_random(void)
{
    for (int i = 0; i < 20000; i++) {
        const double a = log_uniform(1e-8, 1e8), b = a * log_uniform(1e-9, 1.0);
        const double distance = a + b * g_test_rand_double_range(-1.0, 1.0);
        const double expected = shared_by_shells(a, b, distance);
        /* a distance near a - b or a + b determines the volume to its own rounding only */
        const double s = (a - distance) + b;
        const double known = 4e-16 * fmax(1.0, b / s);
        close_to(gb_ball_shared_volume(a, b, distance), expected, 1e-10 + known);
        g_assert_cmpfloat(gb_ball_shared_volume(a, b, distance), ==,
                          gb_ball_shared_volume(b, a, distance));
    }
}

/* Thin intersections, thin remainders, equal spheres, all ratios; lengths are powers of two
 * where that keeps them exact. */
static void test_degenerate(void)
{
    for (int ratio = 0; ratio <= 40; ratio += 4) {
        for (int depth = 1; depth <= 50; depth++) {
            const double b = ldexp(1.0, -ratio), s = ldexp(b, 1 - depth);
            const double out = (1.0 + b) - s, in = (1.0 - b) + s;
            if ((1.0 - out) + b == s && s < 2.0 * b) { /* exact, and not inside */
                /* pi s^2 (...)/(12 d) in long double, which these numbers fit */
                const long double d = out, k = (long double)(2.0 * b - s);
                const long double waist = k / d * (d + 3.0L * (1.0L - b));
                const long double v =
                    M_PI / 12.0L * s * s * (waist + 4.0L * (long double)b);
                close_to(gb_ball_shared_volume(1.0, b, out), (double)v, 1e-14);
                close_to(gb_ball_shared_volume(1.0, b, out),
                         shared_by_shells(1.0, b, out), 1e-10);
            }
            if (in > 0.0 && in < 1.0 + b) {
                close_to(gb_ball_shared_volume(1.0, b, in), shared_by_shells(1.0, b, in),
                         1e-10);
            }
        }
    }
}

static void test_cases(void)
{
    const double full = gb_ball_volume(1.5);
    close_to(full, 4.5 * G_PI, 1e-15);
    g_assert_cmpfloat(gb_ball_shared_volume(1.0, 2.0, 3.0), ==, 0.0); /* touching */
    g_assert_cmpfloat(gb_ball_shared_volume(1.0, 2.0, 1e300), ==, 0.0);
    g_assert_cmpfloat(gb_ball_shared_volume(1.5, 4.0, 2.5), ==,
                      full); /* touching from inside */
    g_assert_cmpfloat(gb_ball_shared_volume(1.5, 4.0, 0.0), ==, full);
    g_assert_cmpfloat(gb_ball_shared_volume(1.5, 1.5, 0.0), ==, full);
    close_to(gb_ball_shared_volume(1.5, 1.5, 1e-300), full, 1e-15);
    g_assert_cmpfloat(gb_ball_shared_volume(1.0, 0.0, 0.5), ==, 0.0);
    g_assert_cmpfloat(gb_ball_shared_volume(0.0, 0.0, 0.0), ==, 0.0);
    close_to(gb_ball_shared_volume(1.0, 1.0, 1.0), 5.0 * G_PI / 12.0, 1e-15);
    /* next to a huge sphere a small one is cut by a plane */
    close_to(gb_ball_shared_volume(1e9, 1.0, 1e9 + 0.5), gb_ball_slab(1.0, 0.5, INFINITY),
             1e-8);
    g_assert_true(isnan(gb_ball_shared_volume(1.0, 1.0, NAN)) &&
                  isnan(gb_ball_shared_volume(NAN, 1.0, 1.0)));
}

static double disc(double z, void *data)
{
    const double r = *(const double *)data;
    return M_PI * (r - z) * (r + z);
}

static void test_slab(void)
{
    const double full = gb_ball_volume(2.0);
    close_to(gb_ball_slab(2.0, -INFINITY, INFINITY), full, 1e-15);
    close_to(gb_ball_slab(2.0, -2.0, 2.0), full, 1e-15);
    close_to(gb_ball_slab(2.0, -INFINITY, 0.0), 0.5 * full, 1e-15);
    g_assert_cmpfloat(gb_ball_slab(2.0, 2.0, 3.0), ==, 0.0);
    g_assert_cmpfloat(gb_ball_slab(2.0, -INFINITY, -2.0), ==, 0.0);
    g_assert_cmpfloat(gb_ball_slab(2.0, 0.3, 0.3), ==, 0.0);
    g_assert_true(isnan(gb_ball_slab(NAN, 0.0, 1.0)));
    for (int i = 0; i < 20000; i++) {
        double r = log_uniform(1e-8, 1e8);
        const double low = r * g_test_rand_double_range(-1.0, 1.0);
        const double high = low + (r - low) * log_uniform(1e-12, 1.0);
        /* next to the pole the quadrature's points are rounded to a part of r */
        const double known = 4e-16 * r / (r - low);
        close_to(gb_ball_slab(r, low, high), quadrature(disc, &r, low, high),
                 1e-10 + known);
        close_to(gb_ball_slab(r, -high, -low), gb_ball_slab(r, low, high), 1e-13);
        /* the parts add up to the whole */
        close_to(gb_ball_slab(r, -INFINITY, low) + gb_ball_slab(r, low, high) +
                     gb_ball_slab(r, high, INFINITY),
                 gb_ball_volume(r), 1e-14);
    }
    /* caps down to a millionth of a millionth */
    for (int depth = 1; depth <= 40; depth++) {
        const double s = ldexp(1.0, -depth);
        close_to(gb_ball_slab(1.0, 1.0 - s, INFINITY), G_PI * s * s * (3.0 - s) / 3.0,
                 1e-14);
    }
}

/* The outside of a ball, met by adding shells: a sphere within grown balls. */
static void test_monotone(void)
{
    const double distance = 1.0, b = 0.4;
    double last = -1.0;
    for (int i = 0; i <= 2000; i++) {
        const double v = gb_ball_shared_volume(i * 1e-3, b, distance);
        g_assert_cmpfloat(v, >=, last);
        last = v;
    }
    g_assert_cmpfloat(last, ==, gb_ball_volume(b));
}

/* Close-packed balls fill pi/sqrt 18 of a large ball, and exactly one of their own cell.
 */
static void test_density(void)
{
    static const double basis[4][3] = {
        {0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}};
    enum { HALF = 12, COUNT = 4 * (2 * HALF) * (2 * HALF) * (2 * HALF) };
    double *x = g_new(double, 3 * COUNT), *r = g_new(double, COUNT);
    int n = 0;
    for (int i = 0; i < COUNT; i++) {
        const int cell = i / 4, side = 2 * HALF;
        const int at[3] = {cell % side, cell / side % side, cell / side / side};
        for (int k = 0; k < 3; k++) {
            x[3 * n + k] = at[k] - HALF + basis[i % 4][k] + 1e-3 * k;
        }
        r[n++] = sqrt(0.125);
    }
    const double centre[3] = {0.1, 0.2, 0.3}, expected = G_PI / sqrt(18.0);
    const double density = gb_ball_density_central(n, x, r, centre, 9.0);
    g_test_message("density in a ball: %.6f, of the lattice %.6f", density, expected);
    close_to(density, expected, 3e-3);
    close_to(gb_ball_solid_volume(n, x, r, centre, 100.0), n * gb_ball_volume(r[0]),
             1e-12);
    close_to(gb_ball_density_whole(n, r, 4.0, 50.0),
             n * gb_ball_volume(r[0]) / (800.0 * G_PI), 1e-12);
    /* a ball inside one particle is full */
    close_to(gb_ball_density_central(1, x, (double[]){50.0}, centre, 3.0), 1.0, 1e-15);
    g_assert_true(isnan(gb_ball_density_whole(n, r, 4.0, 0.0)));
    g_free(x);
    g_free(r);
}

/* What is counted twice, against the estimate in the header. */
static void test_shared(void)
{
    const double h = 1e-3, x[] = {0, 0, 0, 1 - h, 0, 0, 0, 1 - h, 0};
    const double r[] = {0.5, 0.5, 0.5};
    const int64_t start[] = {0, 2, 2, 2};
    const int32_t other[] = {1, 2};
    const double shared = gb_ball_overlap_volume(3, x, r, start, other);
    close_to(shared, 2.0 * gb_ball_shared_volume(0.5, 0.5, 1 - h), 1e-15);
    /* two contacts among three spheres: z = 4/3 */
    close_to(shared / (3.0 * gb_ball_volume(0.5)), 0.75 * 4.0 / 3.0 * h * h, h);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/ball/random", test_random);
    g_test_add_func("/ball/degenerate", test_degenerate);
    g_test_add_func("/ball/cases", test_cases);
    g_test_add_func("/ball/slab", test_slab);
    g_test_add_func("/ball/monotone", test_monotone);
    g_test_add_func("/ball/density", test_density);
    g_test_add_func("/ball/shared", test_shared);
    return g_test_run();
}
