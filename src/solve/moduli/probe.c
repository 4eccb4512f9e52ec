#include "solve/moduli/probe.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/deformation.h"
#include "base/mat.h"
#include "base/vec.h"
#include "greenbody/status.h"
#include "pack/cell/nonaffine.h"
#include "pack/cell/world.h"
#include "pack/kernel/pair_tangent.h"
#include "scene/tolerances.h"

enum { WIDTH = GB_PAIR_TANGENT_WIDTH, BLOCK = 6 };

/* Unit motions of a particle in the nine numbers of a pair: of the first, of the other. */
static void motion_of(int side, int freedom, double motion[WIDTH])
{
    memset(motion, 0, WIDTH * sizeof *motion);
    if (freedom < 3) {
        motion[freedom] = side == 0 ? 1.0 : -1.0;
    } else {
        motion[3 * side + freedom] = 1.0;
    }
}

static double product(const struct gb_pair_tangent *pair, const double a[WIDTH],
                      const double b[WIDTH])
{
    double sum = 0.0;
    for (int m = 0; m < WIDTH; m++) {
        for (int n = 0; n < WIDTH; n++) {
            sum += a[m] * pair->stiffness[m][n] * b[n];
        }
    }
    return sum;
}

/* Adds the symmetric part of a pair to the diagonal block of one of its particles. */
static void add_block(const struct gb_pair_tangent *pair, int side, double *block)
{
    double a[WIDTH], b[WIDTH];
    for (int m = 0; m < BLOCK; m++) {
        motion_of(side, m, a);
        for (int n = 0; n < BLOCK; n++) {
            motion_of(side, n, b);
            block[BLOCK * m + n] += 0.5 * (product(pair, a, b) + product(pair, b, a));
        }
    }
}

/* Lower triangle L of a = L L^T; false if a is not positive definite. */
static bool factor(const double *a, double lower[BLOCK][BLOCK])
{
    for (int m = 0; m < BLOCK; m++) {
        for (int n = 0; n <= m; n++) {
            double sum = a[BLOCK * m + n];
            for (int k = 0; k < n; k++) {
                sum -= lower[m][k] * lower[n][k];
            }
            if (m == n && !(sum > 0.0)) {
                return false;
            }
            lower[m][n] = m == n ? sqrt(sum) : sum / lower[n][n];
        }
    }
    return true;
}

/* Column c of the inverse. */
static void invert_column(const double lower[BLOCK][BLOCK], int c, double *column)
{
    for (int m = 0; m < BLOCK; m++) {
        double sum = m == c ? 1.0 : 0.0;
        for (int k = 0; k < m; k++) {
            sum -= lower[m][k] * column[k];
        }
        column[m] = sum / lower[m][m];
    }
    for (int m = BLOCK - 1; m >= 0; m--) {
        for (int k = m + 1; k < BLOCK; k++) {
            column[m] -= lower[k][m] * column[k];
        }
        column[m] /= lower[m][m];
    }
}

/* Inverse in place; directions without stiffness are held by a weak spring, and a block
 * that is not positive definite is replaced by its mean stiffness. */
static void invert(double *block)
{
    double trace = 0.0, lower[BLOCK][BLOCK];
    for (int m = 0; m < BLOCK; m++) {
        trace += fabs(block[(BLOCK + 1) * m]);
    }
    for (int m = 0; m < BLOCK; m++) {
        block[(BLOCK + 1) * m] += GB_TANGENT_HOLD * trace;
    }
    if (factor(block, lower)) {
        for (int c = 0; c < BLOCK; c++) {
            invert_column((const double(*)[BLOCK])lower, c, block + BLOCK * c);
        }
        return;
    }
    memset(block, 0, BLOCK * BLOCK * sizeof *block);
    for (int m = 0; m < BLOCK && trace > 0.0; m++) {
        block[(BLOCK + 1) * m] = BLOCK / trace;
    }
}

/* Columns instead of rows, so that products are sums of vectors. */
static void transpose(struct gb_pair_tangent *pair)
{
    for (int m = 0; m < WIDTH; m++) {
        for (int n = 0; n < m; n++) {
            const double other = pair->stiffness[m][n];
            pair->stiffness[m][n] = pair->stiffness[n][m];
            pair->stiffness[n][m] = other;
        }
    }
}

static void fill_blocks(struct gb_tangent *tangent)
{
    for (int64_t p = 0; p < tangent->pairs; p++) {
        struct gb_pair_tangent *pair = &tangent->pair[p];
        transpose(pair);
        add_block(pair, 0, tangent->inverse + BLOCK * BLOCK * (int64_t)pair->first);
        add_block(pair, 1, tangent->inverse + BLOCK * BLOCK * (int64_t)pair->other);
    }
    for (int64_t i = 0; i < tangent->count; i++) {
        invert(tangent->inverse + BLOCK * BLOCK * i);
    }
}

