#ifndef GB_TESTS_COMMON_UNEQUAL_H
#define GB_TESTS_COMMON_UNEQUAL_H

#include <math.h>

#include "common/scene.h"

/* Scenes of unequal spheres. */

#define UNEQUAL_LOGNORMAL "particles.distribution=lognormal", "particles.median=9.7 nm"

static inline struct gb_model unequal_model(const char *first, const char *second)
{
    const struct gb_params params =
        scene_params(UNEQUAL_LOGNORMAL, "particles.sigma=0.3", "particles.largest=20 nm",
                     first, second, NULL);
    return scene_model(&params);
}

/* Relative difference of at most `share`. */
static inline void unequal_close(double a, double b, double share)
{
    g_assert_cmpfloat(fabs(a - b), <=, share * fmax(fabs(a), fabs(b)));
}

#endif
