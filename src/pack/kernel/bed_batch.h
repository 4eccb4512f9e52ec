#ifndef GB_PACK_KERNEL_BED_BATCH_H
#define GB_PACK_KERNEL_BED_BATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "pack/die/bed_contacts.h"

enum { GB_BED_BATCH = 64 };

/* Inputs and outputs of the laws for a batch of contacts. */
struct gb_bed_batch {
    int n;
    double step; /* time since the last evaluation, for the shear increments */
    double mu;
    /* branch vector x_i - x_j and R_i + R_j, from which those of the next line come */
    _Alignas(64) double branch[3][GB_BED_BATCH];
    double reach[GB_BED_BATCH];
    /* in: normal, overlap h, and distance of the contact point from the centres over R */
    double unit[3][GB_BED_BATCH], overlap[GB_BED_BATCH], lever[GB_BED_BATCH];
    double slip[3][GB_BED_BATCH]; /* in: v_i - v_j of the centres */
    double held[GB_BED_BATCH];    /* in: stiffness over mass, summed over both partners */
    double holds[GB_BED_BATCH];   /* out: stiffness that it adds to either */
    double roll[3][GB_BED_BATCH]; /* in, friction: sum of both rolls */
    /* out: force on i; moment on either */
    double force[3][GB_BED_BATCH], moment[3][GB_BED_BATCH];
    /* from loop to loop: h/h_x, the binary logarithm of the elastic part over h_x, and that
     * part; normal force, its stiffness and the rate of the overlap; of the shear springs
     * what they become longer by, their squares before and after they were rotated, and a
     * factor */
    double ratio[GB_BED_BATCH], logarithm[GB_BED_BATCH], loaded[GB_BED_BATCH];
    double along[GB_BED_BATCH], stiffness[GB_BED_BATCH], approach[GB_BED_BATCH];
    double rate[3][GB_BED_BATCH], square[2][GB_BED_BATCH], kept[GB_BED_BATCH];
    double stiffest, impact; /* those of gb_bed_tally so far; in and out */
};

/* Advances contacts [slot, slot + batch->n) to the present and fills the outputs. */
typedef void gb_bed_kernel(const struct gb_bed_law *law, struct gb_bed_batch *batch,
                           struct gb_bed_contacts *contacts, int64_t slot);

enum gb_bed_partner { GB_BED_PARTNER_PARTICLE, GB_BED_PARTNER_WALL };

/* The variant for a law, a kind of contact and this processor; it computes only the
 * terms of that law.  widest: 0 picks by processor; 128, 256 or 512 limits the vectors
 * (tests). */
gb_bed_kernel *gb_bed_batch_pick(const struct gb_bed_law *law,
                                 enum gb_bed_partner partner, int widest);

/* Rows of four doubles of the particles, so that a vector is one load. */
typedef double gb_bed_row[4];

/* The partners of a batch: rows first[k] and other[k] + from of contact k.  Without friction
 * neither roll nor moment is used.  Gather: branch vectors, relative velocities and sums
 * of radii into the batch; of pairs normals, overlaps and levers instead of branch vectors and
 * sums of radii.  Scatter: forces and moments back.  A wall is a row as well, at the origin
 * without radius, so that `branch` and `reach` are those of the particle. */
struct gb_bed_rows {
    const gb_bed_row *position, *velocity, *roll;
    gb_bed_row *force, *moment;
    const int32_t *first, *other;
    const int32_t *target; /* row that the force on the second is added to */
    int32_t from;          /* 0 for pairs */
    bool friction;
};
typedef void gb_bed_gather(const struct gb_bed_rows *rows, struct gb_bed_batch *batch);
typedef void gb_bed_scatter(const struct gb_bed_rows *rows,
                            const struct gb_bed_batch *batch);

/* The variant for this processor, widest as above; all give the same bits. */
struct gb_bed_transfer {
    gb_bed_gather *gather, *gather_pairs;
    gb_bed_scatter *scatter;
};
struct gb_bed_transfer gb_bed_transfer_pick(int widest);

#endif
