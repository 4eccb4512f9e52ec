#include "solve/moduli/probe.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/deformation.h"
#include "base/vec.h"
#include "pack/cell/nonaffine.h"
#include "pack/cell/world.h"
#include "pack/kernel/cap_rounding.h"
#include "scene/tolerances.h"

/* Newton steps before FIRE takes over, halvings of a step, and iterations of a solution of
 * the linear equations. */
enum {
    NEWTON_MAX = 30,
    HALVINGS_MAX = 4,
    RISES_MAX = 6,
    ITERATIONS_MAX = 6000,
    SLICE = 200
};

/* Residual of the linear equations in a Newton step, as a share of the forces. */
static const double linear_share = 1e-3;

/* The larger one of rms force and rms torque. */
static double imbalance(const struct gb_world *world)
{
    const struct gb_force_sums *sums = gb_world_sums(world);
    const double count = (double)gb_world_model(world)->count;
    return sqrt(fmax(sums->force2, sums->torque2) / count);
}

/* Imbalance by the rounding of positions. */
static double rounding(const struct gb_world *world)
{
    const double *edge = gb_world_cell(world)->edge;
    return GB_PROBE_ROUNDING * fmax(edge[0], fmax(edge[1], edge[2]));
}

static bool check_cancelled(const struct gb_probe *probe, struct gb_error *err)
{
    return !probe->cancelled || !probe->cancelled(probe->data) ||
           gb_error_set(err, GB_ERR_CANCELLED, "cancelled");
}

/* The saved state after a strain and a motion, as one increment. */
static bool apply(struct gb_probe *probe, const double strain[3][3], const double *motion,
                  struct gb_error *err)
{
    struct gb_deformation deformation;
    const size_t bytes = 3 * (size_t)probe->model.count;
    if (!check_cancelled(probe, err) ||
        !gb_world_copy_restore(probe->world, probe->base, err)) {
        return false;
    }
    for (int k = 0; k < 9; k++) {
        deformation.f[k / 3][k % 3] = strain[k / 3][k % 3] + (k / 3 == k % 3);
    }
    gb_world_deform(probe->world, &deformation);
    const struct gb_bodies b = gb_world_movable(probe->world);
    for (size_t k = 0; k < bytes; k++) {
        b.position[k] += motion[k];
        b.rotation[k] += motion[bytes + k];
    }
    return gb_world_evaluate(probe->world, err);
}

/* Imbalance after a strain and the motion so far; infinite where that overlaps particles
 * beyond what an evaluation accepts. */
static bool try_motion(struct gb_probe *probe, const double strain[3][3], double *left,
                       struct gb_error *err)
{
    struct gb_error refused = {0};
    if (apply(probe, strain, probe->motion, &refused)) {
        *left = imbalance(probe->world);
        return true;
    }
    *left = INFINITY;
    return refused.code == GB_ERR_GUARD ||
           gb_error_set(err, refused.code, "%s", refused.text);
}

/* Forces and torques of the last evaluation into one vector. */
static void read_forces(struct gb_probe *probe)
{
    const struct gb_bodies b = gb_world_bodies(probe->world);
    const size_t numbers = 3 * (size_t)b.count;
    memcpy(probe->force, b.force, numbers * sizeof *b.force);
    memcpy(probe->force + numbers, b.torque, numbers * sizeof *b.torque);
}

/* Step of the differences of a tangent: a share of the motion of contacts. */
static double difference_step(const double strain[3][3])
{
    double most = 0.0;
    for (int k = 0; k < 9; k++) {
        most = fmax(most, fabs(strain[k / 3][k % 3]));
    }
    const double step = most > 0.0 ? GB_PROBE_TANGENT_STEP * most : GB_PROBE_TANGENT_REST;
    return fmin(fmax(step, GB_PROBE_TANGENT_LEAST), GB_PAIR_TANGENT_STEP);
}

/* Stiffness matrix of the saved state after the motion so far. */
static bool renew_local(struct gb_probe *probe, const double strain[3][3],
                        struct gb_error *err)
{
    struct gb_pair_tangent_motion motion = {.motion = probe->motion};
    memcpy(motion.strain, strain, sizeof motion.strain);
    motion.step = difference_step(strain);
    return gb_world_copy_restore(probe->world, probe->base, err) &&
           gb_world_evaluate(probe->world, err) &&
           (probe->local
                ? gb_tangent_renew(probe->local, probe->world, &motion, err)
                : gb_tangent_create(&probe->local, probe->world, err) &&
                      gb_tangent_renew(probe->local, probe->world, &motion, err));
}

