#include "pack/contact.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"

/* The contact as the laws see it in this evaluation. */
struct geometry {
    double n[3];  /* from j to i */
    double r, h;  /* distance and overlap */
    double force; /* f_e */
    double a;     /* radius of the springs: a_ch of a bridge, a of a plain contact */
};

struct caps {
    double shear, pivot;
};

void gb_contact_clear(struct gb_contact *contact)
{
    *contact = (struct gb_contact){.deepest = -1.0};
}

void gb_contact_derive(const struct gb_model *model, struct gb_contact *contact)
{
    if (contact->deepest > 0.0) {
        contact->line_force = gb_law_rod_force(&model->rod, contact->deepest);
        contact->line_slope = gb_law_rod_stiffness(&model->rod, contact->deepest);
    }
}

struct gb_contact_core gb_contact_core(const struct gb_contact *contact)
{
    struct gb_contact_core core = {.deepest = contact->deepest, .pivot = contact->pivot};
    memcpy(core.shear, contact->shear, sizeof core.shear);
    memcpy(core.roll, contact->roll, sizeof core.roll);
    return core;
}

struct gb_contact gb_contact_revive(const struct gb_model *model,
                                    const struct gb_contact_core *core, const double arm[3])
{
    struct gb_contact contact = {.deepest = core->deepest, .pivot = core->pivot};
    memcpy(contact.shear, core->shear, sizeof contact.shear);
    memcpy(contact.roll, core->roll, sizeof contact.roll);
    memcpy(contact.arm, arm, sizeof contact.arm);
    gb_contact_derive(model, &contact);
    return contact;
}

static void set_deepest(const struct gb_model *model, struct gb_contact *contact,
                        double deepest)
{
    if (deepest != contact->deepest) {
        contact->deepest = deepest;
        gb_contact_derive(model, contact);
    }
}

/* Elastic force and spring radius for the bridge state the contact is in. */
static void settle(const struct gb_model *model, const struct gb_contact *contact,
                   struct geometry *g)
{
    if (contact->deepest > 0.0) {
        g->force = contact->line_force - contact->line_slope * (contact->deepest - g->h);
        g->a = gb_law_bridge_radius(&model->bridge, contact->deepest, g->h);
    } else {
        g->force = gb_law_rod_force(&model->rod, g->h);
        g->a = 0.5 * sqrt(g->h);
    }
}

static struct caps caps_of(const struct gb_model *model, const struct gb_contact *contact,
                           const struct geometry *g)
{
    const struct gb_law_slip *slip = &model->slip;
    if (contact->deepest > 0.0) {
        return (struct caps){gb_law_slip_bridge_shear_cap(slip, g->a),
                             gb_law_slip_bridge_pivot_cap(slip, g->a)};
    }
    struct caps caps = {.shear = fmin(slip->mu * g->force,
                                      gb_law_slip_bridge_shear_cap(slip, g->a))};
    if (model->dimension == 3) {
        caps.pivot = gb_law_slip_pivot_cap(slip, &model->rod, g->h);
    }
    return caps;
}

/* Turns v into the plane normal to n, keeping its length. */
static void turn_into_plane(double v[3], const double n[3])
{
    const double before = gb_vec_dot(v, v);
    if (before == 0.0) {
        return;
    }
    gb_vec_add(v, -gb_vec_dot(n, v), n);
    const double after = gb_vec_dot(v, v);
    if (after > 0.0) {
        gb_vec_scale(v, sqrt(before / after));
    }
}

/* Adds the tangential part of motion to a stored spring vector. */
static void add_tangential(double spring[3], const double motion[3], const double n[3],
                           double share)
{
    const double along = gb_vec_dot(motion, n);
    for (int k = 0; k < 3; k++) {
        spring[k] += share * (motion[k] - along * n[k]);
    }
}

static void stretch_springs(const struct gb_model *model, struct gb_contact *contact,
                            const struct geometry *g, const double r[3],
                            const double turn_i[3], const double turn_j[3])
{
    double sum[3], difference[3], slip[3];
    for (int k = 0; k < 3; k++) {
        sum[k] = turn_i[k] + turn_j[k];
        difference[k] = turn_i[k] - turn_j[k];
    }
    gb_vec_cross(sum, g->n, slip);
    for (int k = 0; k < 3; k++) {
        slip[k] = r[k] - contact->arm[k] - 0.5 * g->r * slip[k];
    }
    turn_into_plane(contact->shear, g->n);
    add_tangential(contact->shear, slip, g->n, model->slip.motion);
    contact->pivot += model->slip.motion * gb_vec_dot(difference, g->n);
    if (contact->deepest > 0.0) {
        turn_into_plane(contact->roll, g->n);
        add_tangential(contact->roll, difference, g->n, model->slip.motion);
    }
}

