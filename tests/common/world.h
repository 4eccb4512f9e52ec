#ifndef GB_TESTS_WORLD_H
#define GB_TESTS_WORLD_H

#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "pack/cell/world_private.h"
#include "pack/list/blocks.h"

/* Checks of a periodic world against all its pairs. */

/* Tolerances of a world in each precision. */
struct precision {
    const char *setting;
    double momentum; /* residual per particle, over the largest force */
    double gradient; /* of the energy against a force, E d^2 */
    double skin;     /* relative, of a pressure after 360 moves */
    double lattice;  /* of forces on a site, over a contact's */
};

static const struct precision precisions[] = {
    {"numerics.precision=double", 1e-13, 1e-8, 1e-6, 1e-10},
    {"numerics.precision=single", 1e-7, 1e-7, 1e-3, 2e-5},
};

static inline double world_distance(const struct gb_world *world, int64_t i, int64_t j)
{
    const double *x = gb_world_position(world);
    double r[3] = {x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                   x[3 * i + 2] - x[3 * j + 2]};
    gb_cell_nearest(gb_world_cell(world), r);
    return gb_vec_length(r);
}

/* Pairs in order, block by block, and free slots behind each block. */
static inline void world_check_slots(const struct gb_world *world,
                                     const struct gb_pair_list *list)
{
    const int64_t count = world->engine.particles.count;
    int64_t pairs = 0, left = 0;
    for (int64_t b = 0; b < gb_blocks_count(count); b++) {
        const int64_t end = gb_blocks_end(count, b);
        int64_t k = list->start[gb_blocks_begin(count, b)];
        for (int64_t i = gb_blocks_begin(count, b); i < end; i++) {
            g_assert_cmpint(list->start[i], ==, k);
            while (k < list->stop[b] && list->first[k] == i) {
                g_assert_cmpint(list->other[k], >, i);
                g_assert_true(k == list->start[i] || list->other[k - 1] < list->other[k]);
                k++;
                pairs++;
            }
        }
        g_assert_cmpint(k, ==, list->stop[b]);
        for (; k < list->start[end]; k++) {
            double r[3];
            g_assert_cmpint(list->first[k], ==, end - 1);
            g_assert_cmpint(list->other[k], ==, end - 1);
            g_assert_cmpfloat(
                gb_engine_branch_vector(&world->engine, list, end - 1, k, r), >, 6.0);
            g_assert_true(list != &world->engine.list.near ||
                          !gb_contacts_touch(&world->engine.contacts, k));
            left++;
        }
    }
    g_assert_cmpint(pairs, ==, list->pair_count);
    g_assert_cmpint(pairs + left, ==, gb_neighbour_list_slots(&world->engine.list, list));
    g_assert_cmpint(left, >, 0);
}

/* True if the pair is in the list, with the nearest image. */
static inline bool world_holds_pair(const struct gb_world *world,
                                    const struct gb_pair_list *list, int64_t i, int64_t j,
                                    double distance)
{
    for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
        double r[3];
        if (list->other[k] == j) {
            gb_world_branch_vector(world, list, i, k, r);
            return fabs(gb_vec_length(r) - distance) < 1e-9;
        }
    }
    return false;
}

/* In single precision, of one list: a pair of one block adds to its second particle; a pair
 * of two blocks to a row of its own among those of its second particle, in the order of the
 * list. */
static inline void world_check_rows(const struct gb_world *world,
                                    const struct gb_pair_list *pairs)
{
    const struct gb_wrench_rows *rows = &world->engine.f32.rows;
    const int64_t count = world->engine.list.count;
    const int of = pairs == &world->engine.list.far;
    int32_t *next = g_new(int32_t, (gsize)count);
    for (int64_t j = 0; j < count; j++) {
        next[j] = rows->start[2 * j + of];
    }
    for (int64_t b = 0; b < gb_blocks_count(count); b++) {
        const int64_t begin = gb_blocks_begin(count, b), end = gb_blocks_end(count, b);
        for (int64_t k = pairs->start[begin]; k < pairs->start[end]; k++) {
            const int32_t j = pairs->other[k];
            g_assert_cmpint(pairs->row[k], ==, j < end ? j : next[j]++);
        }
    }
    for (int64_t j = 0; j < count; j++) {
        g_assert_cmpint(next[j], <=, rows->start[2 * j + of + 1]);
    }
    for (int64_t k = count; k < rows->room; k++) {
        for (int c = 0; c < GB_WRENCH_ROWS_WIDTH; c++) {
            g_assert_true(rows->row[k][c] == 0.0F);
        }
    }
    g_free(next);
}

/* Every pair within the cutoff is in a list, every pair in contact in the near list. */
static inline void world_check_lists(const struct gb_world *world)
{
    if (gb_engine_is_f32(&world->engine)) {
        world_check_rows(world, &world->engine.list.near);
        world_check_rows(world, &world->engine.list.far);
    }
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const double gap = gb_world_model(world)->numerics.cutoff - 1.0;
    for (int64_t j = 0; j < pairs->count; j++) {
        for (int64_t i = 0; i < j; i++) {
            const double distance = world_distance(world, i, j);
            const double touch =
                0.5 * (gb_world_diameter(world, i) + gb_world_diameter(world, j));
            const bool near = world_holds_pair(world, &pairs->near, i, j, distance);
            g_assert_true(near || distance >= touch);
            g_assert_true(near || distance >= touch + gap ||
                          world_holds_pair(world, &pairs->far, i, j, distance));
        }
    }
}

/* An evaluation that may end with an overlap. */
static inline void world_evaluate_any(struct gb_world *world)
{
    struct gb_error err = {0};
    if (!gb_world_evaluate(world, &err)) { /* particles moved at random may overlap */
        g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
    }
}

#endif
