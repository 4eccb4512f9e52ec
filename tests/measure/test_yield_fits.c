/* Offset of the plastic strain, fit of an ellipse, Weibull's law: exact cases. */
#include <glib.h>
#include <math.h>

#include "measure/distribution.h"
#include "measure/elastic.h"
#include "measure/yield_point.h"

enum { ROWS = 400 };

static const double bulk = 5.0, shear3 = 8.0; /* stress per strain, GPa */

static struct gb_yield_elastic elastic_of(void)
{
    struct gb_yield_elastic elastic;
    const double by_volume[2] = {bulk, 0.4}, by_shear[2] = {0.3, shear3};
    g_assert_true(gb_yield_point_elastic(&elastic, by_volume, by_shear));
    return elastic;
}

/* Elastic, with coupled moduli, up to q = 0.01 GPa; then q stays and strain flows with a
 * dilatancy of 0.25: the yield point is where it became plastic. */
static void test_perfectly_plastic(void)
{
    double p[ROWS], q[ROWS], v[ROWS], w[ROWS];
    const double yield = 0.01, flow = -0.25;
    const double elastic_w = yield / (shear3 - 0.4 * 0.3 / bulk);
    for (int i = 0; i < ROWS; i++) {
        const double strain = 2e-5 * i;
        const double plastic = fmax(0.0, strain - elastic_w);
        const double we = strain - plastic;
        const double ve = -0.3 / bulk * we; /* p stays */
        p[i] = 0.1 + bulk * ve + 0.3 * we;
        q[i] = 0.4 * ve + shear3 * we;
        v[i] = 0.7 + ve + flow * plastic;
        w[i] = 0.01 + strain;
    }
    const struct gb_yield_path path = {p, q, v, w, ROWS, M_PI / 2.0};
    const struct gb_yield_elastic elastic = elastic_of();
    struct gb_yield_point point;
    g_assert_true(gb_yield_point_find(&path, &elastic, 1e-3, 1.5, &point));
    g_assert_cmpfloat_with_epsilon(point.q_pa, yield, 1e-12);
    g_assert_cmpfloat_with_epsilon(point.p_pa, 0.1, 1e-12);
    g_assert_cmpfloat_with_epsilon(point.flow_shear, 1e-3, 1e-9);
    g_assert_cmpfloat_with_epsilon(point.flow_volume, flow * 1e-3, 1e-9);
    g_assert_false(gb_yield_point_find(&path, &elastic, 0.02, 1.5, &point));
}

/* An elastic path has no yield point; slopes without a stiffness are refused. */
static void test_elastic(void)
{
    double p[ROWS], q[ROWS], v[ROWS], w[ROWS];
    for (int i = 0; i < ROWS; i++) {
        v[i] = 1e-5 * i;
        w[i] = 0.02;
        p[i] = 0.2 + bulk * v[i];
        q[i] = -0.1 + 0.4 * v[i];
    }
    const struct gb_yield_path path = {p, q, v, w, ROWS, 0.0};
    const struct gb_yield_elastic elastic = elastic_of();
    struct gb_yield_point point;
    g_assert_false(gb_yield_point_find(&path, &elastic, 1e-6, 1.5, &point));
    const double none[2] = {-1.0, 0.0}, slope[2] = {bulk, 0.4};
    struct gb_yield_elastic refused;
    g_assert_false(gb_yield_point_elastic(&refused, none, slope));
}

/* A compact that stiffens under compression takes less strain than its first stiffness says.
 * That is no flow, until it yields: then the offset counts from there. */
static void test_stiffening(void)
{
    double p[ROWS], q[ROWS], v[ROWS], w[ROWS];
    const double yield = 0.2; /* by then 2.4e-3 of strain are missing */
    for (int i = 0; i < ROWS; i++) {
        const double strain = 1.5e-4 * i;
        const double pressure = bulk * strain * (1.0 + 1.5 * strain);
        p[i] = fmin(pressure, yield);
        q[i] = 0.0;
        v[i] = strain;
        w[i] = 0.0;
    }
    const double by_volume[2] = {bulk, 0.0}, by_shear[2] = {0.0, shear3};
    struct gb_yield_path path = {p, q, v, w, ROWS, 0.0};
    struct gb_yield_elastic elastic;
    struct gb_yield_point point;
    g_assert_true(gb_yield_point_elastic(&elastic, by_volume, by_shear));
    g_assert_true(gb_yield_point_find(&path, &elastic, 1e-3, 1.5, &point));
    g_assert_cmpfloat_with_epsilon(point.p_pa, yield, 1e-12);
    g_assert_cmpfloat(point.flow_volume, >, 0.0);
    path.count = 250; /* before it yields */
    g_assert_false(gb_yield_point_find(&path, &elastic, 1e-3, 1.5, &point));
}

