#include "pack/structure/chain_growth.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/chain_ray.h"
#include "pack/structure/grid.h"
#include "pack/structure/random.h"

/* Rays that find no position: after the first number another particle becomes the origin;
 * after the second, in a row, the structure counts as full. */
enum { FAILURES_PER_ORIGIN = 64, FAILURES_MOST = 64 * 64 };

/* The cancel flag is polled once in this many rays. */
enum { RAYS_PER_POLL = 64 };

/* Grid cells for searches, in r_eq: from 0.7 to 1 the time changes by a tenth. */
static const double grid_size = 0.85;

static double density(const struct gb_chain_ray *growth, int64_t count)
{
    const struct gb_chain_growth *grow = growth->grow;
    const double one = grow->dimension == 3 ? M_PI / 6.0 : M_PI / 4.0;
    const double mean = grow->model ? grow->model->mean_power : 1.0;
    return one * mean * (double)count / gb_cell_volume(&growth->grid->cell);
}

static bool fill(struct gb_chain_ray *growth, struct gb_error *err)
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
        if (gb_chain_ray_try(growth, origin)) {
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

static void insert_first(struct gb_chain_ray *growth)
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
        .single_contact = model->single_contact,
        .seed = model->seed,
    };
}

static bool assign_diameters(struct gb_chain_ray *growth, struct gb_error *err)
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
    struct gb_chain_ray growth = {.grow = grow};
    struct gb_cell cell;
    bool done = false;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    if (!check(grow, &cell, err)) {
        return false;
    }
    if (!gb_random_open(&growth.rng, &grow->seed, GB_RANDOM_POSITIONS, err)) {
        return false;
    }
    if (!assign_diameters(&growth, err)) {
        goto close_rng;
    }
    growth.room = GB_CHAIN_RAY_CANDIDATES * (growth.diameter ? GB_CHAIN_RAY_SIZED : 1);
    growth.candidates =
        gb_alloc_array((size_t)growth.room, sizeof(struct gb_chain_ray_candidate), err);
    if (!growth.candidates) {
        goto close_rng;
    }
    if (!gb_grid_create(&growth.grid, &cell, grid_size * grow->r_eq, grow->count, err)) {
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