/* motion += factor * step */
static void move(struct gb_probe *probe, double factor)
{
    for (int64_t k = 0; k < 6 * probe->model.count; k++) {
        probe->motion[k] += factor * probe->step[k];
    }
}

/* A Newton step, halved until the imbalance falls, or rises little: contacts that begin or
 * cease to slide raise it once.  False in *fell if it does neither. */
static bool improve(struct gb_probe *probe, const double strain[3][3], double *left,
                    int *rises, bool *fell, struct gb_error *err)
{
    double factor = 1.0;
    read_forces(probe);
    if (!renew_local(probe, strain, err)) {
        return false;
    }
    probe->iterations += gb_tangent_solve(probe->local, probe->force, linear_share,
                                          ITERATIONS_MAX, probe->step);
    move(probe, factor);
    for (int halving = 0; halving <= HALVINGS_MAX; halving++) {
        double now;
        if (!try_motion(probe, strain, &now, err)) {
            return false;
        }
        *fell = now < (1.0 - GB_PROBE_FALL * factor) * *left ||
                (*rises > 0 && now < GB_PROBE_RISE * *left);
        *rises -= now > *left && *fell;
        if (*fell) {
            *left = now;
            return true;
        }
        move(probe, -0.5 * factor);
        factor *= 0.5;
    }
    move(probe, -factor);
    return apply(probe, strain, probe->motion, err);
}

/* FIRE from where Newton's method has ended. */
static bool relax(struct gb_probe *probe, double target, struct gb_error *err)
{
    const double scale = imbalance(probe->world) / gb_world_residual(probe->world);
    enum gb_relax_outcome outcome = GB_RELAX_MORE;
    probe->fallbacks++;
    probe->relax->tolerance = target / scale;
    gb_relax_start(probe->relax, probe->world);
    while (outcome == GB_RELAX_MORE) {
        outcome = gb_relax_advance(probe->relax, probe->world, SLICE, err);
        if (!check_cancelled(probe, err)) {
            return false;
        }
    }
    return outcome != GB_RELAX_FAILED;
}

static bool settle(struct gb_probe *probe, const double strain[3][3], double target,
                   struct gb_error *err)
{
    double left = imbalance(probe->world);
    bool falls = true;
    int rises = RISES_MAX;
    for (int k = 0; k < NEWTON_MAX && falls && left > target; k++) {
        if (!improve(probe, strain, &left, &rises, &falls, err)) {
            return false;
        }
    }
    const double enough = fmax(target, GB_PROBE_ROUNDING_LEFT * rounding(probe->world));
    return left <= enough || relax(probe, target, err);
}

bool gb_probe_strain(struct gb_probe *probe, const double strain[3][3], double first,
                     double share, double pressure[3][3], struct gb_error *err)
{
    double sum = 0.0;
    gb_tangent_affine(probe->tangent, strain, probe->force);
    for (int64_t k = 0; k < 6 * probe->model.count; k++) {
        probe->motion[k] *= first;
        sum += probe->force[k] * probe->force[k];
    }
    const double affine = sqrt(sum / (double)probe->model.count);
    const double target = fmax(share * affine, rounding(probe->world));
    if (!apply(probe, strain, probe->motion, err) ||
        !settle(probe, strain, target, err)) {
        return false;
    }
    gb_world_pressure(probe->world, pressure);
    return true;
}

static bool renew_tangent(struct gb_probe *probe, struct gb_error *err)
{
    gb_tangent_destroy(probe->tangent);
    probe->tangent = NULL;
    probe->residual = gb_world_residual(probe->world);
    gb_world_pressure(probe->world, probe->pressure);
    return gb_tangent_create(&probe->tangent, probe->world, err);
}

bool gb_probe_advance(struct gb_probe *probe, struct gb_error *err)
{
    return gb_world_copy_save(probe->world, &probe->base, err) &&
           renew_tangent(probe, err);
}

bool gb_probe_save(const struct gb_probe *probe, struct gb_world_copy **copy,
                   struct gb_error *err)
{
    return gb_world_copy_restore(probe->world, probe->base, err) &&
           gb_world_evaluate(probe->world, err) &&
           gb_world_copy_save(probe->world, copy, err);
}

bool gb_probe_return(struct gb_probe *probe, const struct gb_world_copy *copy,
                     struct gb_error *err)
{
    return gb_world_copy_restore(probe->world, copy, err) &&
           gb_world_evaluate(probe->world, err) && gb_probe_advance(probe, err);
}

