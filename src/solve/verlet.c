#include "solve/verlet.h"

#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "pack/kernel/simd.h"
#include "pack/structure/assign_sizes.h"
#include "scene/normal_law.h"
#include "scene/unequal_pair.h"

/* m = d^3. */
static bool assign_masses(struct gb_verlet *verlet, const struct gb_model *model,
                          struct gb_error *err)
{
    const size_t n = (size_t)model->count;
    if (!model->polydisperse) {
        return true;
    }
    double *diameter = gb_alloc_array(n, sizeof *diameter, err);
    verlet->inverse_mass = gb_alloc_array(3 * n, sizeof *verlet->inverse_mass, err);
    const bool done =
        diameter && verlet->inverse_mass && gb_assign_sizes_model(model, diameter, err);
    for (int64_t i = 0; done && i < 3 * model->count; i++) {
        const double d = diameter[i / 3];
        verlet->inverse_mass[i] = 1.0 / (d * d * d);
    }
    gb_alloc_free(diameter);
    return done;
}

bool gb_verlet_init(struct gb_verlet *verlet, const struct gb_model *model,
                    struct gb_error *err)
{
    const size_t n = 3 * (size_t)model->count;
    *verlet =
        (struct gb_verlet){.count = model->count, .inertia = model->dynamics.inertia};
    verlet->velocity = gb_alloc_array(n, sizeof *verlet->velocity, err);
    verlet->spin = gb_alloc_array(n, sizeof *verlet->spin, err);
    if (!verlet->velocity || !verlet->spin || !assign_masses(verlet, model, err)) {
        gb_verlet_finish(verlet);
        return false;
    }
    return true;
}

void gb_verlet_finish(struct gb_verlet *verlet)
{
    gb_alloc_free(verlet->velocity);
    gb_alloc_free(verlet->spin);
    gb_alloc_free(verlet->inverse_mass);
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

/* The same with the masses of particles of unequal sizes. */
GB_SIMD_LOOP void kick_masses_loop(double *restrict speed, const double *restrict load,
                                   const double *restrict inverse_mass, double by,
                                   int64_t n)
{
#pragma omp simd
    for (int64_t i = 0; i < n; i++) {
        speed[i] += by * inverse_mass[i] * load[i];
    }
}
GB_SIMD_WIDTHS(kick_masses,
               (double *speed, const double *load, const double *inverse_mass, double by,
                int64_t n),
               (speed, load, inverse_mass, by, n))

static void drift(double *position, const double *speed, double step, int64_t n)
{
    for (int64_t i = 0; i < n; i++) {
        position[i] += step * speed[i];
    }
}

/* Half a kick of all velocities and spins. */
static void kick_all(struct gb_verlet *verlet, const struct gb_bodies *b, double half)
{
    const int64_t n = 3 * b->count;
    const double spin_factor = half / verlet->inertia;
    if (verlet->inverse_mass) {
        kick_masses(verlet->velocity, b->force, verlet->inverse_mass, half, n);
        kick_masses(verlet->spin, b->torque, verlet->inverse_mass, spin_factor, n);
        return;
    }
    kick(verlet->velocity, b->force, half, n);
    kick(verlet->spin, b->torque, spin_factor, n);
}

/* Half a kick and the drift.  Rotations are increments since the last evaluation, which
 * has set them to 0. */
static void kick_drift_all(struct gb_verlet *verlet, const struct gb_bodies *b,
                           double step)
{
    const int64_t n = 3 * b->count;
    const double half = 0.5 * step;
    if (verlet->inverse_mass) {
        kick_all(verlet, b, half);
        drift(b->position, verlet->velocity, step, n);
        drift(b->rotation, verlet->spin, step, n);
        return;
    }
    kick_drift(verlet->velocity, b->force, half, b->position, step, n);
    kick_drift(verlet->spin, b->torque, half / verlet->inertia, b->rotation, step, n);
}

bool gb_verlet_step(struct gb_verlet *verlet, struct gb_world *world, double time_step,
                    const double factor[3], struct gb_error *err)
{
    const struct gb_bodies b = gb_world_bodies(world);
    const struct gb_tally before = *gb_world_tally(world);
    kick_drift_all(verlet, &b, time_step);
    const bool straining = factor[0] != 1.0 || factor[1] != 1.0 || factor[2] != 1.0;
    if (straining) {
        gb_world_strain(world, factor);
    }
    gb_world_set_step(world, time_step);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    kick_all(verlet, &b, 0.5 * time_step);
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
        const double mass = verlet->inverse_mass ? 1.0 / verlet->inverse_mass[i] : 1.0;
        v2 += mass * verlet->velocity[i] * verlet->velocity[i];
        w2 += mass * verlet->spin[i] * verlet->spin[i];
    }
    return 0.5 * (v2 + verlet->inertia * w2);
}

