#include "pack/cell/neighbour_list.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/cell/neighbour_grid.h"
#include "pack/kernel/share.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep.h"
#include "scene/tolerances.h"

/* Neighbours one particle may have within the reach: a dense packing has about a dozen.
 * Also the room that lists have left over. */
enum { CROWD = 256 };

/* Most have no more. */
enum { FEW = 32 };

/* Pairs that lists may be amended by between two builds: some, and one for so many
 * particles. */
enum { AMENDED_LEAST = 64, AMENDED_SHARE = 256 };

/* Free slots behind every block of a one-way list: no block of a small world needs more
 * than it may be amended by at all. */
enum { FREE = AMENDED_LEAST + 16 };

/* Image of a particle of its own that is away along every axis. */
enum { IMAGE_AWAY = 26 };

struct grid {
    struct gb_neighbour_grid shape;
    const struct gb_cell *cell;
    const double *position;
    double (*sorted)[3]; /* places, grid cell by grid cell: begin[c] .. begin[c + 1] */
    const double (*shift)[3];
    const int32_t *begin, *order;
    const double *diameter; /* NULL: all are 1 */
};

static bool list_init(struct gb_pair_list *list, int64_t count, bool one_way,
                      struct gb_error *err)
{
    const size_t starts = (size_t)count + 1;
    list->start = gb_alloc_array(starts, sizeof *list->start, err);
    if (one_way) {
        list->stop =
            gb_alloc_array((size_t)gb_sweep_blocks(count), sizeof *list->stop, err);
    } else {
        list->in_start = gb_alloc_array(starts, sizeof *list->in_start, err);
    }
    return list->start && (list->stop || list->in_start);
}

static void list_drop_pairs(struct gb_pair_list *list)
{
    gb_alloc_free(list->first);
    gb_alloc_free(list->other);
    gb_alloc_free(list->image);
    gb_alloc_free(list->in_slot);
    list->first = NULL;
    list->other = NULL;
    list->image = NULL;
    list->in_slot = NULL;
    list->capacity = 0;
}

static void list_finish(struct gb_pair_list *list)
{
    gb_alloc_free(list->start);
    gb_alloc_free(list->stop);
    gb_alloc_free(list->in_start);
    list_drop_pairs(list);
}

bool gb_neighbour_list_init(struct gb_neighbour_list *pairs, int64_t count, bool one_way,
                            struct gb_error *err)
{
    *pairs =
        (struct gb_neighbour_list){.count = count, .largest = 1.0, .one_way = one_way};
    pairs->next = gb_alloc_array((size_t)count, sizeof *pairs->next, err);
    pairs->built_at = gb_alloc_array(3 * (size_t)count, sizeof *pairs->built_at, err);
    pairs->amended_most = AMENDED_LEAST + count / AMENDED_SHARE;
    pairs->amended =
        gb_alloc_array((size_t)pairs->amended_most, sizeof *pairs->amended, err);
    if (!pairs->next || !pairs->built_at || !pairs->amended ||
        !list_init(&pairs->near, count, one_way, err) ||
        !list_init(&pairs->far, count, one_way, err)) {
        gb_neighbour_list_finish(pairs);
        return false;
    }
    return true;
}

void gb_neighbour_list_finish(struct gb_neighbour_list *pairs)
{
    list_finish(&pairs->near);
    list_finish(&pairs->far);
    gb_alloc_free(pairs->head);
    gb_alloc_free(pairs->next);
    gb_alloc_free(pairs->built_at);
    gb_alloc_free(pairs->amended);
    *pairs = (struct gb_neighbour_list){0};
}

void gb_neighbour_list_shifts(const struct gb_cell *cell, double shift[27][3])
{
    for (int image = 0; image < 27; image++) {
        const int s[3] = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
        for (int k = 0; k < 3; k++) {
            shift[image][k] = cell->periodic[k] ? s[k] * cell->edge[k] : 0.0;
        }
    }
}

static int home_of(const struct grid *grid, int64_t i)
{
    int home[3];
    gb_neighbour_grid_home(&grid->shape, grid->position + 3 * i, home);
    return gb_neighbour_grid_index(&grid->shape, home);
}

/* Sorts the particles by grid cells, ascending within each. */
static void grid_sort(struct gb_neighbour_list *pairs, const struct grid *grid,
                      int64_t cells)
{
    int32_t *begin = pairs->head, *order = pairs->next;
    memset(begin, 0, ((size_t)cells + 1) * sizeof *begin);
    for (int64_t i = 0; i < pairs->count; i++) {
        begin[home_of(grid, i)]++;
    }
    for (int64_t c = 1; c <= cells; c++) {
        begin[c] += begin[c - 1];
    }
    for (int64_t i = pairs->count - 1; i >= 0; i--) {
        const int32_t at = --begin[home_of(grid, i)];
        order[at] = (int32_t)i;
        memcpy(grid->sorted[at], grid->position + 3 * i, sizeof *grid->sorted);
    }
}

