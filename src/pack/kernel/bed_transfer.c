#include <math.h>

#include "pack/kernel/bed_batch.h"
#include "pack/kernel/simd.h"

/* Contacts [done, batch->n) one by one. */
static void gather_rest(const struct gb_bed_rows *rows, struct gb_bed_batch *b, int done)
{
    for (int k = done; k < b->n; k++) {
        const int32_t i = rows->first[k], j = rows->other[k] + rows->from;
        const double *xi = rows->position[i], *xj = rows->position[j];
        for (int c = 0; c < 3; c++) {
            b->branch[c][k] = xi[c] - xj[c];
            b->slip[c][k] = rows->velocity[i][c] - rows->velocity[j][c];
        }
        b->reach[k] = xi[3] + xj[3];
        b->held[k] = rows->velocity[i][3] + rows->velocity[j][3];
        for (int c = 0; c < 3 && rows->friction; c++) {
            b->roll[c][k] = rows->roll[i][c] + rows->roll[j][c];
        }
    }
}

/* Pairs: normal, overlap and lever from the branch vector.  The contact point divides it as
 * the radii do, so that the torques conserve angular momentum up to rounding. */
static void measure_rest(struct gb_bed_batch *b, int done)
{
#pragma omp simd
    for (int k = done; k < b->n; k++) {
        const double x = b->branch[0][k], y = b->branch[1][k], z = b->branch[2][k];
        const double r = sqrt(x * x + y * y + z * z), inverse = 1.0 / r;
        b->unit[0][k] = x * inverse;
        b->unit[1][k] = y * inverse;
        b->unit[2][k] = z * inverse;
        b->overlap[k] = b->reach[k] - r;
        b->lever[k] = r / b->reach[k];
    }
}

static void scatter_rest(const struct gb_bed_rows *rows, const struct gb_bed_batch *b,
                         int done)
{
    for (int k = done; k < b->n; k++) {
        const int32_t i = rows->first[k], to = rows->target[k];
        for (int c = 0; c < 3; c++) {
            rows->force[i][c] += b->force[c][k];
            rows->force[to][c] -= b->force[c][k];
        }
        rows->force[i][3] += b->holds[k];
        rows->force[to][3] += b->holds[k];
        for (int c = 0; c < 3 && rows->friction; c++) {
            rows->moment[i][c] += b->moment[c][k];
            rows->moment[to][c] += b->moment[c][k];
        }
    }
}

static void gather_128(const struct gb_bed_rows *rows, struct gb_bed_batch *batch)
{
    gather_rest(rows, batch, 0);
}

static void scatter_128(const struct gb_bed_rows *rows, const struct gb_bed_batch *batch)
{
    scatter_rest(rows, batch, 0);
}

static void gather_pairs_128(const struct gb_bed_rows *rows, struct gb_bed_batch *batch)
{
    gather_rest(rows, batch, 0);
    measure_rest(batch, 0);
}

static const struct gb_bed_transfer transfer_128 = {gather_128, gather_pairs_128,
                                                    scatter_128};

#if defined(__x86_64__) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define HAVE_256
#endif
#endif

#if defined(HAVE_256)
typedef double v4 __attribute__((vector_size(32), aligned(8), may_alias));

#define SHUFFLE __builtin_shufflevector
/* Four rows into four columns, in place. */
#define TRANSPOSE(a, b, c, d)                                                            \
    do {                                                                                 \
        const v4 ab_even = SHUFFLE(a, b, 0, 4, 2, 6),                                    \
                 cd_even = SHUFFLE(c, d, 0, 4, 2, 6);                                    \
        const v4 ab_odd = SHUFFLE(a, b, 1, 5, 3, 7), cd_odd = SHUFFLE(c, d, 1, 5, 3, 7); \
        a = SHUFFLE(ab_even, cd_even, 0, 1, 4, 5);                                       \
        b = SHUFFLE(ab_odd, cd_odd, 0, 1, 4, 5);                                         \
        c = SHUFFLE(ab_even, cd_even, 2, 3, 6, 7);                                       \
        d = SHUFFLE(ab_odd, cd_odd, 2, 3, 6, 7);                                         \
    } while (0)

#define ROW(rows, i) (*(const v4 *)(rows)[i])

/* As measure_rest, of four pairs.  Between gathered rows, as the processor divides and takes
 * roots while it loads and shuffles. */