/* An isotropic body, then one that is stiffer along z. */
static void test_plane(void)
{
    static const double k = 5.0, g = 3.0, more = 0.9;
    double c[6][6] = {{0.0}}, by_volume[2], by_shear[2];
    for (int m = 0; m < 3; m++) {
        for (int n = 0; n < 3; n++) {
            c[m][n] = k - 2.0 / 3.0 * g + (m == n ? 2.0 * g : 0.0);
        }
        c[m + 3][m + 3] = g;
    }
    gb_elastic_plane((const double(*)[6])c, by_volume, by_shear);
    g_assert_cmpfloat_with_epsilon(by_volume[0], k, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_volume[1], 0.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_shear[0], 0.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_shear[1], 3.0 * g, 1e-12);
    c[2][2] += more;
    gb_elastic_plane((const double(*)[6])c, by_volume, by_shear);
    g_assert_cmpfloat_with_epsilon(by_volume[0], k + more / 9.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_volume[1], more / 3.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_shear[0], more / 3.0, 1e-12);
    g_assert_cmpfloat_with_epsilon(by_shear[1], 3.0 * g + more, 1e-12);
}

static void test_ellipse(void)
{
    enum { POINTS = 12 };
    double p[POINTS], q[POINTS];
    struct gb_ellipse ellipse;
    struct gb_error err = {0};
    for (int i = 0; i < POINTS; i++) {
        p[i] = 40.0 + 55.0 * cos(0.3 + i);
        q[i] = -3.0 + 20.0 * sin(0.3 + i);
    }
    g_assert_true(gb_yield_point_ellipse(&ellipse, p, q, POINTS, &err));
    g_assert_cmpfloat_with_epsilon(ellipse.centre_p, 40.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(ellipse.centre_q, -3.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(ellipse.half_p, 55.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(ellipse.half_q, 20.0, 1e-6);
    g_assert_cmpfloat(ellipse.misfit, <, 1e-9);
    const double normal = gb_yield_point_ellipse_normal(&ellipse, p[2], q[2]);
    const double exact = atan2(sin(2.3) / 20.0, cos(2.3) / 55.0);
    g_assert_cmpfloat_with_epsilon(normal, exact, 1e-6);
    g_assert_false(gb_yield_point_ellipse(&ellipse, p, q, 3, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

/* Quantiles of the law at evenly spaced probabilities; the scale of the values is free. */
static void test_weibull(void)
{
    enum { VALUES = 2000 };
    double value[VALUES];
    struct gb_weibull law, scaled;
    struct gb_error err = {0};
    for (int i = 0; i < VALUES; i++) {
        value[i] = 30.0 * pow(-log1p(-(i + 0.5) / VALUES), 1.0 / 7.0);
    }
    g_assert_true(gb_distribution_weibull(&law, value, VALUES, &err));
    g_assert_cmpfloat_with_epsilon(law.modulus, 7.0, 0.05);
    g_assert_cmpfloat_with_epsilon(law.scale, 30.0, 0.02);
    /* asymptotic standard error of the modulus: 0.78 m / sqrt(n) */
    g_assert_cmpfloat_with_epsilon(law.modulus_high - law.modulus_low,
                                   2.0 * 1.96 * 0.7797 * 7.0 / sqrt(VALUES), 0.02);
    for (int i = 0; i < VALUES; i++) {
        value[i] *= 1e6;
    }
    g_assert_true(gb_distribution_weibull(&scaled, value, VALUES, &err));
    g_assert_cmpfloat_with_epsilon(scaled.modulus, law.modulus, 1e-6);
    g_assert_false(gb_distribution_weibull(&law, value, 2, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/yield/plane", test_plane);
    g_test_add_func("/yield/perfectly_plastic", test_perfectly_plastic);
    g_test_add_func("/yield/elastic", test_elastic);
    g_test_add_func("/yield/stiffening", test_stiffening);
    g_test_add_func("/yield/ellipse", test_ellipse);
    g_test_add_func("/yield/weibull", test_weibull);
    return g_test_run();
}
