#include "pack/structure/chain_growth.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/grid.h"
#include "pack/structure/random.h"
#include "pack/structure/roll.h"

/* P1 follows a ray through the nearest images of the cell.  Rays are also cut at this
 * length (in r_eq), or the cost would grow faster than the count.  In 3D the cut leaves
 * P1's cell as it is, and 100,000 particles still have g(L/2) = 1 (cut at 40: 1.001).
 * P1 gives no number for 2D, where the length matters more: 1000 discs at density 0.5
 * have k = 4.45, 4.42, 4.36 and 4.35 for rays of 34, 40, 60 and without a cut. */
static const double ray_longest_3d = 60.0;
static const double ray_longest_2d = 40.0;

/* Spheres of diameter r_eq whose centres lie within r_eq of a ray of n r_eq fill at most
 * the cylinder of radius 1.5 r_eq and length (n + 1) r_eq: 13.5 (n + 1) of them; discs
 * fill at most the strip, 3.9 (n + 1). */
enum { CANDIDATES_MOST = 824 };

/* Of unequal sizes the small ones are more; those beyond so many times that number, the
 * last ones found, are ignored. */
enum { CANDIDATES_SIZED = 8 };

/* Rays that find no position: after the first number another particle becomes the origin;
 * after the second, in a row, the structure counts as full. */
enum { FAILURES_PER_ORIGIN = 64, FAILURES_MOST = 64 * 64 };

/* The cancel flag is polled once in this many rays. */
enum { RAYS_PER_POLL = 64 };

/* A position on the ray that touches particle j. */
struct candidate {
    int64_t j;
    double along;     /* of the position, from the origin of the ray */
    double offset[3]; /* from j to the position; as long as they touch */
};

struct growth {
    const struct gb_chain_growth *grow;
    struct gb_grid *grid;
    double *diameter; /* d; NULL: all are equal */
    gsl_rng rng;
    struct candidate *candidates;
    int room; /* for candidates */
    int64_t rays;
};

/* The particle that is to be placed next. */
static struct gb_roll next_one(const struct growth *growth)
{
    struct gb_roll roll = {.grid = growth->grid, .r_eq = growth->grow->r_eq};
    if (growth->diameter) {
        roll.model = growth->grow->model;
        roll.diameter = growth->diameter;
        roll.own = growth->diameter[growth->grid->count];
        roll.r_eq = 0.5 * (roll.own + roll.model->diameter_max);
    }
    return roll;
}

static void random_direction(struct growth *growth, double direction[3])
{
    if (growth->grow->dimension == 3) {
        gsl_ran_dir_3d(&growth->rng, &direction[0], &direction[1], &direction[2]);
    } else {
        gsl_ran_dir_2d(&growth->rng, &direction[0], &direction[2]);
        direction[1] = 0.0;
    }
}

/* Where the ray leaves the block of the nearest images, or is cut. */
static double ray_length(const struct growth *growth, const double origin[3],
                         const double direction[3])
{
    const struct gb_cell *cell = &growth->grid->cell;
    const bool planar = growth->grow->dimension == 2;
    double length = (planar ? ray_longest_2d : ray_longest_3d) * growth->grow->r_eq;
    for (int k = 0; k < 3; k++) {
        if (!cell->periodic[k] || direction[k] == 0.0) {
            continue;
        }
        const double border = direction[k] > 0.0 ? 2.0 * cell->edge[k] : -cell->edge[k];
        length = fmin(length, (border - origin[k]) / direction[k]);
    }
    return length;
}

/* Farthest first. */
static int compare_candidates(const void *left, const void *right)
{
    const struct candidate *a = left;
    const struct candidate *b = right;
    if (a->along != b->along) {
        return a->along > b->along ? -1 : 1;
    }
    return (a->j > b->j) - (a->j < b->j);
}

/* All positions on the far side of the particles that the ray passes within r_eq;
 * overlaps are not checked yet.  Returns their number. */
