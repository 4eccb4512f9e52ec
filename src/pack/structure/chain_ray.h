#ifndef GB_PACK_STRUCTURE_CHAIN_RAY_H
#define GB_PACK_STRUCTURE_CHAIN_RAY_H

#include <gsl/gsl_rng.h>
#include <stdbool.h>
#include <stdint.h>

#include "pack/structure/chain_growth.h"
#include "pack/structure/grid_search.h"

/* Spheres of diameter r_eq whose centres lie within r_eq of a ray of n r_eq fill at most
 * the cylinder of radius 1.5 r_eq and length (n + 1) r_eq: 13.5 (n + 1) of them; discs
 * fill at most the strip, 3.9 (n + 1). */
enum { GB_CHAIN_RAY_CANDIDATES = 824 };

/* Small particles of unequal sizes have more candidates.  Their number is limited to this
 * factor times the number above; the last ones found are ignored. */
enum { GB_CHAIN_RAY_SIZED = 8 };

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
bool gb_chain_ray_try(struct gb_chain_ray *growth, int64_t origin);

#endif
