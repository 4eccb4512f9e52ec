#include "pack/batch.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "pack/batch_2d.h"
#include "pack/batch_3d.h"
#include "pack/batch_far.h"
#include "pack/simd.h"

enum { PLANES_3D = 11, PLANES_2D = 5 };

static void name_planes(struct gb_contacts *contacts, int vector, int spring,
                        bool viscous)
{
    double **plane = contacts->plane;
    contacts->deepest = *plane++;
    for (int k = 0; k < spring; k++) {
        contacts->shear[k] = *plane++;
        contacts->roll[k] = *plane++;
    }
    contacts->pivot = vector == 3 ? *plane++ : NULL;
    for (int k = 0; k < vector; k++) {
        contacts->arm[k] = *plane++;
    }
    if (viscous) {
        contacts->last_normal = *plane++;
        contacts->last_shear = *plane++;
        contacts->last_roll = *plane++;
        contacts->last_pivot = vector == 3 ? *plane++ : NULL;
    }
}

bool gb_contacts_init(struct gb_contacts *contacts, int dimension, bool viscous,
                      int64_t room, struct gb_error *err)
{
    const bool solid = dimension == 3;
    const int kept = solid ? PLANES_3D : PLANES_2D, last = viscous ? (solid ? 4 : 3) : 0;
    const int64_t stride = (room + 7) / 8 * 8;
    /* what is kept of a viscous scene is all: its copies go back into the middle of a
     * motion */
    *contacts =
        (struct gb_contacts){.room = room,
                             .planes = kept + last,
                             .kept = viscous ? kept + last : kept - (solid ? 3 : 2)};
    double *slab =
        gb_alloc_array((size_t)contacts->planes * (size_t)stride, sizeof *slab, err);
    if (!slab) {
        *contacts = (struct gb_contacts){0};
        return false;
    }
    for (int p = 0; p < contacts->planes; p++) {
        contacts->plane[p] = slab + p * stride;
    }
    name_planes(contacts, solid ? 3 : 2, solid ? 3 : 1, viscous);
    return true;
}

void gb_contacts_finish(struct gb_contacts *contacts)
{
    gb_alloc_free(contacts->plane[0]);
    *contacts = (struct gb_contacts){0};
}

void gb_contacts_clear(struct gb_contacts *contacts, int64_t slot)
{
    for (int p = 0; p < contacts->planes; p++) {
        contacts->plane[p][slot] = 0.0;
    }
    contacts->deepest[slot] = -1.0;
}