/* Another motion of the same world. */
static bool tangent_renew(struct gb_tangent *tangent, const struct gb_world *world,
                          const struct gb_pair_tangent_motion *motion,
                          struct gb_error *err)
{
    const size_t numbers = BLOCK * BLOCK * (size_t)tangent->count;
    gb_alloc_free(tangent->pair);
    tangent->pair = NULL;
    memset(tangent->inverse, 0, numbers * sizeof *tangent->inverse);
    if (!gb_pair_tangent_list(world, motion, &tangent->pair, &tangent->pairs, err)) {
        return false;
    }
    fill_blocks(tangent);
    return true;
}

/* NULL is fine */
static void tangent_destroy(struct gb_tangent *tangent)
{
    if (!tangent) {
        return;
    }
    for (int v = 0; v < 5; v++) {
        gb_alloc_free(tangent->scratch[v]);
    }
    gb_alloc_free(tangent->inverse);
    gb_alloc_free(tangent->pair);
    gb_alloc_free(tangent);
}

/* Of a world in double precision right after an evaluation; the world does not change.
 * motion: as of gb_pair_tangent_list; NULL is fine. */
static bool tangent_create(struct gb_tangent **out, const struct gb_world *world,
                           struct gb_error *err)
{
    struct gb_tangent *tangent = gb_alloc_array(1, sizeof *tangent, err);
    if (!tangent) {
        return false;
    }
    tangent->count = gb_world_model(world)->count;
    const size_t count = (size_t)tangent->count;
    tangent->inverse = gb_alloc_array(BLOCK * BLOCK * count, sizeof(double), err);
    bool whole = tangent->inverse != NULL;
    for (int v = 0; v < 5 && whole; v++) {
        tangent->scratch[v] = gb_alloc_array(BLOCK * count, sizeof(double), err);
        whole = tangent->scratch[v] != NULL;
    }
    if (!whole || !tangent_renew(tangent, world, NULL, err)) {
        tangent_destroy(tangent);
        return false;
    }
    *out = tangent;
    return true;
}

/* Minus the change of the nine conjugates. */
static void respond(const struct gb_pair_tangent *pair, const double motion[WIDTH],
                    double result[WIDTH])
{
    memset(result, 0, WIDTH * sizeof *result);
    for (int n = 0; n < WIDTH; n++) {
        const double *column = pair->stiffness[n];
        const double by = motion[n];
        for (int m = 0; m < WIDTH; m++) {
            result[m] += column[m] * by;
        }
    }
}

/* Motion of a pair in a motion of all particles. */
static void gather(const struct gb_tangent *tangent, const struct gb_pair_tangent *pair,
                   const double *motion, double out[WIDTH])
{
    const double *rotation = motion + 3 * tangent->count;
    const int64_t i = 3 * (int64_t)pair->first, j = 3 * (int64_t)pair->other;
    for (int c = 0; c < 3; c++) {
        out[c] = motion[i + c] - motion[j + c];
        out[3 + c] = rotation[i + c];
        out[6 + c] = rotation[j + c];
    }
}

/* Adds the conjugates of a pair times `sign` to forces and torques. */
static void scatter(const struct gb_tangent *tangent, const struct gb_pair_tangent *pair,
                    const double result[WIDTH], double sign, double *force)
{
    double *torque = force + 3 * tangent->count;
    const int64_t i = 3 * (int64_t)pair->first, j = 3 * (int64_t)pair->other;
    for (int c = 0; c < 3; c++) {
        force[i + c] += sign * result[c];
        force[j + c] -= sign * result[c];
        torque[i + c] += sign * result[3 + c];
        torque[j + c] += sign * result[6 + c];
    }
}

double gb_probe_affine(const struct gb_tangent *tangent, const double strain[3][3],
                       double *force)
{
    double sum = 0.0;
    memset(force, 0, BLOCK * (size_t)tangent->count * sizeof *force);
    for (int64_t p = 0; p < tangent->pairs; p++) {
        const struct gb_pair_tangent *pair = &tangent->pair[p];
        double motion[WIDTH] = {0}, result[WIDTH];
        gb_mat_apply(strain, pair->r, motion);
        respond(pair, motion, result);
        scatter(tangent, pair, result, -1.0, force);
        sum += 2.0 * gb_vec_dot(result, result);
    }
    return sqrt(sum);
}

