#include "pack/kernel/sweep_sized.h"

#include <math.h>

#include "pack/cell/engine.h"
#include "scene/unequal_pair.h"

/* A spring is cut back to slightly below its cap, so that no rounding error makes one at
 * rest slide; as in batch_laws.h. */
static const double below_cap = 1.0 - 0x1p-40;

/* One near pair while the laws are applied to it. */
struct contact {
    struct gb_law_unequal law;
    double r[3], n[3], distance, overlap;
    double rotation_sum[3];        /* of arcs, see sweep_sized.h */
    double rotation_difference[3]; /* of angles */
    double deepest;
    double shear[3], roll[3], pivot;
    double f_elastic;
    bool slides;
};

/* Spring rotated into the tangent plane with its length kept, plus the tangential part of
 * the relative motion times a factor. */
static void advance_spring(double spring[3], const double motion[3], const double n[3],
                           double factor)
{
    const double along = gb_vec_dot(spring, n), normal = gb_vec_dot(motion, n);
    const double before = gb_vec_dot(spring, spring);
    double tangent[3];
    for (int c = 0; c < 3; c++) {
        tangent[c] = spring[c] - along * n[c];
    }
    const double after = gb_vec_dot(tangent, tangent);
    const double keep = after > 0.0 ? sqrt(before / after) : 0.0;
    for (int c = 0; c < 3; c++) {
        spring[c] = keep * tangent[c] + factor * (motion[c] - normal * n[c]);
    }
}

/* Geometry of near pair k with the branch vector contact->r, and its contact record.
 * rotation_i, rotation_j: rotation increments of its particles. */
static void load(const struct gb_engine *engine, int64_t k, const double rotation_i[3],
                 const double rotation_j[3], struct contact *contact)
{
    const struct gb_pair_list *near = &engine->list.near;
    const struct gb_contacts *contacts = &engine->contacts;
    const double *diameter = engine->particles.diameter;
    const int64_t i = near->first[k], j = near->other[k];
    gb_unequal_pair_init(&contact->law, engine->model, diameter[i], diameter[j]);
    contact->distance = sqrt(gb_vec_dot(contact->r, contact->r));
    contact->overlap = contact->law.mean_diameter - contact->distance;
    contact->deepest = gb_contacts_deepest(contacts, k);
    contact->pivot = gb_contacts_value(contacts, contacts->pivot, k);
    for (int c = 0; c < 3; c++) {
        const double ti = rotation_i[c], tj = rotation_j[c];
        contact->n[c] = contact->r[c] / contact->distance;
        contact->rotation_sum[c] = ti + tj;
        contact->rotation_difference[c] =
            ti * contact->law.inverse_diameter[0] - tj * contact->law.inverse_diameter[1];
        contact->shear[c] = gb_contacts_value(contacts, contacts->shear[c], k);
        contact->roll[c] = gb_contacts_value(contacts, contacts->roll[c], k);
    }
}

static void store(struct gb_engine *engine, int64_t k, const struct contact *contact)
{
    struct gb_contacts *contacts = &engine->contacts;
    gb_contacts_put(contacts, contacts->deepest, k, contact->deepest);
    gb_contacts_put(contacts, contacts->pivot, k, contact->pivot);
    for (int c = 0; c < 3; c++) {
        gb_contacts_put(contacts, contacts->shear[c], k, contact->shear[c]);
        gb_contacts_put(contacts, contacts->roll[c], k, contact->roll[c]);
        gb_contacts_put(contacts, contacts->branch[c], k, contact->r[c]);
    }
}

static void clear_springs(struct contact *contact)
{
    contact->pivot = 0.0;
    for (int c = 0; c < 3; c++) {
        contact->shear[c] = contact->roll[c] = 0.0;
    }
}

static void clear_roll(struct contact *contact)
{
    contact->roll[0] = contact->roll[1] = contact->roll[2] = 0.0;
}

/* Overlap that the contact radius of the springs follows from. */
static double spring_overlap(const struct gb_model *model, const struct contact *contact)
{
    const bool printed = model->bridge.radius_current;
    return contact->deepest <= 0.0 ? contact->overlap
           : printed               ? contact->overlap + contact->law.bridge_length
                                   : contact->deepest;
}

