#ifndef GB_PACK_SINGLE_H
#define GB_PACK_SINGLE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "greenbody/status.h"
#include "pack/batch.h"
#include "pack/cell.h"

/* What a sweep in single precision works on: half the memory traffic of doubles.
 *
 * Places are whole numbers, 2^32 to an edge: exact to 5e-9 d in a cell of 20 d, where a
 * float would leave 1e-6, and the difference of two, wrapping around, is that to the
 * nearest image. */
struct gb_spot {
    int32_t place[4];
    float turn[4]; /* since the last evaluation */
};

struct gb_single {
    struct gb_batch_single_kernel kernel;
    struct gb_spot *spot; /* one a particle */
    float (*total)[8];    /* one a particle: force and torque from its own pairs */
    float (*row)[8];      /* one a near pair: force and torque on j */
    float (*pull)[4];     /* one a far pair: force on the first particle */
    float scale[3];       /* d in a unit of place, as of the last evaluation */
};

bool gb_single_init(struct gb_single *single, const struct gb_model *model,
                    struct gb_error *err);
void gb_single_finish(struct gb_single *single);

/* Room for so many pairs; what was there is lost.  On failure there may be none. */
bool gb_single_reserve_near(struct gb_single *single, int64_t room, struct gb_error *err);
bool gb_single_reserve_far(struct gb_single *single, int64_t room, struct gb_error *err);

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

/* Units of place in a d, along axis c of a cell. */
static inline double gb_single_units(const struct gb_cell *cell, int c)
{
    return 0x1p32 / cell->edge[c];
}

/* x_i - x_j as a sweep sees it. */
void gb_single_arm(const struct gb_cell *cell, const double xi[3], const double xj[3],
                   double r[3]);

#endif
