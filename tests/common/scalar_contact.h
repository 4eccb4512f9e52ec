#ifndef GB_TESTS_COMMON_SCALAR_CONTACT_H
#define GB_TESTS_COMMON_SCALAR_CONTACT_H

#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/model.h"
#include "scene/unequal_pair.h"

/* One pair of unequal particles through the scalar laws of law/law_unequal.h: P1 (1)-(12),
 * viscous forces P2 (3).  The reference for the batches, written without regard to them. */

struct scalar_spring {
    double value[3], increment[3];
    double fore; /* product of the rotated spring and the increment */
    double last; /* stiffness one step before */
};

struct scalar_contact {
    const struct gb_model *model;
    struct gb_law_unequal law;
    bool viscous;
    double damp; /* viscous time over time step */
    double deepest, branch[3], last_normal;
    struct scalar_spring shear, roll, pivot; /* pivot: along the axis, in [0] */
    /* out: force on i, torques on i and j over the diameters */
    double force[3], torque_i[3], torque_j[3], normal, absorbed;
    bool slides;
};

/* A spring is cut back to slightly below its cap, so that no rounding error makes one at
 * rest slide. */
static const double scalar_below_cap = 1.0 - 0x1p-40;

static inline void scalar_contact_init(struct scalar_contact *contact,
                                       const struct gb_model *model, double first,
                                       double second)
{
    memset(contact, 0, sizeof *contact);
    contact->model = model;
    contact->deepest = -1.0;
    gb_unequal_pair_init(&contact->law, model, first, second);
}

static inline void scalar_cross(const double a[3], const double b[3], double scale,
                                double out[3])
{
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        out[c] = scale * (a[u] * b[v] - a[v] * b[u]);
    }
}

static inline void scalar_spring_clear(struct scalar_spring *spring)
{
    memset(spring->value, 0, sizeof spring->value);
    memset(spring->increment, 0, sizeof spring->increment);
    spring->fore = 0.0;
}

/* Rotated into the tangent plane with its length kept, plus the tangential motion. */
static inline void scalar_spring_advance(struct scalar_spring *spring,
                                         const double motion[3], const double n[3],
                                         double factor)
{
    double *v = spring->value, *by = spring->increment, tangent[3];
    const double along = gb_vec_dot(v, n), normal = gb_vec_dot(motion, n);
    const double before = gb_vec_dot(v, v);
    for (int c = 0; c < 3; c++) {
        tangent[c] = v[c] - along * n[c];
    }
    const double after = gb_vec_dot(tangent, tangent);
    const double keep = after > 0.0 ? sqrt(before / after) : 0.0;
    spring->fore = 0.0;
    for (int c = 0; c < 3; c++) {
        by[c] = factor * (motion[c] - normal * n[c]);
        spring->fore += keep * tangent[c] * by[c];
        v[c] = keep * tangent[c] + by[c];
    }
}

/* Load of a spring that is cut back to a cap, on i; adds its work.  lag: viscous time over
 * time step.  Returns whether it was cut. */
static inline bool scalar_spring_load(struct scalar_contact *contact,
                                      struct scalar_spring *spring, double stiffness,
                                      double cap, double lag, double load[3])
{
    double *v = spring->value;
    const double *by = spring->increment;
    const double most = stiffness * sqrt(gb_vec_dot(v, v));
    const bool cut = most > cap;
    const double keep =
        cut ? (contact->viscous ? 1.0 : scalar_below_cap) * cap / most : 1.0;
    const double delay = cut || !contact->viscous ? 0.0 : lag;
    double work = 0.5 * spring->last * spring->fore;
    for (int c = 0; c < 3; c++) {
        v[c] *= keep;
        load[c] = -stiffness * (v[c] + delay * by[c]);
        work += stiffness * (0.5 * v[c] + delay * by[c]) * by[c];
    }
    spring->last = stiffness;
    contact->absorbed += contact->viscous ? work / contact->model->slip.motion : 0.0;
    return cut;
}

static inline double scalar_radius(const struct scalar_contact *contact, double overlap)
{
    const bool held = contact->deepest > 0.0;
    return gb_law_unequal_radius(&contact->law, !held ? overlap
                                                : contact->model->bridge.radius_current
                                                    ? overlap + contact->law.bridge_length
                                                    : contact->deepest);
}

/* A bridge that reaches its shear or pivoting cap shrinks or breaks, P1 below (5). */
static inline void scalar_shear_bridge(struct scalar_contact *contact, double overlap)
{
    const struct gb_law_slip *slip = &contact->model->slip;
    const double a = scalar_radius(contact, overlap);
    const double shear = gb_law_slip_shear_stiffness(slip, a) *
                         sqrt(gb_vec_dot(contact->shear.value, contact->shear.value));
    const double pivot =
        gb_law_slip_pivot_stiffness(slip, a) * fabs(contact->pivot.value[0]);
    if (contact->deepest > 0.0 && (shear > gb_law_slip_bridge_shear_cap(slip, a) ||
                                   pivot > gb_law_slip_bridge_pivot_cap(slip, a))) {
        contact->deepest = overlap > contact->law.bridge_length ? overlap : 0.0;
    }
}

