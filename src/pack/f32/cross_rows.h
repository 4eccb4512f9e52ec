#ifndef GB_PACK_F32_CROSS_ROWS_H
#define GB_PACK_F32_CROSS_ROWS_H

#include <stdint.h>

#include "greenbody/status.h"
#include "pack/list/neighbour_list.h"

/* Elements of in_row that may be read behind the last one. */
enum { GB_CROSS_ROWS_SLACK = 8 };

/* Pairs of a patchable list whose second particle lies in a later block than the first
 * ("cross pairs").  The sweep of the first block writes the force on the second particle
 * into a row; the block of the second particle adds it later.  All other pairs add to
 * both particles at once. */
struct gb_cross_rows {
    int64_t *start;    /* blocks + 1: rows of each block, in the order of its pairs */
    int64_t *source;   /* blocks: earliest block with rows for this block, or itself */
    int32_t *in_start; /* particles + 1: rows for a particle ... */
    int32_t *in_row;   /* ... ascending */
    float *row;
    int width;        /* numbers in a row */
    int64_t capacity; /* rows */
};

bool gb_cross_rows_init(struct gb_cross_rows *rows, int64_t count, int width,
                        struct gb_error *err);
void gb_cross_rows_finish(struct gb_cross_rows *rows);

/* Numbers the cross pairs of a list and reserves their rows.  On failure nothing may be
 * evaluated. */
bool gb_cross_rows_update(struct gb_cross_rows *rows, const struct gb_pair_list *list,
                          int64_t count, struct gb_error *err);

#endif
