#include "pack/kernel/virial.h"

#include <string.h>

#include "base/team.h"
#include "pack/cell/world_private.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/pair_forces.h"
#include "pack/kernel/share.h"
#include "pack/kernel/simd.h"
#include "pack/kernel/sweep_f32.h"

/* Partial sums over at most PARTS parts of the particles, added in their order: the same
 * bits for any number of threads.  Groups of parts have about GROUP_LEAST particles and more,
 * enough to fill some batches; in single precision a part is a group. */
enum { PARTS = 64, GROUP_LEAST = 256 };

static int groups_of(const struct gb_engine *engine)
{
    const int64_t groups = 1 + engine->particles.count / GROUP_LEAST;
    return groups < PARTS ? (int)groups : PARTS;
}

static int parts_of(const struct gb_engine *engine)
{
    return gb_engine_is_f32(engine) ? groups_of(engine) : PARTS;
}

static void add(double sum[3][3], const double force[3], const double r[3])
{
    for (int a = 0; a < 3; a++) {
        gb_vec_add(sum[a], force[a], r);
    }
}

/* Adds the pairs of a batch, lane by lane. */
GB_SIMD_LOOP void add_batch_loop(const struct gb_batch_f32 *batch,
                                 double lane[3][3][GB_LANES])
{
    for (int a = 0; a < 3; a++) {
        const float *restrict force = batch->force[a];
        for (int b = 0; b < 3; b++) {
            const float *restrict r = batch->r[b];
            double *restrict sum = lane[a][b];
            int k = 0;
            for (; k + GB_LANES <= batch->n; k += GB_LANES) {
                for (int l = 0; l < GB_LANES; l++) {
                    sum[l] += (double)force[k + l] * (double)r[k + l];
                }
            }
            for (; k < batch->n; k++) {
                sum[0] += (double)force[k] * (double)r[k];
            }
        }
    }
}
GB_SIMD_WIDTHS(add_batch, (const struct gb_batch_f32 *batch, double lane[3][3][GB_LANES]),
               (batch, lane))

/* Contacts of a batch in single precision that begins at a slot of the near list. */
static void add_fabric_f32(const struct gb_engine *engine,
                           const struct gb_batch_f32 *batch, int64_t slot,
                           struct gb_fabric_sums *fabric)
{
    const struct gb_contacts *contacts = &engine->contacts;
    const float *deepest = (const float *)contacts->plane[contacts->deepest] + slot;
    struct gb_fabric_sums_batch pairs;
    pairs.n = batch->n;
    for (int k = 0; k < batch->n; k++) {
        for (int c = 0; c < 3; c++) {
            pairs.r[c][k] = (double)batch->r[c][k];
            pairs.force[c][k] = (double)batch->force[c][k];
        }
        pairs.deepest[k] = (double)deepest[k];
    }
    gb_fabric_sums_add(fabric, &pairs);
}

/* Pairs [begin, end) of a list in single precision; fabric: of the near list, or NULL. */
static void sum_f32(const struct gb_engine *engine, const struct gb_pair_list *list,
                    int64_t begin, int64_t end, double sum[3][3],
                    struct gb_fabric_sums *fabric)
{
    double lane[3][3][GB_LANES] = {0};
    struct gb_batch_f32 batch;
    for (int64_t slot = begin; slot < end; slot += batch.n) {
        batch.n = end - slot < GB_BATCH ? (int)(end - slot) : GB_BATCH;
        gb_sweep_f32_recompute(engine, list, slot, &batch);
        add_batch(&batch, lane);
        if (fabric) {
            add_fabric_f32(engine, &batch, slot, fabric);
        }
    }
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            for (int l = 0; l < GB_LANES; l++) {
                sum[a][b] += lane[a][b][l];
            }
        }
    }
}

/* Adds pair k to those of the fabric, if it touches; a full batch is added to the sums. */
static void add_fabric_f64(const struct gb_engine *engine, int64_t k,
                           const double force[3], const double r[3],
                           struct gb_fabric_sums_batch *pairs,
                           struct gb_fabric_sums *fabric)
{
    const double deepest = gb_contacts_deepest(&engine->contacts, k);
    if (deepest < 0.0) {
        return;
    }
    for (int c = 0; c < 3; c++) {
        pairs->r[c][pairs->n] = r[c];
        pairs->force[c][pairs->n] = force[c];
    }
    pairs->deepest[pairs->n++] = deepest;
    if (pairs->n == GB_BATCH) {
        gb_fabric_sums_add(fabric, pairs);
        pairs->n = 0;
    }
}

