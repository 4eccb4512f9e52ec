#include "pack/kernel/batch/batch_f64.h"

#include "pack/kernel/batch/batch_2d.h"
#include "pack/kernel/batch/batch_3d.h"
#include "pack/kernel/batch/batch_far.h"
#include "pack/kernel/batch/batch_tally.h"
#include "pack/kernel/simd.h"
#include "scene/loading_kind.h"

INLINE void advance(const struct gb_model *model, struct terms t, struct gb_batch *batch,
                    struct gb_contacts *contacts, int64_t slot)
{
    if (t.planar) {
        advance_2d(model, t, batch, contacts, slot);
    } else {
        advance_3d(model, t, batch, contacts, slot);
    }
}

/* One variant; the terms that it computes are the arguments behind the attribute. */
#define VARIANT(name, attribute, ...)                                                    \
    attribute static void name##_advance(const struct gb_model *model,                   \
                                         struct gb_batch *batch,                         \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const struct terms printed = {.printed = true, __VA_ARGS__};                     \
        if (t.bridges && model->bridge.radius_current) {                                 \
            advance(model, printed, batch, contacts, slot);                              \
        } else {                                                                         \
            advance(model, t, batch, contacts, slot);                                    \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch *batch,                           \
                                       const struct gb_contacts *contacts, int64_t slot, \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const double *deepest = (const double *)contacts->plane[contacts->deepest];      \
        tally_batch(t, batch, deepest + slot, tally);                                    \
    }                                                                                    \
    attribute static void name##_attract(const struct gb_model *model,                   \
                                         struct gb_batch *batch, double *last_distance,  \
                                         double *last_pull, struct gb_tally *tally)      \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        attract(model, t, batch, last_distance, last_pull);                              \
        if (t.viscous) {                                                                 \
            tally_work(t, batch, tally);                                                 \
        }                                                                                \
    }

/* The combinations of terms that scenes have. */
#define THREE(X, name, attribute, ...)                                                   \
    X(name##_normal, attribute, __VA_ARGS__)                                             \
    X(name##_friction, attribute, .friction = true, __VA_ARGS__)                         \
    X(name##_bridges, attribute, .friction = true, .bridges = true, __VA_ARGS__)
#define TWO(X, name, attribute, ...)                                                     \
    X(name##_plain, attribute, .plain = true, __VA_ARGS__)                               \
    X(name##_plain_friction, attribute, .plain = true, .friction = true, __VA_ARGS__)
#define COMBINATIONS(X, width, attribute)                                                \
    THREE(X, width##_3d, attribute, .planar = false)                                     \
    THREE(X, width##_3d_viscous, attribute, .viscous = true)                             \
    TWO(X, width##_3d, attribute, .planar = false)                                       \
    THREE(X, width##_2d, attribute, .planar = true)                                      \
    THREE(X, width##_2d_viscous, attribute, .planar = true, .viscous = true)             \
    TWO(X, width##_2d, attribute, .planar = true)                                        \
    THREE(X, width##_sized, attribute, .sized = true)                                    \
    THREE(X, width##_sized_viscous, attribute, .sized = true, .viscous = true)           \
    TWO(X, width##_sized, attribute, .sized = true)

struct variant {
    struct terms terms;
    struct gb_batch_kernel kernel;
};

#define ROW(name, attribute, ...)                                                        \
    {{__VA_ARGS__}, {name##_advance, name##_tally, name##_attract}},

GB_SIMD_TABLES

/* Discs of several sizes pass through the laws of spheres; cohesionless laws have no viscous
 * partner. */
static struct terms terms_of(const struct gb_model *model)
{
    const bool plain = model->terms.plain;
    return (struct terms){
        .planar = model->dimension == 2 && !model->polydisperse,
        .friction = model->terms.friction || (model->terms.bridges && !plain),
        .bridges = model->terms.bridges && !plain,
        .viscous = gb_loading_kind_at(model->kind)->viscous_contacts && !plain,
        .plain = plain,
        .sized = model->polydisperse,
    };
}

struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest)
{
    const struct variant *table = table_for(widest);
    const struct terms wanted = terms_of(model);
    int row = 0;
    while (row < VARIANTS - 1 && !same_terms(table[row].terms, wanted)) {
        row++;
    }
    return table[row].kernel;
}
