#ifndef GB_PACK_LIST_LIST_CHECK_H
#define GB_PACK_LIST_LIST_CHECK_H

#include <stdbool.h>
#include <stdint.h>

struct gb_engine;

/* A pair that the list it belongs to does not hold: first < other. */
struct gb_missing_pair {
    int32_t first, other;
    bool near; /* belongs to `near`, else to `far` */
};

/* Result of the list check for one block of particles. */
enum { GB_MISSING_PAIRS_MAX = 16 };

struct gb_missing_pairs {
    bool incomplete;    /* more pairs may be missing: no room left, or too many particles
                         * escaped to check them one by one */
    int escaped, count; /* escaped particles; missing pairs */
    struct gb_missing_pair pair[GB_MISSING_PAIRS_MAX];
};

/* State of the list check for one block. */
struct gb_list_check_block {
    double displacement; /* largest since the list was built, d; may be overestimated
                          * below the margin; NaN: a coordinate is not finite */
    struct gb_missing_pairs missing;
};

enum gb_list_check_verdict {
    GB_LIST_CHECK_VALID,     /* no particle escaped */
    GB_LIST_CHECK_UNCERTAIN, /* valid if no pair of the escaped particles is missing */
    GB_LIST_CHECK_INVALID,
};

/* Verdict by the largest displacement (d) alone; NaN, a coordinate that is not finite,
 * gives GB_LIST_CHECK_INVALID. */
enum gb_list_check_verdict gb_list_check_judge(const struct gb_engine *engine,
                                               double displacement);

/* Displacement (d) from which on a particle counts as escaped. */
double gb_list_check_margin(const struct gb_engine *engine);

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