/* Pairs of particle i in double precision; fabric: of the near list, or NULL. */
static void sum_f64(struct gb_pair_forces *forces, int64_t i, double sum[3][3],
                    struct gb_fabric_sums_batch *pairs, struct gb_fabric_sums *fabric)
{
    const struct gb_pair_list *list = forces->list;
    const struct gb_engine *engine = &forces->world->engine;
    for (int64_t k = list->start[i]; k < list->start[i + 1]; k++) {
        double force[3], r[3];
        gb_engine_branch_vector(engine, list, i, k, r);
        gb_pair_forces_at(forces, k, force);
        add(sum, force, r);
        if (fabric) {
            add_fabric_f64(engine, k, force, r, pairs, fabric);
        }
    }
}

/* pairs: contacts in double precision that are not in the fabric yet. */
static void sum_part(const struct gb_world *world, int64_t begin, int64_t end,
                     double sum[3][3], struct gb_fabric_sums_batch *pairs,
                     struct gb_fabric_sums *fabric)
{
    const struct gb_engine *engine = &world->engine;
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    struct gb_pair_forces near_forces, far_forces;
    if (gb_engine_is_f32(engine)) {
        sum_f32(engine, near, near->start[begin], near->start[end], sum, fabric);
        sum_f32(engine, far, far->start[begin], far->start[end], sum, NULL);
        return;
    }
    gb_pair_forces_init(&near_forces, world, GB_PAIR_FORCES_NEAR);
    gb_pair_forces_init(&far_forces, world, GB_PAIR_FORCES_FAR);
    for (int64_t i = begin; i < end; i++) {
        sum_f64(&near_forces, i, sum, pairs, fabric);
        sum_f64(&far_forces, i, sum, NULL, NULL);
    }
}

/* Parts begin .. end - 1; the fabric of all of them, or NULL. */
static void sum_group(const struct gb_world *world, int begin, int end,
                      double (*part)[3][3], struct gb_fabric_sums *fabric)
{
    const int64_t count = world->engine.particles.count;
    const int parts = parts_of(&world->engine);
    struct gb_fabric_sums_batch pairs;
    pairs.n = 0;
    for (int p = begin; p < end; p++) {
        sum_part(world, gb_share(count, p, parts), gb_share(count, p + 1, parts), part[p],
                 &pairs, fabric);
    }
    if (fabric && pairs.n > 0) {
        gb_fabric_sums_add(fabric, &pairs);
    }
}

void gb_virial_sum(const struct gb_world *world, double sum[3][3])
{
    gb_virial_sum_fabric(world, sum, NULL);
}

/* Adds the sums of a group. */
static void add_group(struct gb_fabric_sums *sums, const struct gb_fabric_sums *group)
{
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        sums->weight[kind] += group->weight[kind];
        for (int s = 0; s < 6; s++) {
            sums->tensor[kind][s] += group->tensor[kind][s];
        }
    }
}

struct summing {
    const struct gb_world *world;
    double (*part)[3][3];
    struct gb_fabric_sums *group; /* NULL: no fabric */
};

static void sum_item(void *data, int64_t g)
{
    const struct summing *summing = data;
    const struct gb_engine *engine = &summing->world->engine;
    const int parts = parts_of(engine), groups = groups_of(engine);
    struct gb_fabric_sums *fabric = summing->group ? &summing->group[g] : NULL;
    if (fabric) {
        *fabric = (struct gb_fabric_sums){.weight = {0}};
    }
    sum_group(summing->world, (int)gb_share(parts, (int)g, groups),
              (int)gb_share(parts, (int)g + 1, groups), summing->part, fabric);
}

static void sum_all(const struct gb_world *world, double sum[3][3],
                    struct gb_fabric_sums *fabric)
{
    double part[PARTS][3][3] = {0};
    struct gb_fabric_sums group[PARTS];
    const int parts = parts_of(&world->engine), groups = groups_of(&world->engine);
    struct summing summing = {world, part, fabric ? group : NULL};
    gb_team_run(world->engine.team, groups, sum_item, &summing);
    for (int g = 0; fabric && g < groups; g++) {
        add_group(fabric, &group[g]);
    }
    memset(sum, 0, sizeof part[0]);
    for (int p = 0; p < parts; p++) {
        for (int a = 0; a < 3; a++) {
            gb_vec_add(sum[a], 1.0, part[p][a]);
        }
    }
}

void gb_virial_sum_fabric(const struct gb_world *world, double sum[3][3],
                          struct gb_fabric_sums *fabric)
{
    const struct gb_engine_state *state = &world->engine.state;
    struct gb_virial *last = world->virial;
    if (fabric || last->evaluation != state->evaluation ||
        !gb_engine_state_evaluated(state)) {
        sum_all(world, last->sum, fabric);
        last->evaluation = gb_engine_state_evaluated(state) ? state->evaluation : 0;
    }
    memcpy(sum, last->sum, sizeof last->sum);
}