void gb_probe_virial(const struct gb_tangent *tangent, const double strain[3][3],
                     const double *motion, double change[3][3])
{
    memset(change, 0, 9 * sizeof **change);
    for (int64_t p = 0; p < tangent->pairs; p++) {
        const struct gb_pair_tangent *pair = &tangent->pair[p];
        double affine[3], own[WIDTH], result[WIDTH];
        gb_mat_apply(strain, pair->r, affine);
        gather(tangent, pair, motion, own);
        gb_vec_add(own, 1.0, affine);
        respond(pair, own, result);
        for (int a = 0; a < 3; a++) {
            gb_vec_add(change[a], -result[a], pair->r);
            gb_vec_add(change[a], pair->force[a], own);
        }
    }
}

static void multiply(const struct gb_tangent *tangent, const double *motion,
                     double *force)
{
    memset(force, 0, BLOCK * (size_t)tangent->count * sizeof *force);
    for (int64_t p = 0; p < tangent->pairs; p++) {
        const struct gb_pair_tangent *pair = &tangent->pair[p];
        double own[WIDTH], result[WIDTH];
        gather(tangent, pair, motion, own);
        respond(pair, own, result);
        scatter(tangent, pair, result, 1.0, force);
    }
}

/* Inverse blocks of the diagonal times a vector. */
static void precondition(const struct gb_tangent *tangent, const double *force,
                         double *motion)
{
    const int64_t rotations = 3 * tangent->count;
    for (int64_t i = 0; i < tangent->count; i++) {
        const double *inverse = tangent->inverse + BLOCK * BLOCK * i;
        double in[BLOCK];
        for (int m = 0; m < BLOCK; m++) {
            in[m] = force[(m < 3 ? 0 : rotations - 3) + 3 * i + m];
        }
        for (int m = 0; m < BLOCK; m++) {
            double sum = 0.0;
            for (int n = 0; n < BLOCK; n++) {
                sum += inverse[BLOCK * m + n] * in[n];
            }
            motion[(m < 3 ? 0 : rotations - 3) + 3 * i + m] = sum;
        }
    }
}

