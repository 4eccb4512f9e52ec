#ifndef GB_PACK_SINGLE_H
#define GB_PACK_SINGLE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "greenbody/status.h"
#include "pack/batch.h"
#include "pack/cell.h"
#include "pack/pairs.h"

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
enum { GB_SINGLE_WRENCH = 8, GB_SINGLE_PULL = 4 };

/* Numbers behind the last one of in_row that may be read. */
enum { GB_SINGLE_SLACK = 8 };

/* Neighbours in memory whose ways are looked at together; as many fit into a block. */
enum { GB_SINGLE_FLOCK = 32 };

/* Particles from which on what a sweep wants of others is not in the second cache any
 * more; then it is asked for ahead. */
enum { GB_SINGLE_FETCHED = 16384 };

/* Pairs of a list whose second particle lies in a later block than the first: they leave
 * rows, which the block of the second one collects; all others add to their particles at
 * once. */
struct gb_single_outward {
    int64_t *start;    /* blocks + 1: the rows of each block, in the order of its pairs */
    int64_t *source;   /* blocks: the earliest one whose rows each collects, or itself */
    int32_t *in_start; /* particles + 1: the rows that a particle collects ... */
    int32_t *in_row;   /* ... ascending */
    float *row;
    int64_t room; /* rows */
};

/* Where particles are is told twice: by positions, and by places, which motions with
 * inertia and sweeps go by. */
enum gb_single_ahead {
    GB_SINGLE_EVEN,
    GB_SINGLE_PLACES,    /* positions lag behind: gb_sweep_single_settle */
    GB_SINGLE_POSITIONS, /* somebody may have moved them: gb_sweep_single_prepare */
};

struct gb_single {
    struct gb_batch_single_kernel kernel;
    struct gb_spot *spot;             /* one a particle */
    float (*total)[GB_SINGLE_WRENCH]; /* one a particle: force and torque */
    struct gb_single_outward near;    /* rows: wrenches on j */
    struct gb_single_outward far;     /* pulls on it */
    enum gb_single_ahead ahead;
    float scale[3]; /* d in a unit of place, as of the last evaluation */
    /* Motion (pack/drive.h), count x 3 and a number more each. */
    float *velocity, *spin;
    uint32_t *built; /* places when the lists were built */
    /* Of every flock: nobody in it has come farther since then (d).  From gb_strays_fresh
     * on it is the way of the one that came farthest. */
    float *travel;
    bool bounded; /* they are known: nothing but drives has moved anybody */
    bool driven;  /* spots and ways are those of a drive that nobody evaluated yet */
    bool narrow;  /* the last forces are in `total` only */
};

bool gb_single_init(struct gb_single *single, const struct gb_model *model,
                    struct gb_error *err);
void gb_single_finish(struct gb_single *single);

/* Room for what the pairs of new lists leave, and which of them reach out of their block.
 * On failure nothing may be evaluated. */
bool gb_single_take_lists(struct gb_single *single, const struct gb_pairs *pairs,
                          struct gb_error *err);

/* After lists were amended: which pairs reach out of their block in those that changed
 * there.  Errors as above. */
bool gb_single_amend(struct gb_single *single, const struct gb_pairs *pairs, bool near,
                     bool far, struct gb_error *err);

/* Where position x (d) along an edge (d) is. */
static inline int32_t gb_single_place(double x, double units_per_d)
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
static inline double gb_single_follow(double last, int32_t place, double units_per_d,
                                      double d_per_unit)
{
    const double sum = last * units_per_d + 0x1.8p52; /* as in gb_single_place */
    const double whole = sum - 0x1.8p52;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    const uint32_t wide = (uint32_t)place - (uint32_t)bits;
    int32_t way;
    memcpy(&way, &wide, sizeof way);
    return (whole + (double)way) * d_per_unit;
}

/* Units of place in a d, along axis c of a cell. */
static inline double gb_single_units(const struct gb_cell *cell, int c)
{
    return 0x1p32 / cell->edge[c];
}

/* d in one. */
static inline double gb_single_d(const struct gb_cell *cell, int c)
{
    return cell->edge[c] * 0x1p-32;
}

/* x_i - x_j as a sweep sees it. */
void gb_single_arm(const struct gb_cell *cell, const double xi[3], const double xj[3],
                   double r[3]);

#endif
