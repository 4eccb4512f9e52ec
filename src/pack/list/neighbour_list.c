#include "pack/list/neighbour_list.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "pack/kernel/lanes.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "pack/list/list_levels.h"

/* Pairs reserved beyond the need whenever a list grows. */
enum { EXTRA = 256 };

/* Pairs that may be inserted between two builds: INSERTED_BASE, plus one for every
 * PARTICLES_PER_INSERTED particles. */
enum { INSERTED_BASE = 64, PARTICLES_PER_INSERTED = 256 };

/* Free slots behind every block: a small system never needs more for one block than it
 * may insert at all. */
enum { FREE_SLOTS = INSERTED_BASE + 16 };

/* Image one edge away along every axis. */
enum { IMAGE_AWAY = 26 };

static bool pairs_init(struct gb_pair_list *pairs, int64_t count,
                       enum gb_neighbour_list_layout layout, struct gb_error *err)
{
    const size_t starts = (size_t)count + 1;
    pairs->start = gb_alloc_array(starts, sizeof *pairs->start, err);
    if (layout == GB_NEIGHBOUR_LIST_PATCHABLE) {
        pairs->stop =
            gb_alloc_array((size_t)gb_blocks_count(count), sizeof *pairs->stop, err);
    } else {
        pairs->in_start = gb_alloc_array(starts, sizeof *pairs->in_start, err);
    }
    return pairs->start && (pairs->stop || pairs->in_start);
}

static void free_pairs(struct gb_pair_list *pairs)
{
    gb_alloc_free(pairs->first);
    gb_alloc_free(pairs->other);
    gb_alloc_free(pairs->image);
    gb_alloc_free(pairs->row);
    gb_alloc_free(pairs->in_slot);
    pairs->first = NULL;
    pairs->other = NULL;
    pairs->image = NULL;
    pairs->row = NULL;
    pairs->in_slot = NULL;
    pairs->capacity = 0;
}

static void pairs_finish(struct gb_pair_list *pairs)
{
    gb_alloc_free(pairs->start);
    gb_alloc_free(pairs->stop);
    gb_alloc_free(pairs->in_start);
    free_pairs(pairs);
}

bool gb_neighbour_list_init(struct gb_neighbour_list *list, int64_t count,
                            enum gb_neighbour_list_layout layout, struct gb_error *err)
{
    *list = (struct gb_neighbour_list){.count = count, .largest = 1.0, .layout = layout};
    list->bin_particle =
        gb_alloc_array((size_t)count + GB_LANES_BEYOND, sizeof *list->bin_particle, err);
    list->built_position = gb_alloc_array(3 * (size_t)count + GB_LANES_BEYOND,
                                          sizeof *list->built_position, err);
    list->inserted_max = INSERTED_BASE + count / PARTICLES_PER_INSERTED;
    list->inserted =
        gb_alloc_array((size_t)list->inserted_max, sizeof *list->inserted, err);
    if (!list->bin_particle || !list->built_position || !list->inserted ||
        !pairs_init(&list->near, count, layout, err) ||
        !pairs_init(&list->far, count, layout, err)) {
        gb_neighbour_list_finish(list);
        return false;
    }
    return true;
}

void gb_neighbour_list_finish(struct gb_neighbour_list *list)
{
    pairs_finish(&list->near);
    pairs_finish(&list->far);
    gb_alloc_free(list->bin_start);
    gb_alloc_free(list->bin_particle);
    gb_alloc_free(list->built_position);
    gb_alloc_free(list->inserted);
    gb_list_levels_destroy(list->levels);
    *list = (struct gb_neighbour_list){0};
}

bool gb_neighbour_list_reserve(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                               int64_t need, struct gb_error *err)
{
    const bool transposed = list->layout == GB_NEIGHBOUR_LIST_TRANSPOSED;
    if (need <= pairs->capacity) {
        return true;
    }
    const size_t room = (size_t)(need + need / 16 + EXTRA);
    free_pairs(pairs);
    pairs->first = gb_alloc_array(room, sizeof *pairs->first, err);
    pairs->other = gb_alloc_array(room, sizeof *pairs->other, err);
    pairs->image = gb_alloc_array(room, sizeof *pairs->image, err);
    int32_t **by_layout = transposed ? &pairs->in_slot : &pairs->row;
    *by_layout = gb_alloc_array(room, sizeof **by_layout, err);
    if (!pairs->first || !pairs->other || !pairs->image || !*by_layout) {
        free_pairs(pairs);
        return false;
    }
    pairs->capacity = (int64_t)room;
    return true;
}

int64_t gb_neighbour_list_free_slots(const struct gb_neighbour_list *list)
{
    return list->layout == GB_NEIGHBOUR_LIST_PATCHABLE ? FREE_SLOTS : 0;
}

void gb_neighbour_list_free_slot(struct gb_pair_list *pairs, int64_t slot, int64_t i)
{
    pairs->first[slot] = (int32_t)i;
    pairs->other[slot] = (int32_t)i;
    pairs->image[slot] = IMAGE_AWAY;
    pairs->row[slot] = (int32_t)i;
}

static void pairs_clear(struct gb_pair_list *pairs, int64_t count)
{
    const size_t starts = (size_t)count + 1;
    memset(pairs->start, 0, starts * sizeof *pairs->start);
    if (pairs->in_start) {
        memset(pairs->in_start, 0, starts * sizeof *pairs->in_start);
    }
    if (pairs->stop) {
        memset(pairs->stop, 0, (size_t)gb_blocks_count(count) * sizeof *pairs->stop);
    }
    pairs->pair_count = 0;
}