/* Adds the relative motion since the last evaluation to the springs; branch: r_ij then. */
static void advance_springs(const struct gb_model *model, struct contact *contact,
                            const double branch[3])
{
    const double factor = model->slip.motion, *n = contact->n, *w = contact->rotation_sum;
    const double lever = 0.5 * contact->distance / contact->law.mean_diameter;
    const double motion[3] = {
        contact->r[0] - branch[0] - lever * (w[1] * n[2] - w[2] * n[1]),
        contact->r[1] - branch[1] - lever * (w[2] * n[0] - w[0] * n[2]),
        contact->r[2] - branch[2] - lever * (w[0] * n[1] - w[1] * n[0])};
    advance_spring(contact->shear, motion, n, factor);
    contact->pivot += factor * gb_vec_dot(contact->rotation_difference, n);
    advance_spring(contact->roll, contact->rotation_difference, n, factor);
}

/* A bridge that reaches its shear or pivoting cap shrinks to the present overlap or
 * breaks, P1 below (5). */
static void shear_bridge(const struct gb_model *model, struct contact *contact)
{
    const struct gb_law_slip *slip = &model->slip;
    const double a = gb_law_unequal_radius(&contact->law, spring_overlap(model, contact));
    const double shear = gb_law_slip_shear_stiffness(slip, a) *
                         sqrt(gb_vec_dot(contact->shear, contact->shear));
    const double pivot = gb_law_slip_pivot_stiffness(slip, a) * fabs(contact->pivot);
    if (shear > gb_law_slip_bridge_shear_cap(slip, a) ||
        pivot > gb_law_slip_bridge_pivot_cap(slip, a)) {
        const bool stays = contact->overlap > contact->law.bridge_length;
        contact->deepest = stays ? contact->overlap : 0.0;
    }
}

static void advance(const struct gb_engine *engine, int64_t k, struct contact *contact)
{
    const struct gb_model *model = engine->model;
    const double before = contact->deepest;
    if (contact->overlap <= 0.0) {
        contact->deepest = -1.0;
        clear_springs(contact);
        return;
    }
    struct gb_law_bridge bridge = model->bridge;
    bridge.length = contact->law.bridge_length;
    contact->deepest =
        model->terms.bridges
            ? gb_law_bridge_deepest(&bridge, fmax(before, 0.0), contact->overlap)
            : 0.0;
    if (before < 0.0) {
        clear_springs(contact);
    } else if (model->terms.friction) {
        const struct gb_contacts *contacts = &engine->contacts;
        const double branch[3] = {gb_contacts_value(contacts, contacts->branch[0], k),
                                  gb_contacts_value(contacts, contacts->branch[1], k),
                                  gb_contacts_value(contacts, contacts->branch[2], k)};
        advance_springs(model, contact, branch);
    }
    if (contact->deepest > 0.0) {
        shear_bridge(model, contact);
    }
    if (contact->deepest <= 0.0) {
        clear_roll(contact);
    }
}

/* Factor that cuts a spring of this load back to its cap. */
static double cut(double load, double cap)
{
    return load > cap ? below_cap * cap / load : 1.0;
}

/* Cuts the springs at their caps; their shear force on i, and the moment on i. */
static void spring_forces(const struct gb_model *model, struct contact *contact,
                          double shear[3], double moment[3])
{
    const struct gb_law_slip *slip = &model->slip;
    const bool held = contact->deepest > 0.0;
    const double a = gb_law_unequal_radius(&contact->law, spring_overlap(model, contact));
    const double strength = gb_law_slip_bridge_shear_cap(slip, a);
    const double twisting = gb_law_slip_bridge_pivot_cap(slip, a);
    const double cap = held ? strength : fmin(slip->mu * contact->f_elastic, strength);
    const double pivot_cap =
        held ? twisting
             : fmin(slip->mu_pivot *
                        gb_law_unequal_moment(&contact->law, contact->overlap),
                    twisting);
    const double ks = gb_law_slip_shear_stiffness(slip, a);
    const double kp = gb_law_slip_pivot_stiffness(slip, a);
    const double kr = gb_law_slip_roll_stiffness(slip, a);
    const double keep = cut(ks * sqrt(gb_vec_dot(contact->shear, contact->shear)), cap);
    const double hold = cut(kr * sqrt(gb_vec_dot(contact->roll, contact->roll)),
                            gb_law_slip_roll_cap(a, contact->f_elastic));
    contact->slides = keep < 1.0;
    contact->pivot *= cut(kp * fabs(contact->pivot), pivot_cap);
    for (int c = 0; c < 3; c++) {
        contact->shear[c] *= keep;
        contact->roll[c] *= hold;
        shear[c] = -ks * contact->shear[c];
        moment[c] = -kp * contact->pivot * contact->n[c] - kr * contact->roll[c];
    }
}

