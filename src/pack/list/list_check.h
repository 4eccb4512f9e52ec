#ifndef GB_PACK_LIST_LIST_CHECK_H
#define GB_PACK_LIST_LIST_CHECK_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/list/missing_pairs.h"

struct gb_engine;

/* The list check.  While no particle has moved farther than the margin (about half the
 * skin) since the build, the lists hold every pair.  Of thousands of particles a few,
 * without load, move much farther than the others and would force a rebuild alone.
 * These escaped particles are checked one by one: the lists are valid as long as they
 * hold the pairs of the escaped particles. */

enum gb_list_check_verdict {
    GB_LIST_CHECK_VALID,     /* no particle escaped */
    GB_LIST_CHECK_UNCERTAIN, /* valid if gb_list_check_find finds no missing pair */
    GB_LIST_CHECK_INVALID,
};

/* Verdict by the largest displacement (d) alone; NaN, a coordinate that is not finite,
 * gives GB_LIST_CHECK_INVALID. */
enum gb_list_check_verdict gb_list_check_judge(const struct gb_engine *engine,
                                               double displacement);

/* Displacement (d) from which on a particle counts as escaped. */
double gb_list_check_margin(const struct gb_engine *engine);

/* Pairs of the escaped particles among begin .. end - 1 that are not in the list they
 * belong to. */
void gb_list_check_find(const struct gb_engine *engine, int64_t begin, int64_t end,
                        struct gb_missing_pairs *missing);

/* True if checking the escaped particles costs more than a new list. */
bool gb_list_check_too_many(int64_t escaped, int64_t particles);

/* Displacements of block b since the build, from `position`. */
void gb_list_check_measure(struct gb_engine *engine, int64_t b);

/* Largest displacement of all blocks, d; NaN if a coordinate is not finite. */
double gb_list_check_largest(const struct gb_engine *engine);

/* True if the lists are valid, by the displacements of the blocks; leaves the missing pairs
 * in engine->check. */
bool gb_list_check_run(struct gb_engine *engine);

#endif