GB_SIMD_LOOP GB_TARGET_256 void measure_four(const v4 branch[4], int k,
                                             struct gb_bed_batch *b)
{
    const v4 x = branch[0], y = branch[1], z = branch[2], reach = branch[3];
    const v4 square = x * x + y * y + z * z;
    v4 r;
    for (int p = 0; p < 4; p++) {
        r[p] = sqrt(square[p]);
    }
    const v4 inverse = 1.0 / r;
    *(v4 *)(b->unit[0] + k) = x * inverse;
    *(v4 *)(b->unit[1] + k) = y * inverse;
    *(v4 *)(b->unit[2] + k) = z * inverse;
    *(v4 *)(b->overlap + k) = reach - r;
    *(v4 *)(b->lever + k) = r / reach;
}

/* Rows of the particles of four pairs, then columns of the batch. */
GB_SIMD_LOOP GB_TARGET_256 void gather_fours(const struct gb_bed_rows *rows,
                                             struct gb_bed_batch *b, bool pairs)
{
    const int32_t *restrict first = rows->first, *restrict other = rows->other;
    const gb_bed_row *restrict position = rows->position;
    const gb_bed_row *restrict velocity = rows->velocity, *restrict rolls = rows->roll;
    const bool friction = rows->friction;
    const int32_t from = rows->from;
    const int n = b->n;
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        v4 branch[4], slip[4], roll[4] = {{0}};
        for (int p = 0; p < 4; p++) {
            const int32_t i = first[k + p], j = other[k + p] + from;
            const v4 xi = ROW(position, i), xj = ROW(position, j);
            branch[p] = SHUFFLE(xi - xj, xi + xj, 0, 1, 2, 7);
            const v4 vi = ROW(velocity, i), vj = ROW(velocity, j);
            slip[p] = SHUFFLE(vi - vj, vi + vj, 0, 1, 2, 7);
            if (friction) {
                roll[p] = ROW(rolls, i) + ROW(rolls, j);
            }
        }
        TRANSPOSE(branch[0], branch[1], branch[2], branch[3]);
        TRANSPOSE(slip[0], slip[1], slip[2], slip[3]);
        for (int c = 0; c < 3; c++) {
            *(v4 *)(b->slip[c] + k) = slip[c];
        }
        *(v4 *)(b->held + k) = slip[3];
        if (pairs) {
            measure_four(branch, k, b);
        } else {
            for (int c = 0; c < 3; c++) {
                *(v4 *)(b->branch[c] + k) = branch[c];
            }
            *(v4 *)(b->reach + k) = branch[3];
        }
        if (friction) {
            TRANSPOSE(roll[0], roll[1], roll[2], roll[3]);
            for (int c = 0; c < 3; c++) {
                *(v4 *)(b->roll[c] + k) = roll[c];
            }
        }
    }
    gather_rest(rows, b, k);
    if (pairs) {
        measure_rest(b, k);
    }
}

GB_TARGET_256 static void gather_256(const struct gb_bed_rows *rows,
                                     struct gb_bed_batch *batch)
{
    gather_fours(rows, batch, false);
}

GB_TARGET_256 static void gather_pairs_256(const struct gb_bed_rows *rows,
                                           struct gb_bed_batch *batch)
{
    gather_fours(rows, batch, true);
}

GB_TARGET_256 static void scatter_256(const struct gb_bed_rows *rows,
                                      const struct gb_bed_batch *b)
{
    const int32_t *restrict first = rows->first, *restrict target = rows->target;
    gb_bed_row *restrict force_of = rows->force, *restrict moment_of = rows->moment;
    const v4 opposite = {-1.0, -1.0, -1.0, 1.0};
    const bool friction = rows->friction;
    const int n = b->n;
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        v4 force[4], moment[4] = {{0}};
        for (int c = 0; c < 3; c++) {
            force[c] = *(const v4 *)(b->force[c] + k);
        }
        force[3] = *(const v4 *)(b->holds + k);
        TRANSPOSE(force[0], force[1], force[2], force[3]);
        for (int p = 0; p < 4; p++) {
            *(v4 *)force_of[first[k + p]] += force[p];
            *(v4 *)force_of[target[k + p]] += opposite * force[p];
        }
        if (!friction) {
            continue;
        }
        for (int c = 0; c < 3; c++) {
            moment[c] = *(const v4 *)(b->moment[c] + k);
        }
        TRANSPOSE(moment[0], moment[1], moment[2], moment[3]);
        for (int p = 0; p < 4; p++) {
            *(v4 *)moment_of[first[k + p]] += moment[p];
            *(v4 *)moment_of[target[k + p]] += moment[p];
        }
    }
    scatter_rest(rows, b, k);
}

static const struct gb_bed_transfer transfer_256 = {gather_256, gather_pairs_256,
                                                    scatter_256};
#endif

struct gb_bed_transfer gb_bed_transfer_pick(int widest)
{
#if defined(HAVE_256)
    return gb_simd_width(widest) >= 256 ? transfer_256 : transfer_128;
#else
    (void)widest;
    return transfer_128;
#endif
}
