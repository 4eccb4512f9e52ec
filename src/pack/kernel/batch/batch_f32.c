/* The laws in single precision, for quasi-static scenes in 3D. */
/* The loops of batch_*.h in single precision: include this first. */

#include "law/real_f32.h"

#include "pack/kernel/batch/batch.h"

#define BATCH         struct gb_batch_f32
#define BELOW_CAP     (1.0F - 0x1p-20F)
#define PLANE(p)      ((real *)c->plane[p] + slot)
#define MOMENT_FITTED true

#include "pack/kernel/batch/batch_3d.h"
#include "pack/kernel/batch/batch_far.h"
#include "pack/kernel/batch/batch_tally.h"
#include "pack/kernel/simd.h"

/* One variant; the terms that it computes are the arguments behind the attribute. */
#define VARIANT(name, attribute, ...)                                                    \
    attribute static void name##_advance(const struct gb_model *model,                   \
                                         struct gb_batch_f32 *batch,                     \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const struct terms printed = {.printed = true, __VA_ARGS__};                     \
        if (t.bridges && model->bridge.radius_current) {                                 \
            advance_3d(model, printed, batch, contacts, slot);                           \
        } else {                                                                         \
            advance_3d(model, t, batch, contacts, slot);                                 \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_recompute(                                              \
        const struct gb_model *model, struct gb_batch_f32 *batch,                        \
        const struct gb_contacts *contacts, int64_t slot)                                \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const struct terms printed = {.printed = true, __VA_ARGS__};                     \
        if (t.bridges && model->bridge.radius_current) {                                 \
            recompute_3d(model, printed, batch, contacts, slot);                         \
        } else {                                                                         \
            recompute_3d(model, t, batch, contacts, slot);                               \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch_f32 *batch,                       \
                                       const struct gb_contacts *contacts, int64_t slot, \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        const float *deepest = (const float *)contacts->plane[contacts->deepest];        \
        tally_batch(t, batch, deepest + slot, tally);                                    \
    }                                                                                    \
    attribute static void name##_attract(const struct gb_model *model,                   \
                                         struct gb_batch_f32 *batch)                     \
    {                                                                                    \
        const struct terms t = {__VA_ARGS__};                                            \
        attract(model, t, batch, NULL, NULL);                                            \
    }

/* The combinations of terms that scenes have. */
#define FIVE(X, name, attribute, ...)                                                    \
    X(name##_normal, attribute, __VA_ARGS__)                                             \
    X(name##_friction, attribute, .friction = true, __VA_ARGS__)                         \
    X(name##_bridges, attribute, .friction = true, .bridges = true, __VA_ARGS__)         \
    X(name##_plain, attribute, .plain = true, .unpivoted = true, __VA_ARGS__)            \
    X(name##_plain_friction, attribute, .friction = true, .plain = true,                 \
      .unpivoted = true, __VA_ARGS__)
#define COMBINATIONS(X, width, attribute)                                                \
    FIVE(X, width##_equal, attribute, .sized = false)                                    \
    FIVE(X, width##_sized, attribute, .sized = true)

struct variant {
    struct terms terms;
    struct gb_batch_f32_kernel kernel;
};

#define ROW(name, attribute, ...)                                                        \
    {{__VA_ARGS__}, {name##_advance, name##_tally, name##_attract, name##_recompute}},

GB_SIMD_TABLES

struct gb_batch_f32_kernel gb_batch_f32_pick(const struct gb_model *model, int widest)
{
    const struct variant *table = table_for(widest);
    const bool plain = model->terms.plain, bridges = model->terms.bridges && !plain;
    const struct terms wanted = {.friction = model->terms.friction || bridges,
                                 .bridges = bridges,
                                 .plain = plain,
                                 .unpivoted = plain,
                                 .sized = model->polydisperse};
    int row = 0;
    while (row < VARIANTS - 1 && !same_terms(table[row].terms, wanted)) {
        row++;
    }
    return table[row].kernel;
}
