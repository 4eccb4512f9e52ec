#ifndef GB_MANY_KEY_DIFFERENCE_H
#define GB_MANY_KEY_DIFFERENCE_H

#include <stdbool.h>

#include "greenbody/params.h"

/* Comparison of two scenes key by key. */

/* Keys without effect on the experiment: title, seed, threads, [output]. */
bool gb_key_difference_bookkeeping(const struct gb_field *field);

/* Whether both scenes have the same value of a key. */
bool gb_key_difference_equal(const struct gb_field *field, const struct gb_params *a,
                             const struct gb_params *b);

/* The first key in which two scenes differ, other than bookkeeping and those of
 * `accepted`, a NULL-terminated list of "group.key" and "group."; NULL: none. */
const struct gb_field *gb_key_difference_find(const struct gb_params *a,
                                              const struct gb_params *b,
                                              const char *const *accepted);

#endif
