#include "pack/kernel/cap_rounding.h"

#include <math.h>
#include <string.h>

#include "pack/cell/world_private.h"
#include "pack/kernel/sweep_f64.h"
#include "scene/tolerances.h"

enum { SPRINGS = 3 };

/* Planes of a spring: three numbers, or one. */
struct spring {
    int plane[3], count;
};

static void springs_of(const struct gb_contacts *contacts, struct spring spring[SPRINGS])
{
    spring[0].count = spring[1].count = 3;
    memcpy(spring[0].plane, contacts->shear, sizeof contacts->shear);
    memcpy(spring[1].plane, contacts->roll, sizeof contacts->roll);
    spring[2] = (struct spring){{contacts->pivot}, 1};
}

static double *number_at(const struct gb_contacts *contacts, int plane, int64_t slot)
{
    return (double *)contacts->plane[plane] + slot;
}

static double length_of(const struct gb_contacts *contacts, const struct spring *spring,
                        int64_t slot)
{
    double sum = 0.0;
    for (int c = 0; c < spring->count; c++) {
        const double x = *number_at(contacts, spring->plane[c], slot);
        sum += x * x;
    }
    return sqrt(sum);
}

/* Relative rounding of a cap at overlap h (d): of the cut, and of the overlap. */
static double rounding_at(double h)
{
    return fmin(GB_F32_CAP_SHARE + GB_F32_CAP_POWER * GB_F32_LENGTH / h,
                GB_F32_CAP_SHARE_MAX);
}

/* A bridge within rounding of its deepest overlap, or of peeling, is there. */
static double settle_deepest(double deepest, double h, double length)
{
    if (fabs(deepest - h) <= GB_F32_LENGTH) {
        return h;
    }
    return fabs(deepest - h - length) <= GB_F32_LENGTH ? h + length : deepest;
}

/* Pairs [slot, slot + n) of the near list, their bridges settled and their springs
 * lengthened by more than the rounding, into scratch and batch. */
static void lengthen(struct gb_engine *engine, int64_t slot, struct gb_contacts *scratch,
                     struct gb_batch *batch, double share[GB_BATCH], double *most)
{
    const struct gb_contacts *contacts = &engine->contacts;
    struct spring spring[SPRINGS];
    springs_of(contacts, spring);
    gb_sweep_f64_gather_diameters(engine, &engine->list.near, batch, slot);
    for (int k = 0; k < batch->n; k++) {
        double r[3];
        const int32_t i = engine->list.near.first[slot + k];
        const double mean = engine->particles.diameter
                                ? 0.5 * (batch->diameter[0][k] + batch->diameter[1][k])
                                : 1.0;
        const double h = mean - sqrt(gb_engine_branch_vector(engine, &engine->list.near,
                                                             i, slot + k, r));
        double *deepest = number_at(contacts, contacts->deepest, slot + k);
        if (*deepest > 0.0) {
            const double before = *deepest;
            *deepest = settle_deepest(before, h, engine->model->bridge.length * mean);
            *most = fmax(*most, fabs(*deepest - before));
        }
        for (int c = 0; c < 3; c++) {
            batch->r[c][k] = r[c];
        }
        for (int p = 0; p < contacts->planes; p++) {
            *number_at(scratch, p, k) = *number_at(contacts, p, slot + k);
        }
        for (int c = 0; c < 3; c++) {
            *number_at(scratch, contacts->branch[c], k) = r[c]; /* no motion */
        }
        share[k] = rounding_at(h);
        for (int s = 0; s < SPRINGS; s++) {
            for (int c = 0; c < spring[s].count; c++) {
                *number_at(scratch, spring[s].plane[c], k) *= 1.0 + 2.0 * share[k];
            }
        }
    }
}

/* Takes the springs that the laws have cut; not where that breaks a bridge. */
static void take_cut(struct gb_engine *engine, int64_t slot,
                     const struct gb_contacts *scratch, int n,
                     const double share[GB_BATCH], double *most)
{
    struct gb_contacts *contacts = &engine->contacts;
    struct spring spring[SPRINGS];
    springs_of(contacts, spring);
    for (int k = 0; k < n; k++) {
        const double deepest = gb_contacts_deepest(contacts, slot + k);
        if (deepest < 0.0 ||
            fabs(gb_contacts_deepest(scratch, k) - deepest) > GB_F32_LENGTH) {
            continue;
        }
        for (int s = 0; s < SPRINGS; s++) {
            const double before = length_of(contacts, &spring[s], slot + k);
            const double after = length_of(scratch, &spring[s], k);
            if (!(before > 0.0 && after < (1.0 + share[k]) * before)) {
                continue;
            }
            for (int c = 0; c < spring[s].count; c++) {
                const int plane = spring[s].plane[c];
                *number_at(contacts, plane, slot + k) = *number_at(scratch, plane, k);
            }
            *most = fmax(*most, fabs(after - before));
        }
    }
}

bool gb_cap_rounding_undo(struct gb_world *world, double *most, struct gb_error *err)
{
    struct gb_engine *engine = &world->engine;
    const struct gb_contacts_shape shape = {3, false, GB_REAL_F64};
    const int64_t pairs = gb_neighbour_list_slots(&engine->list, &engine->list.near);
    const double cutoff = gb_engine_cutoff(engine);
    struct gb_contacts scratch;
    *most = 0.0;
    if (!engine->model->terms.friction) {
        return true;
    }
    if (!gb_contacts_init(&scratch, shape, GB_BATCH, err)) {
        return false;
    }
    for (int64_t slot = 0; slot < pairs; slot += GB_BATCH) {
        double share[GB_BATCH];
        struct gb_batch batch;
        memset(&batch, 0, sizeof batch);
        batch.n = pairs - slot < GB_BATCH ? (int)(pairs - slot) : GB_BATCH;
        batch.cutoff2 = cutoff * cutoff;
        lengthen(engine, slot, &scratch, &batch, share, most);
        engine->kernel.advance(engine->model, &batch, &scratch, 0);
        take_cut(engine, slot, &scratch, batch.n, share, most);
    }
    gb_contacts_finish(&scratch);
    return true;
}