static bool grid_fill(struct gb_neighbour_list *pairs, struct grid *grid,
                      struct gb_error *err)
{
    const int64_t cells = (int64_t)grid->shape.n[0] * grid->shape.n[1] * grid->shape.n[2];
    if (cells + 1 > pairs->head_capacity) {
        gb_alloc_free(pairs->head);
        pairs->head_capacity = 0;
        pairs->head = gb_alloc_array((size_t)cells + 1, sizeof *pairs->head, err);
        if (!pairs->head) {
            return false;
        }
        pairs->head_capacity = cells + 1;
    }
    /* the places of the build before are not needed any more */
    grid->sorted = (double(*)[3])pairs->built_at;
    grid_sort(pairs, grid, cells);
    grid->begin = pairs->head;
    grid->order = pairs->next;
    return true;
}

/* Nearest image of x_i - x_j; returns its index and the squared distance. */
static uint8_t nearest_image(const struct gb_cell *cell, const double *xi,
                             const double *xj, double *squared)
{
    int image = 0, weight = 1;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double r = xi[k] - xj[k];
        int s = 0;
        if (cell->periodic[k]) {
            const double half = 0.5 * cell->edge[k];
            s = r > half ? -1 : r < -half ? 1 : 0;
            r += s * cell->edge[k];
        }
        sum += r * r;
        image += (s + 1) * weight;
        weight *= 3;
    }
    *squared = sum;
    return (uint8_t)image;
}

struct neighbour {
    int32_t other;
    uint8_t image;
    bool near;
};

/* Squared distances that bound the two lists, and how far they are from touching. */
struct bounds {
    double near, far;
    double skin, gap;
};

/* Bounds of a pair of unequal sizes. */
static struct bounds bounds_of(const struct grid *grid, int64_t i, int32_t j,
                               struct bounds most)
{
    const double span = 0.5 * (grid->diameter[i] + grid->diameter[j]);
    const double near = span + most.skin, far = span + most.gap;
    return (struct bounds){near * near, far * far, most.skin, most.gap};
}

/* Ascending by the other particle.  Each one's place is how many come before it, counted
 * without a branch: nobody could foretell them. */
static void sort_few(struct neighbour *list, int n)
{
    struct neighbour found[FEW];
    int32_t other[FEW];
    memcpy(found, list, (size_t)n * sizeof *list);
    for (int k = 0; k < FEW; k++) {
        other[k] = k < n ? found[k].other : INT32_MAX;
    }
    for (int k = 0; k < n; k++) {
        int before = 0;
        for (int l = 0; l < FEW; l++) {
            before += other[l] < other[k];
        }
        list[before] = found[k];
    }
}

static void sort_many(struct neighbour *list, int n)
{
    for (int l = 1; l < n; l++) {
        const struct neighbour item = list[l];
        int k = l;
        for (; k > 0 && list[k - 1].other > item.other; k--) {
            list[k] = list[k - 1];
        }
        list[k] = item;
    }
}

/* Members of the grid cells first .. last that come after i and lie within the bounds;
 * image: that of all of them, where the grid is plain. */
static int scan_cells(const struct grid *grid, int64_t i, int first, int last, int image,
                      struct bounds bounds, struct neighbour *list, int n)
{
    const double *x = grid->position + 3 * i, *shift = grid->shift[image];
    for (int32_t k = grid->begin[first]; k < grid->begin[last + 1] && n < CROWD; k++) {
        const double *y = grid->sorted[k];
        const double r[3] = {x[0] - y[0] + shift[0], x[1] - y[1] + shift[1],
                             x[2] - y[2] + shift[2]};
        double squared = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        uint8_t seen = (uint8_t)image;
        if (!grid->shape.plain) {
            seen = nearest_image(grid->cell, x, y, &squared);
        }
        const int32_t other = grid->order[k];
        const struct bounds own =
            grid->diameter ? bounds_of(grid, i, other, bounds) : bounds;
        list[n] = (struct neighbour){other, seen, squared < own.near};
        n += (squared < own.far) & (other > i);
    }
    return n;
}

/* Which image of a neighbouring grid cell is meant, as a digit of the image's index. */
static int image_digit(int place, int n)
{
    return place < 0 ? 2 : place >= n ? 0 : 1;
}

