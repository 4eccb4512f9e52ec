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

#define VARIANTS(width, attribute)                                                       \
    VARIANT(width##_normal, attribute, .friction = false)                                \
    VARIANT(width##_friction, attribute, .friction = true)                               \
    VARIANT(width##_bridges, attribute, .friction = true, .bridges = true)               \
    VARIANT(width##_plain, attribute, .plain = true, .unpivoted = true)                  \
    VARIANT(width##_plain_friction, attribute, .friction = true, .plain = true,          \
            .unpivoted = true)

#define ROW(name)                                                                        \
    {                                                                                    \
        name##_advance, name##_tally, name##_attract, name##_recompute                   \
    }
#define TABLE(width)                                                                     \
    {                                                                                    \
        ROW(width##_normal), ROW(width##_friction), ROW(width##_bridges),                \
            ROW(width##_plain), ROW(width##_plain_friction)                              \
    }

VARIANTS(w128, )
static const struct gb_batch_f32_kernel table128[] = TABLE(w128);
#if defined(__x86_64__)
VARIANTS(w256, GB_TARGET_256)
VARIANTS(w512, GB_TARGET_512)
static const struct gb_batch_f32_kernel table256[] = TABLE(w256);
static const struct gb_batch_f32_kernel table512[] = TABLE(w512);
#endif

struct gb_batch_f32_kernel gb_batch_f32_pick(const struct gb_model *model, int widest)
{
    const int terms = model->terms.plain      ? 3 + model->terms.friction
                      : model->terms.bridges  ? 2
                      : model->terms.friction ? 1
                                              : 0;
#if defined(__x86_64__)
    const int width = gb_simd_width(widest);
    return (width == 512 ? table512 : width == 256 ? table256 : table128)[terms];
#else
    (void)widest;
    return table128[terms];
#endif
}
