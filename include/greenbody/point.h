#ifndef GREENBODY_POINT_H
#define GREENBODY_POINT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Branches of a run.  Positive numbers are unloading branches of quasi-static runs.
 * GB_BRANCH_UNLOAD to GB_BRANCH_EJECTED belong to a full die cycle.  Leg n > 1 of a
 * loading path is GB_BRANCH_LEG - n; leg 1 is GB_BRANCH_LOAD. */
enum {
    GB_BRANCH_RELAX = -1, /* relaxation before loading */
    GB_BRANCH_LOAD = 0,
    GB_BRANCH_HOLD = -2,     /* at the end density of a dynamic run */
    GB_BRANCH_UNLOAD = -3,   /* of the punch */
    GB_BRANCH_CONFINED = -4, /* rest in the die without the punch */
    GB_BRANCH_EJECT = -5,
    GB_BRANCH_EJECTED = -6, /* rest outside the die */
    GB_BRANCH_LEAST = -6,   /* the lowest number except legs */
    GB_BRANCH_LEG = -100
};

/* One recorded point of a run: one row of curve.csv.  The struct is part of the
 * interface of the library: add new members at the end.  Pressures are in Pa.  A value
 * that does not exist, such as py in 2D, is NaN.  p is the mean pressure over the
 * compressed axes, which the loading prescribes. */
struct gb_point {
    int branch;            /* GB_BRANCH_...; k >= 1: the k-th unloading branch */
    double branch_from_pa; /* pressure from which branch k unloads */
    int64_t step;
    double density;
    double px_pa, py_pa, pz_pa, p_pa;
    double coordination; /* pairs with r < d, per particle */
    double bridged;      /* fraction of these pairs with a bridge */
    double rattlers;     /* fraction of particles with fewer than two contacts */
    double residual;     /* rms force and torque over the force scale */
    int64_t iterations;  /* of the relaxer in this step */
    int64_t evaluations; /* of the forces in this step */
    double seconds;      /* since the start of the run */
    /* NaN in quasi-static runs.  work: done by the moving cell on the packing since the
     * start; elastic: energy in the contacts and their attraction. */
    double time_s;                             /* simulated */
    double kinetic, work, elastic, dissipated; /* J */
    double energy_residual;                    /* error of the energy balance / work */
    /* NaN except in dies, which also have time_s.  In a die pz and p are the force on the
     * punch / its area. */
    double central;          /* relative density of the central region, P3 5 */
    double height_m;         /* of the powder */
    double height_change;    /* relative to the height before pressing; negative */
    double target_pa;        /* prescribed pressure of the punch */
    double floor_over_punch; /* ratio of forces; far from 1: not quasi-static */
    double floor_pa;         /* force on the floor / its area */
    double wall_pa;          /* mean radial pressure on the wall */
    double wall_third_pa[3]; /* in the lower, middle and upper third of the powder */
    double wall_friction_n;  /* axial force of the wall on the powder, downward */
    double punch_work;       /* work on the powder since pressing began, J */
    /* (height) / (height under the full pressure) - 1, and
     * (outer radius) / (radius of the bore) - 1 */
    double axial_springback, radial_springback;
    double welded; /* fraction of the cold welds that are intact */
    /* NaN except in periodic cells.  Components: xx, yy, zz, xy, xz, yz. */
    double shear_pa[3]; /* xy, xz, yz of the pressure tensor: -stress */
    double q_pa; /* sqrt(3/2 s:s) with the deviator s of the pressures; 2D: |p1 - p2| */
    double asymmetry; /* antisymmetric part of the pressures / their mean */
    double strain[6]; /* since the start: logarithmic strains, compression positive, then
                       * engineering shears, summed over the steps */
    double fabric[6]; /* mean of n_i n_j over contacts with unit vectors n */
    /* Fabric anisotropies: 3/2 (2D: 2) times the largest eigenvalue of the deviator,
     * for all contacts, bridged contacts, contacts in tension, and weighted by normal
     * force. */
    double anisotropy[4];
    double leg; /* of loading.path, from 1; NaN without a path */
    /* 1: the relaxation ended above its tolerance and the guards let the run continue, so
     * the point is not in equilibrium.  0: otherwise.  NaN except in quasi-static
     * scenes. */
    double unrelaxed;
};

/* Writes the name of a branch as in curve.csv: "load", "relax", "hold", "unload:100MPa",
 * "unload", "in-die", "eject", "ejected", "leg:2".  Writes at most `size` bytes including
 * the final '\0'.  Returns buffer: "" for an unknown branch, NULL without a buffer. */
char *gb_curve_branch_name(const struct gb_point *point, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif

#endif