/* One row of grid cells along x. */
static int scan_row(const struct grid *grid, int64_t i, int home, int row, int image,
                    struct bounds bounds, struct neighbour *list, int n)
{
    const int cells = grid->shape.n[0];
    if (grid->shape.plain && cells > 2 && home > 0 && home < cells - 1) {
        return scan_cells(grid, i, row + home - 1, row + home + 1, image + 1, bounds,
                          list, n);
    }
    for (int u = grid->shape.span_low[0]; u <= grid->shape.span_high[0]; u++) {
        const int c = row + (home + u + cells) % cells;
        n = scan_cells(grid, i, c, c, image + image_digit(home + u, cells), bounds, list,
                       n);
    }
    return n;
}

/* Neighbours j > i of particle i, sorted; CROWD when there are too many. */
static int scan_particle(const struct grid *grid, int64_t i, struct bounds bounds,
                         struct neighbour *list)
{
    const struct gb_neighbour_grid *shape = &grid->shape;
    int home[3], n = 0;
    gb_neighbour_grid_home(shape, grid->position + 3 * i, home);
    for (int w = shape->span_low[2]; w <= shape->span_high[2]; w++) {
        const int cw = (home[2] + w + shape->n[2]) % shape->n[2];
        for (int v = shape->span_low[1]; v <= shape->span_high[1]; v++) {
            const int cv = (home[1] + v + shape->n[1]) % shape->n[1];
            const int image = 9 * image_digit(home[2] + w, shape->n[2]) +
                              3 * image_digit(home[1] + v, shape->n[1]);
            n = scan_row(grid, i, home[0], (cw * shape->n[1] + cv) * shape->n[0], image,
                         bounds, list, n);
        }
    }
    (n <= FEW ? sort_few : sort_many)(list, n);
    return n;
}

/* Room for `need` pairs; what was there is lost. */
static bool reserve(struct gb_pair_list *list, int64_t need, bool one_way,
                    struct gb_error *err)
{
    if (need <= list->capacity) {
        return true;
    }
    const size_t room = (size_t)(need + need / 16 + CROWD);
    list_drop_pairs(list);
    list->first = gb_alloc_array(room, sizeof *list->first, err);
    list->other = gb_alloc_array(room, sizeof *list->other, err);
    list->image = gb_alloc_array(room, sizeof *list->image, err);
    if (!one_way) {
        list->in_slot = gb_alloc_array(room, sizeof *list->in_slot, err);
    }
    if (!list->first || !list->other || !list->image || !(one_way || list->in_slot)) {
        list_drop_pairs(list);
        return false;
    }
    list->capacity = (int64_t)room;
    return true;
}

/* Particles begin .. end - 1 with all their neighbours, found by one thread. */
struct stretch {
    int64_t begin, end;
    struct neighbour *found; /* particle after particle, sorted within each */
    int64_t count, room;
    int64_t near, far; /* of these so many each; then where they go in the lists */
    struct gb_error err;
};

static bool make_room(struct stretch *stretch)
{
    if (stretch->count + CROWD < stretch->room) {
        return true;
    }
    const int64_t room = 2 * stretch->room + 16 * CROWD;
    struct neighbour *found = gb_alloc_array((size_t)room, sizeof *found, &stretch->err);
    if (!found) {
        return false;
    }
    if (stretch->count > 0) {
        memcpy(found, stretch->found, (size_t)stretch->count * sizeof *found);
    }
    gb_alloc_free(stretch->found);
    stretch->found = found;
    stretch->room = room;
    return true;
}

/* Leaves in start[i + 1] of both lists how many particle i has. */
static bool scan_stretch(struct gb_neighbour_list *pairs, const struct grid *grid,
                         struct bounds bounds, struct stretch *stretch)
{
    for (int64_t i = stretch->begin; i < stretch->end; i++) {
        if (!make_room(stretch)) {
            return false;
        }
        const struct neighbour *found = stretch->found + stretch->count;
        const int n = scan_particle(grid, i, bounds, stretch->found + stretch->count);
        if (n >= CROWD) {
            return gb_error_set(&stretch->err, GB_ERR_GUARD,
                                "particle %lld has %d or more neighbours within %.3g d: "
                                "the packing has collapsed",
                                (long long)i, n, sqrt(bounds.far));
        }
        int near = 0;
        for (int k = 0; k < n; k++) {
            near += found[k].near;
        }
        pairs->near.start[i + 1] = near;
        pairs->far.start[i + 1] = n - near;
        stretch->near += near;
        stretch->far += n - near;
        stretch->count += n;
    }
    return true;
}

