#include "pack/kernel/batch_f64.h"

#include "pack/kernel/batch_2d.h"
#include "pack/kernel/batch_3d.h"
#include "pack/kernel/batch_far.h"
#include "pack/kernel/batch_tally.h"
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

/* Variants: planar or not, {normal only, friction, friction and bridges}, viscous or not.
 */
#define VARIANT(name, attribute, planar_, friction_, bridges_, viscous_)                 \
    attribute static void name##_advance(const struct gb_model *model,                   \
                                         struct gb_batch *batch,                         \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false, false};   \
        const struct terms printed = {planar_,  friction_, bridges_,                     \
                                      viscous_, true,      false};                       \
        if (bridges_ && model->bridge.radius_current) {                                  \
            advance(model, printed, batch, contacts, slot);                              \
        } else {                                                                         \
            advance(model, t, batch, contacts, slot);                                    \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch *batch,                           \
                                       const struct gb_contacts *contacts, int64_t slot, \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false, false};   \
        const double *deepest = (const double *)contacts->plane[contacts->deepest];      \
        tally_batch(t, batch, deepest + slot, tally);                                    \
    }                                                                                    \
    attribute static void name##_attract(const struct gb_model *model,                   \
                                         struct gb_batch *batch, double *last_distance,  \
                                         double *last_pull, struct gb_tally *tally)      \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false, false};   \
        attract(model, t, batch, last_distance, last_pull);                              \
        if (viscous_) {                                                                  \
            tally_work(t, batch, tally);                                                 \
        }                                                                                \
    }

#define VARIANTS(width, attribute)                                                       \
    VARIANT(width##_3d_normal, attribute, false, false, false, false)                    \
    VARIANT(width##_3d_friction, attribute, false, true, false, false)                   \
    VARIANT(width##_3d_bridges, attribute, false, true, true, false)                     \
    VARIANT(width##_3d_normal_viscous, attribute, false, false, false, true)             \
    VARIANT(width##_3d_friction_viscous, attribute, false, true, false, true)            \
    VARIANT(width##_3d_bridges_viscous, attribute, false, true, true, true)              \
    VARIANT(width##_2d_normal, attribute, true, false, false, false)                     \
    VARIANT(width##_2d_friction, attribute, true, true, false, false)                    \
    VARIANT(width##_2d_bridges, attribute, true, true, true, false)                      \
    VARIANT(width##_2d_normal_viscous, attribute, true, false, false, true)              \
    VARIANT(width##_2d_friction_viscous, attribute, true, true, false, true)             \
    VARIANT(width##_2d_bridges_viscous, attribute, true, true, true, true)

#define ROW(name)                                                                        \
    {                                                                                    \
        name##_advance, name##_tally, name##_attract                                     \
    }
#define TABLE(width)                                                                     \
    {                                                                                    \
        ROW(width##_3d_normal), ROW(width##_3d_friction), ROW(width##_3d_bridges),       \
            ROW(width##_3d_normal_viscous), ROW(width##_3d_friction_viscous),            \
            ROW(width##_3d_bridges_viscous), ROW(width##_2d_normal),                     \
            ROW(width##_2d_friction), ROW(width##_2d_bridges),                           \
            ROW(width##_2d_normal_viscous), ROW(width##_2d_friction_viscous),            \
            ROW(width##_2d_bridges_viscous)                                              \
    }

VARIANTS(w128, )
static const struct gb_batch_kernel table128[] = TABLE(w128);
#if defined(__x86_64__)
VARIANTS(w256, GB_TARGET_256)
VARIANTS(w512, GB_TARGET_512)
static const struct gb_batch_kernel table256[] = TABLE(w256);
static const struct gb_batch_kernel table512[] = TABLE(w512);
#endif

static const struct gb_batch_kernel *table_for(int widest)
{
#if defined(__x86_64__)
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
    return table_for(widest)[6 * planar + 3 * viscous + terms];
}