/* Springs and bridge after the motion since the last evaluation. */
static inline void scalar_advance_history(struct scalar_contact *contact,
                                          const double r[3], double distance,
                                          const double arc_i[3], const double arc_j[3])
{
    const struct gb_model *model = contact->model;
    const double factor = model->slip.motion, before = contact->deepest;
    const double overlap = contact->law.mean_diameter - distance;
    struct gb_law_bridge bridge = model->bridge;
    double n[3], sum[3], swing[3], roll[3], motion[3];
    bridge.length = contact->law.bridge_length;
    contact->deepest = model->terms.bridges
                           ? gb_law_bridge_deepest(&bridge, fmax(before, 0.0), overlap)
                           : 0.0;
    for (int c = 0; c < 3; c++) {
        n[c] = r[c] / distance;
        sum[c] = arc_i[c] + arc_j[c];
        roll[c] = arc_i[c] * contact->law.inverse_diameter[0] -
                  arc_j[c] * contact->law.inverse_diameter[1];
    }
    if (before < 0.0 || !model->terms.friction) {
        scalar_spring_clear(&contact->shear);
        scalar_spring_clear(&contact->roll);
        scalar_spring_clear(&contact->pivot);
    } else {
        scalar_cross(sum, n, 0.5 * distance / contact->law.mean_diameter, swing);
        for (int c = 0; c < 3; c++) {
            motion[c] = r[c] - contact->branch[c] - swing[c];
        }
        struct scalar_spring *pivot = &contact->pivot;
        pivot->increment[0] = factor * gb_vec_dot(roll, n);
        pivot->fore = pivot->value[0] * pivot->increment[0];
        pivot->value[0] += pivot->increment[0];
        scalar_spring_advance(&contact->shear, motion, n, factor);
        scalar_spring_advance(&contact->roll, roll, n, factor);
    }
    scalar_shear_bridge(contact, overlap);
    if (contact->deepest <= 0.0) { /* its load acted over half of the increment */
        memset(contact->roll.value, 0, sizeof contact->roll.value);
    }
}

static inline void scalar_slip(struct scalar_contact *contact, const double n[3],
                               double distance, double elastic)
{
    const struct gb_model *model = contact->model;
    const struct gb_law_slip *slip = &model->slip;
    const struct gb_law_unequal *law = &contact->law;
    const double overlap = law->mean_diameter - distance;
    const double a = scalar_radius(contact, overlap);
    const bool held = contact->deepest > 0.0;
    const double strength = gb_law_slip_bridge_shear_cap(slip, a);
    const double twisting = gb_law_slip_bridge_pivot_cap(slip, a);
    const double roll_lag = contact->damp * model->dynamics.viscous_rolling;
    double shear[3], roll[3], pivot[3], both[3];
    contact->slides =
        scalar_spring_load(contact, &contact->shear, gb_law_slip_shear_stiffness(slip, a),
                           held ? strength : fmin(slip->mu * elastic, strength),
                           contact->damp * model->dynamics.viscous_shear, shear);
    scalar_spring_load(
        contact, &contact->pivot, gb_law_slip_pivot_stiffness(slip, a),
        held ? twisting
             : fmin(slip->mu_pivot * gb_law_unequal_moment(law, overlap), twisting),
        roll_lag, pivot);
    scalar_spring_load(contact, &contact->roll,
                       held ? gb_law_slip_roll_stiffness(slip, a) : 0.0,
                       gb_law_slip_roll_cap(a, fmax(elastic, 0.0)), roll_lag, roll);
    scalar_cross(n, shear, -0.5 * distance / law->mean_diameter, both);
    for (int c = 0; c < 3; c++) {
        const double moment = pivot[0] * n[c] + roll[c];
        contact->force[c] += shear[c];
        contact->torque_i[c] = both[c] + moment * law->inverse_diameter[0];
        contact->torque_j[c] = both[c] - moment * law->inverse_diameter[1];
    }
}

/* r: branch vector from j to i; arc_*: rotation since the last call times the diameter. */
static inline void scalar_contact_move(struct scalar_contact *contact, const double r[3],
                                       const double arc_i[3], const double arc_j[3])
{
    const struct gb_model *model = contact->model;
    const struct gb_law_unequal *law = &contact->law;
    const double distance = gb_vec_length(r), before = gb_vec_length(contact->branch);
    const double overlap = law->mean_diameter - distance;
    const double n[3] = {r[0] / distance, r[1] / distance, r[2] / distance};
    double elastic = 0.0, slope = 0.0, pull = law->adhesion;
    contact->slides = false;
    contact->absorbed = contact->normal = 0.0;
    memset(contact->torque_i, 0, sizeof contact->torque_i);
    memset(contact->torque_j, 0, sizeof contact->torque_j);
    if (overlap > 0.0) {
        scalar_advance_history(contact, r, distance, arc_i, arc_j);
        elastic = gb_law_unequal_elastic(law, contact->deepest, overlap, &slope);
        contact->normal = fabs(elastic - pull);
    } else {
        const bool reached =
            model->terms.attraction && -overlap < model->numerics.cutoff - 1.0;
        contact->deepest = -1.0;
        scalar_spring_clear(&contact->shear);
        scalar_spring_clear(&contact->roll);
        scalar_spring_clear(&contact->pivot);
        contact->shear.last = contact->roll.last = contact->pivot.last = 0.0;
        pull = reached ? gb_law_unequal_attraction(law, distance) : 0.0;
    }
    double whole = elastic - pull;
    if (contact->viscous) {
        const double by = before > 0.0 ? before - distance : 0.0;
        const double lag = contact->damp * slope * by;
        contact->absorbed += (0.5 * (contact->last_normal + whole) + lag) * by;
        contact->last_normal = whole;
        whole += lag;
    }
    for (int c = 0; c < 3; c++) {
        contact->force[c] = whole * n[c];
        contact->branch[c] = r[c];
    }
    if (overlap > 0.0 && model->terms.friction) {
        scalar_slip(contact, n, distance, elastic);
    }
}

#endif
