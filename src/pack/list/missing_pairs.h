#ifndef GB_PACK_LIST_MISSING_PAIRS_H
#define GB_PACK_LIST_MISSING_PAIRS_H

#include <stdbool.h>
#include <stdint.h>

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

#endif
