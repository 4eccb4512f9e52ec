#include <glib.h>
#include <math.h>

#include "common/unequal.h"
#include "scene/unequal_pair.h"

/* The laws of contacts between unequal spheres. */

/* Between equal spheres of diameter 1 the laws are those of P1. */
static void test_equal(void)
{
    const struct gb_model model = unequal_model(NULL, NULL);
    struct gb_law_unequal law;
    gb_unequal_pair_init(&law, &model, 1.0, 1.0);
    for (double h = 1e-4; h < 0.4; h *= 1.7) {
        double slope;
        unequal_close(gb_law_unequal_elastic(&law, 0.0, h, &slope),
                      gb_law_rod_force(&model.rod, h), 1e-14);
        unequal_close(slope, gb_law_rod_stiffness(&model.rod, h), 1e-14);
        unequal_close(gb_law_unequal_elastic(&law, h, 0.7 * h, NULL),
                      gb_law_bridge_force(&model.rod, h, 0.7 * h), 1e-12);
        unequal_close(gb_law_unequal_elastic_energy(&law, 0.0, h),
                      gb_law_rod_energy(&model.rod, h), 1e-14);
        unequal_close(gb_law_unequal_moment(&law, h), gb_law_rod_moment(&model.rod, h),
                      1e-14);
        unequal_close(gb_law_unequal_radius(&law, h), 0.5 * sqrt(h), 1e-14);
    }
    for (double r = 0.95; r < 1.6; r += 0.01) {
        unequal_close(gb_law_unequal_attraction(&law, r),
                      gb_law_dispersion_force(&model.dispersion, r), 1e-12);
        unequal_close(gb_law_unequal_attraction_energy(&law, r),
                      gb_law_dispersion_energy(&model.dispersion, r), 1e-9);
    }
}

/* The laws do not depend on the unit of length: equal spheres of 2 d follow those of P1 at
 * that size. */
static void test_scale(void)
{
    const struct gb_params twice =
        scene_params("particles.diameter=19.4 nm", "contact.bridge_length=0.008 d", NULL);
    const struct gb_model own = scene_model(&twice);
    const struct gb_params once = scene_params(NULL);
    const struct gb_model model = scene_model(&once);
    struct gb_law_unequal law;
    gb_unequal_pair_init(&law, &model, 2.0, 2.0);
    for (double h = 1e-3; h < 0.3; h *= 2.0) {
        unequal_close(gb_law_unequal_elastic(&law, 0.0, 2.0 * h, NULL),
                      4.0 * gb_law_rod_force(&own.rod, h), 1e-13);
        unequal_close(gb_law_unequal_moment(&law, 2.0 * h),
                      8.0 * gb_law_rod_moment(&own.rod, h), 1e-13);
        unequal_close(gb_law_unequal_attraction(&law, 2.0 * (1.0 + h)),
                      4.0 * gb_law_dispersion_force(&own.dispersion, 1.0 + h), 1e-12);
    }
    unequal_close(gb_law_unequal_equilibrium(&law), 2.0 * own.h_eq, 1e-12);
    unequal_close(law.bridge_length, 2.0 * own.bridge.length, 1e-14);
}

static const double sizes[][2] = {{0.5, 1.9}, {1.9, 0.5}, {0.8, 0.9}, {0.4, 0.4}};

/* Forces are slopes of energies; the order of the two particles does not matter. */
static void test_potential(void)
{
    const struct gb_model model = unequal_model(NULL, NULL);
    for (size_t s = 0; s < G_N_ELEMENTS(sizes); s++) {
        struct gb_law_unequal law, other;
        gb_unequal_pair_init(&law, &model, sizes[s][0], sizes[s][1]);
        gb_unequal_pair_init(&other, &model, sizes[s][1], sizes[s][0]);
        const double step = 1e-5 * law.mean_diameter;
        for (double h = 1e-3; h < 0.3; h *= 2.0) {
            const double from = h * law.mean_diameter;
            const double slope = (gb_law_unequal_elastic_energy(&law, 0.0, from + step) -
                                  gb_law_unequal_elastic_energy(&law, 0.0, from - step)) /
                                 (2.0 * step);
            const double force = gb_law_unequal_elastic(&law, 0.0, from, NULL);
            unequal_close(slope, force, 1e-4);
            g_assert_cmpfloat(force, ==, gb_law_unequal_elastic(&other, 0.0, from, NULL));
        }
        for (double gap = 0.01; gap < 0.5; gap *= 2.0) {
            const double r = (1.0 + gap) * law.mean_diameter;
            const double slope = (gb_law_unequal_attraction_energy(&law, r + step) -
                                  gb_law_unequal_attraction_energy(&law, r - step)) /
                                 (2.0 * step);
            unequal_close(slope, gb_law_unequal_attraction(&law, r), 1e-5);
        }
        const double rest = gb_law_unequal_equilibrium(&law);
        unequal_close(gb_law_unequal_elastic(&law, 0.0, rest, NULL), law.adhesion, 1e-12);
    }
}

/* Small overlaps follow Hertz with the reduced radius; near a much larger sphere (3) tends
 * to Hamaker's sphere at a wall, whose leading term is A d/(12 s^2) with the gap s. */
static void test_limits(void)
{
    const struct gb_model model = unequal_model(NULL, NULL);
    struct gb_law_unequal law;
    gb_unequal_pair_init(&law, &model, 0.5, 2.0);
    const double h = 1e-7, reduced = 0.25 * 1.0 / 1.25;
    unequal_close(gb_law_unequal_elastic(&law, 0.0, h, NULL),
                  4.0 * model.rod.hertz * 0.5 * sqrt(reduced) * pow(h, 1.5), 2e-3);
    unequal_close(gb_law_unequal_radius(&law, h), sqrt(reduced * h), 1e-13);
    gb_unequal_pair_init(&law, &model, 1.0, 1e5);
    const double alpha_d0 = model.dispersion.shift, gap = 0.01;
    const double hamaker = 6.0 * model.dispersion.strength;
    unequal_close(gb_law_unequal_attraction(&law, law.mean_diameter + gap),
                  hamaker / (12.0 * (gap + alpha_d0) * (gap + alpha_d0)),
                  4.0 * (gap + alpha_d0));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/sized/equal", test_equal);
    g_test_add_func("/sized/scale", test_scale);
    g_test_add_func("/sized/potential", test_potential);
    g_test_add_func("/sized/limits", test_limits);
    return g_test_run();
}
