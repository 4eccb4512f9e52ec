#ifndef GB_PACK_LIST_LIST_PATCH_H
#define GB_PACK_LIST_LIST_PATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/list/neighbour_list.h"

struct gb_engine;

enum gb_list_patch_outcome {
    GB_LIST_PATCH_DONE,    /* the lists are complete */
    GB_LIST_PATCH_REBUILD, /* nothing was done: too many pairs are missing, or it is not
                            * known which */
    GB_LIST_PATCH_FAILED,  /* error set; the lists have to be rebuilt before any use */
};

/* Inserts the pairs that the last list check found missing, without a history; pairs that
 * come to touch leave the far list.  Errors: GB_ERR_MEMORY. */
enum gb_list_patch_outcome gb_list_patch_insert(struct gb_engine *engine,
                                                struct gb_error *err);

/* Inserts the pairs that a checkpoint kept into lists that were just built.  Errors:
 * GB_ERR_INPUT where they are out of order or range, or in the lists already;
 * GB_ERR_MEMORY. */
bool gb_list_patch_load(struct gb_engine *engine, const struct gb_inserted_pair *kept,
                        int64_t count, struct gb_error *err);

#endif
