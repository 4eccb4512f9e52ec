/* What is left out of a picture is seen by no ray through the middle of a sample. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/hidden.h"

enum { WIDTH = 240, HEIGHT = 180, SPHERES = 3000, RODS = 400 };

static float uniform(GRand *rand, double low, double high)
{
    return (float)g_rand_double_range(rand, low, high);
}

static void fill(struct gb_scene *scene, double radius)
{
    GRand *rand = g_rand_new_with_seed(7);
    for (size_t i = 0; i < scene->count; i++) {
        float *at = &scene->sphere[4 * i];
        at[0] = uniform(rand, -6.0, 6.0);
        at[1] = uniform(rand, -6.0, 6.0);
        at[2] = uniform(rand, 30.0, 42.0);
        at[3] = (float)radius * uniform(rand, 0.7, 1.3);
    }
    for (size_t i = 0; i < scene->rods; i++) {
        float *rod = &scene->rod[8 * i];
        memcpy(rod, &scene->sphere[4 * i], 3 * sizeof *rod);
        memcpy(rod + 4, &scene->sphere[4 * (i + 1)], 3 * sizeof *rod);
        rod[3] = 0.05F;
        for (int k = 0; k < 3; k++) {
            rod[4 + k] = rod[k] + 0.1F * (rod[4 + k] - rod[k]);
        }
    }
    g_rand_free(rand);
}

/* Squared distance of a ray from a point, and how far along it is. */
static double miss(const double from[3], const double ray[3], const float *at, double *t)
{
    double to[3];
    double along = 0.0;
    double rays = 0.0;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        to[k] = (double)at[k] - from[k];
        along += to[k] * ray[k];
        rays += ray[k] * ray[k];
    }
    *t = along / rays;
    for (int k = 0; k < 3; k++) {
        const double off = to[k] - *t * ray[k];
        sum += off * off;
    }
    return sum;
}

static double enter(const double from[3], const double ray[3], const float *at, double r)
{
    double t;
    const double h = r * r - miss(from, ray, at, &t);
    const double rays = ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2];
    return h < 0.0 ? INFINITY : t - sqrt(h / rays);
}

/* The part that a ray meets first; rods are balls along their way here. */
static size_t first_met(const struct gb_scene *scene, const double from[3],
                        const double ray[3])
{
    size_t best = scene->count + scene->rods;
    double nearest = INFINITY;
    for (size_t i = 0; i < scene->count; i++) {
        const float *at = &scene->sphere[4 * i];
        const double t = enter(from, ray, at, (double)at[3]);
        if (t < nearest) {
            nearest = t;
            best = i;
        }
    }
    for (size_t i = 0; i < scene->rods; i++) {
        for (int step = 0; step <= 8; step++) {
            const float *rod = &scene->rod[8 * i];
            float at[3];
            for (int k = 0; k < 3; k++) {
                at[k] = rod[k] + 0.125F * (float)step * (rod[4 + k] - rod[k]);
            }
            const double t = enter(from, ray, at, (double)rod[3]);
            if (t < nearest) {
                nearest = t;
                best = scene->count + i;
            }
        }
    }
    return best;
}

/* Number of hidden parts; fails when one of them is seen. */
static int check(const struct gb_scene *scene, const struct gb_camera *camera)
{
    const size_t parts = scene->count + scene->rods;
    uint8_t *hidden = g_malloc(parts);
    struct gb_error err = {0};
    g_assert_true(gb_hidden_find(scene, camera, WIDTH, HEIGHT, hidden, &err));
    for (int y = 0; y < HEIGHT; y += 3) {
        for (int x = 0; x < WIDTH; x += 3) {
            const double focal = (double)camera->projection[2];
            const double u = (x + 0.5 - (double)camera->projection[0]) / focal;
            const double v = -(y + 0.5 - (double)camera->projection[1]) / focal;
            const bool flat = camera->projection[3] != 0.0F;
            const double from[3] = {flat ? u : 0.0, flat ? v : 0.0, 0.0};
            const double ray[3] = {flat ? 0.0 : u, flat ? 0.0 : v, 1.0};
            const size_t met = first_met(scene, from, ray);
            g_assert_true(met == parts || hidden[met] == 0);
        }
    }
    int count = 0;
    for (size_t i = 0; i < parts; i++) {
        count += hidden[i];
    }
    g_free(hidden);
    return count;
}

static const struct gb_camera straight = {
    .projection = {0.5F * WIDTH, 0.5F * HEIGHT, 12.0F, 1.0F},
    .depth_range = {29.0F, 43.0F},
    .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
};

static void test_view(gconstpointer data)
{
    const bool flat = GPOINTER_TO_INT(data) != 0;
    float sphere[4 * (SPHERES + 1)];
    float rod[8 * RODS];
    struct gb_scene scene = {
        .count = SPHERES, .rods = RODS, .sphere = sphere, .rod = rod};
    struct gb_camera camera = straight;
    camera.projection[2] = flat ? 12.0F : 400.0F;
    camera.projection[3] = flat ? 1.0F : 0.0F;
    fill(&scene, 0.5);
    const int hidden = check(&scene, &camera);
    g_assert_cmpint(hidden, >, SPHERES / 3); /* worth it */
    g_assert_cmpint(hidden, <, SPHERES);
    fill(&scene, 0.1); /* gaps everywhere */
    g_assert_cmpint(check(&scene, &camera), <, hidden);
}

/* What reaches beyond the target is kept, even behind a wall. */
static void test_border(void)
{
    float sphere[4 * 3] = {0.0F, 0.0F, 30.0F, 5.0F, /* in front */
                           0.0F, 0.0F, 50.0F, 1.0F, /* behind it */
                           0.0F, 0.0F, 90.0F, 20.0F /* larger than the target */};
    float rod[8] = {0.0F, 0.0F, 50.0F, 0.5F, 1.0F, 0.0F, 55.0F, 0.0F};
    uint8_t hidden[4];
    const struct gb_scene scene = {.count = 3, .rods = 1, .sphere = sphere, .rod = rod};
    g_assert_true(gb_hidden_find(&scene, &straight, WIDTH, HEIGHT, hidden, NULL));
    g_assert_cmpint(hidden[0], ==, 0);
    g_assert_cmpint(hidden[1], ==, 1);
    g_assert_cmpint(hidden[2], ==, 0);
    g_assert_cmpint(hidden[3], ==, 1);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_data_func("/hidden/flat", GINT_TO_POINTER(1), test_view);
    g_test_add_data_func("/hidden/perspective", GINT_TO_POINTER(0), test_view);
    g_test_add_func("/hidden/border", test_border);
    return g_test_run();
}
