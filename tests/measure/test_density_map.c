#include <math.h>

#include <glib.h>

#include "measure/ball.h"

/* Sphere within a cylinder about its own axis: a slab of the sphere where it is wide. */
static void test_coaxial(void)
{
    for (int k = 1; k <= 8; k++) {
        const double sphere = 1.3, cylinder = 0.2 * k, c = fmin(cylinder, sphere);
        const double half = sqrt(sphere * sphere - c * c);
        /* the cylinder's part between the caps, and the caps */
        const double exact =
            2.0 * M_PI * c * c * half + 2.0 * gb_ball_slab(sphere, half, INFINITY);
        const double found = gb_ball_cylinder(cylinder, sphere, 0.0, -INFINITY, INFINITY);
        g_assert_cmpfloat_with_epsilon(found / exact, 1.0, 1e-6);
        const double part = gb_ball_cylinder(cylinder, sphere, 0.0, 0.0, INFINITY);
        g_assert_cmpfloat_with_epsilon(part / exact, 0.5, 1e-6);
    }
}

/* A cylinder far wider than the sphere is a plane: half of it where it runs through the
 * centre. */
static void test_plane(void)
{
    const double sphere = 0.7, wide = 1e5, ball = gb_ball_volume(sphere);
    for (double at = -0.6; at <= 0.6; at += 0.15) {
        const double exact = gb_ball_slab(sphere, -INFINITY, at);
        const double found =
            gb_ball_cylinder(wide, sphere, wide - at, -INFINITY, INFINITY);
        g_assert_cmpfloat_with_epsilon(found / ball, exact / ball, 1e-5);
    }
    g_assert_cmpfloat(gb_ball_cylinder(1.0, 0.5, 1.5, -INFINITY, INFINITY), ==, 0.0);
    g_assert_cmpfloat_with_epsilon(
        gb_ball_cylinder(2.0, sphere, 0.4, -INFINITY, INFINITY) / ball, 1.0, 1e-6);
}

/* Against a midpoint rule in the plane of the section, 240 x 240 cells. */
static void test_eccentric(void)
{
    enum { N = 240 };
    static const double cases[][3] = {
        {0.5, 0.4, 0.3}, {0.5, 0.4, 0.6}, {0.3, 0.8, 0.5}, {0.3, 0.8, 1.0}};
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        const double cylinder = cases[k][0], sphere = cases[k][1], axis = cases[k][2];
        double sum = 0.0;
        for (int i = 0; i < N; i++) {
            for (int j = 0; j < N; j++) {
                const double x = axis - sphere + 2.0 * sphere * (i + 0.5) / N;
                const double y = -sphere + 2.0 * sphere * (j + 0.5) / N;
                const double left2 = sphere * sphere - (x - axis) * (x - axis) - y * y;
                sum += x * x + y * y < cylinder * cylinder && left2 > 0.0
                           ? 2.0 * sqrt(left2)
                           : 0.0;
            }
        }
        sum *= 4.0 * sphere * sphere / N / N;
        const double found =
            gb_ball_cylinder(cylinder, sphere, axis, -INFINITY, INFINITY);
        g_assert_cmpfloat_with_epsilon(found / gb_ball_volume(sphere),
                                       sum / gb_ball_volume(sphere), 1e-3);
    }
}

/* All cells together hold all of the spheres, whatever their number; no cell is
 * negative. */
static void test_conserves(void)
{
    enum { SPHERES = 60, MOST = 200 };
    double position[3 * SPHERES], radius[SPHERES], density[MOST], solid = 0.0;
    static const int shape[][2] = {{1, 1}, {7, 1}, {1, 11}, {9, 13}};
    for (int i = 0; i < SPHERES; i++) {
        radius[i] = 0.3 + 0.2 * sin(3.7 * i);
        const double rho = 2.0 * fabs(sin(1.3 * i)), angle = 2.4 * i;
        position[3 * i] = 5.0 + rho * cos(angle);
        position[3 * i + 1] = 4.0 + rho * sin(angle);
        position[3 * i + 2] = 0.6 + 0.1 * i;
        solid += gb_ball_volume(radius[i]);
    }
    for (size_t k = 0; k < G_N_ELEMENTS(shape); k++) {
        const struct gb_density_map map = {shape[k][0], shape[k][1], 3.0, 0.0, 8.0};
        double sum = 0.0;
        gb_ball_density_map(&map, SPHERES, position, radius, (double[2]){5.0, 4.0},
                            density);
        for (int c = 0; c < map.rings * map.bands; c++) {
            const double ring = c / map.bands, width = map.radius / map.rings;
            g_assert_cmpfloat(density[c], >, -1e-9);
            sum +=
                density[c] * M_PI * width * width * (2.0 * ring + 1.0) * 8.0 / map.bands;
        }
        g_assert_cmpfloat_with_epsilon(sum / solid, 1.0, 1e-6);
    }
}

/* A column of touching spheres on the axis: its density in a tube of their size is 2/3 in
 * every band of their height. */
static void test_column(void)
{
    enum { BALLS = 6 };
    double position[3 * BALLS], radius[BALLS], density[BALLS];
    for (int i = 0; i < BALLS; i++) {
        position[3 * i] = position[3 * i + 1] = 0.0;
        position[3 * i + 2] = i + 0.5;
        radius[i] = 0.5;
    }
    const struct gb_density_map map = {1, BALLS, 0.5, 0.0, BALLS};
    gb_ball_density_map(&map, BALLS, position, radius, (double[2]){0.0, 0.0}, density);
    for (int k = 0; k < BALLS; k++) {
        g_assert_cmpfloat_with_epsilon(density[k], 2.0 / 3.0, 1e-6);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/density_map/coaxial", test_coaxial);
    g_test_add_func("/density_map/plane", test_plane);
    g_test_add_func("/density_map/eccentric", test_eccentric);
    g_test_add_func("/density_map/conserves", test_conserves);
    g_test_add_func("/density_map/column", test_column);
    return g_test_run();
}
