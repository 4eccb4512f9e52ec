#ifndef GB_SOLVE_MODULI_MODULI_H
#define GB_SOLVE_MODULI_MODULI_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/world.h"

/* Elastic moduli of a packing at a state: C_ij = d sigma_i/d eps_j with the stress that is
 * already there, particles free to move and turn, contact histories as they are.
 *
 * Components 0 to 5 are xx, yy, zz, yz, xz, xy; strains of the last three are engineering
 * shears.  sigma = -(1/V) sum f_i r_j over pairs, V the volume after the strain: tension
 * is positive.  In 2D only xx, zz and xz are not 0. */
struct gb_moduli {
    double c[6][6];        /* E; first index stress, second strain */
    double pressure[3][3]; /* of the state, minus the stress; E */
    double density;        /* relative */
    double strain;         /* of the probes */
    double agreement;      /* largest difference of C at `strain` and at half of it, over
                             * the largest C */
    double elastic_range;  /* strain at which a secant has lost 5 %; NaN: not measured */
    bool range_open;       /* it is beyond elastic_range */
    double residual;       /* of the state, over the mean contact force */
    double moved_rms;      /* displacements to reach that, d */
    double moved_most;
    int64_t evaluations; /* of the forces, on the copy */
    int64_t iterations;  /* of the linear equations */
    int64_t fallbacks;   /* strains that Newton's method did not relax */
};

struct gb_moduli_options {
    bool range;                    /* measure the elastic range, too: doubles the time */
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *data;
};

/* Central differences on a copy in double precision; the world, right after an evaluation,
 * does not change by a bit.  Errors: of gb_probe_create. */
bool gb_moduli_measure(struct gb_moduli *moduli, const struct gb_world *world,
                       const struct gb_moduli_options *options, struct gb_error *err);

/* Symmetric strain whose component k is `size`. */
void gb_moduli_strain(int k, double size, double strain[3][3]);

#endif
