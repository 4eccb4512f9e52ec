#include "pack/list/escaped_search.h"

#include "pack/cell/engine.h"

/* True if the pair is in the list with the image that is the nearest one now. */
static bool holds(const struct gb_engine *engine, const struct gb_pair_list *list,
                  int64_t i, int64_t j, double squared)
{
    const int64_t low = i < j ? i : j, high = i < j ? j : i;
    for (int64_t k = list->start[low]; k < list->start[low + 1]; k++) {
        double r[3];
        if (list->other[k] == high) {
            return gb_engine_branch_vector(engine, list, low, k, r) <=
                   squared + GB_ESCAPED_SEARCH_TOLERANCE;
        }
    }
    return false;
}

static void add_missing(struct gb_missing_pairs *missing, int64_t i, int64_t j, bool near)
{
    if (missing->count == GB_MISSING_PAIRS_MAX) {
        missing->incomplete = true;
        return;
    }
    missing->pair[missing->count++] = (struct gb_missing_pair){
        (int32_t)(i < j ? i : j), (int32_t)(i < j ? j : i), near};
}

/* Possible partners of an escaped particle.  They lie scattered in memory, so all of them
 * are prefetched before the first is read. */
enum { CANDIDATES = 256 };
struct candidates {
    bool tilted; /* gb_cell_tilted of the cell */
    int count;
    int32_t particle[CANDIDATES];
};

/* Squared distance of two fixed-point positions, nearest images, d^2. */
static double fixed_distance2(const struct gb_engine *engine, const int32_t from[3],
                              const int32_t to[3])
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const int32_t units =
            gb_fixed_position_difference((uint32_t)to[k], (uint32_t)from[k]);
        const double r =
            (double)units * gb_fixed_position_unit(&engine->particles.cell, k);
        squared += r * r;
    }
    return squared;
}

static double distance2_tilted(const struct gb_cell *cell, const double *xi,
                               const double *xj)
{
    double r[3] = {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]};
    gb_cell_nearest(cell, r);
    return gb_vec_dot(r, r);
}

/* The same where the cell has no tilt, in registers. */
static inline double distance2_straight(const struct gb_cell *cell, const double *xi,
                                        const double *xj)
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const double r = xi[k] - xj[k], edge = cell->edge[k];
        const double nearest = cell->periodic[k] ? r - edge * gb_cell_whole(r / edge) : r;
        squared += nearest * nearest;
    }
    return squared;
}

/* Squared distance of nearest images, d^2. */
static double distance2(const struct gb_engine *engine, bool tilted, int64_t i, int64_t j)
{
    const struct gb_particles *particles = &engine->particles;
    const double *xi = particles->position + 3 * i, *xj = particles->position + 3 * j;
    if (gb_engine_is_f32(engine)) {
        return fixed_distance2(engine, engine->f32.particle[i].position,
                               engine->f32.particle[j].position);
    }
    return tilted ? distance2_tilted(&particles->cell, xi, xj)
                  : distance2_straight(&particles->cell, xi, xj);
}

/* Keeps the candidates that are near enough to be in a list of particle i. */
static void keep_near(const struct gb_engine *engine, int64_t i,
                      struct candidates *candidates)
{
    const double gap = engine->model->numerics.cutoff - 1.0 + GB_ESCAPED_SEARCH_TOLERANCE;
    const double *d = engine->list.diameter;
    int kept = 0;
    for (int k = 0; k < candidates->count; k++) {
        const int32_t j = candidates->particle[k];
        const double reach = gap + (d ? 0.5 * (d[i] + d[j]) : 1.0);
        const double squared = distance2(engine, candidates->tilted, i, j);
        candidates->particle[kept] = j;
        kept += squared < reach * reach && j != i;
    }
    candidates->count = kept;
}

static void prefetch_pairs(const struct gb_engine *engine, int64_t i,
                           const struct candidates *candidates)
{
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    for (int k = 0; k < candidates->count; k++) {
        const int64_t low = i < candidates->particle[k] ? i : candidates->particle[k];
        __builtin_prefetch(&near->start[low]);
        __builtin_prefetch(&far->start[low]);
    }
    for (int k = 0; k < candidates->count; k++) {
        const int64_t low = i < candidates->particle[k] ? i : candidates->particle[k];
        __builtin_prefetch(&near->other[near->start[low]]);
        __builtin_prefetch(&near->image[near->start[low]]);
    }
}

