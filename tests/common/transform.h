#ifndef GB_TESTS_TRANSFORM_H
#define GB_TESTS_TRANSFORM_H

#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/cases.h"
#include "common/scene.h"
#include "pack/structure/assign_sizes.h"
#include "scene/imported/imported.h"

/* The same packing seen otherwise: axes exchanged, mirrored, particles in another order,
 * the periodic cell repeated. */
struct transform {
    int axis[3];    /* new axis k is the old axis[k] ... */
    double sign[3]; /* ... or its mirror image */
    int repeat[3];  /* cells along each old axis */
    int64_t *order; /* of old particles among those of a cell; NULL: the same */
};

static const struct transform transform_none = {
    .axis = {0, 1, 2}, .sign = {1.0, 1.0, 1.0}, .repeat = {1, 1, 1}};

static inline double transform_parity(const struct transform *t)
{
    const int *a = t->axis;
    const double swapped =
        (a[0] - a[1]) * (a[1] - a[2]) * (a[2] - a[0]) == -2 ? -1.0 : 1.0;
    return swapped * t->sign[0] * t->sign[1] * t->sign[2];
}

/* A vector; `axial`: a rotation or torque, which a mirror reverses. */
static inline void transform_vector(const struct transform *t, bool axial,
                                    const double in[3], double out[3])
{
    const double hand = axial ? transform_parity(t) : 1.0;
    for (int k = 0; k < 3; k++) {
        out[k] = hand * t->sign[k] * in[t->axis[k]];
    }
}

static inline void transform_tensor(const struct transform *t, double in[3][3],
                                    double out[3][3])
{
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            out[a][b] = t->sign[a] * t->sign[b] * in[t->axis[a]][t->axis[b]];
        }
    }
}

static inline int transform_copies(const struct transform *t)
{
    return t->repeat[0] * t->repeat[1] * t->repeat[2];
}

/* Particle of the new packing that is copy c of particle i of `count`. */
static inline int64_t transform_particle(const struct transform *t, int64_t count,
                                         int64_t i, int c)
{
    return c * count + (t->order ? t->order[i] : i);
}

/* A quarter rotation about an axis of the cell; of discs about theirs. */
static inline void transform_rotate(struct transform *t, int dimension, GRand *random)
{
    const int about = dimension == 2 ? 1 : cases_choice(random, 3);
    const int one = (about + 1) % 3, two = (about + 2) % 3;
    t->axis[one] = two;
    t->axis[two] = one;
    t->sign[cases_choice(random, 2) == 0 ? one : two] = -1.0;
}

/* A random order of particles; g_free. */
static inline int64_t *transform_random_order(int64_t count, GRand *random)
{
    int64_t *order = g_new(int64_t, (gsize)count);
    for (int64_t i = 0; i < count; i++) {
        const int64_t j = g_rand_int_range(random, 0, (gint32)(i + 1));
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

/* A packing with its model, which the world needs as long as it lives. */
struct packed {
    struct gb_model model;
    struct gb_imported sizes;
    double *position, *diameter;
    struct gb_world *world;
};

static inline void packed_finish(struct packed *packed)
{
    gb_world_destroy(packed->world);
    g_free(packed->position);
    g_free(packed->diameter);
}

/* World of the arrays, whose diameters are given particle by particle. */
static inline void packed_create(struct packed *packed)
{
    struct gb_error err = {0};
    packed->sizes = (struct gb_imported){.count = packed->model.count,
                                         .position = packed->position,
                                         .diameter = packed->diameter};
    packed->model.packing = &packed->sizes;
    if (!gb_world_create(&packed->world, &packed->model, packed->position, &err)) {
        g_error("%s", err.text);
    }
}

/* The initial structure of a model, pressed together by `squeeze` and shaken by up to
 * `shake` (d) a component. */
static inline void packed_init(struct packed *packed, const struct gb_model *model,
                               double squeeze, double shake, GRand *random)
{
    struct gb_error err = {0};
    const int64_t count = model->count;
    double *position = scene_positions(model);
    packed->model = *model;
    packed->diameter = g_new0(double, (gsize)count);
    g_assert_true(gb_assign_sizes_model(model, packed->diameter, &err));
    packed->position = g_new0(double, (gsize)(3 * count));
    for (int64_t i = 0; i < 3 * count; i++) {
        const bool flat = model->dimension == 2 && i % 3 == 1;
        packed->position[i] =
            flat ? 0.0 : squeeze * position[i] + cases_between(random, -shake, shake);
    }
    for (int k = 0; k < 3; k++) {
        packed->model.edges[k] *= model->dimension == 2 && k == 1 ? 1.0 : squeeze;
    }
    gb_alloc_free(position);
    packed_create(packed);
}

/* The packing seen otherwise; the old one has not moved yet. */
static inline void packed_transform(struct packed *packed, const struct packed *old,
                                    const struct transform *t)
{
    const int64_t count = old->model.count;
    const int copies = transform_copies(t);
    double whole[3];
    packed->model = old->model;
    packed->model.count = count * copies;
    packed->diameter = g_new0(double, (gsize)(count * copies));
    packed->position = g_new0(double, (gsize)(3 * count * copies));
    for (int k = 0; k < 3; k++) {
        whole[k] = old->model.edges[k] * t->repeat[k];
    }
    for (int k = 0; k < 3; k++) {
        packed->model.edges[k] = whole[t->axis[k]];
    }
    for (int c = 0; c < copies; c++) {
        const int at[3] = {c % t->repeat[0], c / t->repeat[0] % t->repeat[1],
                           c / t->repeat[0] / t->repeat[1]};
        for (int64_t i = 0; i < count; i++) {
            const int64_t to = transform_particle(t, count, i, c);
            packed->diameter[to] = old->diameter[i];
            for (int k = 0; k < 3; k++) {
                const int a = t->axis[k];
                const double x = old->position[3 * i + a] + at[a] * old->model.edges[a];
                packed->position[3 * to + k] =
                    t->sign[k] > 0.0 || x == 0.0 ? x : whole[a] - x;
            }
        }
    }
    packed_create(packed);
}

#endif
