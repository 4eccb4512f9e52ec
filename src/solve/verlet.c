#include "solve/verlet.h"

#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/kernel/simd.h"
#include "scene/normal_law.h"

bool gb_verlet_init(struct gb_verlet *verlet, const struct gb_model *model,
                    struct gb_error *err)
{
    const size_t n = 3 * (size_t)model->count;
    *verlet =
        (struct gb_verlet){.count = model->count, .inertia = model->dynamics.inertia};
    verlet->velocity = gb_alloc_array(n, sizeof *verlet->velocity, err);
    verlet->spin = gb_alloc_array(n, sizeof *verlet->spin, err);
    if (!verlet->velocity || !verlet->spin) {
        gb_verlet_finish(verlet);
        return false;
    }
    return true;
}

void gb_verlet_finish(struct gb_verlet *verlet)
{
    gb_alloc_free(verlet->velocity);
    gb_alloc_free(verlet->spin);
    *verlet = (struct gb_verlet){0};
}

/* Half a kick of velocities or spins: n numbers.  In 2D what is zero stays zero: one run
 * through all components is quicker than picking three of six. */
GB_SIMD_LOOP void kick_loop(double *restrict speed, const double *restrict load,
                            double by, int64_t n)
{
#pragma omp simd
    for (int64_t i = 0; i < n; i++) {
        speed[i] += by * load[i];
    }
}
GB_SIMD_WIDTHS(kick, (double *speed, const double *load, double by, int64_t n),
               (speed, load, by, n))

/* Half a kick and the drift, in one run through memory. */
GB_SIMD_LOOP void kick_drift_loop(double *restrict speed, const double *restrict load,
                                  double by, double *restrict position, double step,
                                  int64_t n)
{
#pragma omp simd
    for (int64_t i = 0; i < n; i++) {
        speed[i] += by * load[i];
        position[i] += step * speed[i];
    }
}
GB_SIMD_WIDTHS(kick_drift,
               (double *speed, const double *load, double by, double *position,
                double step, int64_t n),
               (speed, load, by, position, step, n))

bool gb_verlet_step(struct gb_verlet *verlet, struct gb_world *world, double time_step,
                    const double factor[3], struct gb_error *err)
{
    const struct gb_bodies b = gb_world_bodies(world);
    const struct gb_tally before = *gb_world_tally(world);
    const int64_t n = 3 * b.count;
    const double half = 0.5 * time_step, spin_factor = half / verlet->inertia;
    kick_drift(verlet->velocity, b.force, half, b.position, time_step, n);
    /* rotations are increments since the last evaluation, which has set them to 0 */
    kick_drift(verlet->spin, b.torque, spin_factor, b.rotation, time_step, n);
    const bool straining = factor[0] != 1.0 || factor[1] != 1.0 || factor[2] != 1.0;
    if (straining) {
        gb_world_strain(world, factor);
    }
    gb_world_set_step(world, time_step);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    kick(verlet->velocity, b.force, half, n);
    kick(verlet->spin, b.torque, spin_factor, n);
    const struct gb_tally *after = gb_world_tally(world);
    for (int k = 0; k < 3 && straining; k++) {
        /* the affine increment of r over r, between the two ends of the step */
        const double shrink = 2.0 * (1.0 - factor[k]) / (1.0 + factor[k]);
        verlet->work += 0.5 * (before.virial[k] + after->virial[k]) * shrink;
    }
    verlet->absorbed += after->absorbed;
    return true;
}

double gb_verlet_kinetic(const struct gb_verlet *verlet)
{
    double v2 = 0.0, w2 = 0.0;
    for (int64_t i = 0; i < 3 * verlet->count; i++) {
        v2 += verlet->velocity[i] * verlet->velocity[i];
        w2 += verlet->spin[i] * verlet->spin[i];
    }
    return 0.5 * (v2 + verlet->inertia * w2);
}

double gb_verlet_frequency(const struct gb_world *world, double *scratch)
{
    const struct gb_model *model = gb_world_model(world);
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    /* mass-weighted: two masses, and two inertias on levers of half a diameter */
    const double shear_share = model->slip.motion * (2.0 + 0.5 / model->dynamics.inertia);
    for (int64_t i = 0; i < model->count; i++) {
        scratch[i] = 0.0;
    }
    for (int64_t i = 0; i < model->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double deepest = gb_contacts_deepest(contacts, k);
            if (deepest < 0.0) {
                continue;
            }
            double r[3];
            gb_world_branch_vector(world, near, i, k, r);
            const double h = 1.0 - gb_vec_length(r);
            const double from = deepest > 0.0 ? deepest : h;
            const double a = deepest > 0.0 ? gb_law_bridge_radius(&model->bridge, from, h)
                                           : 0.5 * sqrt(fmax(h, 0.0));
            const double normal = 2.0 * gb_normal_law_stiffness(model, from);
            const double shear =
                model->terms.friction
                    ? shear_share * gb_law_slip_shear_stiffness(&model->slip, a)
                    : 0.0;
            const double stiffest = normal > shear ? normal : shear;
            scratch[i] += stiffest;
            scratch[near->other[k]] += stiffest;
        }
    }
    double most = 0.0;
    for (int64_t i = 0; i < model->count; i++) {
        most = scratch[i] > most ? scratch[i] : most;
    }
    /* contacts point in all directions: each mode feels about half of them */
    return sqrt(0.5 * most);
}