INLINE double lane_sum(const double *lane)
{
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
           ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/* Lanes that a batch is filled up to: two groups, so that no sum waits for the last one.
 */
INLINE int whole_lanes(int n)
{
    return (n + 2 * GB_LANES - 1) / (2 * GB_LANES) * (2 * GB_LANES);
}

/* Adds the products of two arrays (times 1 where b is NULL) over whole lanes. */
INLINE double lane_total(const double *a, const double *b, int n)
{
    double even[GB_LANES] = {0}, odd[GB_LANES] = {0};
    for (int k = 0; k < n; k += 2 * GB_LANES) {
        for (int l = 0; l < GB_LANES; l++) {
            even[l] += b ? a[k + l] * b[k + l] : a[k + l];
        }
        for (int l = 0; l < GB_LANES; l++) {
            const int m = k + GB_LANES + l;
            odd[l] += b ? a[m] * b[m] : a[m];
        }
    }
    return lane_sum(even) + lane_sum(odd);
}

/* Lanes behind the last pair count nothing; returns the number with them. */
INLINE int pad_work(struct terms t, struct gb_batch *b)
{
    const int whole = whole_lanes(b->n);
    for (int k = b->n; k < whole; k++) {
        b->absorbed[k] = 0.0;
        for (int c = 0; c < (t.planar ? 2 : 3); c++) {
            b->force[c][k] = b->r[c][k] = 0.0;
        }
    }
    return whole;
}

/* Work taken up and virial of a batch; viscous scenes. */
INLINE void tally_work(struct terms t, struct gb_batch *b, struct gb_tally *tally)
{
    const int whole = pad_work(t, b);
    tally->absorbed += lane_total(b->absorbed, NULL, whole);
    for (int c = 0; c < (t.planar ? 2 : 3); c++) {
        tally->virial[t.planar ? 2 * c : c] += lane_total(b->force[c], b->r[c], whole);
    }
}

INLINE void tally_batch(struct terms t, struct gb_batch *b, const double *deepest,
                        struct gb_tally *tally)
{
    const int whole = whole_lanes(b->n);
    for (int k = b->n; k < whole; k++) {
        b->normal[k] = b->sliding[k] = 0.0;
    }
    double contacts = 0.0, most = tally->deepest;
#pragma omp simd reduction(+ : contacts) reduction(max : most)
    for (int k = 0; k < b->n; k++) {
        contacts += mask(deepest[k] >= 0.0); /* whole numbers: the same in any order */
        most = larger(b->overlap[k], most);
    }
    tally->contacts += (int64_t)contacts;
    tally->deepest = most;
    tally->normal_sum += lane_total(b->normal, NULL, whole);
    if (t.friction) {
        tally->sliding += (int64_t)lane_total(b->sliding, NULL, whole);
    }
    if (t.viscous) {
        tally_work(t, b, tally);
    }
}

INLINE void stretch(const struct gb_model *model, struct terms t, struct gb_batch *batch,
                    struct gb_contacts *contacts, int64_t slot)
{
    if (t.planar) {
        advance_2d(model, t, batch, contacts, slot);
    } else {
        stretch_3d(model, t, batch, contacts, slot);
    }
}

INLINE void load(const struct gb_model *model, struct terms t, struct gb_batch *batch,
                 struct gb_contacts *contacts, int64_t slot)
{
    if (!t.planar) {
        load_3d(model, t, batch, contacts, slot);
    }
}

/* Variants: planar or not, {normal only, friction, friction and bridges}, viscous or not.
 */
#define VARIANT(name, attribute, planar_, friction_, bridges_, viscous_)                 \
    attribute static void name##_stretch(const struct gb_model *model,                   \
                                         struct gb_batch *batch,                         \
                                         struct gb_contacts *contacts, int64_t slot)     \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false};          \
        const struct terms printed = {planar_, friction_, bridges_, viscous_, true};     \
        if (bridges_ && model->bridge.radius_current) {                                  \
            stretch(model, printed, batch, contacts, slot);                              \
        } else {                                                                         \
            stretch(model, t, batch, contacts, slot);                                    \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_load(const struct gb_model *model,                      \
                                      struct gb_batch *batch,                            \
                                      struct gb_contacts *contacts, int64_t slot)        \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false};          \
        const struct terms printed = {planar_, friction_, bridges_, viscous_, true};     \
        if (bridges_ && model->bridge.radius_current) {                                  \
            load(model, printed, batch, contacts, slot);                                 \
        } else {                                                                         \
            load(model, t, batch, contacts, slot);                                       \
        }                                                                                \
    }                                                                                    \
    attribute static void name##_tally(struct gb_batch *batch, const double *deepest,    \
                                       struct gb_tally *tally)                           \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false};          \
        tally_batch(t, batch, deepest, tally);                                           \
    }                                                                                    \
    attribute static void name##_attract(const struct gb_model *model,                   \
                                         struct gb_batch *batch, double *last_distance,  \
                                         double *last_pull, struct gb_tally *tally)      \
    {                                                                                    \
        const struct terms t = {planar_, friction_, bridges_, viscous_, false};          \
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
        name##_stretch, name##_load, name##_tally, name##_attract                        \
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
    const int viscous = model->kind == GB_KIND_DYNAMIC;
    const int planar = model->dimension == 2;
    return table_for(widest)[6 * planar + 3 * viscous + terms];
}

/* First moment of the contact pressure, M(a) of (9), for the pivoting cap of contacts
 * without a bridge.  Few contacts need it in scenes with bridges. */
static void fill_moments(const struct gb_model *model, struct gb_batch *batch,
                         const double *deepest)
{
    for (int k = 0; k < batch->n; k++) {
        if (deepest[k] == 0.0) {
            batch->moment[k] = gb_law_rod_moment(&model->rod, batch->overlap[k]);
        }
    }
}

/* A bridge whose shear or pivoting cap is reached shrinks to the present overlap, or is
 * gone; P1 below (5) and (11). */
static void fail_bridges(const struct gb_model *model, struct gb_batch *batch,
                         double *deepest)
{
    for (int k = 0; k < batch->n; k++) {
        if (batch->fails[k] != 0.0) {
            const bool stays = batch->overlap[k] > model->bridge.length;
            deepest[k] = stays ? batch->overlap[k] : 0.0;
            batch->loose += !stays;
        }
    }
}

void gb_batch_advance(const struct gb_batch_kernel *kernel, const struct gb_model *model,
                      struct gb_batch *batch, struct gb_contacts *contacts, int64_t slot)
{
    kernel->stretch(model, batch, contacts, slot);
    if (model->dimension == 2) {
        return; /* all in one pass */
    }
    if (batch->failed > 0.0) {
        fail_bridges(model, batch, contacts->deepest + slot);
    }
    if (batch->loose > 0.0 && model->slip.mu_pivot > 0.0) {
        fill_moments(model, batch, contacts->deepest + slot);
    }
    kernel->load(model, batch, contacts, slot);
}
