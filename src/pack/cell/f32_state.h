#ifndef GB_PACK_CELL_F32_STATE_H
#define GB_PACK_CELL_F32_STATE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "greenbody/status.h"
#include "pack/cell/cell.h"
#include "pack/cell/neighbour_list.h"
#include "pack/kernel/batch.h"

/* What a sweep in single precision works on: half the memory traffic of doubles.
 *
 * Places are whole numbers, 2^32 to an edge: exact to 5e-9 d in a cell of 20 d, where a
 * float would leave 1e-6, and the difference of two, wrapping around, is that to the
 * nearest image. */
struct gb_spot {
    int32_t place[4];
    float turn[4]; /* since the last evaluation */
};

/* Numbers in a row: force and torque on a particle, each with a fourth number that is 0;
 * a pull. */
enum { GB_F32_STATE_WRENCH = 8, GB_F32_STATE_PULL = 4 };

/* Numbers behind the last one of in_row that may be read. */
enum { GB_F32_STATE_SLACK = 8 };

/* Neighbours in memory whose ways are looked at together; as many fit into a block. */
enum { GB_F32_STATE_FLOCK = 32 };

/* Particles from which on what a sweep wants of others is not in the second cache any
 * more; then it is asked for ahead. */
enum { GB_F32_STATE_FETCHED = 16384 };

/* Pairs of a list whose second particle lies in a later block than the first: they leave
 * rows, which the block of the second one collects; all others add to their particles at
 * once. */
struct gb_f32_state_outward {
    int64_t *start;    /* blocks + 1: the rows of each block, in the order of its pairs */
    int64_t *source;   /* blocks: the earliest one whose rows each collects, or itself */
    int32_t *in_start; /* particles + 1: the rows that a particle collects ... */
    int32_t *in_row;   /* ... ascending */
    float *row;
    int64_t room; /* rows */
};

/* Where particles are is told twice: by positions, and by places, which motions with
 * inertia and sweeps go by. */
enum gb_f32_state_ahead {
    GB_F32_STATE_EVEN,
    GB_F32_STATE_PLACES,    /* positions lag behind: gb_sweep_f32_settle */
    GB_F32_STATE_POSITIONS, /* somebody may have moved them: gb_sweep_f32_prepare */
};

struct gb_f32_state {
    struct gb_batch_f32_kernel kernel;
    struct gb_spot *spot;                /* one a particle */
    float (*total)[GB_F32_STATE_WRENCH]; /* one a particle: force and torque */
    struct gb_f32_state_outward near;    /* rows: wrenches on j */
    struct gb_f32_state_outward far;     /* pulls on it */
    enum gb_f32_state_ahead ahead;
    float scale[3]; /* d in a unit of place, as of the last evaluation */
    /* Motion (pack/cell/integrate_f32.h), count x 3 and a number more each. */
    float *velocity, *spin;
    uint32_t *built; /* places when the lists were built */
    /* Of every flock: nobody in it has come farther since then (d).  From gb_list_check_fresh
     * on it is the way of the one that came farthest. */
    float *travel;
    bool bounded; /* they are known: nothing but drives has moved anybody */
    bool driven;  /* spots and ways are those of a drive that nobody evaluated yet */
    bool narrow;  /* the last forces are in `total` only */
};

bool gb_f32_state_init(struct gb_f32_state *single, const struct gb_model *model,
                       struct gb_error *err);
void gb_f32_state_finish(struct gb_f32_state *single);

/* Room for what the pairs of new lists leave, and which of them reach out of their block.
 * On failure nothing may be evaluated. */
bool gb_f32_state_take_lists(struct gb_f32_state *single,
                             const struct gb_neighbour_list *pairs, struct gb_error *err);

/* After lists were amended: which pairs reach out of their block in those that changed
 * there.  Errors as above. */
bool gb_f32_state_amend(struct gb_f32_state *single,
                        const struct gb_neighbour_list *pairs, bool near, bool far,
                        struct gb_error *err);

/* Where position x (d) along an edge (d) is. */
static inline int32_t gb_f32_state_place(double x, double units_per_d)
{
    /* the sum has the whole number in its lowest bits, rounded to even */
    const double sum = x * units_per_d + 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const uint32_t low = (uint32_t)bits;
    int32_t place;
    memcpy(&place, &low, sizeof place);
    return place;
}

/* Position along an edge (d) that the last one, up to half an edge away, has become where
 * the place has become this one.  Only place and edge, and how often a particle has gone
 * around, decide on its bits. */
static inline double gb_f32_state_follow(double last, int32_t place, double units_per_d,
                                         double d_per_unit)
{
    const double sum = last * units_per_d + 0x1.8p52; /* as in gb_f32_state_place */
    const double whole = sum - 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const uint32_t wide = (uint32_t)place - (uint32_t)bits;
    int32_t way;
    memcpy(&way, &wide, sizeof way);
    return (whole + (double)way) * d_per_unit;
}

/* Units of place in a d, along axis c of a cell. */
static inline double gb_f32_state_units(const struct gb_cell *cell, int c)
{
    return 0x1p32 / cell->edge[c];
}

/* d in one. */
static inline double gb_f32_state_d(const struct gb_cell *cell, int c)
{
    return cell->edge[c] * 0x1p-32;
}

/* x_i - x_j as a sweep sees it. */
void gb_f32_state_arm(const struct gb_cell *cell, const double xi[3], const double xj[3],
                      double r[3]);

#endif
