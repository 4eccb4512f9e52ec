#include "measure/percolation.h"

#include "base/alloc.h"
#include "measure/structure.h"

/* Without adhesion touching particles are at r = d except for rounding. */
static const double rounding = 1e-9;

/* More particles where a structure does not percolate. */
static const double growth_factor = 1.1;

double gb_percolation_reach(double r_eq)
{
    return r_eq < 1.0 ? 1.0 : 1.0 + rounding;
}

/* Whether the first `count` particles span every axis of the cell. */
static bool percolates(const struct gb_chain_growth *grow, const double *position,
                       int64_t count, bool *spans, struct gb_error *err)
{
    struct gb_connectivity found;
    struct gb_cell cell;
    gb_cell_init(&cell, grow->dimension, grow->edges);
    if (!gb_structure_connectivity(&cell, count, position, NULL,
                                   gb_percolation_reach(grow->r_eq), &found, err)) {
        return false;
    }
    *spans = true;
    for (int k = 0; k < 3; k++) {
        *spans = *spans && (found.percolates[k] || !cell.periodic[k]);
    }
    return true;
}

/* By bisection: a particle more never parts a cluster. */
static bool find_least(const struct gb_chain_growth *grow, const double *position,
                       int64_t *particles, struct gb_error *err)
{
    int64_t low = 0; /* does not percolate */
    int64_t high = grow->count;
    while (high - low > 1) {
        const int64_t middle = low + (high - low) / 2;
        bool spans = false;
        if (!percolates(grow, position, middle, &spans, err)) {
            return false;
        }
        *(spans ? &high : &low) = middle;
    }
    *particles = high;
    return true;
}

bool gb_percolation_find(const struct gb_chain_growth *grow, int64_t *particles,
                         struct gb_error *err)
{
    struct gb_chain_growth longer = *grow;
    bool spans = false;
    if (grow->model != NULL) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "particles.distribution: the percolation of a growing cluster "
            "is sought for mono");
    }
    for (;;) {
        double *position =
            gb_alloc_array((size_t)longer.count * 3, sizeof *position, err);
        const bool grown = position != NULL &&
                           gb_chain_growth_run(&longer, position, err) &&
                           percolates(&longer, position, longer.count, &spans, err);
        const bool done =
            grown && (!spans || find_least(&longer, position, particles, err));
        gb_alloc_free(position);
        if (!done || spans) {
            return done;
        }
        longer.count = (int64_t)((double)longer.count * growth_factor) + 1;
    }
}
