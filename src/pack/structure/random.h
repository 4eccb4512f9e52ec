#ifndef GB_PACK_STRUCTURE_RANDOM_H
#define GB_PACK_STRUCTURE_RANDOM_H

#include <gsl/gsl_rng.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Makes a Mersenne twister for a seed.  Its state comes from gb_alloc_array:
 * gsl_rng_alloc would abort the program when memory is out.  Errors: GB_ERR_MEMORY. */
bool gb_random_open(gsl_rng *random, uint64_t seed, struct gb_error *err);
void gb_random_close(gsl_rng *random);

#endif