/* True when a spring of squared length length2 carries more than its cap.  Squares spare the
 * root of every contact that sticks, which is nearly all of them. */
static bool beyond(double stiffness, double length2, double cap)
{
    return stiffness * stiffness * length2 > cap * cap;
}

/* A bridge whose shear or pivoting cap is reached shrinks to the present overlap, or is gone;
 * P1 below (5) and (11). */
static bool bridge_fails(const struct gb_model *model, const struct gb_contact *contact,
                         const struct geometry *g)
{
    const struct gb_law_slip *slip = &model->slip;
    return beyond(gb_law_slip_shear_stiffness(slip, g->a),
                  gb_vec_dot(contact->shear, contact->shear),
                  gb_law_slip_bridge_shear_cap(slip, g->a)) ||
           beyond(gb_law_slip_pivot_stiffness(slip, g->a), contact->pivot * contact->pivot,
                  gb_law_slip_bridge_pivot_cap(slip, g->a));
}

static void fail_bridge(const struct gb_model *model, struct gb_contact *contact,
                        struct geometry *g)
{
    set_deepest(model, contact, g->h > model->bridge.length ? g->h : 0.0);
    settle(model, contact, g);
}

/* Cuts a spring back so that its load is at the cap; tells whether it was cut. */
static bool cut(double *spring, int n, double length2, double stiffness, double cap)
{
    if (!beyond(stiffness, length2, cap)) {
        return false;
    }
    const double keep = cap / (stiffness * sqrt(length2));
    for (int k = 0; k < n; k++) {
        spring[k] *= keep;
    }
    return true;
}

static void tangential_wrench(const struct gb_model *model, struct gb_contact *contact,
                              struct geometry *g, struct gb_wrench *wrench,
                              double torque_i[3], struct gb_tally *tally)
{
    const struct gb_law_slip *slip = &model->slip;
    if (contact->deepest > 0.0 && bridge_fails(model, contact, g)) {
        fail_bridge(model, contact, g);
    }
    const struct caps caps = caps_of(model, contact, g);
    const double k_shear = gb_law_slip_shear_stiffness(slip, g->a);
    const double k_pivot = gb_law_slip_pivot_stiffness(slip, g->a);
    tally->sliding += cut(contact->shear, 3, gb_vec_dot(contact->shear, contact->shear),
                          k_shear, caps.shear);
    cut(&contact->pivot, 1, contact->pivot * contact->pivot, k_pivot, caps.pivot);

    double twist[3] = {0.0, 0.0, 0.0};
    if (contact->deepest > 0.0) {
        const double k_roll = gb_law_slip_roll_stiffness(slip, g->a);
        cut(contact->roll, 3, gb_vec_dot(contact->roll, contact->roll), k_roll,
            gb_law_slip_roll_cap(g->a, g->force));
        gb_vec_add(twist, -k_roll, contact->roll);
    } else {
        contact->roll[0] = contact->roll[1] = contact->roll[2] = 0.0;
    }
    gb_vec_add(twist, -k_pivot * contact->pivot, g->n);

    double cross[3];
    gb_vec_cross(g->n, contact->shear, cross);
    for (int k = 0; k < 3; k++) {
        wrench->force[k] = -k_shear * contact->shear[k];
        const double twin = 0.5 * g->r * k_shear * cross[k];
        wrench->torque_j[k] = twin - twist[k];
        torque_i[k] += twin + twist[k];
    }
}

void gb_contact_advance(const struct gb_model *model, struct gb_contact *contact,
                        const double r[3], double distance, const double turn_i[3],
                        const double turn_j[3], struct gb_wrench *wrench,
                        double torque_i[3], struct gb_tally *tally)
{
    struct geometry g = {.r = distance, .h = 1.0 - distance};
    for (int k = 0; k < 3; k++) {
        g.n[k] = r[k] / distance;
    }
    const bool fresh = contact->deepest < 0.0;
    if (fresh) {
        *contact = (struct gb_contact){.deepest = 0.0};
    }
    if (model->terms.bridges) {
        set_deepest(model, contact,
                    gb_law_bridge_deepest(&model->bridge, contact->deepest, g.h));
    }
    settle(model, contact, &g);
    if (model->terms.friction) {
        if (!fresh) {
            stretch_springs(model, contact, &g, r, turn_i, turn_j);
        }
        tangential_wrench(model, contact, &g, wrench, torque_i, tally);
    } else {
        *wrench = (struct gb_wrench){0};
    }
    const double normal = g.force - model->adhesion;
    for (int k = 0; k < 3; k++) {
        wrench->force[k] += normal * g.n[k];
        contact->arm[k] = r[k];
    }
    tally->contacts++;
    tally->normal_sum += fabs(normal);
    tally->deepest = g.h > tally->deepest ? g.h : tally->deepest;
}
