#ifndef GB_PACK_CELL_WORLD_PRIVATE_H
#define GB_PACK_CELL_WORLD_PRIVATE_H

#include "pack/cell/contact_history.h"
#include "pack/cell/engine.h"
#include "pack/cell/world.h"
#include "pack/list/engine_lists.h"

/* The sum of an evaluation; 0: of none. */
struct gb_virial {
    int64_t evaluation;
    double sum[3][3];
};

/* The inside of gb_world, for the top files of the periodic engine only: world*.c,
 * pair_tangent.c, integrate_f32.c, nonaffine.c, pair_forces.c, pair_tangent.c and world.c
 * (docs/engine.md). */
struct gb_world {
    struct gb_engine engine;
    struct gb_virial *virial;      /* the last one, by world.c */
    struct gb_contact_carry carry; /* across list rebuilds */
    int32_t *coordination;         /* scratch of gb_world_coordination, one a particle */
    int64_t evaluations, rebuilds;
};

struct gb_world_copy {
    struct gb_cell cell;
    int64_t count;
    double *position;
    struct gb_contact_history history;
};

/* New lists from the positions, with the contacts of a history (NULL: those that there are);
 * positions are wrapped into the cell.  On failure there are no lists. */
bool gb_world_evaluate_rebuild(struct gb_world *world,
                               const struct gb_contact_history *history,
                               struct gb_error *err);

#endif
