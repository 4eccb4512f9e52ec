/* Numbers of a yield surface from made-up points: flow along the normal, and beside it. */
#include <glib.h>
#include <math.h>

#include "study/yield.h"

enum { CELLS = 8, DIRECTIONS = 12 };

static const double centre = 60e6, half_p = 50e6, half_q = 30e6;
static const double scatter = 8.0; /* of the flow of one cell, degrees */

static struct gb_yield_point points[CELLS * DIRECTIONS];
static double top[CELLS];

/* Uniform, of standard deviation 1. */
static double noise_of(GRand *random)
{
    return sqrt(12.0) * (g_rand_double(random) - 0.5);
}

/* An ellipse whose flow deviates from the normal towards +p by an angle, with scatter. */
static void measure(struct gb_yield_surface *surface, double deviation_degrees,
                    guint32 seed)
{
    struct gb_error err = {0};
    GRand *random = g_rand_new_with_seed(seed);
    for (int i = 0; i < CELLS * DIRECTIONS; i++) {
        const double direction = 2.0 * M_PI * (i % DIRECTIONS) / DIRECTIONS;
        const double p = cos(direction), q = sin(direction);
        const double normal = atan2(q / half_q, p / half_p);
        const double side = fabs(q) < 1e-9 ? 0.0 : copysign(1.0, q);
        const double noise = noise_of(random);
        const double radius = 1.0 + 0.01 * noise_of(random);
        const double flow =
            normal + (scatter * noise - side * deviation_degrees) * M_PI / 180.0;
        points[i] = (struct gb_yield_point){.density = 0.5,
                                            .p_pa = centre + half_p * radius * p,
                                            .q_pa = half_q * radius * q,
                                            .flow_volume = 1e-3 * cos(flow),
                                            .flow_shear = 1e-3 * sin(flow),
                                            .replica = i / DIRECTIONS + 1,
                                            .direction = direction};
    }
    const struct gb_yield_surface_data data = {points, top, top, CELLS, DIRECTIONS};
    g_assert_true(gb_yield_surface_measure(surface, &data, &err));
    g_rand_free(random);
}

/* Flow along the normal has an rms angle of the size of its errors, without a sign. */
static void test_normal_flow(void)
{
    const double expected = scatter / sqrt((double)CELLS);
    double beyond = 0.0;
    for (guint32 seed = 1; seed <= 40; seed++) {
        struct gb_yield_surface surface = {0};
        measure(&surface, 0.0, seed);
        const struct gb_fit_value *value = surface.quantity;
        g_assert_cmpfloat(value[GB_YIELD_ANGLE_RMS].value, >, 0.4 * expected);
        g_assert_cmpfloat(value[GB_YIELD_ANGLE_RMS].value, <, 1.8 * expected);
        g_assert_cmpfloat_with_epsilon(value[GB_YIELD_ANGLE_NOISE].value, expected,
                                       0.3 * expected);
        beyond += value[GB_YIELD_FLOW_DEVIATION].low > 0.0 ||
                  value[GB_YIELD_FLOW_DEVIATION].high < 0.0;
    }
    g_assert_cmpfloat(beyond, <=, 6.0); /* 5 % of 40 is 2 */
}

static void test_deviating_flow(void)
{
    for (guint32 seed = 1; seed <= 10; seed++) {
        struct gb_yield_surface surface = {0};
        measure(&surface, 12.0, seed);
        const struct gb_fit_value *value = surface.quantity;
        g_assert_cmpfloat_with_epsilon(value[GB_YIELD_FLOW_DEVIATION].value, 12.0,
                                       4.5 * value[GB_YIELD_FLOW_DEVIATION].error);
        g_assert_cmpfloat(value[GB_YIELD_FLOW_DEVIATION].error, <, 2.0);
        g_assert_cmpfloat(value[GB_YIELD_FLOW_DEVIATION].low, >, 0.0);
        g_assert_cmpfloat_with_epsilon(value[GB_YIELD_CENTRE_P].value, centre,
                                       4.5 * value[GB_YIELD_CENTRE_P].error);
        g_assert_cmpfloat_with_epsilon(value[GB_YIELD_SHIFT].value, 1.2,
                                       4.5 * value[GB_YIELD_SHIFT].error);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/yield_surface/normal_flow", test_normal_flow);
    g_test_add_func("/yield_surface/deviating_flow", test_deviating_flow);
    return g_test_run();
}