/* The k for which the stiffest mode of a pair has the squared frequency
 * k (1/m_i + 1/m_j): the normal one, or shear and rotation together, on levers of half a
 * diameter with the inertias m/10. */
static double contact_stiffness(const struct gb_model *model,
                                const struct gb_law_unequal *law, double deepest,
                                double h)
{
    const double levers = 1.0 + 0.25 / model->dynamics.inertia;
    const double wide = deepest <= 0.0                 ? h
                        : model->bridge.radius_current ? h + law->bridge_length
                                                       : deepest;
    const double a = gb_law_unequal_radius(law, wide);
    double normal = 0.0;
    gb_law_unequal_elastic(law, deepest, h, &normal);
    const double shear =
        model->terms.friction
            ? model->slip.motion * levers * gb_law_slip_shear_stiffness(&model->slip, a)
            : 0.0;
    return fmax(normal, shear);
}

/* Sums of the rows of the mass-weighted stiffness matrix, a bound of its eigenvalues:
 * k (1/m_i + 1/sqrt(m_i m_j)) of each contact. */
static void sum_sized_rows(const struct gb_world *world, double *sum)
{
    const struct gb_model *model = gb_world_model(world);
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    for (int64_t i = 0; i < model->count; i++) {
        for (int64_t k = near->start[i]; k < near->start[i + 1]; k++) {
            const double deepest = gb_contacts_deepest(contacts, k);
            if (deepest < 0.0) {
                continue;
            }
            const int64_t j = near->other[k];
            const double di = gb_world_diameter(world, i);
            const double dj = gb_world_diameter(world, j);
            struct gb_law_unequal law;
            double r[3];
            gb_unequal_pair_init(&law, model, di, dj);
            gb_world_branch_vector(world, near, i, k, r);
            const double stiffness = contact_stiffness(
                model, &law, deepest, law.mean_diameter - gb_vec_length(r));
            const double mixed = 1.0 / sqrt(di * di * di * dj * dj * dj);
            sum[i] += stiffness * (1.0 / (di * di * di) + mixed);
            sum[j] += stiffness * (1.0 / (dj * dj * dj) + mixed);
        }
    }
}

/* The same for particles of one size, all of mass 1. */
static void sum_equal_rows(const struct gb_world *world, double *sum)
{
    const struct gb_model *model = gb_world_model(world);
    const struct gb_pair_list *near = &gb_world_pairs(world)->near;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    /* mass-weighted: two masses, and two inertias on levers of half a diameter */
    const double shear_share = model->slip.motion * (2.0 + 0.5 / model->dynamics.inertia);
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
            sum[i] += stiffest;
            sum[near->other[k]] += stiffest;
        }
    }
}

double gb_verlet_frequency(const struct gb_world *world, double *scratch)
{
    const struct gb_model *model = gb_world_model(world);
    for (int64_t i = 0; i < model->count; i++) {
        scratch[i] = 0.0;
    }
    (model->polydisperse ? sum_sized_rows : sum_equal_rows)(world, scratch);
    double most = 0.0;
    for (int64_t i = 0; i < model->count; i++) {
        most = scratch[i] > most ? scratch[i] : most;
    }
    /* contacts point in all directions: each mode feels about half of them */
    return sqrt(0.5 * most);
}
