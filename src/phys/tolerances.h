#ifndef GB_PHYS_TOLERANCES_H
#define GB_PHYS_TOLERANCES_H

/* Every tolerance of the engine: its meaning, and what breaks when it changes. */

/* Share of f_a(d) to which the attraction has fallen at the automatic cutoff, by
 * fidelity. Larger: attraction is lost and the force jumps where pairs cross the cutoff,
 * so that tight relaxations stall.  Smaller: longer neighbour lists, slower sweeps. */
#define GB_CUTOFF_SHARE_FAST      3e-3
#define GB_CUTOFF_SHARE_BALANCED  1e-3
#define GB_CUTOFF_SHARE_REFERENCE 2e-4

/* The cutoff never lies closer than this (d): contacts need a margin to be found in time.
 */
#define GB_CUTOFF_LEAST 1.05

/* Margin of the neighbour list beyond the cutoff (d).  Larger: rarer rebuilds, more pairs
 * to look at in every sweep.  No result depends on it. */
#define GB_SKIN 0.08

/* rms residual over force scale at which a strain step counts as relaxed, by fidelity. */
#define GB_TOLERANCE_FAST      2e-2
#define GB_TOLERANCE_BALANCED  1e-2
#define GB_TOLERANCE_REFERENCE 2e-3

/* The force scale of the stopping rule never falls below f_e at this overlap (d): without
 * adhesion a loose packing carries no force at all, and a share of nothing cannot be
 * reached. At 1e-4 the floor is worth about 0.1 MPa in alumina. */
#define GB_OVERLAP_FLOOR 1e-4

/* Force evaluations after which a strain step is recorded unrelaxed.  Too few cut the
 * reference relaxer short, which takes thousands at tight tolerances. */
#define GB_EVALUATIONS_MOST 200000

/* A step recorded unrelaxed with a residual above this many tolerances stops the run. */
#define GB_RESIDUAL_STOP 30.0

/* Overlap (d) beyond which the contact laws have lost their meaning: h -> 1 is singular,
 * and two centres about to cross mean that a strain step was too large. */
#define GB_OVERLAP_MOST 0.5

/* Unloading ends when the pressure is below this share of where it began. */
#define GB_UNLOADED_SHARE 1e-3

/* Dynamic scenes.  Error of the end pressure when omega * step = 1; the square of omega *
 * step scales it.  From the known 2 % at 0.5 T in P2's scene, where omega is near 2 / T
 * at the end; 20 cells at v1 agree: 2850 +- 34 MPa where 1 % is allowed, 2805 +- 25 at
 * 0.04 T. */
#define GB_STEP_ERROR_UNIT 0.02

/* Share of the critical step that is taken where the guard has to choose.  Friction caps
 * hide instabilities closer to 1. */
#define GB_STEP_CRITICAL_SHARE 0.5

/* Share of sliding contacts above which the time step is taken to be unstable.  P2's
 * scene at v1 has 0.03 in the loose state and up to 0.24 near density 0.9, the same at
 * 0.04 T and at 0.5 T; 0.8 is reported for unstable steps while the kinetic energy looks
 * innocent. */
#define GB_SLIDING_MOST 0.4

/* Halvings of the time step after which a dynamic run stops. */
#define GB_STEP_HALVINGS_MOST 6

/* Length of a cell edge over the reach of the neighbour list: below 2 a pair would meet
 * two images of the same particle. */
#define GB_EDGE_OVER_REACH 2.0

#endif
