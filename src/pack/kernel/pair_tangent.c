/* The stiffness of each pair, by central differences of the laws.  Beforehand the cuts that rounding
 * made in springs at their caps are undone, as each would count as sliding. */
#include "pack/kernel/pair_tangent.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "greenbody/status.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/sweep_f64.h"
#include "scene/loading_kind.h"
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

bool gb_pair_tangent_undo(struct gb_world *world, double *most, struct gb_error *err)
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

enum { WIDTH = GB_PAIR_TANGENT_WIDTH };

/* The nine motions of 128 pairs, and the nine conjugates. */
struct span {
    double motion[WIDTH][GB_BATCH];
    double result[WIDTH][GB_BATCH];
};

/* One of the two lists. */
struct source {
    const struct gb_engine *engine;
    const struct gb_pair_list *list;
    bool near;
    struct gb_contacts *scratch;                 /* one batch of contact records */
    const struct gb_pair_tangent_motion *motion; /* or NULL */
};

/* Indices of the nine numbers that exist in the plane x-z; the others stay 0. */
static const int planar_index[] = {0, 2, 4, 7};

static int index_count(const struct gb_engine *engine)
{
    return engine->model->dimension == 2 ? 4 : WIDTH;
}

static int index_at(const struct gb_engine *engine, int k)
{
    return engine->model->dimension == 2 ? planar_index[k] : k;
}

/* Contact records [slot, slot + n) into the scratch. */
static void copy_contacts(const struct source *from, int64_t slot, int n)
{
    const struct gb_contacts *contacts = &from->engine->contacts;
    for (int p = 0; p < contacts->planes; p++) {
        memcpy(from->scratch->plane[p], (const double *)contacts->plane[p] + slot,
               (size_t)n * sizeof(double));
    }
}

/* Rows of r, of rotations and of forces in a batch: three in space, in the plane x, z and
 * one rotation about y. */
static void to_batch(const struct span *span, int dimension, struct gb_batch *batch)
{
    const int vectors = dimension == 2 ? 2 : 3, rotations = dimension == 2 ? 1 : 3;
    for (int c = 0; c < vectors; c++) {
        const double *motion = span->motion[dimension == 2 ? 2 * c : c];
        memcpy(batch->r[c], motion, sizeof batch->r[c]);
    }
    for (int c = 0; c < rotations; c++) {
        const int axis = dimension == 2 ? 1 : c;
        const double *i = span->motion[3 + axis], *j = span->motion[6 + axis];
        for (int k = 0; k < batch->n; k++) {
            batch->rotation_sum[c][k] = i[k] + j[k];
            batch->rotation_difference[c][k] = i[k] - j[k];
        }
    }
}

static void from_batch(const struct gb_batch *batch, int dimension, bool near,
                       struct span *span)
{
    const int vectors = dimension == 2 ? 2 : 3, rotations = dimension == 2 ? 1 : 3;
    memset(span->result, 0, sizeof span->result);
    for (int c = 0; c < vectors; c++) {
        memcpy(span->result[dimension == 2 ? 2 * c : c], batch->force[c],
               sizeof batch->force[c]);
    }
    for (int c = 0; c < rotations && near; c++) {
        const int axis = dimension == 2 ? 1 : c;
        memcpy(span->result[3 + axis], batch->torque_i[c], sizeof batch->torque_i[c]);
        memcpy(span->result[6 + axis], batch->torque_j[c], sizeof batch->torque_j[c]);
    }
}

/* The kernel of the sweep on a copy of the contact records. */
static void apply(const struct source *from, int64_t slot, int n, struct span *span)
{
    const struct gb_engine *engine = from->engine;
    const double cutoff =
        engine->model->terms.attraction ? engine->model->numerics.cutoff : 0.0;
    struct gb_tally tally = {0};
    struct gb_batch batch;
    memset(&batch, 0, sizeof batch);
    batch.n = n;
    batch.cutoff2 = cutoff * cutoff;
    to_batch(span, engine->model->record_dimension, &batch);
    gb_sweep_f64_gather_diameters(engine, from->list, &batch, slot);
    if (from->near) {
        copy_contacts(from, slot, n);
        engine->kernel.advance(engine->model, &batch, from->scratch, 0);
    } else {
        engine->kernel.attract(engine->model, &batch, NULL, NULL, &tally);
    }
    from_batch(&batch, engine->model->record_dimension, from->near, span);
}

/* Adds the motion of all particles to the numbers of pair k of a span. */
static void add_motion(const struct source *from, struct gb_pair_tangent *pair, int k,
                       struct span *span)
{
    const int64_t count = from->engine->particles.count;
    const double *motion = from->motion->motion;
    const double *xi = motion + 3 * (int64_t)pair->first;
    const double *xj = motion + 3 * (int64_t)pair->other;
    double affine[3];
    gb_mat_apply(from->motion->strain, pair->r, affine);
    for (int c = 0; c < 3; c++) {
        pair->r[c] += affine[c] + xi[c] - xj[c];
        span->motion[3 + c][k] = xi[3 * count + c];
        span->motion[6 + c][k] = xj[3 * count + c];
    }
}

