#ifndef GB_PACK_KERNEL_BATCH_BATCH_TALLY_H
#define GB_PACK_KERNEL_BATCH_BATCH_TALLY_H

#include "pack/kernel/batch/batch_laws.h"

INLINE real lane_sum(const real *lane)
{
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
           ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/* Lanes that a batch is padded to: an even number of groups, summed in two chains. */
INLINE int whole_lanes(int n)
{
    return (n + 2 * GB_LANES - 1) / (2 * GB_LANES) * (2 * GB_LANES);
}

/* Adds the products of two arrays (times 1 where b is NULL) over whole lanes. */
INLINE real lane_total(const real *a, const real *b, int n)
{
    real even[GB_LANES] = {0}, odd[GB_LANES] = {0};
    for (int k = 0; k < n; k += 2 * GB_LANES) {
        for (int l = 0; l < GB_LANES; l++) {
            even[l] += b ? a[k + l] * b[k + l] : a[k + l];
        }
        for (int l = 0; l < GB_LANES; l++) {
            const int m = k + GB_LANES + l;
            odd[l] += b ? a[m] * b[m] : a[m];
        }
    }
    return lane_sum(even) + lane_sum(odd);
}

/* Sets the lanes behind the last pair to 0; returns the number of lanes. */
INLINE int pad_work(struct terms t, BATCH *b)
{
    const int whole = whole_lanes(b->n);
    for (int k = b->n; k < whole; k++) {
        b->absorbed[k] = 0;
        for (int c = 0; c < (t.planar ? 2 : 3); c++) {
            b->force[c][k] = b->r[c][k] = 0;
        }
    }
    return whole;
}

/* Absorbed work and virial of a batch; viscous scenes. */
INLINE void tally_work(struct terms t, BATCH *b, struct gb_tally *tally)
{
    const int whole = pad_work(t, b);
    tally->absorbed += lane_total(b->absorbed, NULL, whole);
    for (int c = 0; c < (t.planar ? 2 : 3); c++) {
        tally->virial[t.planar ? 2 * c : c] += lane_total(b->force[c], b->r[c], whole);
    }
}

INLINE void tally_batch(struct terms t, BATCH *b, const real *deepest,
                        struct gb_tally *tally)
{
    const int whole = whole_lanes(b->n);
    for (int k = b->n; k < whole; k++) {
        b->normal[k] = b->sliding[k] = 0;
    }
    real contacts = 0, most = (real)tally->deepest;
#pragma omp simd reduction(+ : contacts) reduction(max : most)
    for (int k = 0; k < b->n; k++) {
        contacts += mask(deepest[k] >= 0); /* whole numbers: the same in any order */
        const real h = b->overlap[k];      /* in D */
        const real larger_inverse = larger(b->inverse[0][k], b->inverse[1][k]);
        most = larger(t.sized ? h * b->mean[k] * larger_inverse : h, most);
    }
    tally->contacts += (int64_t)contacts;
    tally->deepest = most;
    tally->normal_sum += lane_total(b->normal, NULL, whole);
    if (t.friction) {
        tally->sliding += (int64_t)lane_total(b->sliding, NULL, whole);
    }
    if (t.viscous) {
        tally_work(t, b, tally);
    }
}

#endif
