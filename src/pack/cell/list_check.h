#ifndef GB_PACK_CELL_LIST_CHECK_H
#define GB_PACK_CELL_LIST_CHECK_H

#include <stdbool.h>
#include <stdint.h>

struct gb_world;

/* Strays: particles that have come further since the list was made than half its margin.
 * The list is sure to hold every pair while there is none; but of thousands of particles
 * a few, without a load, run ahead of all others and would wear it out alone.  So they
 * are looked at one by one: the list is good as long as it holds their pairs. */

/* After so long a way at most, what is the list of a world? */
enum gb_list_check_list {
    GB_LIST_CHECK_FRESH,   /* good: nobody strayed */
    GB_LIST_CHECK_DOUBTED, /* good if gb_strays_listed says so of all particles */
    GB_LIST_CHECK_STALE,
};
/* travel: of the particle that came furthest; NaN where a place is not finite */
enum gb_list_check_list gb_list_check_judge(const struct gb_world *world, double travel);

/* The way (d) from which on the list is not fresh. */
double gb_list_check_fresh(const struct gb_world *world);

/* A pair that the list it belongs into does not hold: first < other. */
struct gb_list_check_pair {
    int32_t first, other;
    bool near; /* into that list, else into `far` */
};

/* Those of a block of particles. */
enum { GB_LIST_CHECK_MISSING = 16 };
struct gb_list_check_missing {
    bool many; /* there may be more, or there were too many strays to look at */
    int strays, count;
    struct gb_list_check_pair pair[GB_LIST_CHECK_MISSING];
};

/* Which pairs of the strays among particles begin .. end - 1 are not where they belong in
 * the list? */
void gb_list_check_look(const struct gb_world *world, int64_t begin, int64_t end,
                        struct gb_list_check_missing *missing);

/* Are so many strays among all particles more than a new list costs? */
bool gb_list_check_too_many(int64_t strays, int64_t particles);

#endif
