/* The laws in single precision, for quasi-static scenes in 3D. */
#include "pack/kernel/batch/batch_f32.h"

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

/* All variants of equal or of unequal sizes. */
#define FIVE(name, attribute, ...)                                                       \
    VARIANT(name##_normal, attribute, __VA_ARGS__)                                       \
    VARIANT(name##_friction, attribute, .friction = true, __VA_ARGS__)                   \
    VARIANT(name##_bridges, attribute, .friction = true, .bridges = true, __VA_ARGS__)   \
    VARIANT(name##_plain, attribute, .plain = true, .unpivoted = true, __VA_ARGS__)      \
    VARIANT(name##_plain_friction, attribute, .friction = true, .plain = true,           \
            .unpivoted = true, __VA_ARGS__)

#define VARIANTS(width, attribute)                                                       \
    FIVE(width##_equal, attribute, .sized = false)                                       \
    FIVE(width##_sized, attribute, .sized = true)

#define ROW(name)                                                                        \
    {                                                                                    \
        name##_advance, name##_tally, name##_attract, name##_recompute                   \
    }
#define ROWS(name)                                                                       \
    ROW(name##_normal), ROW(name##_friction), ROW(name##_bridges), ROW(name##_plain),    \
        ROW(name##_plain_friction)
#define TABLE(width)                                                                     \
    {                                                                                    \
        ROWS(width##_equal), ROWS(width##_sized)                                         \
    }

VARIANTS(w128, )
static const struct gb_batch_f32_kernel table128[] = TABLE(w128);
#if GB_SIMD_LEVELS
VARIANTS(w256, GB_TARGET_256)
VARIANTS(w512, GB_TARGET_512)
static const struct gb_batch_f32_kernel table256[] = TABLE(w256);
static const struct gb_batch_f32_kernel table512[] = TABLE(w512);
#endif

struct gb_batch_f32_kernel gb_batch_f32_pick(const struct gb_model *model, int widest)
{
    const int law = model->terms.plain      ? 3 + model->terms.friction
                    : model->terms.bridges  ? 2
                    : model->terms.friction ? 1
                                            : 0;
    const int terms = law + (model->polydisperse ? 5 : 0);
#if GB_SIMD_LEVELS
    const int width = gb_simd_width(widest);
    return (width == 512 ? table512 : width == 256 ? table256 : table128)[terms];
#else
    (void)widest;
    return table128[terms];
#endif
}
