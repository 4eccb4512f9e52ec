/* Loose powder in the funnel above a die: the bed that filling begins with.
 *
 * Spheres are inserted at random positions of the cone without overlap, the large ones first,
 * until all have a place.  Boxes at least as wide as the largest sphere find the neighbours.
 * Source: P3, section 5. */

#include "pack/die/filling.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdbool.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "pack/die/bed.h"
#include "pack/structure/assign_sizes.h"
#include "pack/structure/random.h"
#include "scene/derived.h"
#include "scene/thread_count.h"

/* ---- Insertion ---- */

/* Random positions tried for one sphere before the funnel counts as full. */
enum { TRIES_MOST = 20000 };

/* The box around the powder in cubes at least as wide as the largest sphere, so that
 * neighbours lie in the 27 around; lists by index + 1. */
struct boxes {
    double low[3], size;
    int cells[3];
    int32_t *first, *next;
};

struct pour {
    struct gb_bed *bed;
    gsl_rng rng;
    struct boxes boxes;
    double top; /* of the powder */
    size_t *order;
};

/* Height at which the cone from the outlet up holds the volume: V = pi (r^3 - r0^3)/(3
 * tan). */
static double cone_top(const struct gb_die *die, double volume)
{
    const double slope = die->sine / die->cosine, r0 = die->outlet;
    const double r = gb_portable_cbrt(r0 * r0 * r0 + 3.0 * slope * volume / M_PI);
    return die->height + (r - r0) / slope;
}

static bool boxes_open(struct boxes *boxes, const struct gb_die *die, double top,
                       double largest, int64_t count, struct gb_error *err)
{
    const double room = gb_die_radius_at(die, top);
    const double span[3] = {2.0 * room, 2.0 * room, top - die->height};
    boxes->size = 2.0 * largest;
    int64_t cells = 1;
    for (int k = 0; k < 3; k++) {
        boxes->low[k] = k < 2 ? -room : die->height;
        boxes->cells[k] = (int)fmin(span[k] / boxes->size, 200.0) + 1;
        boxes->size = fmax(boxes->size, span[k] / boxes->cells[k]);
        cells *= boxes->cells[k];
    }
    boxes->first = gb_alloc_array((size_t)cells, sizeof *boxes->first, err);
    boxes->next = gb_alloc_array((size_t)count, sizeof *boxes->next, err);
    return boxes->first && boxes->next;
}

static void cell_of(const struct boxes *boxes, const double x[3], int cell[3])
{
    for (int k = 0; k < 3; k++) {
        const int at = (int)((x[k] - boxes->low[k]) / boxes->size);
        cell[k] = at < 0 ? 0 : at < boxes->cells[k] ? at : boxes->cells[k] - 1;
    }
}

static int32_t *box_at(const struct boxes *boxes, int x, int y, int z)
{
    const int64_t row = (int64_t)z * boxes->cells[1] + y;
    return &boxes->first[row * boxes->cells[0] + x];
}

static bool meets(const struct gb_bed *bed, int32_t item, const struct boxes *boxes,
                  const double x[3], double radius)
{
    for (; item > 0; item = boxes->next[item - 1]) {
        const double *other = bed->position[item - 1];
        const double dx = x[0] - other[0], dy = x[1] - other[1], dz = x[2] - other[2];
        const double reach = radius + other[3];
        if (dx * dx + dy * dy + dz * dz < reach * reach) {
            return true;
        }
    }
    return false;
}

static bool is_free(const struct pour *pour, const double x[3], double radius)
{
    const struct boxes *boxes = &pour->boxes;
    int at[3];
    cell_of(boxes, x, at);
    for (int c = 0; c < 27; c++) {
        const int i = at[0] + c % 3 - 1, j = at[1] + c / 3 % 3 - 1, k = at[2] + c / 9 - 1;
        if (i >= 0 && j >= 0 && k >= 0 && i < boxes->cells[0] && j < boxes->cells[1] &&
            k < boxes->cells[2] &&
            meets(pour->bed, *box_at(boxes, i, j, k), boxes, x, radius)) {
            return false;
        }
    }
    return true;
}

