#include "pack/kernel/sized_contact.h"

#include <math.h>

#include "pack/cell/engine.h"
#include "scene/unequal_pair.h"

/* A spring is cut back to slightly below its cap, so that no rounding error makes one at
 * rest slide; as in batch_laws.h. */
static const double below_cap = 1.0 - 0x1p-40;

/* Spring rotated into the tangent plane with its length kept, plus the tangential part of
 * the relative motion times a factor, which is stored in `by`.  Returns the product of
 * the rotated spring and the increment. */
static double advance_spring(double spring[3], const double motion[3], const double n[3],
                             double factor, double by[3])
{
    const double along = gb_vec_dot(spring, n), normal = gb_vec_dot(motion, n);
    const double before = gb_vec_dot(spring, spring);
    double tangent[3];
    for (int c = 0; c < 3; c++) {
        tangent[c] = spring[c] - along * n[c];
    }
    const double after = gb_vec_dot(tangent, tangent);
    const double keep = after > 0.0 ? sqrt(before / after) : 0.0;
    double product = 0.0;
    for (int c = 0; c < 3; c++) {
        const double rotated = keep * tangent[c];
        by[c] = factor * (motion[c] - normal * n[c]);
        product += rotated * by[c];
        spring[c] = rotated + by[c];
    }
    return product;
}

void gb_sized_contact_load(const struct gb_engine *engine, int64_t k,
                           const double rotation_i[3], const double rotation_j[3],
                           struct gb_sized_contact *contact)
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

void gb_sized_contact_load_viscous(const struct gb_engine *engine, int64_t k,
                                   struct gb_sized_contact *contact)
{
    const struct gb_contacts *contacts = &engine->contacts;
    const int planes[4] = {contacts->last_normal, contacts->last_shear,
                           contacts->last_roll, contacts->last_pivot};
    double before2 = 0.0;
    for (int c = 0; c < 3; c++) {
        const double before = gb_contacts_value(contacts, contacts->branch[c], k);
        before2 += before * before;
    }
    for (int p = 0; p < 4; p++) {
        contact->last[p] = gb_contacts_value(contacts, planes[p], k);
    }
    contact->viscous = true;
    contact->damp = engine->damp;
    contact->by.overlap = before2 > 0.0 ? sqrt(before2) - contact->distance : 0.0;
}

void gb_sized_contact_store(struct gb_engine *engine, int64_t k,
                            const struct gb_sized_contact *contact)
{
    struct gb_contacts *contacts = &engine->contacts;
    const int planes[4] = {contacts->last_normal, contacts->last_shear,
                           contacts->last_roll, contacts->last_pivot};
    for (int p = 0; p < 4 && contact->viscous; p++) {
        gb_contacts_put(contacts, planes[p], k, contact->last[p]);
    }
    gb_contacts_put(contacts, contacts->deepest, k, contact->deepest);
    gb_contacts_put(contacts, contacts->pivot, k, contact->pivot);
    for (int c = 0; c < 3; c++) {
        gb_contacts_put(contacts, contacts->shear[c], k, contact->shear[c]);
        gb_contacts_put(contacts, contacts->roll[c], k, contact->roll[c]);
        gb_contacts_put(contacts, contacts->branch[c], k, contact->r[c]);
    }
}

static void clear_springs(struct gb_sized_contact *contact)
{
    contact->pivot = 0.0;
    for (int c = 0; c < 3; c++) {
        contact->shear[c] = contact->roll[c] = 0.0;
    }
}

static void clear_roll(struct gb_sized_contact *contact)
{
    contact->roll[0] = contact->roll[1] = contact->roll[2] = 0.0;
}

/* Overlap that the contact radius of the springs follows from. */
static double spring_overlap(const struct gb_model *model,
                             const struct gb_sized_contact *contact)
{
    const bool printed = model->bridge.radius_current;
    return contact->deepest <= 0.0 ? contact->overlap
           : printed               ? contact->overlap + contact->law.bridge_length
                                   : contact->deepest;
}

/* Adds the relative motion since the last evaluation to the springs; branch: r_ij then. */
static void advance_springs(const struct gb_model *model,
                            struct gb_sized_contact *contact, const double branch[3])
{
    const double factor = model->slip.motion, *n = contact->n, *w = contact->rotation_sum;
    const double lever = 0.5 * contact->distance / contact->law.mean_diameter;
    const double motion[3] = {
        contact->r[0] - branch[0] - lever * (w[1] * n[2] - w[2] * n[1]),
        contact->r[1] - branch[1] - lever * (w[2] * n[0] - w[0] * n[2]),
        contact->r[2] - branch[2] - lever * (w[0] * n[1] - w[1] * n[0])};
    struct gb_sized_contact_increments *by = &contact->by;
    by->shear_before = advance_spring(contact->shear, motion, n, factor, by->shear);
    by->pivot = factor * gb_vec_dot(contact->rotation_difference, n);
    by->pivot_before = contact->pivot * by->pivot;
    contact->pivot += by->pivot;
    by->roll_before =
        advance_spring(contact->roll, contact->rotation_difference, n, factor, by->roll);
}

/* A bridge that reaches its shear or pivoting cap shrinks to the present overlap or
 * breaks, P1 below (5). */
static void shear_bridge(const struct gb_model *model, struct gb_sized_contact *contact)
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

void gb_sized_contact_advance(const struct gb_engine *engine, int64_t k,
                              struct gb_sized_contact *contact)
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

/* Factor that cuts a spring of this load back to its cap; without viscous forces slightly
 * below it. */
static double cut(const struct gb_sized_contact *contact, double load, double cap)
{
    return load > cap ? (contact->viscous ? 1.0 : below_cap) * cap / load : 1.0;
}

