#ifndef GB_PACK_KERNEL_TALLY_H
#define GB_PACK_KERNEL_TALLY_H

#include <stdint.h>

/* Sums of a sweep over its pairs, in a fixed order. */
struct gb_tally {
    int64_t contacts;  /* pairs with r < d */
    int64_t sliding;   /* contacts with the shear spring at its cap */
    double normal_sum; /* sum of |f_n| over contacts, E d^2 */
    double deepest; /* largest overlap, in diameters of the smaller particle of a pair */
    /* dynamic scenes: */
    double absorbed;  /* work absorbed by the pairs since the last evaluation, E d^3 */
    double virial[3]; /* sum of f_k r_k over pairs, axis by axis (x, y, z), E d^3 */
};

/* Sums over the forces on the particles. */
struct gb_force_sums {
    double force2, torque2; /* sums of squares */
    double power;           /* along the velocities given to the evaluation; else 0 */
};

/* Of one block of particles (pack/list/blocks.h), or of all. */
struct gb_tally_block {
    struct gb_tally tally;
    struct gb_force_sums sums;
};

/* Velocities of the particles and of their rotations, count x 3 each, that the power of
 * the forces is summed along; in single precision those of integrate_f32.c are used. */
struct gb_sweep_along {
    const double *velocity, *spin; /* NULL: no power */
};

#endif