static int collect_candidates(struct growth *growth, const struct gb_roll *roll,
                              const double origin[3], const double direction[3])
{
    struct gb_grid_ray ray;
    struct gb_grid_hit hit;
    int count = 0;
    gb_grid_ray_init(&ray, growth->grid, origin, direction, roll->r_eq,
                     ray_length(growth, origin, direction));
    while (count < growth->room && gb_grid_ray_next(&ray, &hit)) {
        const double across = fmax(0.0, hit.square - hit.along * hit.along);
        const double touch = gb_roll_contact_distance(roll, hit.index);
        if (growth->diameter && across >= touch * touch) {
            continue; /* the ray does not meet it */
        }
        struct candidate *candidate = &growth->candidates[count++];
        candidate->j = hit.index;
        candidate->along = hit.along + sqrt(touch * touch - across);
        for (int k = 0; k < 3; k++) {
            candidate->offset[k] = candidate->along * direction[k] - hit.r[k];
        }
    }
    qsort(growth->candidates, (size_t)count, sizeof(*growth->candidates),
          compare_candidates);
    return count;
}

static void position_of(const struct growth *growth, const struct candidate *candidate,
                        double position[3])
{
    const double *j = growth->grid->position + 3 * candidate->j;
    for (int k = 0; k < 3; k++) {
        position[k] = j[k] + candidate->offset[k];
    }
}

/* Neighbours within r_meso; stops counting at enough. */
static int count_neighbours(const struct growth *growth, const double position[3],
                            int enough)
{
    struct gb_grid_ball ball;
    struct gb_grid_hit hit;
    int count = 0;
    gb_grid_ball_init(&ball, growth->grid, position, growth->grow->r_meso);
    while (count < enough && gb_grid_ball_next(&ball, &hit)) {
        count++;
    }
    return count;
}

/* The free position with the fewest neighbours, the farthest of several; NULL when the
 * ray has none.  The candidates come farthest first, so only fewer neighbours win, and
 * one neighbour (the particle touched) cannot be beaten. */
static const struct candidate *choose_candidate(const struct growth *growth,
                                                const struct gb_roll *roll, int count)
{
    const struct candidate *best = NULL;
    int fewest = INT32_MAX;
    for (int i = 0; i < count && fewest > 1; i++) {
        double position[3];
        position_of(growth, &growth->candidates[i], position);
        if (gb_roll_overlaps(roll, position)) {
            continue;
        }
        const int neighbours = count_neighbours(growth, position, fewest);
        if (neighbours < fewest) {
            fewest = neighbours;
            best = &growth->candidates[i];
        }
    }
    return best;
}

/* One ray from particle `origin`; inserts a particle where a candidate is free. */
static bool try_ray(struct growth *growth, int64_t origin)
{
    const struct gb_roll roll = next_one(growth);
    double start[3], direction[3], position[3];
    memcpy(start, growth->grid->position + 3 * origin, sizeof(start));
    random_direction(growth, direction);
    growth->rays++;
    if (growth->grid->count == 1) {
        /* Nothing to roll onto: the second particle just touches the first. */
        for (int k = 0; k < 3; k++) {
            position[k] = start[k] + gb_roll_contact_distance(&roll, 0) * direction[k];
        }
        gb_grid_insert(growth->grid, position);
        return true;
    }
    const int count = collect_candidates(growth, &roll, start, direction);
    const struct candidate *best = choose_candidate(growth, &roll, count);
    if (!best || !gb_roll_onto(&roll, best->j, best->offset, position)) {
        return false;
    }
    gb_grid_insert(growth->grid, position);
    return true;
}

static double density(const struct growth *growth, int64_t count)
{
    const struct gb_chain_growth *grow = growth->grow;
    const double one = grow->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    const double mean = grow->model ? grow->model->mean_cube : 1.0;
    return one * mean * (double)count / gb_cell_volume(&growth->grid->cell);
}

