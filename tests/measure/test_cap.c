#include <math.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "measure/cap.h"
#include "measure/cap_fit.h"

enum { POINTS = 12, SAMPLES = 300 };

static const struct gb_cap truth[] = {
    {.d = 40e6, .beta = 0.9, .r = 0.7, .p_a = 120e6, .a = 0.03},
    {.d = 1e6, .beta = 0.2, .r = 2.0, .p_a = 3e6, .a = 0.01},
    {.d = 5e8, .beta = 1.1, .r = 0.3, .p_a = 1e8, .a = 0.05},
    {.d = 40e6, .beta = 0.9, .r = 0.7, .p_a = 120e6, .a = 0.0},
};

/* Cap meets transition at p_a with a level tangent, transition the line at p_t with its
 * slope; p_b is on the axis. */
static void test_geometry(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(truth); i++) {
        const struct gb_cap *cap = &truth[i];
        const double depth = gb_cap_depth(cap), step = 1e-7 * depth;
        const double t = gb_cap_tangent(cap), b = gb_cap_end(cap);
        const double top = gb_cap_flattening(cap) * depth;
        const double eps = 1e-9 * depth;
        g_assert_cmpfloat_with_epsilon(gb_cap_height(cap, cap->p_a), top, eps);
        g_assert_cmpfloat_with_epsilon(gb_cap_height(cap, cap->p_a + step), top,
                                       1e-6 * top);
        g_assert_cmpfloat_with_epsilon(gb_cap_height(cap, b), 0.0, 1e-4 * top);
        g_assert_cmpfloat(gb_cap_height(cap, b + step), <, 0.0);
        g_assert_cmpfloat_with_epsilon(gb_cap_height(cap, t), cap->d + t * tan(cap->beta),
                                       eps);
        if (cap->a > 0.0) {
            const double h = 1e-4 * (cap->p_a - t);
            const double slope = (gb_cap_height(cap, t + h) - gb_cap_height(cap, t)) / h;
            g_assert_cmpfloat_with_epsilon(slope, tan(cap->beta),
                                           1e-3 * tan(cap->beta) + 1e-3);
        }
        g_assert_cmpfloat_with_epsilon(gb_cap_height(cap, gb_cap_apex(cap)), 0.0, eps);
        const struct gb_cap same = gb_cap_with_end(cap, b);
        g_assert_cmpfloat_with_epsilon(same.p_a, cap->p_a, eps);
    }
}

/* Flow of the cap is normal to it: along the surface the work of the flow does not
 * change.  At p_a there is no flow of volume. */
static void test_flow(void)
{
    const struct gb_cap *cap = &truth[0];
    double volume, shear;
    for (double share = 0.1; share < 1.0; share += 0.2) {
        const double p = cap->p_a + share * (gb_cap_end(cap) - cap->p_a);
        const double h = 1e2, q = gb_cap_height(cap, p);
        const double slope =
            (gb_cap_height(cap, p + h) - gb_cap_height(cap, p - h)) / (2.0 * h);
        gb_cap_flow(cap, p, q, &volume, &shear);
        g_assert_cmpfloat_with_epsilon(volume + slope * shear, 0.0, 1e-4 * volume);
    }
    gb_cap_flow(cap, cap->p_a, 1.0, &volume, &shear);
    g_assert_cmpfloat(volume, ==, 0.0);
    gb_cap_flow(cap, 0.5 * cap->p_a, 1.0, &volume, &shear);
    g_assert_cmpfloat(volume, <, 0.0);
}

/* Points of a surface on rays from inside, with noise of p and q. */
static void make_points(const struct gb_cap *cap, struct gb_yield_point *point,
                        double noise, gsl_rng *random)
{
    const double b = gb_cap_end(cap), low = 0.9 * gb_cap_apex(cap);
    const double t = gb_cap_tangent(cap);
    for (int i = 0; i < POINTS; i++) {
        const bool shear = i < POINTS / 2;
        const double share = (i % (POINTS / 2) + 0.5) / (POINTS / 2);
        const double p =
            shear ? low + share * (t - low) : cap->p_a + share * share * (b - cap->p_a);
        const double q = gb_cap_height(cap, p), sign = i % 2 == 0 ? 1.0 : -1.0;
        memset(&point[i], 0, sizeof point[i]);
        point[i].p_pa = p;
        point[i].q_pa = sign * q;
        point[i].flow_volume = shear ? -1.0 : 1.0;
        point[i].flow_shear = sign;
        if (random != NULL) {
            point[i].p_error_pa = noise * b;
            point[i].q_error_pa = noise * b;
            point[i].p_pa += gsl_ran_gaussian(random, noise * b);
            point[i].q_pa += gsl_ran_gaussian(random, noise * b);
        }
    }
}