/* Adds the pair if it is not in the list that belongs to its distance. */
static void check_pair(const struct gb_engine *engine, bool tilted, int64_t i, int64_t j,
                       struct gb_missing_pairs *missing)
{
    const struct gb_neighbour_list *list = &engine->list;
    const double *d = list->diameter;
    const double touch = (d ? 0.5 * (d[i] + d[j]) : 1.0) + GB_ESCAPED_SEARCH_TOLERANCE;
    const double reach = touch + engine->model->numerics.cutoff - 1.0;
    const double squared = distance2(engine, tilted, i, j);
    const bool touches = squared < touch * touch;
    if (squared < reach * reach && !holds(engine, &list->near, i, j, squared) &&
        (touches || !holds(engine, &list->far, i, j, squared))) {
        add_missing(missing, i, j, touches);
    }
}

static void check_candidates(const struct gb_engine *engine, int64_t i,
                             struct candidates *candidates,
                             struct gb_missing_pairs *missing)
{
    keep_near(engine, i, candidates);
    prefetch_pairs(engine, i, candidates);
    for (int k = 0; k < candidates->count; k++) {
        check_pair(engine, candidates->tilted, i, candidates->particle[k], missing);
    }
    candidates->count = 0;
}

/* Bin that particle i would have had at the build, had the cell only been strained since. */
static void bin_at_build(const struct gb_engine *engine, int64_t i, int bin[3])
{
    const struct gb_neighbour_list *list = &engine->list;
    double now[3], x[3];
    gb_engine_position(engine, i, now);
    gb_cell_fraction(&list->unit, now, x);
    gb_cell_wrap(&list->built, x);
    gb_neighbour_grid_bin(&list->grid, x, bin);
}

/* Bins beside each other along x: their particles are contiguous in bin_particle. */
struct run {
    int first, last;
};

/* Runs of `span` bins to each side of particle i; two runs where they wrap around. */
enum {
    RUNS = 2 * (2 * GB_ESCAPED_SEARCH_SPAN_MAX + 1) * (2 * GB_ESCAPED_SEARCH_SPAN_MAX + 1)
};
static int find_runs(const struct gb_engine *engine, int64_t i, int span, struct run *run)
{
    const struct gb_neighbour_grid *grid = &engine->list.grid;
    int bin[3], low[3], count[3], runs = 0;
    bin_at_build(engine, i, bin);
    for (int k = 0; k < 3; k++) { /* every bin once, where there are few */
        const bool all = grid->n[k] <= 2 * span + 1;
        low[k] = all ? 0 : bin[k] - span + (bin[k] < span ? grid->n[k] : 0);
        count[k] = all ? grid->n[k] : 2 * span + 1;
    }
    const int wrapped = low[0] + count[0] - grid->n[0];
    for (int r = 0; r < count[1] * count[2]; r++) {
        const int at[3] = {0, (low[1] + r % count[1]) % grid->n[1],
                           (low[2] + r / count[1]) % grid->n[2]};
        const int row = gb_neighbour_grid_index(grid, at);
        const int end = wrapped > 0 ? grid->n[0] : low[0] + count[0];
        run[runs++] = (struct run){row + low[0], row + end - 1};
        if (wrapped > 0) {
            run[runs++] = (struct run){row, row + wrapped - 1};
        }
    }
    return runs;
}

static void prefetch_particle(const struct gb_engine *engine, int32_t j)
{
    __builtin_prefetch(gb_engine_is_f32(engine)
                           ? (const void *)&engine->f32.particle[j]
                           : engine->particles.position + 3 * (int64_t)j);
}

void gb_escaped_search_run(const struct gb_engine *engine, int64_t i, int span,
                           struct gb_missing_pairs *missing)
{
    const int32_t *start = engine->list.bin_start, *particle = engine->list.bin_particle;
    struct run run[RUNS];
    struct candidates candidates;
    candidates.tilted = gb_cell_tilted(&engine->particles.cell);
    candidates.count = 0;
    const int runs = find_runs(engine, i, span, run);
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&start[run[r].first]);
    }
    for (int r = 0; r < runs; r++) {
        __builtin_prefetch(&particle[start[run[r].first]]);
    }
    for (int r = 0; r < runs; r++) {
        const int32_t stop = start[run[r].last + 1];
        for (int32_t k = start[run[r].first]; k < stop; k++) {
            prefetch_particle(engine, particle[k]);
            candidates.particle[candidates.count++] = particle[k];
            if (candidates.count == CANDIDATES) {
                check_candidates(engine, i, &candidates, missing);
            }
        }
    }
    check_candidates(engine, i, &candidates, missing);
}