static void append(struct gb_pair_list *list, int64_t i, int64_t k,
                   const struct neighbour *found)
{
    list->first[k] = (int32_t)i;
    list->other[k] = found->other;
    list->image[k] = found->image;
}

void gb_neighbour_list_vacate(struct gb_pair_list *list, int64_t slot, int64_t i)
{
    list->first[slot] = (int32_t)i;
    list->other[slot] = (int32_t)i;
    list->image[slot] = IMAGE_AWAY;
}

/* Slots stay free behind the pairs of block b, whose last particle is i; returns where
 * those of the next one go. */
static int64_t end_block(struct gb_pair_list *list, int64_t b, int64_t i, int64_t slot)
{
    list->stop[b] = slot;
    for (int k = 0; k < FREE; k++) {
        gb_neighbour_list_vacate(list, slot++, i);
    }
    return slot;
}

/* Into the lists, each from its place on. */
static void place_stretch(struct gb_neighbour_list *pairs, const struct stretch *stretch)
{
    const struct neighbour *found = stretch->found;
    int64_t near = stretch->near, far = stretch->far;
    int64_t b = stretch->begin / gb_sweep_block_size(pairs->count);
    int64_t end = gb_sweep_block_end(pairs->count, b);
    for (int64_t i = stretch->begin; i < stretch->end; i++) {
        int64_t n = pairs->near.start[i + 1] + pairs->far.start[i + 1];
        for (; n > 0; n--, found++) {
            if (found->near) {
                append(&pairs->near, i, near++, found);
            } else {
                append(&pairs->far, i, far++, found);
            }
        }
        if (pairs->one_way && i + 1 == end) {
            near = end_block(&pairs->near, b, i, near);
            far = end_block(&pairs->far, b, i, far);
            end = gb_sweep_block_end(pairs->count, ++b);
        }
        pairs->near.start[i + 1] = near;
        pairs->far.start[i + 1] = far;
    }
}

/* Where each stretch goes, and room for all of them. */
static bool line_up(struct gb_neighbour_list *pairs, struct stretch *stretch, int threads,
                    struct gb_error *err)
{
    const int64_t size = gb_sweep_block_size(pairs->count);
    int64_t near = 0, far = 0;
    for (int t = 0; t < threads; t++) {
        if (stretch[t].err.code != GB_OK) {
            return gb_error_set(err, stretch[t].err.code, "%s", stretch[t].err.text);
        }
        const int64_t own_near = stretch[t].near, own_far = stretch[t].far;
        const int64_t left_free = pairs->one_way ? FREE * (stretch[t].begin / size) : 0;
        stretch[t].near = near + left_free;
        stretch[t].far = far + left_free;
        near += own_near;
        far += own_far;
    }
    pairs->near.start[0] = pairs->far.start[0] = 0;
    pairs->near.pair_count = near;
    pairs->far.pair_count = far;
    const int64_t left_free = pairs->one_way ? FREE * gb_sweep_blocks(pairs->count) : 0;
    return reserve(&pairs->near, near + left_free, pairs->one_way, err) &&
           reserve(&pairs->far, far + left_free, pairs->one_way, err);
}

/* Fills both lists, the same ones for any number of threads. */
static bool fill_pairs(struct gb_neighbour_list *pairs, const struct grid *grid,
                       struct bounds bounds, int threads, struct gb_error *err)
{
    struct stretch *stretch = gb_alloc_array((size_t)threads, sizeof *stretch, err);
    if (!stretch) {
        return false;
    }
    for (int t = 0; t < threads; t++) {
        stretch[t].begin = gb_share(pairs->count, t, threads);
        stretch[t].end = gb_share(pairs->count, t + 1, threads);
    }
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        (void)scan_stretch(pairs, grid, bounds, &stretch[t]);
    }
    const bool good = line_up(pairs, stretch, threads, err);
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        if (good) {
            place_stretch(pairs, &stretch[t]);
        }
        gb_alloc_free(stretch[t].found);
    }
    gb_alloc_free(stretch);
    return good;
}

/* The transposed list, by counting. */
static void transpose(struct gb_pair_list *list, int64_t count)
{
    int64_t *in = list->in_start;
    memset(in, 0, ((size_t)count + 1) * sizeof *in);
    for (int64_t k = 0; k < list->pair_count; k++) {
        in[list->other[k] + 1]++;
    }
    for (int64_t j = 0; j < count; j++) {
        in[j + 1] += in[j];
    }
    for (int64_t k = 0; k < list->pair_count; k++) {
        list->in_slot[in[list->other[k]]++] = (int32_t)k;
    }
    for (int64_t j = count; j > 0; j--) {
        in[j] = in[j - 1];
    }
    in[0] = 0;
}

