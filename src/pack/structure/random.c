#include "pack/structure/random.h"

#include "base/alloc.h"

bool gb_random_open(gsl_rng *random, uint64_t seed, struct gb_error *err)
{
    random->type = gsl_rng_mt19937;
    random->state = gb_alloc_array(1, random->type->size, err);
    if (!random->state) {
        return false;
    }
    /* The seed of mt19937 has 32 bits; the upper ones are combined with the lower. */
    gsl_rng_set(random, (unsigned long)((seed ^ (seed >> 32)) & 0xffffffffu));
    return true;
}

void gb_random_close(gsl_rng *random)
{
    gb_alloc_free(random->state);
    random->state = NULL;
}
