#ifndef GB_PACK_STRAYS_H
#define GB_PACK_STRAYS_H

#include <stdbool.h>
#include <stdint.h>

struct gb_world;

/* Strays: particles that have come further since the list was made than half its margin.
 * The list is sure to hold every pair while there is none; but of thousands of particles
 * a few, without a load, run ahead of all others and would wear it out alone.  So they
 * are looked at one by one: the list is good as long as it holds their pairs. */

/* After so long a way at most, what is the list of a world? */
enum gb_strays_list {
    GB_STRAYS_FRESH,   /* good: nobody strayed */
    GB_STRAYS_DOUBTED, /* good if gb_strays_listed says so of all particles */
    GB_STRAYS_STALE,
};
/* travel: of the particle that came furthest; NaN where a place is not finite */
enum gb_strays_list gb_strays_judge(const struct gb_world *world, double travel);

/* Are all pairs of the strays among particles begin .. end - 1 where they belong in the
 * list?  Also false where there are too many of them to look at. */
bool gb_strays_listed(const struct gb_world *world, int64_t begin, int64_t end);

#endif