/* Particles, branch vectors and forces of pairs [slot, slot + n). */
static void fill_pairs(const struct source *from, int64_t slot, int n, struct span *span,
                       struct gb_pair_tangent *pair)
{
    memset(span, 0, sizeof *span);
    memset(pair, 0, (size_t)n * sizeof *pair);
    for (int k = 0; k < n; k++) {
        const int32_t i = from->list->first[slot + k];
        pair[k].first = i;
        pair[k].other = from->list->other[slot + k];
        gb_engine_branch_vector(from->engine, from->list, i, slot + k, pair[k].r);
        if (from->motion) {
            add_motion(from, &pair[k], k, span);
        }
        for (int c = 0; c < 3; c++) {
            span->motion[c][k] = pair[k].r[c];
        }
    }
    apply(from, slot, n, span);
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < 3; c++) {
            pair[k].force[c] = span->result[c][k];
        }
    }
}

/* Adds a side of the difference by motion m. */
static void add_side(const struct source *from, int64_t slot, int n, int m, double step,
                     struct span *span, struct gb_pair_tangent *pair)
{
    const double weight = -0.5 / step;
    double before[GB_BATCH];
    memcpy(before, span->motion[m], sizeof before);
    for (int k = 0; k < n; k++) {
        span->motion[m][k] += step;
    }
    apply(from, slot, n, span);
    memcpy(span->motion[m], before, sizeof before);
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < WIDTH; c++) {
            pair[k].stiffness[c][m] += weight * span->result[c][k];
        }
    }
}

/* The laws have a kink where a contact opens or slides: each side is taken as it is. */
static void fill_stiffness(const struct source *from, int64_t slot, int n,
                           struct span *span, struct gb_pair_tangent *pair)
{
    const double step = from->motion ? from->motion->step : GB_PAIR_TANGENT_STEP;
    for (int k = 0; k < index_count(from->engine); k++) {
        const int m = index_at(from->engine, k);
        add_side(from, slot, n, m, step, span, pair);
        add_side(from, slot, n, m, -step, span, pair);
    }
}

/* True for a contact, and for a pair that attracts across a gap. */
static bool transmits(const struct source *from, int64_t slot,
                      const struct gb_pair_tangent *pair)
{
    return (from->near && gb_contacts_touch(&from->engine->contacts, slot)) ||
           pair->force[0] != 0.0 || pair->force[1] != 0.0 || pair->force[2] != 0.0;
}

/* Appends the pairs of a list that transmit forces; counts them where out is NULL.
 * pair: scratch. */
static int64_t append(const struct source *from, struct gb_pair_tangent *pair,
                      struct gb_pair_tangent *out)
{
    const int64_t pairs = from->list->pair_count;
    int64_t count = 0;
    struct span span;
    for (int64_t slot = 0; slot < pairs; slot += GB_BATCH) {
        const int n = pairs - slot < GB_BATCH ? (int)(pairs - slot) : GB_BATCH;
        fill_pairs(from, slot, n, &span, pair);
        if (out) {
            fill_stiffness(from, slot, n, &span, pair);
        }
        for (int k = 0; k < n; k++) {
            if (transmits(from, slot + k, &pair[k])) {
                if (out) {
                    out[count] = pair[k];
                }
                count++;
            }
        }
    }
    return count;
}

bool gb_pair_tangent_list(const struct gb_world *world,
                          const struct gb_pair_tangent_motion *motion,
                          struct gb_pair_tangent **out, int64_t *count,
                          struct gb_error *err)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_contacts_shape shape = {
        engine->model->record_dimension,
        gb_loading_kind_at(engine->model->kind)->viscous_contacts, GB_REAL_F64};
    struct gb_contacts scratch;
    struct gb_pair_tangent *pair = gb_alloc_array(GB_BATCH, sizeof *pair, err);
    if (!pair || !gb_contacts_init(&scratch, shape, GB_BATCH, err)) {
        gb_alloc_free(pair);
        return false;
    }
    const struct source near = {engine, &engine->list.near, true, &scratch, motion};
    const struct source far = {engine, &engine->list.far, false, &scratch, motion};
    const int64_t pairs = append(&near, pair, NULL) + append(&far, pair, NULL);
    *out = gb_alloc_array((size_t)pairs + 1, sizeof **out, err);
    if (*out) {
        *count = append(&near, pair, *out);
        *count += append(&far, pair, *out + *count);
    }
    gb_contacts_finish(&scratch);
    gb_alloc_free(pair);
    return *out != NULL;
}
