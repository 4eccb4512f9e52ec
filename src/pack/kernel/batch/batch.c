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

/* {normal only, friction, friction and bridges} with the same other terms. */
#define THREE(name, attribute, ...)                                                      \
    VARIANT(name##_normal, attribute, __VA_ARGS__)                                       \
    VARIANT(name##_friction, attribute, .friction = true, __VA_ARGS__)                   \
    VARIANT(name##_bridges, attribute, .friction = true, .bridges = true, __VA_ARGS__)

/* {normal only, friction} of the cohesionless laws. */
#define TWO(name, attribute, ...)                                                        \
    VARIANT(name##_plain, attribute, .plain = true, __VA_ARGS__)                         \
    VARIANT(name##_plain_friction, attribute, .plain = true, .friction = true,           \
            __VA_ARGS__)

#define VARIANTS(width, attribute)                                                       \
    THREE(width##_3d, attribute, .planar = false)                                        \
    THREE(width##_3d_viscous, attribute, .planar = false, .viscous = true)               \
    THREE(width##_2d, attribute, .planar = true)                                         \
    THREE(width##_2d_viscous, attribute, .planar = true, .viscous = true)                \
    TWO(width##_3d, attribute, .planar = false)                                          \
    TWO(width##_2d, attribute, .planar = true)                                           \
    THREE(width##_sized, attribute, .planar = false, .sized = true)                      \
    THREE(width##_sized_viscous, attribute, .planar = false, .sized = true,              \
          .viscous = true)                                                               \
    TWO(width##_sized, attribute, .planar = false, .sized = true)

#define ROW(name)                                                                        \
    {                                                                                    \
        name##_advance, name##_tally, name##_attract                                     \
    }
#define ROWS(name)       ROW(name##_normal), ROW(name##_friction), ROW(name##_bridges)
#define PLAIN_ROWS(name) ROW(name##_plain), ROW(name##_plain_friction)
#define TABLE(width)                                                                     \
    {                                                                                    \
        ROWS(width##_3d), ROWS(width##_3d_viscous), ROWS(width##_2d),                    \
            ROWS(width##_2d_viscous), PLAIN_ROWS(width##_3d), PLAIN_ROWS(width##_2d),    \
            ROWS(width##_sized), ROWS(width##_sized_viscous), PLAIN_ROWS(width##_sized)  \
    }

VARIANTS(w128, )
static const struct gb_batch_kernel table128[] = TABLE(w128);
#if GB_SIMD_LEVELS
VARIANTS(w256, GB_TARGET_256)
VARIANTS(w512, GB_TARGET_512)
static const struct gb_batch_kernel table256[] = TABLE(w256);
static const struct gb_batch_kernel table512[] = TABLE(w512);
#endif

static const struct gb_batch_kernel *table_for(int widest)
{
#if GB_SIMD_LEVELS
    const int width = gb_simd_width(widest);
    return width == 512 ? table512 : width == 256 ? table256 : table128;
#else
    (void)widest;
    return table128;
#endif
}

struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest)
{
    const int terms = model->terms.bridges ? 2 : model->terms.friction ? 1 : 0;
    const int viscous = gb_loading_kind_at(model->kind)->viscous_contacts;
    const int planar = model->dimension == 2;
    if (model->polydisperse) { /* behind all of one size; discs by the rows of 3D */
        const int row =
            model->terms.plain ? 6 + model->terms.friction : 3 * viscous + terms;
        return table_for(widest)[16 + row];
    }
    if (model->terms.plain) { /* behind the four times three rows */
        return table_for(widest)[12 + 2 * planar + model->terms.friction];
    }
    return table_for(widest)[6 * planar + 3 * viscous + terms];
}