static double dot(const double *a, const double *b, int64_t n)
{
    double sum = 0.0;
    for (int64_t k = 0; k < n; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

static void add(double *a, double factor, const double *b, int64_t n)
{
    for (int64_t k = 0; k < n; k++) {
        a[k] += factor * b[k];
    }
}

/* A direction of the biconjugate gradients: preconditioned, and the forces against it. */
static void follow(const struct gb_tangent *tangent, const double *direction,
                   double *motion, double *force)
{
    precondition(tangent, direction, motion);
    multiply(tangent, motion, force);
}

/* Source: H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13, 631 (1992), with the
 * preconditioner from the right; rest is the residual, mirror the residual at the start. */
int gb_probe_solve(struct gb_tangent *tangent, const double *force, double tolerance,
                   int iterations_max, double *motion)
{
    const int64_t n = BLOCK * tangent->count;
    const size_t bytes = (size_t)n * sizeof *motion;
    double *rest = tangent->scratch[0], *direction = tangent->scratch[1];
    double *pushed = tangent->scratch[2], *moved = tangent->scratch[3];
    double *bent = tangent->scratch[4];
    const double *mirror = force;
    const double target = tolerance * tolerance * dot(force, force, n);
    memset(motion, 0, bytes);
    memcpy(rest, force, bytes);
    memcpy(direction, force, bytes);
    double rate = dot(mirror, rest, n);
    int iterations = 0;
    while (iterations < iterations_max && dot(rest, rest, n) > target) {
        follow(tangent, direction, moved, pushed);
        const double along = rate / dot(mirror, pushed, n);
        if (!isfinite(along)) {
            break;
        }
        add(motion, along, moved, n);
        add(rest, -along, pushed, n);
        follow(tangent, rest, moved, bent);
        const double length2 = dot(bent, bent, n);
        const double smooth = length2 > 0.0 ? dot(bent, rest, n) / length2 : 0.0;
        add(motion, smooth, moved, n);
        add(rest, -smooth, bent, n);
        const double next = dot(mirror, rest, n), share = next / rate * along / smooth;
        iterations++;
        if (!isfinite(share)) {
            break;
        }
        for (int64_t k = 0; k < n; k++) {
            direction[k] = rest[k] + share * (direction[k] - smooth * pushed[k]);
        }
        rate = next;
    }
    return iterations;
}

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
           (probe->local ? tangent_renew(probe->local, probe->world, &motion, err)
                         : tangent_create(&probe->local, probe->world, err) &&
                               tangent_renew(probe->local, probe->world, &motion, err));
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
    probe->iterations += gb_probe_solve(probe->local, probe->force, linear_share,
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
    gb_probe_affine(probe->tangent, strain, probe->force);
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
    tangent_destroy(probe->tangent);
    probe->tangent = NULL;
    probe->residual = gb_world_residual(probe->world);
    gb_world_pressure(probe->world, probe->pressure);
    return tangent_create(&probe->tangent, probe->world, err);
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

/* From the state of a run to equilibrium within GB_PROBE_RESIDUAL: FIRE to the residual
 * `first`, then Newton's method in one increment. */
static bool balance(struct gb_probe *probe, double first, struct gb_error *err)
{
    static const double none[3][3] = {{0.0}};
    const double scale = imbalance(probe->world) / gb_world_residual(probe->world);
    const double target = fmax(GB_PROBE_RESIDUAL * scale, rounding(probe->world));
    if (imbalance(probe->world) > first * scale && !relax(probe, first * scale, err)) {
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
static bool balance_rounded(struct gb_probe *probe, double first, struct gb_error *err)
{
    double most = INFINITY;
    for (int k = 0; k < GB_PROBE_CAPS_ROUNDS && most > GB_PROBE_CAPS; k++) {
        if (!gb_pair_tangent_undo(probe->world, &most, err) ||
            !gb_world_evaluate(probe->world, err) || !balance(probe, first, err)) {
            return false;
        }
    }
    return true;
}

/* A copy of a state in equilibrium.  first: residual at which Newton's method takes over. */
static bool balance_from(struct gb_probe *probe, const struct gb_world_copy *start,
                         bool rounded, double first, struct gb_error *err)
{
    return gb_world_copy_restore(probe->world, start, err) &&
           gb_world_evaluate(probe->world, err) &&
           (rounded ? balance_rounded(probe, first, err) : balance(probe, first, err));
}

/* Do the smallest strains of both signs change the stress by opposite amounts?  Contacts that
 * slide one way only make them differ by up to a fifth.  An equilibrium of Newton's method may be
 * unstable: then particles leave it, and the stress jumps by the same amount at any strain. */
static bool is_stable(struct gb_probe *probe, struct gb_error *err)
{
    static const double size = GB_PROBE_STRAIN_MIN;
    const double strain[2][3][3] = {
        {{0.0, 0.0, size}, {0.0, 0.0, 0.0}, {size, 0.0, size}},
        {{0.0, 0.0, -size}, {0.0, 0.0, 0.0}, {-size, 0.0, -size}}};
    double pressure[2][3][3], apart = 0.0, change = 0.0;
    for (int side = 0; side < 2; side++) {
        memset(probe->motion, 0, BLOCK * (size_t)probe->model.count * sizeof(double));
        if (!gb_probe_strain(probe, strain[side], 0.0, GB_PROBE_SHARE, pressure[side],
                             err)) {
            return false;
        }
    }
    for (int k = 0; k < 9; k++) {
        const double rest = probe->pressure[k / 3][k % 3];
        const double one = pressure[0][k / 3][k % 3] - rest;
        const double other = pressure[1][k / 3][k % 3] - rest;
        apart = fmax(apart, fabs(one + other));
        change = fmax(change, fabs(one - other));
    }
    return apart <= GB_PROBE_ASYMMETRY * change;
}

static bool copy_world(struct gb_probe *probe, const struct gb_world *world,
                       struct gb_error *err)
{
    const bool rounded = gb_world_model(world)->numerics.single;
    struct gb_world_copy *start = NULL;
    struct gb_error refused = {0};
    bool done =
        gb_world_create(&probe->world, &probe->model, gb_world_position(world), err) &&
        gb_world_copy_save(world, &start, err) &&
        balance_from(probe, start, rounded, GB_PROBE_RESIDUAL_START, err);
    if (done && is_stable(probe, &refused)) {
        done = gb_world_copy_restore(probe->world, probe->base, err) &&
               gb_world_evaluate(probe->world, err);
    } else if (done) {
        done = check_cancelled(probe, err) &&
               balance_from(probe, start, rounded, GB_PROBE_RESIDUAL_STABLE, err);
    }
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
    tangent_destroy(probe->tangent);
    tangent_destroy(probe->local);
    gb_relax_destroy(probe->relax);
    gb_world_copy_destroy(probe->base);
    gb_world_destroy(probe->world);
    gb_alloc_free(probe->motion);
    gb_alloc_free(probe->force);
    gb_alloc_free(probe->step);
    gb_alloc_free(probe);
}