static void transpose_both(struct gb_neighbour_list *pairs, int threads)
{
    (void)threads; /* without OpenMP */
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int l = 0; l < 2; l++) {
        transpose(l == 0 ? &pairs->near : &pairs->far, pairs->count);
    }
}

bool gb_neighbour_list_build(struct gb_neighbour_list *pairs, const struct gb_cell *cell,
                             const double *position, double cutoff, double skin,
                             int threads, struct gb_error *err)
{
    const double reach = pairs->largest - 1.0 + cutoff + skin;
    if (gb_cell_shortest(cell) < GB_EDGE_OVER_RANGE_MIN * reach) {
        return gb_error_set(
            err, GB_ERR_GUARD,
            "the cell has shrunk to %.3g d, less than twice the neighbour "
            "reach %.3g d: take more particles or another structure.base",
            gb_cell_shortest(cell), reach);
    }
    double shift[27][3];
    gb_neighbour_list_shifts(cell, shift);
    struct grid grid = {.cell = cell,
                        .position = position,
                        .shift = (const double(*)[3])shift,
                        .diameter = pairs->diameter};
    gb_neighbour_grid_init(&grid.shape, cell, reach, pairs->count);
    const struct bounds bounds = {(1.0 + skin) * (1.0 + skin), reach * reach, skin,
                                  cutoff - 1.0 + skin};
    if (!grid_fill(pairs, &grid, err) ||
        !fill_pairs(pairs, &grid, bounds, threads, err)) {
        return false;
    }
    if (!pairs->one_way) {
        transpose_both(pairs, threads);
    }
    pairs->amended_count = 0;
    pairs->grid = grid.shape;
    memcpy(pairs->built_at, position, 3 * (size_t)pairs->count * sizeof *position);
    memcpy(pairs->built_edge, cell->edge, sizeof pairs->built_edge);
    pairs->stretch[0] = pairs->stretch[1] = pairs->stretch[2] = 1.0;
    pairs->strain = 0.0;
    return true;
}

static void list_clear(struct gb_pair_list *list, int64_t count)
{
    const size_t starts = (size_t)count + 1;
    memset(list->start, 0, starts * sizeof *list->start);
    if (list->in_start) {
        memset(list->in_start, 0, starts * sizeof *list->in_start);
    }
    if (list->stop) {
        memset(list->stop, 0, (size_t)gb_sweep_blocks(count) * sizeof *list->stop);
    }
    list->pair_count = 0;
}

void gb_neighbour_list_clear(struct gb_neighbour_list *pairs)
{
    list_clear(&pairs->near, pairs->count);
    list_clear(&pairs->far, pairs->count);
    pairs->amended_count = 0;
}

/* Largest squared way beside the affine motion; total: their sum, not finite when one is
 * not. */
GB_SIMD_LOOP void travel_loop(const double *restrict position,
                              const double *restrict built_at, const double stretch[3],
                              int64_t count, double *restrict total,
                              double *restrict most)
{
    const double sx = stretch[0], sy = stretch[1], sz = stretch[2];
    double sum = 0.0, longest = 0.0;
#pragma omp simd reduction(+ : sum) reduction(max : longest)
    for (int64_t i = 0; i < count; i++) {
        const double x = position[3 * i] - built_at[3 * i] * sx;
        const double y = position[3 * i + 1] - built_at[3 * i + 1] * sy;
        const double z = position[3 * i + 2] - built_at[3 * i + 2] * sz;
        const double way2 = x * x + y * y + z * z;
        longest = way2 > longest ? way2 : longest;
        sum += way2;
    }
    *total = sum;
    *most = longest;
}
GB_SIMD_WIDTHS(travel,
               (const double *position, const double *built_at, const double stretch[3],
                int64_t count, double *total, double *most),
               (position, built_at, stretch, count, total, most))

double gb_neighbour_list_travel(const struct gb_neighbour_list *pairs,
                                const double *position, int64_t begin, int64_t end)
{
    double total = 0.0, most = 0.0;
    travel(position + 3 * begin, pairs->built_at + 3 * begin, pairs->stretch, end - begin,
           &total, &most);
    return isfinite(total) ? sqrt(most) : (double)NAN; /* comparisons pass NaN by */
}

void gb_neighbour_list_strain(struct gb_neighbour_list *pairs, const double factor[3])
{
    double change = 0.0;
    for (int k = 0; k < 3; k++) {
        change = fmax(change, fabs(1.0 / factor[k] - 1.0));
        pairs->stretch[k] *= factor[k];
    }
    pairs->strain = (1.0 + pairs->strain) * (1.0 + change) - 1.0;
}
