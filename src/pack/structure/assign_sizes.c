#include "pack/structure/assign_sizes.h"

#include <string.h>

#include "pack/structure/random.h"
#include "scene/imported/imported.h"

static bool shuffle(int64_t count, uint64_t seed, double *diameter_m,
                    struct gb_error *err)
{
    gsl_rng random;
    if (!gb_random_open(&random, seed, GB_RANDOM_SIZES, err)) {
        return false;
    }
    for (int64_t i = count - 1; i > 0; i--) {
        const int64_t j = (int64_t)gsl_rng_uniform_int(&random, (unsigned long)(i + 1));
        const double kept = diameter_m[i];
        diameter_m[i] = diameter_m[j];
        diameter_m[j] = kept;
    }
    gb_random_close(&random);
    return true;
}

bool gb_assign_sizes(const struct gb_sizes *sizes, int64_t count, uint64_t seed,
                     double *diameter_m, struct gb_error *err)
{
    gb_sizes_fill(sizes, count, diameter_m);
    return sizes->distribution == GB_DISTRIBUTION_MONO ||
           shuffle(count, seed, diameter_m, err);
}

bool gb_assign_sizes_model(const struct gb_model *model, double *diameter,
                           struct gb_error *err)
{
    if (model->packing) {
        memcpy(diameter, model->packing->diameter,
               (size_t)model->count * sizeof *diameter);
        return true;
    }
    if (model->polydisperse &&
        !gb_assign_sizes(&model->sizes, model->count, model->seed, diameter, err)) {
        return false;
    }
    for (int64_t i = 0; i < model->count; i++) {
        diameter[i] = model->polydisperse ? diameter[i] / model->metre_per_length : 1.0;
    }
    return true;
}
