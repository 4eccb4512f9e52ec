#ifndef GB_PACK_STRUCTURE_CHAIN_GROWTH_H
#define GB_PACK_STRUCTURE_CHAIN_GROWTH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "scene/model.h"

/* Chain-growth initial structure of P1, section III, in 3D and 2D: periodic, connected.
 */
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
    struct gb_seed seed;
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

#endif
