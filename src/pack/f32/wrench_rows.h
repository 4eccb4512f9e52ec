#ifndef GB_PACK_F32_WRENCH_ROWS_H
#define GB_PACK_F32_WRENCH_ROWS_H

#include <stdint.h>

#include "greenbody/status.h"
#include "pack/list/neighbour_list.h"

/* Numbers of a row: force and torque, each with a fourth number that is 0, and where the
 * torque begins; rows that are read at once, the last ones without being used. */
enum { GB_WRENCH_ROWS_WIDTH = 8, GB_WRENCH_ROWS_TORQUE = 4, GB_WRENCH_ROWS_AT_ONCE = 4 };

/* Forces and torques in single precision.  The first rows are those on the particles.  A
 * pair whose second particle lies in a later block than the first ("cross pair") adds to a
 * row of its own, which the block of the second particle adds to it afterwards and sets to
 * 0: between evaluations these rows are 0.  All other pairs add to both particles. */
struct gb_wrench_rows {
    float (*row)[GB_WRENCH_ROWS_WIDTH];
    int64_t room; /* rows */
    /* 2 particles + 1: of each the first row of near cross pairs, then of far ones, both
     * in the order of the lists.  Rows behind those of a block are not used. */
    int32_t *start;
};

/* Rows of the particles alone. */
bool gb_wrench_rows_init(struct gb_wrench_rows *rows, int64_t count,
                         struct gb_error *err);
void gb_wrench_rows_finish(struct gb_wrench_rows *rows);

/* Gives every pair of the lists its row (gb_pair_list.row); the rows of the particles stay
 * as they are.  On failure nothing may be evaluated. */
bool gb_wrench_rows_update(struct gb_wrench_rows *rows, struct gb_neighbour_list *list,
                           struct gb_error *err);

/* Sets the cross rows of particles begin .. end - 1, a whole block, to 0. */
void gb_wrench_rows_clear(const struct gb_wrench_rows *rows, int64_t begin, int64_t end);

#endif
