#ifndef GB_PACK_STRUCTURE_RANDOM_H
#define GB_PACK_STRUCTURE_RANDOM_H

#include <gsl/gsl_rng.h>
#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Independent sequences of one seed. */
enum gb_random_stream {
    GB_RANDOM_POSITIONS, /* of an initial structure or a loose filling */
    GB_RANDOM_SIZES      /* which particle has which size */
};

/* Makes a random number generator for a seed and a stream.  Philox takes all 64 bits as
 * its key and the stream as the upper half of its counter, so that no two seeds and no
 * two streams share a sequence.  Numbers of gsl_rng_uniform have 53 bits.  The state
 * comes from gb_alloc_array: gsl_rng_alloc would abort the program when memory is out.
 *
 * Errors: GB_ERR_MEMORY.
 * Source: Salmon et al., Parallel random numbers: as easy as 1, 2, 3 (SC11), section 5. */
bool gb_random_open(gsl_rng *random, uint64_t seed, enum gb_random_stream stream,
                    struct gb_error *err);
void gb_random_close(gsl_rng *random);

/* Unit vectors, uniform over the sphere or the circle.  GSL's functions have other bits
 * where its compiler fused multiply and add (aarch64).
 * Source: Knop, Commun. ACM 13, 326 (1970); von Neumann, Nat. Bur. Stand. AMS 12, 36
 * (1951). */
void gb_random_direction_3d(const gsl_rng *random, double direction[3]);
void gb_random_direction_2d(const gsl_rng *random, double *x, double *z);

#endif
