#include "pack/kernel/sweep_sized.h"

#include <math.h>

#include "base/team/team.h"
#include "pack/cell/engine.h"
#include "pack/kernel/sized_contact.h"
#include "scene/loading_kind.h"
#include "scene/unequal_pair.h"

/* Behind the forces of a near pair, its part of the tally: normal force, overlap over the
 * contact distance, 1 if it slides, work absorbed in this step (viscous scenes). */
enum { WIDTH = GB_PAIR_RESULTS_SIZED, NORMAL = 9, OVERLAP, SLIDES, ABSORBED };
_Static_assert((int)ABSORBED + 1 == (int)WIDTH, "a row holds these");

static void sweep_near(struct gb_engine *engine, int64_t k, bool viscous)
{
    struct gb_sized_contact contact = {0};
    double *row = engine->pair.wrench + WIDTH * k;
    const struct gb_pair_list *near = &engine->list.near;
    const double *rotation = engine->particles.rotation;
    gb_engine_branch_vector(engine, near, near->first[k], k, contact.r);
    gb_sized_contact_load(engine, k, rotation + 3 * (int64_t)near->first[k],
                          rotation + 3 * (int64_t)near->other[k], &contact);
    if (viscous) {
        gb_sized_contact_load_viscous(engine, k, &contact);
    }
    gb_sized_contact_advance(engine, k, &contact);
    for (int c = 0; c < WIDTH; c++) {
        row[c] = 0.0;
    }
    if (contact.deepest >= 0.0) {
        gb_sized_contact_forces(engine->model, &contact, row);
        row[NORMAL] = fabs(contact.f_elastic - contact.law.adhesion);
        row[SLIDES] = contact.slides;
    } else {
        gb_sized_contact_near_gap(engine->model, &contact, row);
    }
    row[OVERLAP] = contact.overlap / contact.law.mean_diameter;
    row[ABSORBED] = contact.absorbed;
    gb_sized_contact_store(engine, k, &contact);
}

void gb_sweep_sized_pair(const struct gb_engine *engine, bool near, int64_t k,
                         const double motion[9], double result[9])
{
    const struct gb_pair_list *far = &engine->list.far;
    const double *diameter = engine->particles.diameter;
    struct gb_sized_contact contact = {.r = {motion[0], motion[1], motion[2]}};
    double row[9] = {0};
    if (near) {
        gb_sized_contact_load(engine, k, motion + 3, motion + 6, &contact);
        gb_sized_contact_advance(engine, k, &contact);
    } else {
        gb_unequal_pair_init(&contact.law, engine->model, diameter[far->first[k]],
                             diameter[far->other[k]]);
        contact.distance = sqrt(gb_vec_dot(contact.r, contact.r));
        contact.deepest = -1.0;
    }
    if (contact.deepest >= 0.0) {
        gb_sized_contact_forces(engine->model, &contact, row);
    } else {
        gb_sized_contact_gap(engine->model, &contact.law, contact.r, contact.distance,
                             row);
    }
    for (int c = 0; c < 3; c++) { /* a row has the torque on j first */
        result[c] = row[c];
        result[3 + c] = row[6 + c];
        result[6 + c] = row[3 + c];
    }
}

static void sweep_far(struct gb_engine *engine, int64_t k)
{
    const struct gb_pair_list *far = &engine->list.far;
    const double *diameter = engine->particles.diameter;
    const int64_t i = far->first[k], j = far->other[k];
    struct gb_law_unequal law;
    double r[3];
    gb_unequal_pair_init(&law, engine->model, diameter[i], diameter[j]);
    const double distance = sqrt(gb_engine_branch_vector(engine, far, i, k, r));
    gb_sized_contact_gap(engine->model, &law, r, distance, engine->pair.pull + 3 * k);
}

