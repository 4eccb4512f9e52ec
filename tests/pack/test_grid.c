#include <glib.h>
#include <math.h>
#include <string.h>

#include "pack/structure/grid.h"

enum { POINTS = 200, IMAGES = 4 };

static struct gb_grid *make_grid(int dimension, const double edges[3],
                                 const double tilts[3], double size, GRand *random)
{
    struct gb_cell cell;
    struct gb_grid *grid = NULL;
    struct gb_error err = {0};
    gb_cell_init(&cell, dimension, edges);
    memcpy(cell.tilt, tilts, sizeof cell.tilt);
    g_assert_true(gb_grid_create(&grid, &cell, size, POINTS, &err));
    for (int i = 0; i < POINTS; i++) {
        double x[3];
        for (int k = 0; k < 3; k++) {
            /* also outside the cell */
            x[k] = g_rand_double_range(random, -edges[k], 2.0 * edges[k]);
        }
        if (dimension == 2) {
            x[1] = 0.0;
        }
        gb_grid_insert(grid, x);
    }
    return grid;
}

/* Calls accept for every image in a block much larger than the search; sum tells the set
 * apart from another. */
static double sum_images(const struct gb_grid *grid, const double origin[3],
                         bool (*accept)(const double r[3], const void *data),
                         const void *data, int *count)
{
    const int span = grid->cell.periodic[1] ? IMAGES : 0;
    double sum = 0.0, matrix[3][3];
    gb_cell_matrix(&grid->cell, matrix);
    *count = 0;
    for (int64_t i = 0; i < grid->count; i++) {
        for (int a = -IMAGES; a <= IMAGES; a++) {
            for (int b = -span; b <= span; b++) {
                for (int c = -IMAGES; c <= IMAGES; c++) {
                    const int image[3] = {a, b, c};
                    double r[3];
                    for (int k = 0; k < 3; k++) {
                        r[k] = grid->position[3 * i + k] - origin[k];
                        for (int edge = 0; edge < 3; edge++) {
                            r[k] += image[edge] * matrix[k][edge];
                        }
                    }
                    if (accept(r, data)) {
                        (*count)++;
                        sum += (double)(i + 1) * (r[0] + 2.0 * r[1] + 3.0 * r[2]);
                    }
                }
            }
        }
    }
    return sum;
}

static double add_hit(const struct gb_grid_hit *hit)
{
    return (double)(hit->index + 1) * (hit->r[0] + 2.0 * hit->r[1] + 3.0 * hit->r[2]);
}

static bool in_ball(const double r[3], const void *data)
{
    const double reach = *(const double *)data;
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] <= reach * reach;
}

static bool near_ray(const double r[3], const void *data)
{
    const struct gb_grid_ray *ray = data;
    const double along =
        r[0] * ray->direction[0] + r[1] * ray->direction[1] + r[2] * ray->direction[2];
    const double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    return along >= 0.0 && along <= ray->length &&
           square - along * along <= ray->reach * ray->reach;
}

static void compare(int found, double found_sum, int expected, double expected_sum)
{
    g_assert_cmpint(found, ==, expected);
    g_assert_cmpfloat_with_epsilon(found_sum, expected_sum,
                                   1e-9 + 1e-12 * fabs(expected_sum));
}

/* Rays are for cells without tilt. */
static void check_searches(int dimension, const double edges[3], const double tilts[3],
                           double size, GRand *random)
{
    struct gb_grid *grid = make_grid(dimension, edges, tilts, size, random);
    for (int round = 0; round < 20; round++) {
        double origin[3], direction[3];
        double length = 0.0;
        for (int k = 0; k < 3; k++) {
            origin[k] = g_rand_double_range(random, -edges[k], 2.0 * edges[k]);
            direction[k] = g_rand_double_range(random, -1.0, 1.0);
            if (dimension == 2 && k == 1) {
                origin[k] = direction[k] = 0.0;
            }
            length += direction[k] * direction[k];
        }
        for (int k = 0; k < 3; k++) {
            direction[k] /= sqrt(length);
        }
        struct gb_grid_hit hit;
        int expected;
        int found = 0;
        double sum = 0.0;
        const double reach = g_rand_double_range(random, 0.1, 4.0);
        struct gb_grid_ball ball;
        gb_grid_ball_init(&ball, grid, origin, reach);
        while (gb_grid_ball_next(&ball, &hit)) {
            found++;
            sum += add_hit(&hit);
        }
        const double in = sum_images(grid, origin, in_ball, &reach, &expected);
        compare(found, sum, expected, in);
        if (gb_cell_tilted(&grid->cell)) {
            continue;
        }
        struct gb_grid_ray ray;
        found = 0;
        sum = 0.0;
        gb_grid_ray_init(&ray, grid, origin, direction, 1.0, 6.0);
        while (gb_grid_ray_next(&ray, &hit)) {
            found++;
            sum += add_hit(&hit);
        }
        const double near = sum_images(grid, origin, near_ray, &ray, &expected);
        compare(found, sum, expected, near);
    }
    gb_grid_destroy(grid);
}

/* Balls and rays against all images, one by one: each is met once, in cells larger and
 * smaller than the search, upright and tilted, with one grid cell and with many. */
static void test_searches(void)
{
    const double cells[][3] = {{8.0, 7.0, 9.0}, {2.5, 6.0, 3.1}, {3.0, 3.0, 3.0}};
    const double sizes[] = {0.4, 1.0, 2.9, 100.0};
    const double tilts[][3] = {{0.0, 0.0, 0.0}, {0.4, -0.5, 0.3}, {-0.5, 0.5, -0.5}};
    GRand *random = g_rand_new_with_seed(7);
    for (size_t c = 0; c < G_N_ELEMENTS(cells); c++) {
        for (size_t s = 0; s < G_N_ELEMENTS(sizes); s++) {
            const double *edge = cells[c], plane[3] = {edge[0], 1.0, edge[2]};
            for (size_t t = 0; t < G_N_ELEMENTS(tilts); t++) {
                const double tilt[3] = {tilts[t][0] * edge[0], tilts[t][1] * edge[0],
                                        tilts[t][2] * edge[1]};
                const double planar[3] = {0.0, tilt[1], 0.0};
                check_searches(3, edge, tilt, sizes[s], random);
                check_searches(2, plane, planar, sizes[s], random);
            }
        }
    }
    g_rand_free(random);
}

static void test_too_many(void)
{
    const double edges[3] = {9.0, 9.0, 9.0};
    struct gb_cell cell;
    struct gb_grid *grid = NULL;
    struct gb_error err = {0};
    gb_cell_init(&cell, 3, edges);
    g_assert_false(gb_grid_create(&grid, &cell, 1.0, INT32_MAX, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_null(grid);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/grid/searches", test_searches);
    g_test_add_func("/grid/too-many", test_too_many);
    return g_test_run();
}
