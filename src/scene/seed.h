#ifndef GB_SCENE_SEED_H
#define GB_SCENE_SEED_H

#include <stdint.h>

#include "greenbody/params.h"

/* What makes the random numbers of a scene. */
struct gb_seed {
    int generator; /* enum gb_generator */
    uint64_t value;
};

static inline struct gb_seed gb_seed_of(const struct gb_params *params)
{
    return (struct gb_seed){params->generator, params->seed};
}

#endif
