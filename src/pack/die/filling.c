#include "pack/die/filling.h"

#include <math.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "pack/die/random_insertion.h"
#include "pack/structure/assign_sizes.h"
#include "scene/derived.h"
#include "scene/thread_count.h"

/* Density of the loosest filling for which an automatic height leaves room, with its
 * heap, and the densest one that a given height may ask for. */
static const double loosest = 0.5, densest = 0.64;

struct gb_bed_law gb_filling_law(const struct gb_params *params)
{
    const struct gb_elastic elastic = {1.0, params->poisson};
    struct gb_bed_law law = {.damping = params->damping, .mu_wall = params->mu_wall};
    gb_law_hertz_init(&law.normal.hertz, &elastic, &elastic);
    law.shear = 4.0 * law.normal.hertz.shear / law.normal.hertz.modulus; /* (9), (12) */
    return law;
}

struct gb_bed_law gb_filling_compaction_law(const struct gb_params *params)
{
    const struct gb_elastic elastic = {1.0, params->poisson};
    struct gb_bed_law law = gb_filling_law(params);
    law.mu = params->mu;
    if (params->normal == GB_NORMAL_STORAKERS) {
        const double strength = gb_derived_hollomon_pa(params) / params->young_pa;
        law.storakers = true;
        law.shear = params->shear_ratio; /* (21) */
        gb_law_storakers_init(&law.normal, &elastic, &elastic, strength, strength,
                              params->hardening,
                              params->storakers == GB_STORAKERS_PRINTED);
    }
    return law;
}

/* Radii in reduced units, and their sum of volumes and largest. */
static bool draw_radii(const struct gb_params *params, double *radius, double *volume,
                       double *largest, struct gb_error *err)
{
    const struct gb_seed seed = gb_seed_of(params);
    struct gb_sizes sizes;
    if (!gb_sizes_init(&sizes, params, err) ||
        !gb_assign_sizes(&sizes, params->count, &seed, radius, err)) {
        return false;
    }
    *volume = *largest = 0.0;
    for (int64_t i = 0; i < params->count; i++) {
        const double d = radius[i] / params->diameter_m;
        radius[i] = 0.5 * d;
        *volume += M_PI / 6.0 * d * d * d;
        *largest = fmax(*largest, 0.5 * d);
    }
    return true;
}

static bool size_die(struct gb_die *die, const struct gb_params *params,
                     const struct gb_die_scene *scene, double volume, double largest,
                     struct gb_error *err)
{
    const double area = M_PI * scene->radius * scene->radius;
    *die = (struct gb_die){
        .radius = scene->radius,
        .funnel = true,
        .height = scene->height > 0.0 ? scene->height
                                      : volume / (loosest * area) + 2.0 * largest,
        .outlet = scene->outlet,
        .sine = gb_portable_sin(scene->angle),
        .cosine = gb_portable_cos(scene->angle),
    };
    const double micron = 1e6 * params->diameter_m;
    if (largest >= scene->outlet) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die.outlet = %.4g um: must be above the largest particle "
                            "diameter, %.4g um",
                            2.0 * micron * scene->outlet, 2.0 * micron * largest);
    }
    if (volume > densest * area * die->height) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "particles.count = %lld: more powder than a die of height %.4g "
            "um holds; increase die.height or set it to auto",
            (long long)params->count, micron * die->height);
    }
    return true;
}

bool gb_filling_allocate(struct gb_bed **out, const struct gb_params *params,
                         const struct gb_model *model, struct gb_error *err)
{
    const struct gb_bed_law law = gb_filling_law(params);
    struct gb_die die;
    double volume = 0.0, largest = 0.0;
    double *radius = gb_alloc_array((size_t)params->count, sizeof *radius, err);
    const bool done =
        radius && draw_radii(params, radius, &volume, &largest, err) &&
        size_die(&die, params, &model->die, volume, largest, err) &&
        gb_bed_create(out, params->count, radius, &die, &law, params->inertia_scale, err);
    gb_alloc_free(radius);
    if (done && !gb_bed_use_threads(*out, gb_thread_count(model), err)) {
        gb_bed_destroy(*out);
        return false;
    }
    return done;
}

bool gb_filling_create(struct gb_bed **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err)
{
    struct gb_bed *bed = NULL;
    if (!gb_filling_allocate(&bed, params, model, err)) {
        return false;
    }
    const struct gb_seed seed = gb_seed_of(params);
    if (!gb_random_insertion_fill(bed, &seed, model->die.loose_density, cancelled, data,
                                  err)) {
        gb_bed_destroy(bed);
        return false;
    }
    *out = bed;
    return true;
}
