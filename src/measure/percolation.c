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

/* What became of a structure of a length. */
enum growth { FULL, LOOSE, SPANNING, FAILED };

/* Grows a structure and, where it spans the cell, finds the least number. */
static enum growth grow_once(const struct gb_chain_growth *grow, int64_t *particles,
                             struct gb_error *err)
{
    struct gb_error cause = {0};
    bool spans = false;
    double *position = gb_alloc_array((size_t)grow->count * 3, sizeof *position, err);
    if (position == NULL) {
        return FAILED;
    }
    enum growth outcome = FAILED;
    if (!gb_chain_growth_run(grow, position, &cause)) {
        outcome = cause.code == GB_ERR_INPUT ? FULL : FAILED;
        gb_error_set(err, cause.code, "%s", cause.text);
    } else if (percolates(grow, position, grow->count, &spans, err) &&
               (!spans || find_least(grow, position, particles, err))) {
        outcome = spans ? SPANNING : LOOSE;
    }
    gb_alloc_free(position);
    return outcome;
}

/* Longer and longer structures; below a length that finds no room, by bisection. */
bool gb_percolation_find(const struct gb_chain_growth *grow, int64_t *particles,
                         struct gb_error *err)
{
    struct gb_chain_growth longer = *grow;
    int64_t loose = 0; /* longest that does not span */
    int64_t full = 0;  /* shortest that finds no room; 0: none yet */
    if (grow->model != NULL) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "particles.distribution: the percolation of a growing cluster "
            "is sought for mono");
    }
    for (;;) {
        const enum growth outcome = grow_once(&longer, particles, err);
        if (outcome == SPANNING || outcome == FAILED) {
            return outcome == SPANNING;
        }
        *(outcome == FULL ? &full : &loose) = longer.count;
        if (full > 0 && full - loose <= 1) {
            return false; /* err says where it was full */
        }
        longer.count = full > 0 ? loose + (full - loose) / 2
                                : (int64_t)((double)loose * growth_factor) + 1;
    }
}