static void expect(const struct gb_fit_value *value, double exact, double share)
{
    g_assert_cmpfloat_with_epsilon(value->value, exact, share * fabs(exact));
}

static void test_exact(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(truth); i++) {
        struct gb_yield_point point[POINTS];
        struct gb_cap_fit fit;
        struct gb_error err = {0};
        make_points(&truth[i], point, 0.0, NULL);
        if (!gb_cap_fit(&fit, point, POINTS, truth[i].a, 0.0, &err)) {
            g_error("%s", err.text);
        }
        expect(&fit.d, truth[i].d, 1e-8);
        expect(&fit.beta, truth[i].beta, 1e-8);
        expect(&fit.r, truth[i].r, 1e-5);
        expect(&fit.p_a, truth[i].p_a, 1e-5);
        expect(&fit.p_b, gb_cap_end(&truth[i]), 1e-5);
        g_assert_cmpuint(fit.shear_points, ==, POINTS / 2);
        /* a point of failure in tension does not count */
        point[0].q_pa = 0.0;
        point[0].flow_shear = 0.1;
        g_assert_true(gb_cap_fit(&fit, point, POINTS, truth[i].a, 0.0, &err));
        expect(&fit.d, truth[i].d, 1e-8);
    }
}

/* Flow along the normal changes nothing; flow of a longer cap lengthens it, the more the
 * more it weighs. */
static void test_flow_counts(void)
{
    const struct gb_cap *cap = &truth[0];
    struct gb_cap longer = *cap;
    struct gb_yield_point point[POINTS];
    struct gb_cap_fit fit[3];
    struct gb_error err = {0};
    longer.r = 1.5 * cap->r;
    make_points(cap, point, 0.0, NULL);
    for (int i = POINTS / 2; i < POINTS; i++) {
        gb_cap_flow(cap, point[i].p_pa, fabs(point[i].q_pa), &point[i].flow_volume,
                    &point[i].flow_shear);
        point[i].flow_shear *= point[i].q_pa < 0.0 ? -1.0 : 1.0;
    }
    g_assert_true(gb_cap_fit(&fit[0], point, POINTS, cap->a, 1.0, &err));
    expect(&fit[0].r, cap->r, 1e-6);
    expect(&fit[0].p_a, cap->p_a, 1e-6);
    for (int i = POINTS / 2; i < POINTS; i++) {
        gb_cap_flow(&longer, point[i].p_pa, point[i].q_pa, &point[i].flow_volume,
                    &point[i].flow_shear);
    }
    for (int k = 0; k < 3; k++) {
        g_assert_true(
            gb_cap_fit(&fit[k], point, POINTS, cap->a, k == 0 ? 0.0 : 0.1 * k * k, &err));
    }
    expect(&fit[0].r, cap->r, 1e-5);
    g_assert_cmpfloat(fit[1].r.value, >, 1.001 * cap->r);
    g_assert_cmpfloat(fit[2].r.value, >, 1.001 * fit[1].r.value);
}

/* The 95 % intervals cover the truth: of 300 samples 285 on average, standard deviation
 * 3.8. */
static void test_coverage(void)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const struct gb_cap *cap = &truth[0];
    const double exact[5] = {cap->d, cap->beta, cap->r, cap->p_a, gb_cap_end(cap)};
    int inside[5] = {0};
    for (int s = 0; s < SAMPLES; s++) {
        struct gb_yield_point point[POINTS];
        struct gb_cap_fit fit;
        struct gb_error err = {0};
        make_points(cap, point, 0.01, random);
        if (!gb_cap_fit(&fit, point, POINTS, cap->a, 0.0, &err)) {
            g_error("%s", err.text);
        }
        const struct gb_fit_value *const value[5] = {&fit.d, &fit.beta, &fit.r, &fit.p_a,
                                                     &fit.p_b};
        for (int k = 0; k < 5; k++) {
            inside[k] += value[k]->low <= exact[k] && exact[k] <= value[k]->high;
        }
    }
    for (int k = 0; k < 5; k++) {
        g_test_message("parameter %d: %d of %d", k, inside[k], SAMPLES);
        g_assert_cmpint(inside[k], >=, 270);
        g_assert_cmpint(inside[k], <=, 297);
    }
    gsl_rng_free(random);
}

