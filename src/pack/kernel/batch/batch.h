#ifndef GB_PACK_KERNEL_BATCH_BATCH_H
#define GB_PACK_KERNEL_BATCH_BATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/cell/contacts.h"
#include "pack/kernel/tally.h"
#include "scene/model.h"

/* The contact laws over batches of pairs, in vector registers. */

enum { GB_BATCH = 128, GB_LANES = 8 };

/* Inputs and outputs of the laws for a batch of pairs, in double or single precision. */
#define GB_BATCH_OF(name, real, bits)                                                      \
    struct name {                                                                          \
        int n;                                                                             \
        real cutoff2; /* squared reach of the attraction, d^2 */                           \
        real damp;    /* viscous time A over time step; viscous scenes only */             \
        real loose;   /* number of contacts without a bridge, between the halves */        \
        /* in: branch vectors r_ij, sum and difference of the rotation increments of     \
         * i and j since the last evaluation */ \
        _Alignas(64) real r[3][GB_BATCH];                                                  \
        real rotation_sum[3][GB_BATCH], rotation_difference[3][GB_BATCH];                  \
        real diameter[2][GB_BATCH]; /* of i and j; unequal sizes only */                   \
        /* out: force on i (the opposite acts on j), torques on i and on j */              \
        real force[3][GB_BATCH], torque_i[3][GB_BATCH], torque_j[3][GB_BATCH];             \
        real normal[GB_BATCH];   /* |f_n| of contacts, 0 elsewhere */                      \
        real overlap[GB_BATCH];  /* h */                                                   \
        real sliding[GB_BATCH];  /* 1: shear spring at its cap */                          \
        real absorbed[GB_BATCH]; /* work absorbed in this step; viscous scenes */          \
        /* from the first half of a law to the second */                                   \
        real unit[3][GB_BATCH], distance[GB_BATCH], moment[GB_BATCH];                      \
        bits lasts[GB_BATCH]; /* all bits: in contact before and now */                    \
        /* squared springs of shear and rolling, before and after their rotation */        \
        real square[4][GB_BATCH];                                                          \
        real rate[8][GB_BATCH]; /* increments of the springs; 7: of h */                   \
        /* parts of the normal force; the force, its slope, and it without adhesion */     \
        real root[GB_BATCH], tail_at[GB_BATCH], rod_slope[GB_BATCH], pull[GB_BATCH];       \
        real along[GB_BATCH], slope[GB_BATCH], elastic[GB_BATCH];                          \
        /* of shear, pivoting and rolling: what the cap leaves of a spring; 1: below it */ \
        real stiffness[3][GB_BATCH], kept[3][GB_BATCH], below[3][GB_BATCH];                \
        /* unequal sizes: 1/d_i, 1/d_j, their mean D, 1/D and d' = d_i d_j/D */            \
        real inverse[2][GB_BATCH], mean[GB_BATCH], inverse_mean[GB_BATCH],                 \
            reduced[GB_BATCH];                                                             \
    };
GB_BATCH_OF(gb_batch, double, uint64_t)
GB_BATCH_OF(gb_batch_f32, float, uint32_t)
#undef GB_BATCH_OF

/* Advances contacts [slot, slot + batch->n) and fills the outputs.
 *
 * The increment of relative motion is r minus the stored branch vector, so it includes
 * the affine motion of the cell.  Stored vectors are rotated into the current tangent
 * plane keeping their length before the increment is added.  Source: P1 (1)-(12);
 * viscous forces P2 (3); unequal sizes by law/law_unequal.h, with rotations that are arcs
 * and torques over the diameters (pack/kernel/sweep_f64.h). */
struct gb_batch_kernel {
    void (*advance)(const struct gb_model *model, struct gb_batch *batch,
                    struct gb_contacts *contacts, int64_t slot);
    /* Adds a batch to a tally: lane by lane, then the lanes, whatever the vector width.
     */
    void (*tally)(struct gb_batch *batch, const struct gb_contacts *contacts,
                  int64_t slot, struct gb_tally *tally);
    /* Pairs across a gap: fills the forces.  In viscous scenes also updates the distances
     * and attractions of the last evaluation (0: none yet) and adds work and virial to the
     * tally. */
    void (*attract)(const struct gb_model *model, struct gb_batch *batch,
                    double *last_distance, double *last_pull, struct gb_tally *tally);
};

/* The same in single precision, for quasi-static scenes in 3D. */
struct gb_batch_f32_kernel {
    void (*advance)(const struct gb_model *model, struct gb_batch_f32 *batch,
                    struct gb_contacts *contacts, int64_t slot);
    void (*tally)(struct gb_batch_f32 *batch, const struct gb_contacts *contacts,
                  int64_t slot, struct gb_tally *tally);
    void (*attract)(const struct gb_model *model, struct gb_batch_f32 *batch);
    /* Branch vectors and forces on the first particles after the last `advance`, from the
     * contact records, which do not change. */
    void (*recompute)(const struct gb_model *model, struct gb_batch_f32 *batch,
                      const struct gb_contacts *contacts, int64_t slot);
};

/* The variant for this scene and this processor; it computes only the terms of the scene.
 * widest: 0 picks by processor, 128, 256 or 512 limits the vectors (tests). */
struct gb_batch_kernel gb_batch_pick(const struct gb_model *model, int widest);
struct gb_batch_f32_kernel gb_batch_f32_pick(const struct gb_model *model, int widest);

#endif
