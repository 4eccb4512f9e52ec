#include "solve/moduli/tangent.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
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

bool gb_tangent_create(struct gb_tangent **out, const struct gb_world *world,
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
    if (!whole || !gb_tangent_renew(tangent, world, NULL, err)) {
        gb_tangent_destroy(tangent);
        return false;
    }
    *out = tangent;
    return true;
}

bool gb_tangent_renew(struct gb_tangent *tangent, const struct gb_world *world,
                      const struct gb_pair_tangent_motion *motion, struct gb_error *err)
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

void gb_tangent_destroy(struct gb_tangent *tangent)
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

double gb_tangent_affine(const struct gb_tangent *tangent, const double strain[3][3],
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

void gb_tangent_virial(const struct gb_tangent *tangent, const double strain[3][3],
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
int gb_tangent_solve(struct gb_tangent *tangent, const double *force, double tolerance,
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