static void test_refused(void)
{
    struct gb_yield_point point[POINTS];
    struct gb_cap_fit fit;
    struct gb_error err = {0};
    make_points(&truth[0], point, 0.0, NULL);
    g_assert_false(gb_cap_fit(&fit, point, POINTS / 2, 0.03, 0.0, &err));
    g_assert_nonnull(strstr(err.text, "lie on the cap"));
    g_assert_false(gb_cap_fit(&fit, point + POINTS / 2, POINTS / 2, 0.03, 0.0, &err));
    g_assert_nonnull(strstr(err.text, "fail in shear"));
    for (int i = 0; i < POINTS / 2; i++) {
        point[i].q_pa = 1e8 - 0.5 * point[i].p_pa;
    }
    g_assert_false(gb_cap_fit(&fit, point, POINTS, 0.03, 0.0, &err));
    g_assert_nonnull(strstr(err.text, "tan(beta)"));
}

/* Two rows; K, G, d, beta and R alike, so that closed forms exist. */
static const struct gb_cap_row rows[] = {
    {.density = 0.40,
     .bulk = 4e9,
     .shear_modulus = 3e9,
     .cap = {.d = 30e6, .beta = 0.8, .r = 0.6, .a = 0.03},
     .p_b = 50e6,
     .plastic_volume = 0.0},
    {.density = 0.60,
     .bulk = 4e9,
     .shear_modulus = 3e9,
     .cap = {.d = 30e6, .beta = 0.8, .r = 0.6, .a = 0.03},
     .p_b = 650e6,
     .plastic_volume = 0.3},
};
static const struct gb_cap_material material = {rows, G_N_ELEMENTS(rows)};

static void strain(struct gb_cap_state *state, const double step[6])
{
    struct gb_error err = {0};
    if (!gb_cap_strain(&material, state, step, &err)) {
        g_error("%s", err.text);
    }
}

static void test_elastic(void)
{
    struct gb_cap_state state = {.density = 0.42};
    const double step[6] = {0.0, 0.0, 2e-3, 0.0, 1e-3, 0.0};
    strain(&state, step);
    g_assert_cmpfloat_with_epsilon(state.pressure[2], (4e9 + 4e9) * 2e-3, 1.0);
    g_assert_cmpfloat_with_epsilon(state.pressure[0], (4e9 - 2e9) * 2e-3, 1.0);
    g_assert_cmpfloat_with_epsilon(state.pressure[4], 3e9 * 1e-3, 1.0);
    g_assert_cmpfloat(state.plastic_volume, ==, 0.0);
    g_assert_cmpfloat_with_epsilon(state.density, 0.42 * exp(2e-3), 1e-12);
}

/* Isotropic compression from p_b on: d eps = dp/K + dp/(dp_b/d eps_p), both linear. */
static void test_isotropic(void)
{
    struct gb_cap_state state = {.density = 0.41};
    const double total = 0.10, slope = 600e6 / 0.3;
    const double step[6] = {total / 3.0, total / 3.0, total / 3.0, 0.0, 0.0, 0.0};
    const double after = total - 50e6 / 4e9;
    const double p = 50e6 + after / (1.0 / 4e9 + 1.0 / slope);
    strain(&state, step);
    g_assert_cmpfloat_with_epsilon(gb_cap_mean(state.pressure), p, 1e-6 * p);
    g_assert_cmpfloat_with_epsilon(state.plastic_volume, (p - 50e6) / slope, 1e-8);
    g_assert_cmpfloat_with_epsilon(gb_cap_deviator(state.pressure), 0.0, 1.0);
    /* back to no pressure: elastic */
    const double back[6] = {-p / 12e9, -p / 12e9, -p / 12e9, 0.0, 0.0, 0.0};
    strain(&state, back);
    g_assert_cmpfloat_with_epsilon(gb_cap_mean(state.pressure), 0.0, 1e-6 * p);
}

