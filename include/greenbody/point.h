#ifndef GREENBODY_POINT_H
#define GREENBODY_POINT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Branches of a run besides unloading: relaxation before loading, loading, and holding at
 * the end density of a dynamic run; of a full die cycle unloading, rest in the die without
 * the punch, ejection, and rest outside.  Leg n > 1 of a loading path: GB_BRANCH_LEG - n;
 * the first one is the loading. */
enum {
    GB_BRANCH_RELAX = -1,
    GB_BRANCH_LOAD = 0,
    GB_BRANCH_HOLD = -2,
    GB_BRANCH_UNLOAD = -3,
    GB_BRANCH_CONFINED = -4,
    GB_BRANCH_EJECT = -5,
    GB_BRANCH_EJECTED = -6,
    GB_BRANCH_LEAST = -6, /* but for legs */
    GB_BRANCH_LEG = -100
};

/* One recorded point of a run: one row of curve.csv.  Part of the library's interface: new
 * members go to the end.  Pressures in Pa; NaN where a value
 * does not exist (py in 2D).  p is the mean pressure over the compressed axes: the one
 * that the loading prescribes. */
struct gb_point {
    int branch;            /* GB_BRANCH_...; k >= 1: the k-th unloading branch */
    double branch_from_pa; /* pressure from which branch k unloads */
    int64_t step;
    double density;
    double px_pa, py_pa, pz_pa, p_pa;
    double coordination; /* pairs with r < d, per particle */
    double bridged;      /* share of those pairs that carry a bridge */
    double rattlers;     /* share of particles with fewer than two contacts */
    double residual;     /* rms force and torque over the force scale */
    int64_t iterations;  /* of the relaxer in this step */
    int64_t evaluations; /* of the forces in this step */
    double seconds;      /* since the start of the run */
    /* Dynamic runs only, NaN in quasi-static ones.  work: done on the packing by the
     * moving cell since the start; elastic: in the contacts and their attraction. */
    double time_s;                             /* simulated */
    double kinetic, work, elastic, dissipated; /* J */
    double energy_residual; /* error of the energy balance, over the work */
    /* Dies only, else NaN (with time_s); pz and p are the force on the punch over its
     * area. */
    double central;          /* relative density of the central region, P3 5 */
    double height_m;         /* of the powder */
    double height_change;    /* over the height before pressing; negative */
    double target_pa;        /* prescribed pressure of the punch */
    double floor_over_punch; /* forces; far from 1: not quasi-static */
    double floor_pa;         /* force on the floor over its area */
    double wall_pa;          /* mean radial pressure on the wall */
    double wall_third_pa[3]; /* of the lower, middle and upper third of its powder */
    double wall_friction_n;  /* axial force of the wall on the powder, downward */
    double punch_work;       /* done on the powder since pressing began, J */
    /* Height over that under the full pressure, outer radius over that of the bore, each
     * less 1. */
    double axial_springback, radial_springback;
    double welded; /* share of the cold welds that holds */
    /* Periodic cells only, else NaN.  Components in the order xx, yy, zz, xy, xz, yz. */
    double shear_pa[3]; /* pressure tensor, xy, xz, yz: minus the stresses */
    double q_pa;      /* sqrt(3/2 s:s), s the deviator of the pressures; 2D: |p1 - p2| */
    double asymmetry; /* antisymmetric part of the pressures over their mean */
    double strain[6]; /* since the start: logarithmic, compression positive; then the
                         * engineering shears, summed over the steps */
    double fabric[6]; /* mean of n_i n_j over contacts; n: unit vector along a contact */
    /* Fabric anisotropies, 3/2 of the largest eigenvalue of the deviator (2D: twice): of all
     * contacts, of bridged ones, of those in tension, and weighted by normal force. */
    double anisotropy[4];
    double leg; /* of loading.path, from 1; NaN without one */
    /* Quasi-static scenes, else NaN.  1: the relaxation ended above its tolerance, and the
     * guards accepted it; the point is not in equilibrium.  0 else. */
    double unrelaxed;
};

/* "load", "relax", "hold", "unload:100MPa", "unload", "in-die", "eject", "ejected", "leg:2":
 * the branch column of curve.csv.  Writes at most size bytes with the end; returns
 * buffer.  "" for a branch that no run has, NULL without a buffer. */
char *gb_curve_branch_name(const struct gb_point *point, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif

#endif