/* A random centre in the cone, as far from its wall as the radius; false when this draw
 * is outside. */
static bool draw(struct pour *pour, double radius, double x[3])
{
    const struct gb_die *die = &pour->bed->die;
    const double room = gb_die_radius_at(die, pour->top);
    x[0] = room * (2.0 * gsl_rng_uniform(&pour->rng) - 1.0);
    x[1] = room * (2.0 * gsl_rng_uniform(&pour->rng) - 1.0);
    x[2] = die->height + (pour->top - die->height) * gsl_rng_uniform(&pour->rng);
    double unit[3];
    return gb_die_contains(die, x) &&
           gb_die_overlap(die, GB_DIE_FUNNEL, x, radius, unit) < 0.0;
}

static bool insert_one(struct pour *pour, int64_t i, struct gb_error *err)
{
    struct gb_bed *bed = pour->bed;
    double x[3];
    for (int tried = 0; tried < TRIES_MOST; tried++) {
        if (draw(pour, bed->position[i][3], x) && is_free(pour, x, bed->position[i][3])) {
            int at[3];
            cell_of(&pour->boxes, x, at);
            int32_t *first = box_at(&pour->boxes, at[0], at[1], at[2]);
            for (int k = 0; k < 3; k++) {
                bed->position[i][k] = x[k];
            }
            pour->boxes.next[i] = *first;
            *first = (int32_t)(i + 1);
            return true;
        }
    }
    return gb_error_set(
        err, GB_ERR_INPUT,
        "die.outlet, particles.diameter: no room in the funnel for a "
        "particle of diameter %.3g d; widen the die or reduce the particles",
        2.0 * bed->position[i][3]);
}

static bool insert_all(struct pour *pour, bool (*cancelled)(void *data), void *data,
                       struct gb_error *err)
{
    for (int64_t k = pour->bed->count - 1; k >= 0; k--) { /* the largest first */
        if (!insert_one(pour, (int64_t)pour->order[k], err)) {
            return false;
        }
        if (k % 256 == 0 && cancelled && cancelled(data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
    }
    return true;
}

bool gb_filling_fill(struct gb_bed *bed, uint64_t seed, double density,
                     bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct pour pour = {.bed = bed};
    const size_t count = (size_t)bed->count;
    pour.top = cone_top(&bed->die, gb_bed_solid_volume(bed) / density);
    pour.order = gb_alloc_array(count, sizeof *pour.order, err);
    bool done = pour.order && gb_random_open(&pour.rng, seed, GB_RANDOM_POSITIONS, err);
    if (done) {
        gsl_sort_index(pour.order, bed->mass, 1, count);
        const double largest = bed->position[pour.order[count - 1]][3];
        done = boxes_open(&pour.boxes, &bed->die, pour.top, largest, bed->count, err) &&
               insert_all(&pour, cancelled, data, err);
    }
    gb_bed_invalidate_lists(bed);
    gb_alloc_free(pour.order);
    gb_random_close(&pour.rng);
    gb_alloc_free(pour.boxes.first);
    gb_alloc_free(pour.boxes.next);
    return done;
}

/* ---- The bed of a scene ---- */

/* Density of the loosest filling for which an automatic height leaves room, with its
 * heap, and the densest one that a given height may ask for. */
static const double loosest = 0.5, densest = 0.64;

static struct gb_bed_law filling_law(const struct gb_params *params)
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
    struct gb_bed_law law = filling_law(params);
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
    struct gb_sizes sizes;
    if (!gb_sizes_init(&sizes, params, err) ||
        !gb_assign_sizes(&sizes, params->count, params->seed, radius, err)) {
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
    const struct gb_bed_law law = filling_law(params);
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
    if (!gb_filling_fill(bed, params->seed, model->die.loose_density, cancelled, data,
                         err)) {
        gb_bed_destroy(bed);
        return false;
    }
    *out = bed;
    return true;
}
