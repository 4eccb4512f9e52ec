#ifndef GB_STUDY_PAPERS_PAPERS_MEASURES_H
#define GB_STUDY_PAPERS_PAPERS_MEASURES_H

#include "study/papers/papers_comparisons.h"

/* --- readings of one run ----------------------------------------------------------------- */

gb_papers_read gb_papers_measures_loaded;   /* quantity where loading reaches `at` MPa */
gb_papers_read gb_papers_measures_unloaded; /* quantity unloaded from `at` MPa */
gb_papers_read gb_papers_measures_lost;     /* loaded less unloaded */
gb_papers_read gb_papers_measures_lateral;  /* px/pz where loading reaches `at` MPa */
gb_papers_read gb_papers_measures_initial;  /* coordination of the initial structure */
/* Particles at which the structure, grown again with the parameters of the run, joins its
 * images along all axes: N_1 of P1 section III. */
gb_papers_read gb_papers_measures_percolation;
gb_papers_read gb_papers_measures_first; /* column in the first row of the run */
gb_papers_read gb_papers_measures_last;  /* column in the last row of loading */
gb_papers_read
    gb_papers_measures_at_density; /* column where loading reaches density `at` */

/* Mean normal force of contacts within 25 degrees of the plane across z over that within 25
 * degrees of z, in the last state. */
gb_papers_read gb_papers_measures_across;

/* Share of the particles with `contacts` contacts in the kept state snapshots/`column`.h5. */
gb_papers_read gb_papers_measures_share;

/* --- measures of all runs of the first experiment ---------------------------------------- */

gb_papers_measure gb_papers_measures_mean;       /* of the reading, at a point */
gb_papers_measure gb_papers_measures_difference; /* of the means at `point` and `other` */

/* Density at `at` MPa by continuum theory, P1 (18)-(23): isotropic less uniaxial, with the
 * hardening law of the mean curve of `point`, which is uniaxial. */
gb_papers_measure gb_papers_measures_continuum;

/* --- dynamic runs: papers_rates.c -------------------------------------------------------- */

/* Parameters of P2 (4), fitted to the mean curve of holding: p0 and the fall to it from the
 * mean pressure at density 0.95, MPa; the time after which 1/e of that fall remains, where
 * it is below 1 ns, and the longest time constant, where it is above, ns. */
gb_papers_measure gb_papers_rates_p0, gb_papers_rates_fall, gb_papers_rates_fast,
    gb_papers_rates_slow;
/* Amplitudes of both stages, MPa; of the fast one, what the slow one leaves of the fall. */
gb_papers_measure gb_papers_rates_fast_amplitude, gb_papers_rates_slow_amplitude;

/* P2 (9) fitted to the mean pressures of all its experiments: k_v with the printed
 * exponents, MPa s^(1/4), and the exponent of the rate where it is free. */
gb_papers_measure gb_papers_rates_kv, gb_papers_rates_exponent;
/* k_v v^(1/4) (rho - rho0)^3 at the rate `at`, 1/s, and density 0.95, with that k_v, MPa. */
gb_papers_measure gb_papers_rates_excess;

/* |density of the asymptote (5)-(8) at the pressure of the mean curve where it reaches
 * density `at`, over that density, less 1|. */
gb_papers_measure gb_papers_rates_asymptote;

/* --- laws alone: papers_laws.c ----------------------------------------------------------- */

gb_papers_measure gb_papers_laws_surface_energy; /* J/m2 */
gb_papers_measure gb_papers_laws_peel;           /* GPa, bridges of length `at` d */
gb_papers_measure gb_papers_laws_unit_time;      /* s, of P2's discs */
gb_papers_measure gb_papers_laws_rate;           /* 1/s, cells shortened by `at` a step */
gb_papers_measure gb_papers_laws_hollomon;       /* Pa, exponent `at` */
gb_papers_measure gb_papers_laws_yield_force;    /* N */
gb_papers_measure gb_papers_laws_yield_overlap;  /* m */
gb_papers_measure gb_papers_laws_pair_hertz;     /* h/2R at F/4R^2 = `at` MPa */
gb_papers_measure gb_papers_laws_pair_storakers; /* the same, P3 (16) */
gb_papers_measure gb_papers_laws_unequal;        /* m, spheres of 10 and 2 um at `at` N */

#endif
