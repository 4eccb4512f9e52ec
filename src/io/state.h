#ifndef GB_IO_STATE_H
#define GB_IO_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/curve.h"
#include "greenbody/status.h"
#include "pack/cell/cell.h"

struct gb_state_source;

/* A packing for pictures, exporters and state.h5: plain arrays owned by the struct,
 * lengths in diameters, forces in E d^2. */
struct gb_state {
    int dimension;
    int64_t count;
    double cell[3];      /* periodic edges, d; y is 1 in 2D */
    double tilt[3];      /* of the cell: xy, xz, yz, d */
    double die_radius;   /* d; 0: a periodic cell, else the cell is the box of a die */
    double die_top;      /* open end of the bore; NaN: endless; <= 0: removed */
    double *position;    /* count x 3, inside the cell */
    double *radius;      /* count */
    int32_t *contacts;   /* count: coordination number of each particle */
    int64_t pair_count;  /* pairs with r < d */
    int32_t *pair;       /* pair_count x 2 particle indices */
    double *pair_force;  /* pair_count x 3: total force on the first, E d^2 */
    double *pair_normal; /* pair_count: f_n, positive when pressed */
    uint8_t *pair_bridged;
    int64_t wall_count; /* contacts with the walls of a die */
    int32_t *wall;      /* wall_count x 2: particle, enum gb_die_wall */
    double *wall_force; /* wall_count x 3: total force on the particle, E d^2 */
    /* Optional arrays; NULL: not in this state. */
    double *velocity;       /* count x 3, d/T; without the affine motion of a cell */
    double *spin;           /* count x 3: angular velocity, 1/T */
    double *force;          /* count x 3: resultant of the contacts, E d^2 */
    double *torque;         /* count x 3, about the centre, E d^3 */
    double *contact_radius; /* pair_count: of the contact, or of its bridge, d */
    /* For a state that is only written: the arrays of pairs and the optional arrays are
     * NULL, and their rows are generated from a record (io/state_record.h).  NULL:
     * none. */
    struct gb_state_source *source;
    struct gb_point point;
    double metre_per_length, pascal_per_stress;
    double second_per_time; /* T in s; NaN: unknown, or a scene without time */
    char preset[256];       /* title of the preset */
    uint64_t seed;
    char version[32];
    /* Attraction across gaps (io/state_forces.h): strength (E d^2) and shift (d) of P1
     * (3), and its range (d); 0: none. */
    double attraction_strength, attraction_shift, attraction_cutoff;
    /* For pictures, in addition to the packing. */
    double pressed[3];    /* 1: an axis along which the scene is pressed */
    double punch_height;  /* of the face of the upper punch of a die, d; NaN: none */
    double funnel_height; /* of the funnel's outlet over the floor, d; 0: no funnel */
    double funnel_outlet; /* radius, d */
    double funnel_slope;  /* radius over height of its cone */
};

/* Creates a state with zeroed arrays for count particles and pair_count pairs. */
bool gb_state_create(struct gb_state **out, int64_t count, int64_t pair_count,
                     struct gb_error *err);
/* Creates a state with zeroed arrays for count particles only; a source provides the
 * pairs. */
bool gb_state_create_particles(struct gb_state **out, int64_t count, int64_t pair_count,
                               struct gb_error *err);
/* Allocates zeroed arrays for the pairs. */
bool gb_state_allocate_pairs(struct gb_state *state, struct gb_error *err);
/* Allocates zeroed arrays for count contacts with walls and frees the previous ones. */
bool gb_state_allocate_walls(struct gb_state *state, int64_t count, struct gb_error *err);
void gb_state_destroy(struct gb_state *state); /* NULL is fine */

/* The periodic cell, or the box around a die. */
struct gb_cell gb_state_cell(const struct gb_state *state);

/* Writes an HDF5 file to a temporary name, syncs and renames it.  Units are attributes.
 * record (may be NULL) becomes the group /checkpoint, see hdf/hdf_record.h. */
bool gb_state_write(const struct gb_state *state, const struct gb_record *record,
                    const char *path, struct gb_error *err);
/* Errors: GB_ERR_MACHINE (cannot be opened) or GB_ERR_INPUT (not a state, sizes that do
 * not match, indices or numbers out of range), naming path and dataset. */
bool gb_state_read(struct gb_state **out, const char *path, struct gb_error *err);

/* Allocates a zeroed optional array: &state->velocity, ... */
bool gb_state_optional_allocate(struct gb_state *state, double **member,
                                struct gb_error *err);

/* Copies the optional arrays that the record of a run has.  Rotations of a periodic
 * cell are stored as arcs (diameter times angle), so the radii of the state must be
 * set.  Errors: GB_ERR_MEMORY, GB_ERR_INPUT for an item of another shape. */
bool gb_state_optional_take(struct gb_state *state, const struct gb_record *record,
                            struct gb_error *err);

/* The same without a copy, for sources of a periodic cell: check the shapes of all
 * items; has the record an item for the array at this offset of gb_state; convert rows
 * begin .. end - 1. */
bool gb_state_optional_check(const struct gb_state *state, const struct gb_record *record,
                             struct gb_error *err);

bool gb_state_optional_has(const struct gb_record *record, size_t member);

void gb_state_optional_fill(const struct gb_state *state, const struct gb_record *record,
                            size_t member, int64_t begin, int64_t end, double *to);

#endif
