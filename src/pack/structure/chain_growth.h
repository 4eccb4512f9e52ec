#ifndef GB_PACK_STRUCTURE_CHAIN_GROWTH_H
#define GB_PACK_STRUCTURE_CHAIN_GROWTH_H

#include <gsl/gsl_rng.h>
#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/structure/grid.h"
#include "scene/model.h"

/* Chain-growth initial structure of P1, section III, in 3D and 2D: periodic, connected. */
struct gb_chain_growth {
    int dimension;
    int64_t count;
    double edges[3]; /* d; y is 1 in 2D */
    double r_eq;     /* distance of touching particles, d: 1 - h_eq; of unequal sizes the
                      * longest that can be */
    double r_meso;   /* d */
    /* Share of the particles that stay where the ray meets one other, instead of going on
     * to the closest position that touches two; P1: 0. */
    double single_contact;
    uint64_t seed;
    const struct gb_model *model;  /* of unequal sizes; else NULL */
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *data;
};

/* The structure a model begins with; cancelled is left NULL. */
struct gb_chain_growth gb_chain_growth_from_model(const struct gb_model *model);

/* Places the particles.
 *
 * position   count x 3, filled with positions inside the cell (y = 0 in 2D)
 * Errors: GB_ERR_INPUT "structure.density = 0.7: not reached, stopped at 0.44 (...)" when
 * no free position is left, GB_ERR_MEMORY, GB_ERR_CANCELLED.
 * Deterministic: same struct, same bits.  Cost about linear in count. */
bool gb_chain_growth_run(const struct gb_chain_growth *grow, double *position,
                         struct gb_error *err);

/* ---- For tests: one ray at a time ---- */

/* Centres closer than (1 - GB_ROLL_TOLERANCE) r_eq overlap.  Above the rounding of a
 * position on two spheres, so that the hexagons of 2D can close; below any distance that
 * matters. */
#define GB_ROLL_TOLERANCE 1e-9

/* A new particle and the existing ones, with its distances of contact. */
struct gb_roll {
    const struct gb_grid *grid;
    double r_eq; /* the distance; of unequal sizes: the longest */
    /* unequal sizes: */
    const struct gb_model *model;
    const double *diameter; /* of all, d; NULL: all are equal */
    double own;             /* of the new one */
};

/* Distance of the new particle to particle j in contact. */
double gb_chain_growth_contact_distance(const struct gb_roll *roll, int64_t j);

/* Spheres of diameter r_eq whose centres lie within r_eq of a ray of n r_eq fill at most
 * the cylinder of radius 1.5 r_eq and length (n + 1) r_eq: 13.5 (n + 1) of them; discs
 * fill at most the strip, 3.9 (n + 1). */
enum { GB_CHAIN_RAY_CANDIDATES = 824 };

/* A position on the ray that touches particle j. */
struct gb_chain_ray_candidate {
    int64_t j;
    double along;     /* of the position, from the origin of the ray */
    double offset[3]; /* from j to the position; as long as they touch */
    double touch;     /* that distance */
    double foot;      /* of j on the ray, from its origin */
    double across;    /* square of the distance of j from the ray */
    int least;        /* neighbours that are known of; INT32_MAX: overlaps, or tried */
};

/* State of a growing structure. */
struct gb_chain_ray {
    const struct gb_chain_growth *grow;
    struct gb_grid *grid;
    double *diameter; /* d; NULL: all are equal */
    gsl_rng rng;
    struct gb_chain_ray_candidate *candidates;
    int room; /* for candidates */
    int64_t rays;
};

/* One random ray from particle `origin`; inserts a particle where a candidate is free. */
bool gb_chain_growth_try(struct gb_chain_ray *growth, int64_t origin);

/* Places the particles of the structure that a model begins with: grown chains, a
 * lattice, or those of a file.
 *
 * position    count x 3, filled with positions inside the cell (y = 0 in 2D)
 * cancelled   polled with data during growth; NULL is fine
 * Errors: of gb_chain_growth_run. */
bool gb_chain_growth_fill(const struct gb_model *model, bool (*cancelled)(void *data),
                          void *data, double *position, struct gb_error *err);

#endif
