/* The reference relaxer: displacements proportional to the forces, P1 eq. (15).
 *
 * "The value of k is set in such a way that the displacement of the particle under the
 * maximum force is equal to (d - r_eq)/2; the particle is not moved farther than the
 * position where the minimum of the absolute value of the force is reached."  The second
 * rule limits k by the stiffness K of the most strongly held particle: k <= 1/K.  Rotations
 * follow the torques with mobility k/inertia, where the inertia makes them as soft as
 * translations. */
#include <math.h>

#include "base/vec.h"
#include "scene/normal_law.h"
#include "scene/tolerances.h"
#include "solve/relax/relax.h"

static const double inertia = GB_RELAX_INERTIA;

struct steepest {
    double k_most; /* 1 / stiffness of the most strongly held particle */
    double last;   /* residual at the last check */
    double safety; /* halved when the residual grows, a sign of an unstable k */
};

static void start(struct gb_relax *relax, struct gb_world *world)
{
    struct steepest *state = relax->state;
    (void)world;
    *state = (struct steepest){0.0, INFINITY, 1.0};
}

static double contact_stiffness(const struct gb_model *model, double deepest, double h)
{
    const double from = deepest > 0.0 ? deepest : h;
    const double normal = gb_normal_law_stiffness(model, from);
    if (!model->terms.friction) {
        return normal;
    }
    const double a = deepest > 0.0 ? gb_law_bridge_radius(&model->bridge, deepest, h)
                                   : 0.5 * sqrt(fmax(h, 0.0));
    const double shear =
        model->slip.motion * gb_law_slip_shear_stiffness(&model->slip, a);
    return fmax(normal, shear * (1.0 + 0.25 / inertia));
}

double gb_relax_steepest_stiffest(const struct gb_world *world, double *sum)
{
    const struct gb_pair_list *pairs = &gb_world_pairs(world)->near;
    const int64_t count = gb_world_model(world)->count;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    double most = 0.0;
    for (int64_t i = 0; i < count; i++) {
        sum[i] = 0.0;
    }
    for (int64_t i = 0; i < count; i++) {
        for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
            if (gb_contacts_touch(contacts, k)) {
                double r[3];
                gb_world_branch_vector(world, pairs, i, k, r);
                const double stiffness = contact_stiffness(
                    gb_world_model(world), gb_contacts_deepest(contacts, k),
                    1.0 - gb_vec_length(r));
                sum[i] += stiffness;
                sum[pairs->other[k]] += stiffness;
            }
        }
    }
    for (int64_t i = 0; i < count; i++) {
        most = fmax(most, sum[i]);
    }
    return most;
}

static void check_stiffness(struct gb_relax *relax, struct gb_world *world)
{
    struct steepest *state = relax->state;
    const double stiffness = gb_relax_steepest_stiffest(world, relax->vector[0]);
    if (relax->residual > GB_STEEPEST_RESIDUAL_GROWTH_MAX * state->last) {
        state->safety *= 0.5;
    }
    state->last = relax->residual;
    state->k_most = stiffness > 0.0 ? state->safety / stiffness : INFINITY;
}

void gb_relax_steepest_step(struct gb_world *world, double k)
{
    const struct gb_bodies b = gb_world_bodies(world);
    const double k_rotation = k / inertia;
    for (int64_t i = 0; i < 3 * b.count; i++) {
        b.position[i] += k * b.force[i];
        b.rotation[i] += k_rotation * b.torque[i];
    }
}

static void move(struct gb_relax *relax, struct gb_world *world)
{
    struct steepest *state = relax->state;
    if (relax->iterations % GB_STEEPEST_STIFFNESS_MOVES == 0) {
        check_stiffness(relax, world);
    }
    const struct gb_bodies b = gb_world_bodies(world);
    double most = 0.0;
    for (int64_t i = 0; i < b.count; i++) {
        most = fmax(most, gb_vec_dot(b.force + 3 * i, b.force + 3 * i));
    }
    const double reach =
        fmax(0.5 * gb_world_model(world)->h_eq, GB_STEEPEST_DISPLACEMENT_MIN);
    const double k = most > 0.0 ? fmin(reach / sqrt(most), state->k_most) : state->k_most;
    if (isfinite(k)) {
        gb_relax_steepest_step(world, k);
    }
}

const struct gb_relaxer gb_relax_steepest = {
    .name = "steepest",
    .doc = "displacements proportional to the forces, P1 (15): the reference",
    .state_size = sizeof(struct steepest),
    .vectors = 1,
    .light = 1.0,
    .slow = true,
    .start = start,
    .move = move,
};