static bool fill(struct growth *growth, struct gb_error *err)
{
    const struct gb_chain_growth *grow = growth->grow;
    struct gb_grid *grid = growth->grid;
    int64_t origin = 0;
    int failures = 0;
    while (grid->count < grow->count) {
        if (growth->rays % RAYS_PER_POLL == 0 && grow->cancelled &&
            grow->cancelled(grow->data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "packing cancelled");
        }
        if (try_ray(growth, origin)) {
            origin = grid->count - 1;
            failures = 0;
            continue;
        }
        failures++;
        if (failures == FAILURES_MOST) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "structure.density = %.4g: not reached, stopped at %.3g "
                                "(%lld of %lld particles; no room was found from there)",
                                density(growth, grow->count),
                                density(growth, grid->count), (long long)grid->count,
                                (long long)grow->count);
        }
        if (failures % FAILURES_PER_ORIGIN == 0) {
            origin =
                (int64_t)gsl_rng_uniform_int(&growth->rng, (unsigned long)grid->count);
        }
    }
    return true;
}

static bool check(const struct gb_chain_growth *grow, const struct gb_cell *cell,
                  struct gb_error *err)
{
    if (grow->count < 1) {
        return gb_error_set(err, GB_ERR_INPUT, "particles.count = %lld: 1 or more",
                            (long long)grow->count);
    }
    if (!(grow->r_eq > 0.0) || !(grow->r_meso > 0.0) || !isfinite(grow->r_meso)) {
        return gb_error_set(err, GB_ERR_INPUT, "structure.r_meso = %g d: above 0 d",
                            grow->r_meso);
    }
    /* Below two diameters a particle would touch its own images. */
    if (!(gb_cell_shortest(cell) > 2.0 * grow->r_eq)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "structure.base: a cell of %g x %g x %g d is too small, every "
            "edge is above 2 d",
            grow->edges[0], grow->edges[1], grow->edges[2]);
    }
    return true;
}

static void insert_first(struct growth *growth)
{
    double position[3];
    for (int k = 0; k < 3; k++) {
        const double edge = growth->grid->cell.edge[k];
        position[k] =
            growth->grid->cell.periodic[k] ? edge * gsl_rng_uniform(&growth->rng) : 0.0;
    }
    gb_grid_insert(growth->grid, position);
}

struct gb_chain_growth gb_chain_growth_from_model(const struct gb_model *model)
{
    return (struct gb_chain_growth){
        .dimension = model->dimension,
        .count = model->count,
        .edges = {model->edges[0], model->edges[1], model->edges[2]},
        .r_eq = model->polydisperse ? model->diameter_max : 1.0 - model->h_eq,
        .model = model->polydisperse ? model : NULL,
        .r_meso = model->r_meso,
        .seed = model->seed,
    };
}

static bool assign_diameters(struct growth *growth, struct gb_error *err)
{
    if (!growth->grow->model) {
        return true;
    }
    growth->diameter =
        gb_alloc_array((size_t)growth->grow->count, sizeof *growth->diameter, err);
    return growth->diameter &&
           gb_assign_sizes_model(growth->grow->model, growth->diameter, err);
}

bool gb_chain_growth_run(const struct gb_chain_growth *grow, double *position,
                         struct gb_error *err)
{
    struct growth growth = {.grow = grow};
    struct gb_cell cell;
    bool done = false;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    if (!check(grow, &cell, err)) {
        return false;
    }
    if (!gb_random_open(&growth.rng, grow->seed, err)) {
        return false;
    }
    if (!assign_diameters(&growth, err)) {
        goto close_rng;
    }
    growth.room = CANDIDATES_MOST * (growth.diameter ? CANDIDATES_SIZED : 1);
    growth.candidates =
        gb_alloc_array((size_t)growth.room, sizeof(struct candidate), err);
    if (!growth.candidates) {
        goto close_rng;
    }
    if (!gb_grid_create(&growth.grid, &cell, grow->r_eq, grow->count, err)) {
        goto free_candidates;
    }
    insert_first(&growth);
    done = fill(&growth, err);
    if (done) {
        memcpy(position, growth.grid->position,
               (size_t)grow->count * 3 * sizeof(*position));
    }
    gb_grid_destroy(growth.grid);
free_candidates:
    gb_alloc_free(growth.candidates);
close_rng:
    gb_alloc_free(growth.diameter);
    gb_random_close(&growth.rng);
    return done;
}