/* Work of a spring's load over the step: mean of the elastic loads before and after, and
 * the viscous one, P2 (3), which is `lag` times the increment.  components: 3, or 1 of
 * pivoting; before: product of the spring before and the increment. */
static double spring_work(const double *spring, const double *by, int components,
                          double before, double stiffness, double lag, double *last)
{
    double after = 0.0, square = 0.0;
    for (int c = 0; c < components; c++) {
        after += spring[c] * by[c];
        square += by[c] * by[c];
    }
    const double work = 0.5 * (*last * before + stiffness * after);
    *last = stiffness;
    return work + lag * stiffness * square;
}

/* Increments that the viscous loads add to the springs: none where a spring is cut. */
struct lags {
    double shear, roll, pivot;
};

static struct lags spring_lags(const struct gb_model *model,
                               struct gb_sized_contact *contact,
                               const double stiffness[3], const bool cut_back[3])
{
    const struct gb_sized_contact_increments *by = &contact->by;
    const double shear = contact->damp * model->dynamics.viscous_shear;
    const double roll = contact->damp * model->dynamics.viscous_rolling;
    const struct lags lag = {cut_back[0] ? 0.0 : shear, cut_back[1] ? 0.0 : roll,
                             cut_back[2] ? 0.0 : roll};
    if (!contact->viscous) {
        return (struct lags){0.0, 0.0, 0.0};
    }
    double work = spring_work(contact->shear, by->shear, 3, by->shear_before,
                              stiffness[0], lag.shear, &contact->last[1]);
    work += spring_work(contact->roll, by->roll, 3, by->roll_before, stiffness[1],
                        lag.roll, &contact->last[2]);
    work += spring_work(&contact->pivot, &by->pivot, 1, by->pivot_before, stiffness[2],
                        lag.pivot, &contact->last[3]);
    contact->absorbed += work / model->slip.motion; /* loads act over the whole motion */
    return lag;
}

/* Cuts the springs at their caps; their shear force on i, and the moment on i. */
static void spring_forces(const struct gb_model *model, struct gb_sized_contact *contact,
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
    const double keep =
        cut(contact, ks * sqrt(gb_vec_dot(contact->shear, contact->shear)), cap);
    const double hold = cut(contact, kr * sqrt(gb_vec_dot(contact->roll, contact->roll)),
                            gb_law_slip_roll_cap(a, contact->f_elastic));
    const double stay = cut(contact, kp * fabs(contact->pivot), pivot_cap);
    contact->slides = keep < 1.0;
    contact->pivot *= stay;
    for (int c = 0; c < 3; c++) {
        contact->shear[c] *= keep;
        contact->roll[c] *= hold;
    }
    const double stiffness[3] = {ks, held ? kr : 0.0, kp};
    const bool cut_back[3] = {keep < 1.0, hold < 1.0, stay < 1.0};
    const struct lags lag = spring_lags(model, contact, stiffness, cut_back);
    const struct gb_sized_contact_increments *by = &contact->by;
    const double pivot = contact->pivot + lag.pivot * by->pivot;
    for (int c = 0; c < 3; c++) {
        const double roll = held ? contact->roll[c] + lag.roll * by->roll[c] : 0.0;
        shear[c] = -ks * (contact->shear[c] + lag.shear * by->shear[c]);
        moment[c] = -kp * pivot * contact->n[c] - kr * roll;
    }
}

/* Adds the viscous part to the whole normal force of a pair, and its work. */
static double normal_force(struct gb_sized_contact *contact, double elastic, double slope)
{
    if (!contact->viscous) {
        return elastic;
    }
    const double by = contact->by.overlap, lag = contact->damp * slope * by;
    contact->absorbed += (0.5 * (contact->last[0] + elastic) + lag) * by;
    contact->last[0] = elastic;
    return elastic + lag;
}

void gb_sized_contact_forces(const struct gb_model *model,
                             struct gb_sized_contact *contact, double row[9])
{
    double shear[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    const double *n = contact->n,
                 lever = 0.5 * contact->distance / contact->law.mean_diameter;
    double slope = 0.0;
    contact->f_elastic =
        gb_law_unequal_elastic(&contact->law, contact->deepest, contact->overlap, &slope);
    const double normal =
        normal_force(contact, contact->f_elastic - contact->law.adhesion, slope);
    if (model->terms.friction) {
        spring_forces(model, contact, shear, moment);
    }
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        const double both = -lever * (n[u] * shear[v] - n[v] * shear[u]);
        row[c] = normal * n[c] + shear[c];
        row[3 + c] = both - moment[c] * contact->law.inverse_diameter[1];
        row[6 + c] = both + moment[c] * contact->law.inverse_diameter[0];
    }
}

double gb_sized_contact_gap(const struct gb_model *model,
                            const struct gb_law_unequal *law, const double r[3],
                            double distance, double force[3])
{
    const bool reached = model->terms.attraction &&
                         distance - law->mean_diameter < model->numerics.cutoff - 1.0;
    const double pull =
        reached ? gb_law_unequal_attraction(law, distance) / distance : 0.0;
    for (int c = 0; c < 3; c++) {
        force[c] = -pull * r[c];
    }
    return pull * distance;
}

void gb_sized_contact_near_gap(const struct gb_model *model,
                               struct gb_sized_contact *contact, double force[3])
{
    const double pull =
        gb_sized_contact_gap(model, &contact->law, contact->r, contact->distance, force);
    normal_force(contact, -pull, 0.0);
    contact->last[1] = contact->last[2] = contact->last[3] = 0.0;
}