void gb_neighbour_list_clear(struct gb_neighbour_list *list)
{
    pairs_clear(&list->near, list->count);
    pairs_clear(&list->far, list->count);
    list->inserted_count = 0;
}

/* Largest squared displacement beside the affine motion, in *most.  *total is the sum of
 * all squares: not finite when a coordinate is not. */
GB_SIMD_LOOP void displacement_loop(const double *restrict position,
                                    const double *restrict built, const double scaling[3],
                                    int64_t count, double *restrict total,
                                    double *restrict most)
{
    const double sx = scaling[0], sy = scaling[1], sz = scaling[2];
    double sum = 0.0, longest = 0.0;
#pragma omp simd reduction(+ : sum) reduction(max : longest)
    for (int64_t i = 0; i < count; i++) {
        const double x = position[3 * i] - built[3 * i] * sx;
        const double y = position[3 * i + 1] - built[3 * i + 1] * sy;
        const double z = position[3 * i + 2] - built[3 * i + 2] * sz;
        const double square = x * x + y * y + z * z;
        longest = square > longest ? square : longest;
        sum += square;
    }
    *total = sum;
    *most = longest;
}
GB_SIMD_WIDTHS(displacement,
               (const double *position, const double *built, const double scaling[3],
                int64_t count, double *total, double *most),
               (position, built, scaling, count, total, most))

double gb_neighbour_list_displacement2_tilted(const struct gb_neighbour_list *list,
                                              int64_t i, const double x[3])
{
    double matrix[3][3], moved[3];
    gb_cell_matrix(&list->unit, matrix);
    gb_mat_apply((const double(*)[3])matrix, list->built_position + 3 * i, moved);
    gb_vec_add(moved, -1.0, x);
    return gb_vec_dot(moved, moved);
}

/* The same as displacement_loop under shear. */
static void displacement_sheared(const struct gb_neighbour_list *list,
                                 const double *position, int64_t begin, int64_t end,
                                 double *total, double *most)
{
    for (int64_t i = begin; i < end; i++) {
        const double square =
            gb_neighbour_list_displacement2_tilted(list, i, position + 3 * i);
        *most = square > *most ? square : *most;
        *total += square;
    }
}

double gb_neighbour_list_displacement(const struct gb_neighbour_list *list,
                                      const double *position, int64_t begin, int64_t end)
{
    double total = 0.0, most = 0.0;
    if (gb_cell_tilted(&list->unit)) {
        displacement_sheared(list, position, begin, end, &total, &most);
    } else {
        displacement(position + 3 * begin, list->built_position + 3 * begin,
                     list->unit.edge, end - begin, &total, &most);
    }
    /* a maximum alone would ignore NaN: comparisons with it are false */
    return isfinite(total) ? sqrt(most) : (double)NAN;
}

/* Bound of |F^-1 r - r| / |r|. */
static double strain_of(const struct gb_deformation *deformation)
{
    double inverse[3][3], sum = 0.0, change = 0.0;
    if (gb_deformation_is_scaling(deformation)) {
        for (int k = 0; k < 3; k++) {
            change = fmax(change, fabs(1.0 / deformation->f[k][k] - 1.0));
        }
        return change;
    }
    gb_mat_inverse(deformation->f, inverse);
    for (int k = 0; k < 3; k++) {
        inverse[k][k] -= 1.0;
        sum += gb_vec_dot(inverse[k], inverse[k]);
    }
    return sqrt(sum);
}

void gb_neighbour_list_deform(struct gb_neighbour_list *list,
                              const struct gb_deformation *deformation)
{
    gb_cell_deform(&list->unit, deformation);
    list->strain = (1.0 + list->strain) * (1.0 + strain_of(deformation)) - 1.0;
}

/* The same in a tilted cell: whole numbers of edge vectors. */
static void update_shifts_tilted(struct gb_neighbour_list *list,
                                 const struct gb_cell *cell)
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    for (int image = 0; image < 27; image++) {
        const int digit[3] = {image % 3, image / 3 % 3, image / 9};
        double s[3];
        for (int k = 0; k < 3; k++) {
            s[k] = cell->periodic[k] ? digit[k] - 1 : 0.0;
        }
        gb_mat_apply((const double(*)[3])matrix, s, list->shift[image]);
    }
}

void gb_neighbour_list_update_shifts(struct gb_neighbour_list *list,
                                     const struct gb_cell *cell)
{
    double along[3][3]; /* -1, 0, 1 edges of each axis */
    if (gb_cell_tilted(cell)) {
        update_shifts_tilted(list, cell);
        return;
    }
    for (int k = 0; k < 3; k++) {
        along[k][2] = cell->periodic[k] ? cell->edge[k] : 0.0;
        along[k][1] = 0.0;
        along[k][0] = 0.0 - along[k][2];
    }
    for (int w = 0; w < 3; w++) {
        for (int v = 0; v < 3; v++) {
            for (int u = 0; u < 3; u++) {
                double *shift = list->shift[9 * w + 3 * v + u];
                shift[0] = along[0][u];
                shift[1] = along[1][v];
                shift[2] = along[2][w];
            }
        }
    }
}
