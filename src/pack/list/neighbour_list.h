#ifndef GB_PACK_LIST_NEIGHBOUR_LIST_H
#define GB_PACK_LIST_NEIGHBOUR_LIST_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"

struct gb_list_levels;
struct gb_team;

/* Bins at least as wide as the reach of a neighbour list.  A build sorts the particles
 * into them, and list_check.c looks them up again. */
struct gb_neighbour_grid {
    int n[3];        /* bins along each axis */
    int span_low[3]; /* neighbouring bins to visit: span_low .. span_high */
    int span_high[3];
    double inverse[3];   /* one over the width of a bin, 1/d */
    bool tilted;         /* then, instead: */
    double to_bin[3][3]; /* bins along each edge vector from x, 1/d */
    bool
        plain; /* more than two bins along each periodic axis: a pair of bins has one image */
};

/* How the pairs of a particle are found from its second partner. */
enum gb_neighbour_list_layout {
    GB_NEIGHBOUR_LIST_TRANSPOSED, /* by the transposed list; sweeps in double precision */
    GB_NEIGHBOUR_LIST_PATCHABLE,  /* not at all; every block of particles ends with free
                                   * slots for later insertions; single precision */
};

/* One of the two lists: pairs (i, other[k]) with i < other[k] for k in
 * [start[i], start[i+1]), sorted by other within i. */
struct gb_pair_list {
    int64_t pair_count;
    int64_t capacity; /* pairs the arrays can hold */
    int64_t *start;   /* particles + 1 */
    /* Patchable lists, else NULL: one past the last pair of every block of particles
     * (pack/list/blocks.h).  The slots from there to the next block are free, so that an
     * inserted pair moves no other block.  A free slot holds the last particle of the
     * block paired with its own image one edge away along every axis: never in contact. */
    int64_t *stop;
    int32_t *first; /* i of each pair */
    int32_t *other; /* j of each pair */
    uint8_t *image; /* periodic image of j; index of gb_neighbour_list.shift */
    int32_t *row;   /* patchable: row that sums the forces on j (pack/f32/f32_state.h) */
    int64_t
        *in_start;    /* transposed: particles + 1: pairs with j as second particle ... */
    int32_t *in_slot; /* ... as indices k, ascending */
};

/* A pair inserted into a list after its build; see pack/list/list_patch.h.  The layout is
 * that of the checkpoint's item of inserted pairs (pack/cell/world_record.c). */
struct gb_inserted_pair {
    int32_t first, other, image;
    int32_t near; /* 1: into `near`; 0: into `far` */
};

/* Verlet list.  Pairs that can touch before the next build (nearer than 1 + skin) are in
 * `near` and carry a contact record; pairs in `far` can only attract across a gap. */
struct gb_neighbour_list {
    int64_t count; /* particles */
    /* Diameters (d), owned by gb_particles: a pair touches at the mean of its diameters,
     * and skin and cutoff - 1 count from there.  NULL: all are 1. */
    const double *diameter;
    double largest;                /* diameter, d */
    struct gb_list_levels *levels; /* scratch of builds with diameters; NULL: none yet */
    struct gb_pair_list near, far;
    enum gb_neighbour_list_layout layout;
    /* Displacement of each periodic image (d), added to x_i - x_j; as of the last
     * evaluation. */
    double shift[27][3];
    /* Of the last build: particles of bin c are bin_particle[bin_start[c]] ... */
    struct gb_neighbour_grid grid;
    int32_t *bin_start, *bin_particle;
    int64_t bin_capacity;
    /* ... and what the same lists can be built from again. */
    double *built_position; /* count x 3, d */
    struct gb_cell built;
    struct gb_cell unit; /* the unit cube at the build, deformed with the cell since */
    double strain;       /* largest affine strain since the build */
    /* Pairs inserted since the build, ascending. */
    struct gb_inserted_pair *inserted;
    int64_t inserted_count, inserted_max;
};

bool gb_neighbour_list_init(struct gb_neighbour_list *list, int64_t count,
                            enum gb_neighbour_list_layout layout, struct gb_error *err);
void gb_neighbour_list_finish(struct gb_neighbour_list *list);

/* Slots of a list, including the free ones. */
static inline int64_t gb_neighbour_list_slots(const struct gb_neighbour_list *list,
                                              const struct gb_pair_list *pairs)
{
    return pairs->start[list->count];
}

/* Marks a slot of the block that ends with particle i as free. */
void gb_neighbour_list_free_slot(struct gb_pair_list *pairs, int64_t slot, int64_t i);

/* Neighbours that one particle may have within the reach in bins: a dense packing of like
 * sizes has about a dozen. */
enum { GB_NEIGHBOUR_LIST_SCAN_MAX = 256 };

/* Range of the lists, beyond a diameter of 1. */
struct gb_neighbour_list_range {
    double cutoff; /* of the attraction, d */
    double skin;   /* d */
};

/* Builds both lists for positions inside the cell, out to cutoff + skin, and sets `shift`.
 *
 * team   threads that share the work; NULL: the caller.  The lists are the same.
 * Errors: GB_ERR_MEMORY; GB_ERR_GUARD when the cell is too small for the reach or a particle has
 * too many neighbours. */
bool gb_neighbour_list_build(struct gb_neighbour_list *list, const struct gb_cell *cell,
                             const double *position, struct gb_neighbour_list_range range,
                             struct gb_team *team, struct gb_error *err);

/* Lists without a pair: the safe state after a failed build. */
void gb_neighbour_list_clear(struct gb_neighbour_list *list);

/* Largest displacement of particles begin .. end - 1 since the build, in excess of the affine
 * motion, d; NaN when a coordinate is not finite. */
double gb_neighbour_list_displacement(const struct gb_neighbour_list *list,
                                      const double *position, int64_t begin, int64_t end);

/* Squared displacement of particle i at x since the build, in excess of the affine motion, d^2;
 * after any deformation of the cell (gb_cell_tilted of `unit`). */
double gb_neighbour_list_displacement2_tilted(const struct gb_neighbour_list *list,
                                              int64_t i, const double x[3]);

/* The same where the cell was only scaled. */
static inline double
gb_neighbour_list_displacement2_scaled(const struct gb_neighbour_list *list, int64_t i,
                                       const double x[3])
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        const double moved = x[k] - list->built_position[3 * i + k] * list->unit.edge[k];
        square += moved * moved;
    }
    return square;
}

/* The cell and all positions were deformed. */
void gb_neighbour_list_deform(struct gb_neighbour_list *list,
                              const struct gb_deformation *deformation);

/* Bin of a position inside the cell, along each axis. */
void gb_neighbour_list_bin(const struct gb_neighbour_grid *grid, const double x[3],
                           int bin[3]);

static inline int gb_neighbour_list_bin_index(const struct gb_neighbour_grid *grid,
                                              const int bin[3])
{
    return (bin[2] * grid->n[1] + bin[1]) * grid->n[0] + bin[0];
}

/* Sets `shift` for the edge vectors of a cell. */
void gb_neighbour_list_update_shifts(struct gb_neighbour_list *list,
                                     const struct gb_cell *cell);

#endif