/* Row of a pair in contact: force on i, torque (over arcs) on i, on j. */
static void contact_forces(const struct gb_model *model, struct contact *contact,
                           double row[9])
{
    double shear[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    const double *n = contact->n,
                 lever = 0.5 * contact->distance / contact->law.mean_diameter;
    contact->f_elastic =
        gb_law_unequal_elastic(&contact->law, contact->deepest, contact->overlap, NULL);
    if (model->terms.friction) {
        spring_forces(model, contact, shear, moment);
    }
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        const double both = -lever * (n[u] * shear[v] - n[v] * shear[u]);
        row[c] = (contact->f_elastic - contact->law.adhesion) * n[c] + shear[c];
        row[3 + c] = both - moment[c] * contact->law.inverse_diameter[1];
        row[6 + c] = both + moment[c] * contact->law.inverse_diameter[0];
    }
}

/* Attraction on i of a pair across a gap. */
static void gap_force(const struct gb_model *model, const struct gb_law_unequal *law,
                      const double r[3], double distance, double force[3])
{
    const bool reached = model->terms.attraction &&
                         distance - law->mean_diameter < model->numerics.cutoff - 1.0;
    const double pull =
        reached ? gb_law_unequal_attraction(law, distance) / distance : 0.0;
    for (int c = 0; c < 3; c++) {
        force[c] = -pull * r[c];
    }
}

/* Behind the forces of a near pair, its part of the tally: normal force, overlap over the
 * contact distance, 1 if it slides. */
enum { WIDTH = GB_PAIR_RESULTS_SIZED, NORMAL = 9, OVERLAP = 10, SLIDES = 11 };
_Static_assert((int)SLIDES + 1 == (int)WIDTH, "a row holds these");

static void sweep_near(struct gb_engine *engine, int64_t k)
{
    struct contact contact = {0};
    double *row = engine->pair.wrench + WIDTH * k;
    const struct gb_pair_list *near = &engine->list.near;
    const double *rotation = engine->particles.rotation;
    gb_engine_branch_vector(engine, near, near->first[k], k, contact.r);
    load(engine, k, rotation + 3 * (int64_t)near->first[k],
         rotation + 3 * (int64_t)near->other[k], &contact);
    advance(engine, k, &contact);
    for (int c = 0; c < WIDTH; c++) {
        row[c] = 0.0;
    }
    if (contact.deepest >= 0.0) {
        contact_forces(engine->model, &contact, row);
        row[NORMAL] = fabs(contact.f_elastic - contact.law.adhesion);
        row[SLIDES] = contact.slides;
    } else {
        gap_force(engine->model, &contact.law, contact.r, contact.distance, row);
    }
    row[OVERLAP] = contact.overlap / contact.law.mean_diameter;
    store(engine, k, &contact);
}

void gb_sweep_sized_pair(const struct gb_engine *engine, bool near, int64_t k,
                         const double motion[9], double result[9])
{
    const struct gb_pair_list *far = &engine->list.far;
    const double *diameter = engine->particles.diameter;
    struct contact contact = {.r = {motion[0], motion[1], motion[2]}};
    double row[9] = {0};
    if (near) {
        load(engine, k, motion + 3, motion + 6, &contact);
        advance(engine, k, &contact);
    } else {
        gb_unequal_pair_init(&contact.law, engine->model, diameter[far->first[k]],
                             diameter[far->other[k]]);
        contact.distance = sqrt(gb_vec_dot(contact.r, contact.r));
        contact.deepest = -1.0;
    }
    if (contact.deepest >= 0.0) {
        contact_forces(engine->model, &contact, row);
    } else {
        gap_force(engine->model, &contact.law, contact.r, contact.distance, row);
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
    gap_force(engine->model, &law, r, distance, engine->pair.pull + 3 * k);
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

static void sum_tally(struct gb_engine *engine)
{
    struct gb_tally tally = {0};
    for (int64_t k = 0; k < engine->list.near.pair_count; k++) {
        const double *row = engine->pair.wrench + WIDTH * k;
        tally.contacts += gb_contacts_touch(&engine->contacts, k);
        tally.normal_sum += row[NORMAL];
        tally.sliding += row[SLIDES] > 0.0;
        tally.deepest = fmax(tally.deepest, row[OVERLAP]);
    }
    engine->total.tally = tally;
}

void gb_sweep_sized_run(struct gb_engine *engine)
{
    const int64_t near = engine->list.near.pair_count, far = engine->list.far.pair_count;
#pragma omp parallel num_threads(engine->threads) if (engine->threads > 1)
    {
#pragma omp for schedule(static) nowait
        for (int64_t k = 0; k < near; k++) {
            sweep_near(engine, k);
        }
#pragma omp for schedule(static)
        for (int64_t k = 0; k < far; k++) {
            sweep_far(engine, k);
        }
    }
    sum_forces(engine);
    sum_tally(engine);
}