/* Sums in the order of the lists, by one thread; rotation increments are used up. */
static void sum_forces(struct gb_engine *engine)
{
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    struct gb_particles *particles = &engine->particles;
    double *force = particles->force, *torque = particles->torque;
    for (int64_t i = 0; i < 3 * particles->count; i++) {
        force[i] = torque[i] = particles->rotation[i] = 0.0;
    }
    for (int64_t k = 0; k < near->pair_count; k++) {
        const int64_t i = 3 * (int64_t)near->first[k], j = 3 * (int64_t)near->other[k];
        const double *row = engine->pair.wrench + WIDTH * k;
        for (int c = 0; c < 3; c++) {
            force[i + c] += row[c];
            force[j + c] -= row[c];
            torque[i + c] += row[6 + c];
            torque[j + c] += row[3 + c];
        }
    }
    for (int64_t k = 0; k < far->pair_count; k++) {
        const double *pull = engine->pair.pull + 3 * k;
        for (int c = 0; c < 3; c++) {
            force[3 * (int64_t)far->first[k] + c] += pull[c];
            force[3 * (int64_t)far->other[k] + c] -= pull[c];
        }
    }
}

/* Adds force f along branch vector r to the sums over the pairs. */
static void add_virial(struct gb_tally *tally, const double f[3], const double r[3])
{
    for (int c = 0; c < 3; c++) {
        tally->virial[c] += f[c] * r[c];
    }
}

/* Viscous scenes: virial of all pairs, work of the far ones. */
static void sum_work(struct gb_engine *engine, struct gb_tally *tally)
{
    const struct gb_pair_list *near = &engine->list.near, *far = &engine->list.far;
    struct gb_pair_results *pair = &engine->pair;
    double r[3];
    for (int64_t k = 0; k < near->pair_count; k++) {
        gb_engine_branch_vector(engine, near, near->first[k], k, r);
        add_virial(tally, pair->wrench + WIDTH * k, r);
        tally->absorbed += pair->wrench[WIDTH * k + ABSORBED];
    }
    for (int64_t k = 0; k < far->pair_count; k++) {
        const double *force = pair->pull + 3 * k, before = pair->far_distance[k];
        const double distance =
            sqrt(gb_engine_branch_vector(engine, far, far->first[k], k, r));
        const double pull = sqrt(gb_vec_dot(force, force));
        add_virial(tally, force, r);
        if (before > 0.0) {
            tally->absorbed += 0.5 * (pair->far_pull[k] + pull) * (distance - before);
        }
        pair->far_distance[k] = distance;
        pair->far_pull[k] = pull;
    }
}

static void sum_tally(struct gb_engine *engine, bool viscous)
{
    struct gb_tally tally = {0};
    for (int64_t k = 0; k < engine->list.near.pair_count; k++) {
        const double *row = engine->pair.wrench + WIDTH * k;
        tally.contacts += gb_contacts_touch(&engine->contacts, k);
        tally.normal_sum += row[NORMAL];
        tally.sliding += row[SLIDES] > 0.0;
        tally.deepest = fmax(tally.deepest, row[OVERLAP]);
    }
    if (viscous) {
        sum_work(engine, &tally);
    }
    engine->total.tally = tally;
}

/* Pairs that are worth a thread. */
enum { PAIRS_LEAST = 512 };

static void sweep_near_range(void *data, int64_t begin, int64_t end)
{
    struct gb_engine *engine = data;
    const bool viscous = gb_loading_kind_at(engine->model->kind)->viscous_contacts;
    for (int64_t k = begin; k < end; k++) {
        sweep_near(engine, k, viscous);
    }
}

static void sweep_far_range(void *data, int64_t begin, int64_t end)
{
    struct gb_engine *engine = data;
    for (int64_t k = begin; k < end; k++) {
        sweep_far(engine, k);
    }
}

void gb_sweep_sized_run(struct gb_engine *engine)
{
    const int64_t near = engine->list.near.pair_count, far = engine->list.far.pair_count;
    const bool viscous = gb_loading_kind_at(engine->model->kind)->viscous_contacts;
    gb_team_run_ranges(engine->team, near, PAIRS_LEAST, sweep_near_range, engine);
    gb_team_run_ranges(engine->team, far, PAIRS_LEAST, sweep_far_range, engine);
    sum_forces(engine);
    sum_tally(engine, viscous);
}