/* On a uniaxial path the stress stays on the cap, and its flow follows the normal; steps
 * need no sub-steps of the caller. */
static void test_uniaxial(void)
{
    struct gb_cap_state coarse = {.density = 0.41}, fine = coarse;
    const double whole[6] = {0.0, 0.0, 0.05, 0.0, 0.0, 0.0};
    const double small[6] = {0.0, 0.0, 0.05 / 4000.0, 0.0, 0.0, 0.0};
    strain(&coarse, whole);
    for (int i = 0; i < 4000; i++) {
        strain(&fine, small);
    }
    const double p = gb_cap_mean(fine.pressure), q = gb_cap_deviator(fine.pressure);
    const struct gb_cap_row now = gb_cap_at(&material, fine.density, fine.plastic_volume);
    g_assert_cmpfloat_with_epsilon(q, gb_cap_height(&now.cap, p), 1e-4 * q);
    g_assert_cmpfloat(p, >, now.cap.p_a);
    g_assert_cmpfloat_with_epsilon(coarse.pressure[0] / coarse.pressure[2],
                                   fine.pressure[0] / fine.pressure[2], 2e-4);
    g_assert_cmpfloat_with_epsilon(coarse.pressure[2], fine.pressure[2],
                                   1e-3 * fine.pressure[2]);
}

/* Shear at constant volume from low pressure reaches the failure line, dilates plastically
 * and so raises the pressure. */
static void test_shear(void)
{
    struct gb_cap_state state = {.density = 0.45, .plastic_volume = 0.2};
    const double step[6] = {0.0, 0.0, 0.0, 0.0, 0.04, 0.0};
    strain(&state, step);
    const double p = gb_cap_mean(state.pressure), q = gb_cap_deviator(state.pressure);
    const struct gb_cap_row now =
        gb_cap_at(&material, state.density, state.plastic_volume);
    g_assert_cmpfloat(p, >, 0.0);
    g_assert_cmpfloat(state.plastic_volume, <, 0.2);
    g_assert_cmpfloat_with_epsilon(q, now.cap.d + p * tan(now.cap.beta), 2e-3 * q);
    g_assert_cmpfloat_with_epsilon(sqrt(3.0) * state.pressure[4], q, 1e-9 * q);
    g_assert_cmpfloat_with_epsilon(p / 4e9, 0.2 - state.plastic_volume, 1e-9);
}

/* Tension returns to the apex and to no stress beyond it. */
static void test_tension(void)
{
    struct gb_cap_state state = {.density = 0.45, .plastic_volume = 0.2};
    const double step[6] = {-0.02, -0.02, -0.02, 0.0, 0.0, 0.0};
    strain(&state, step);
    const double apex = -30e6 / tan(0.8);
    g_assert_cmpfloat_with_epsilon(gb_cap_mean(state.pressure), apex, 1e-6 * -apex);
}

static void test_check(void)
{
    struct gb_cap_row wrong[2] = {rows[0], rows[1]};
    const struct gb_cap_material bad = {wrong, 2};
    struct gb_error err = {0};
    g_assert_true(gb_cap_check(&material, &err));
    wrong[1].p_b = wrong[0].p_b;
    g_assert_false(gb_cap_check(&bad, &err));
    g_assert_nonnull(strstr(err.text, "0.6000"));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/cap/geometry", test_geometry);
    g_test_add_func("/cap/flow", test_flow);
    g_test_add_func("/cap/exact", test_exact);
    g_test_add_func("/cap/flow-counts", test_flow_counts);
    g_test_add_func("/cap/coverage", test_coverage);
    g_test_add_func("/cap/refused", test_refused);
    g_test_add_func("/cap/elastic", test_elastic);
    g_test_add_func("/cap/isotropic", test_isotropic);
    g_test_add_func("/cap/uniaxial", test_uniaxial);
    g_test_add_func("/cap/shear", test_shear);
    g_test_add_func("/cap/tension", test_tension);
    g_test_add_func("/cap/check", test_check);
    return g_test_run();
}