/* From the state of a run to equilibrium within GB_PROBE_RESIDUAL: FIRE as far as Newton's
 * method needs it, then Newton's method in one increment. */
static bool balance(struct gb_probe *probe, struct gb_error *err)
{
    static const double none[3][3] = {{0.0}};
    const double scale = imbalance(probe->world) / gb_world_residual(probe->world);
    const double target = fmax(GB_PROBE_RESIDUAL * scale, rounding(probe->world));
    if (imbalance(probe->world) > GB_PROBE_RESIDUAL_START * scale &&
        !relax(probe, GB_PROBE_RESIDUAL_START * scale, err)) {
        return false;
    }
    if (imbalance(probe->world) > target) {
        if (!gb_probe_advance(probe, err)) {
            return false;
        }
        memset(probe->motion, 0, 6 * (size_t)probe->model.count * sizeof(double));
        if (!settle(probe, none, target, err)) {
            return false;
        }
    }
    return gb_probe_advance(probe, err);
}

/* The same from a state in single precision, whose sliding contacts slide here as well.
 * Each motion to equilibrium takes some of them off their caps, by less each time. */
static bool balance_rounded(struct gb_probe *probe, struct gb_error *err)
{
    double most = INFINITY;
    for (int k = 0; k < GB_PROBE_CAPS_ROUNDS && most > GB_PROBE_CAPS; k++) {
        if (!gb_cap_rounding_undo(probe->world, &most, err) ||
            !gb_world_evaluate(probe->world, err) || !balance(probe, err)) {
            return false;
        }
    }
    return true;
}

static bool copy_world(struct gb_probe *probe, const struct gb_world *world,
                       struct gb_error *err)
{
    const bool rounded = gb_world_model(world)->numerics.single;
    struct gb_world_copy *start = NULL;
    bool done =
        gb_world_create(&probe->world, &probe->model, gb_world_position(world), err) &&
        gb_world_copy_save(world, &start, err) &&
        gb_world_copy_restore(probe->world, start, err) &&
        gb_world_evaluate(probe->world, err) &&
        (rounded ? balance_rounded(probe, err) : balance(probe, err));
    if (done) {
        const struct gb_nonaffine moved = gb_nonaffine_since(probe->world, start);
        probe->moved_rms = moved.rms;
        probe->moved_most = moved.farthest;
        done = probe->residual <= GB_PROBE_RESIDUAL_MAX ||
               gb_error_set(err, GB_ERR_INPUT,
                            "no equilibrium near this state: the residual stays at %.1e "
                            "of the mean contact force",
                            probe->residual);
    }
    gb_world_copy_destroy(start);
    return done;
}

bool gb_probe_create(struct gb_probe **out, const struct gb_world *world,
                     bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct gb_probe *probe = gb_alloc_array(1, sizeof *probe, err);
    if (!probe) {
        return false;
    }
    const size_t numbers = 6 * (size_t)gb_world_model(world)->count;
    probe->model = *gb_world_model(world);
    probe->model.kind = GB_KIND_QUASISTATIC;
    probe->model.numerics.single = false;
    probe->model.numerics.tolerance_scale = GB_TOLERANCE_CONTACT;
    snprintf(probe->model.numerics.relaxer, sizeof probe->model.numerics.relaxer, "fire");
    probe->model.numerics.max_evaluations = GB_PROBE_EVALUATIONS_MAX;
    probe->cancelled = cancelled;
    probe->data = data;
    probe->motion = gb_alloc_array(numbers, sizeof *probe->motion, err);
    probe->force = gb_alloc_array(numbers, sizeof *probe->force, err);
    probe->step = gb_alloc_array(numbers, sizeof *probe->step, err);
    if (!probe->motion || !probe->force || !probe->step ||
        !gb_relax_create(&probe->relax, &probe->model, err) ||
        !copy_world(probe, world, err)) {
        gb_probe_destroy(probe);
        return false;
    }
    *out = probe;
    return true;
}

void gb_probe_destroy(struct gb_probe *probe)
{
    if (!probe) {
        return;
    }
    gb_tangent_destroy(probe->tangent);
    gb_tangent_destroy(probe->local);
    gb_relax_destroy(probe->relax);
    gb_world_copy_destroy(probe->base);
    gb_world_destroy(probe->world);
    gb_alloc_free(probe->motion);
    gb_alloc_free(probe->force);
    gb_alloc_free(probe->step);
    gb_alloc_free(probe);
}
