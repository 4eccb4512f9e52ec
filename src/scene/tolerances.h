#ifndef GB_SCENE_TOLERANCES_H
#define GB_SCENE_TOLERANCES_H

/* The tolerances of the engine: the meaning of each one, and what goes wrong if it is
 * larger or smaller. */

/* Fraction of f_a(d) to which the attraction has fallen at the automatic cutoff, by
 * fidelity.  Larger: attraction is lost, and the force jumps when pairs cross the
 * cutoff, so that tight relaxations stall.  Smaller: longer neighbour lists, slower
 * sweeps. */
#define GB_CUTOFF_FRACTION_FAST      3e-3
#define GB_CUTOFF_FRACTION_BALANCED  1e-3
#define GB_CUTOFF_FRACTION_REFERENCE 2e-4

/* Least cutoff (d): the neighbour list needs a margin to find contacts in time. */
#define GB_CUTOFF_MIN 1.05

/* Margin of the neighbour list beyond the cutoff (d).  Larger: fewer rebuilds, more
 * pairs to test in every sweep.  Results do not depend on it. */
#define GB_SKIN 0.08
/* The same in dynamic scenes, where particles move faster.  It saves 3 % of the time of
 * P2's scene. */
#define GB_SKIN_DYNAMIC 0.15

/* rms residual over force scale at which a strain step counts as relaxed, by fidelity. */
#define GB_TOLERANCE_FAST      2e-2
#define GB_TOLERANCE_BALANCED  1e-2
#define GB_TOLERANCE_REFERENCE 2e-3

/* The same for predict at fast and balanced.  Predict starts near the equilibrium and
 * is equally accurate at a looser tolerance.  Without bridges, contacts of small
 * overlap open and close: at 3e-2 an unloaded packing of set I has 0.08 contacts per
 * particle too few. */
#define GB_PREDICT_TOLERANCE_FAST       5e-2
#define GB_PREDICT_TOLERANCE_BALANCED   3e-2
#define GB_UNBRIDGED_TOLERANCE_FAST     3e-2
#define GB_UNBRIDGED_TOLERANCE_BALANCED 2e-2

/* Largest strain that predict relaxes at once at fast and balanced, along one axis.  If
 * several axes are pressed, it is divided by the root of their number: with 5e-4 along
 * each of three axes the density at 100 MPa is 0.006 too high. */
#define GB_PREDICT_STRAIN_PART_FAST     1e-3
#define GB_PREDICT_STRAIN_PART_BALANCED 5e-4

/* Largest predicted displacement (d) and rotation (rad) of a particle over the strain
 * step.  It prevents extrapolating the rearrangement of a particle that moved into a
 * void.  At 2 the density of set II at 100 MPa is 0.007 too low.  Without a bound a
 * cell takes a fifth more evaluations, pressures below 20 MPa are too low, and packings
 * without bridges end too loose. */
#define GB_PREDICT_RATIO_MAX 8.0

/* Ratio of the strain step to the last one above which predict makes no prediction,
 * because the nonaffine motion does not scale that far.  Smaller than 2: a step that is
 * doubled again after a guard starts without a prediction. */
#define GB_PREDICT_STRAIN_RATIO_MAX 2.0

/* Largest displacement (d) of a particle in one step of fire and predict.  Overlaps are
 * a few per cent.  Larger: particles miss contacts.  Smaller: relaxations start slowly.
 */
#define GB_FIRE_DISPLACEMENT_MAX 0.01

/* steepest: displacement (d) under the largest force if h_eq = 0 (no adhesion);
 * otherwise P1 (15) gives h_eq/2.  Larger: particles miss contacts.  Smaller: slower. */
#define GB_STEEPEST_DISPLACEMENT_MIN 0.0025
/* steepest: moves between two computations of the stiffness k of the packing.  More: k
 * is outdated for contacts that have closed since. */
#define GB_STEEPEST_STIFFNESS_MOVES 50
/* steepest: k is halved as unstable if the residual grows by more than this factor
 * between two computations.  Near 1: harmless fluctuations halve it as well. */
#define GB_STEEPEST_RESIDUAL_GROWTH_MAX 1.5

/* If the mean contact force is below the adhesion f_a(d), the tolerance of predict is
 * multiplied by GB_PREDICT_TOLERANCE_SLOPE times (mean contact force)/f_a(d), but at
 * least by this fraction.  A larger fraction saves evaluations below 10 MPa, but the
 * pressure there is too high: at 1 the first step of set II has 5 MPa instead of 0.6. */
#define GB_PREDICT_TOLERANCE_FRACTION_MIN 0.2
#define GB_PREDICT_TOLERANCE_SLOPE        3.0

/* Tightest tolerance at which numerics.precision = auto chooses single.  Rounding
 * leaves a residual of 1e-5, so tighter relaxations would not converge. */
#define GB_F32_TOLERANCE_MIN 5e-3

/* Largest strain relaxed at once at fidelity = reference, by any relaxer.  The error in
 * density at 100 MPa grows by 0.0015 for each 1e-3. */
#define GB_STRAIN_PART_REFERENCE 2e-4

/* Shear strength of contacts without cement (E): in effect no limit, but finite, so
 * that its product with 0 is 0. */
#define GB_STRENGTH_COHESIONLESS 1e6

/* The force scale of the stopping rule is at least f_e at this overlap (d).  Without
 * adhesion a loose packing has no forces at all, and a fraction of 0 cannot be reached.
 * At 1e-4 this is about 0.1 MPa in alumina. */
#define GB_FORCE_FLOOR_OVERLAP 1e-4

/* Force evaluations after which a strain step is recorded unrelaxed.  Too few cut the
 * reference relaxer short, which takes thousands at tight tolerances. */
#define GB_EVALUATIONS_MAX 200000

/* A step recorded unrelaxed with a residual above this many tolerances stops the run. */
#define GB_RESIDUAL_STOP 30.0

/* A relaxation counts as cycling if the residual does not fall by this fraction within
 * this many evaluations.  It mostly alternates between two states of a breaking bridge
 * or of a pair at the cutoff.  It is restarted once and then given up.  Fewer: the
 * reference relaxer is cut short. */
#define GB_STALL_EVALUATIONS 5000
#define GB_STALL_FRACTION    0.01

/* Nonaffine displacement (d) in one strain step beyond which a particle may have missed
 * contacts.  The step is then halved, twice at most.  If the displacement stays above,
 * it is a sudden rearrangement of the packing.  In a cell of 1000 particles none of 928
 * steps of 0.1 % exceeds 0.2, and two of 94 steps of 1 % do.  Smaller values halve
 * steps without need. */
#define GB_NONAFFINE_MAX          0.2
#define GB_NONAFFINE_HALVINGS_MAX 2

/* Overlap, in diameters of the smaller particle, beyond which the contact laws do not
 * hold.  They are singular as h -> 1, and two centres about to cross mean that a step
 * was too large.  At a wall, a particle with this overlap has its centre on the wall;
 * beyond it, the centre is outside the die. */
#define GB_OVERLAP_MAX 0.5

/* Halvings of the strain step in a row after which a quasi-static run stops.  More: a
 * run that cannot continue takes longer to stop. */
#define GB_STRAIN_HALVINGS_MAX 6

/* The first point that reaches loading.until or a pressure of loading.unload_from may
 * exceed it by this fraction, or by this stress (E; 1.9 MPa in alumina), because points
 * are one strain step apart.  With the default step the excess in the presets is at
 * most 8 %, or up to 1 MPa at 1 and 2 MPa.  Larger: a run that ends at a wrong pressure
 * is not reported.  Smaller: usual steps are reported. */
#define GB_TARGET_EXCESS        0.1
#define GB_TARGET_EXCESS_STRESS 5e-6

/* Unloading ends when the pressure is below this fraction of its initial value. */
#define GB_UNLOADED_FRACTION 1e-3

/* Growth of the edges after which an unloading branch ends even if pressure is left.
 * Smaller: packings with a large springback are cut short. */
#define GB_UNLOADING_GROWTH_MAX 1.5

/* Smallest fraction of an unloading step that is taken if the pressure extrapolates to
 * zero within the step.  Smaller: many tiny steps near zero.  Larger: the branch ends
 * further below zero. */
#define GB_UNLOADING_SHARE_MIN 0.02

/* Bounds of the factor of an edge in one strain step.  A checkpoint with a value
 * outside is damaged.  Narrower: checkpoints of long strain steps are refused. */
#define GB_STRAIN_FACTOR_MIN 0.1
#define GB_STRAIN_FACTOR_MAX 10.0

/* For the progress display only.  Largest progress of a quasi-static run by density
 * before it has ended; and the end density assumed if none is given, at which curves
 * reach 1 GPa for any powder. */
#define GB_PROGRESS_MAX         0.99
#define GB_PROGRESS_END_DENSITY 0.62

/* Loading paths.  Affine strain with which the tangent is measured.  Larger: contacts
 * slide.  Smaller: rounding of single precision shows. */
#define GB_TANGENT_STRAIN 1e-5

/* A held stress is reached within this fraction of its value, or of the largest stress
 * of the leg.  The documented limits are 0.5 % and 1e-3, which larger fractions would
 * break.  Smaller: more corrections. */
#define GB_PATH_STRESS_SHARE 0.003
#define GB_PATH_STRESS_SCALE 6e-4

/* A step that passes the end of its leg by more than this many end tolerances is
 * repeated with a shorter strain, up to GB_PATH_SHORTENINGS_MAX times, because a
 * packing that breaks can jump past any stress.  If the leg still ends further past it,
 * the run reports the excess. */
#define GB_PATH_BEYOND          3.0
#define GB_PATH_SHORTENINGS_MAX 4

/* The largest stress of a leg counts as at least this fraction of the stress that ends
 * the leg. 0: in a loose packing stresses scatter about 0, and the tolerance of held
 * stresses would be less than the scatter. */
#define GB_PATH_LARGEST_SHARE 0.1

/* A leg has ended within this fraction of the stress that ends it, or within this
 * fraction of the largest stress of the leg.  Smaller: more short steps at the end. */
#define GB_PATH_END_SHARE 0.002
#define GB_PATH_END_SCALE 4e-4
/* The same for strains and for the logarithm of density; covers rounding. */
#define GB_PATH_STRAIN_TOLERANCE 1e-9

/* The first step of a leg is this many times shorter, because the tangent in its
 * direction is not known yet.  Fewer: held stresses are missed by more before they are
 * corrected. */
#define GB_PATH_FIRST_STEP_PARTS 8.0

/* Largest strain of a component with a held stress, over the strain step.  A tangent
 * that requires more is not trusted. */
#define GB_PATH_STRAIN_RATIO_MAX 4.0

/* Corrections of held stresses in a strain step after which the step is halved.  One or
 * two are usual. */
#define GB_PATH_CORRECTIONS_MAX 12

/* Largest strain of one correction of held stresses, or the strain step if that is
 * larger.  Smaller: a stress drop that needs more strain than a short step is mistaken
 * for a collapse. */
#define GB_PATH_CORRECTION_STRAIN 1e-3

/* Smallest correction that updates the tangent.  Below it, rounding and the residual of
 * the force balance dominate. */
#define GB_PATH_LEARN_STRAIN_MIN 1e-6

/* Number of steps without progress of held stresses towards their values after which
 * the values count as out of reach. */
#define GB_PATH_APPROACH_STEPS 40

/* Strain of the leading component without a rise of the stress that ends the leg, after
 * which this stress counts as out of reach.  Smaller: scatter of a small cell is
 * mistaken for a plateau. */
#define GB_PATH_PLATEAU_STRAIN 0.05

/* Dynamic scenes.  Error of the end pressure at omega * step = 1; it scales with the
 * square of omega * step.  It follows from the known error of 2 % at 0.5 T in P2's
 * scene, where omega is near 2 / T at the end.  Check with 20 cells at v1: 2850 +- 34
 * MPa if 1 % is allowed, 2805 +- 25 MPa at 0.04 T. */
#define GB_STEP_ERROR_UNIT 0.02

/* The same while nothing is driven (relaxing, holding), when motion is far slower than
 * the stiffest mode.  Check with fifty holds of 400 discs at v1: p at omega step = 1
 * differs from p at a quarter of it by (0.6 +- 0.1) 1e-4 after 20 ps and by (0.2 +- 1)
 * 1e-4 after 60 ps. */
#define GB_STEP_ERROR_UNIT_FREE 1e-4

/* Largest strain of the cell in an automatic time step of pressing.  P2's fastest rate
 * has up to 1e-4.  The error of the energy balance is of first order in it, because
 * viscous forces jump when pressing begins.
 *
 * Energy lost, pressing at 1e12 1/s from density 0.30 to 0.36 (/motion/fast):
 *     strain per step     1e-2     1e-3      2e-4
 *     of the whole work   0.60 %   0.07 %    0.013 %
 *     of the first points 39 %     3 %       0.6 %
 * With p2-3d-v3 at 1e12 1/s, steps of 1e-3 lose 28 % of the first 0.2 % of density, steps
 * of 2e-4 lose 5 %. */
#define GB_STEP_STRAIN_MAX 2e-4

/* Largest fraction of the critical step that the guard allows and that `stability`
 * suggests.  Friction caps hide instabilities closer to 1. */
#define GB_STEP_CRITICAL_FRACTION 0.5

/* Fraction of sliding contacts above which the time step is compared with half of it.
 * P2's scene at v1 has 0.03 in the loose state and up to 0.24 near density 0.9 (0.35
 * with relative_motion = full), both at 0.04 T and at 0.5 T.  Unstable steps reach 0.7
 * to 1 within 200 steps while the kinetic energy stays normal. */
#define GB_SLIDING_FRACTION_MAX 0.4
/* If half the step keeps this ratio of the fraction, friction is the cause and not the
 * step.  Example: small mu without bridges gives 0.41 at any step. */
#define GB_SLIDING_RATIO_UNCHANGED 0.8

/* Halvings of the time step after which a dynamic run stops. */
#define GB_STEP_HALVINGS_MAX 6

/* A stage of a dynamic run ends when less than this reduced time is left. 0: rounding
 * of the sum of the steps leaves a last step of 1e-12.  Longer than a time step: the
 * stage ends early. */
#define GB_STAGE_END_TOLERANCE 1e-9

/* Excess over a whole number of time steps that is treated as rounding, as a fraction
 * of a step. 0: an interval that is a multiple of the step gets one step more, and all
 * become shorter.  Larger: steps exceed the allowed one by this fraction over their
 * number. */
#define GB_STEP_COUNT_TOLERANCE 1e-9

/* Relative distance to the final density at which loading ends. 0: rounding of the
 * products of strains leaves one more step of zero length. */
#define GB_DENSITY_END_TOLERANCE 1e-12

/* The automatic time step assumes at least this circular frequency (1/T), because
 * packings without contacts have none.  Larger than in loose packings: their steps are
 * shorter than needed. */
#define GB_FREQUENCY_MIN 1e-3

/* Largest deviation from 1 of the sum of the fractions in a table of sizes; the
 * fractions are then scaled.  Smaller: tables written with three or four digits are
 * refused.  Larger: a forgotten row is not noticed. */
#define GB_SIZE_FRACTIONS_TOLERANCE 2e-3

/* Average number of pairs per sphere beyond which a neighbour search is given up.
 * Dense packings have 5 to 10 with a usual skin; spheres that all lie at one point
 * would fill the memory. */
#define GB_HGRID_PAIRS_PER_SPHERE_MAX 100

/* Die scenes.  Fraction of the critical time step, by fidelity.  Above 1 chains of
 * spheres are unstable.  The same bed of p3-hertz-mu0 pressed at 0.9 and 0.5 has
 * densities within 0.0003 up to 50 MPa.  Beds poured and pressed at 0.1, 0.5 and 0.9
 * have 0.6573, 0.6587 and 0.6585, each within 0.0017. */
#define GB_SAFETY_FAST      0.9
#define GB_SAFETY_BALANCED  0.5
#define GB_SAFETY_REFERENCE 0.1

/* Fraction of the safety at which a step resolves an impact.  The critical step of a
 * spring that pushes back in Hertz' time T is 2 T/pi.  If a step detects an impact
 * late, the overlap is too deep by up to 1.9 times the product of this fraction and the
 * safety, relative to the deepest overlap.  Larger: such particles gain energy.
 * Smaller: pouring takes longer. */
#define GB_IMPACT_SHARE 0.5

/* Largest distance that the fastest particle of a die scene moves in a step, in radii
 * of the smallest particle.  Larger: a particle in free flight can end a step deep
 * inside another.  Smaller: it limits steps that resolve every impact. */
#define GB_STEP_TRAVEL_MAX 0.1

/* Largest ratio of a step of a die scene to the last one.  Contacts that close stiffen
 * over many steps, and none is met at full stiffness.  Larger: the first steps of an
 * impact exceed the critical step. */
#define GB_STEP_GROWTH_MAX 1.05

/* Longest automatic step (T) of die scenes, and by the smallest diameter of dynamic
 * scenes.  Nothing else limits it before a contact is stiff.  In 1 T sound crosses a
 * particle of diameter d.  Longer: particles overlap deeply before a contact is
 * detected; without attraction the energies of collisions are wrong by 20 times the
 * work (/motion/free). */
#define GB_FREE_STEP_MAX 1.0

/* Powder is at rest if its mean kinetic energy is below that of a fall by this (d), ...
 */
#define GB_REST_FALL 1e-4
/* ... and the rms resultant force is below this fraction of the mean contact force ... */
#define GB_REST_UNBALANCED 0.02
/* ... in this many consecutive checks.  Fewer: particles still fall when the height is
 * measured. */
#define GB_REST_CHECKS 4
/* Time steps between two checks.  Fewer: the checks cost time, and GB_REST_CHECKS of
 * them lie within one vibration.  More: a stage ends later. */
#define GB_REST_CHECK_STEPS 256

/* Time steps after which the particles of powder that is poured are renumbered.  Fewer:
 * each renumbering takes as long as about ten steps.  More: neighbours in space are far
 * apart in memory, and steps take longer. */
#define GB_RENUMBER_STEPS 4096

/* Time steps between checks for particles outside the die, which also run at each point
 * and at the end of a stage.  More: an escaped particle disturbs the bed before a guard
 * acts. */
#define GB_ESCAPE_CHECK_STEPS 16

/* Limits for a warning that a cell is not in equilibrium: the height over the width
 * exceeds the first, and the height (d) times numerics.tolerance exceeds the second.
 * Example: the density of p1-set2-9.7nm at 100 MPa.  With tolerance 0.03 it is right
 * for an initial height of 54 d, 0.7 % too low for 215 d and 4 % too low for 430 d;
 * with 0.01 it is right for 215 d.  Larger: such cells are not reported.  Smaller:
 * cells that agree with cubes are reported. */
#define GB_COLUMN_ASPECT     3.0
#define GB_COLUMN_UNBALANCED 2.0

/* Time within which powder must come to rest, in times of a fall through the height of
 * the die.  Fewer: beds without friction, which creep for about ten falls, are given
 * up.  More: a bed that an unstable step keeps moving is given up later. */
#define GB_REST_FALLS_MAX 100.0

/* GB_REST_FALL and GB_REST_UNBALANCED while pouring, to detect that no particle falls
 * any more. */
#define GB_POURED_FALL       0.1
#define GB_POURED_UNBALANCED 0.2

/* In addition the highest particle must rest on others: its contacts carry at least
 * this fraction of its weight.  The means above do not detect one small particle that
 * still falls, and it would be taken for the top of the powder, which sets the punch
 * and the height.  A falling particle has 0, a resting one has 1.  Smaller: a particle
 * that slides down the wall counts as resting.  Near 1: rest is not detected while the
 * highest particle vibrates. */
#define GB_REST_SUPPORT_MIN 0.5

/* Allowed deviation from 1 of the force on the floor over the force on the punch.
 * Further away, inertia carries a part of the pressure and the point is not
 * quasi-static. */
#define GB_FLOOR_OVER_PUNCH_TOLERANCE 0.05

/* Fraction of loading.until by which the largest recorded pressure may differ from it.
 * Points are means over time, and the last one is before the end of the ramp.  Larger:
 * a missed goal is not reported. 0: every run misses it. */
#define GB_DIE_GOAL_TOLERANCE 0.05

/* Relative density, of a cell or under the punch, that ends a run.  The laws assume
 * that contacts deform one by one, which ends when no pore space is left.  Larger:
 * points without a meaning are recorded. */
#define GB_DENSITY_MAX 1.0

/* Rise of the punch above its initial height, as a fraction of that height, beyond
 * which the powder has thrown it off.  Smaller: the bounce of a light punch at the
 * first touch halves the time step.  Larger: points without contact are recorded. */
#define GB_PUNCH_RISE_MAX 0.1

/* Mean pressure since the last point over the pressure of the ramp at the point.  Below
 * this ratio the powder does not follow the punch, and the mean is not shifted to the
 * pressure of the point.  With a ramp quadratic in time the first mean is a third of
 * the pressure; above that ratio, the first point of every die would be recorded as a
 * mean. 0: a punch that touches nothing seems to carry half the ramp. */
#define GB_PUNCH_FOLLOWS_MIN 0.25

/* Time constants of a drag on the powder while gravity is reduced, and while the powder
 * comes to rest, as fractions of the time of the reduction.  The second applies to
 * gravity at rest and scales with 1/sqrt of a higher gravity.  Without drag a bed of
 * smooth spheres rotates about the axis of the die forever: spheres roll at the wall,
 * and no friction stops the others.  Stronger: loose particles take long to fall.
 *
 * Time to rest after flattening, p3-hertz-mu0 at safety 0.8; the density at 0.5 MPa is
 * the same within 0.0007:
 *     second constant    0.3          1             3
 *     time, us           41 to 78     42 to 522     56 to 80
 *     beds               8            11            8 */
#define GB_GRAVITY_RAMP_DRAG 0.1
#define GB_REST_DRAG         0.3

/* Time constant of a drag on the powder from the withdrawal of the punch, as a fraction
 * of loading.rest_time.  Without it the compact vibrates in the die and loose particles
 * are thrown off.  Stronger: the springback is delayed. */
#define GB_CYCLE_DRAG 0.1

/* Powder is flattened under the gravity at rest times this power of (gravity of
 * filling)/(gravity at rest).  Times of flattening scale with 1/sqrt of gravity. 0:
 * flattening and the rest after it take most time steps of a filled die. 1: the weight
 * of the bed presses about as much as the punch, and the top of the bed rises again
 * afterwards.  The overall density is then 0.002 to 0.006 lower; the density of the
 * central sphere is the same. */
#define GB_FLATTEN_GRAVITY (2.0 / 3.0)

/* The flattening punch may throw a particle up by a quarter of this (d).  Larger:
 * faster, and particles are thrown up. */
#define GB_FLATTEN_RISE 0.2

/* Moduli.  Displacement (d) and rotation for the finite differences of the tangent of a
 * pair.  Larger: lightly loaded contacts open within the difference.  Smaller:
 * rounding. */
#define GB_PAIR_TANGENT_STEP 1e-7

/* Stiffness of a weak spring for directions without stiffness, as a fraction of the
 * stiffness of the particle.  Without it the blocks of rattlers are singular.  Larger:
 * the solver converges more slowly. */
#define GB_TANGENT_HOLD 1e-9

/* Residual at which the linear equations for the response to a strain are solved, as a
 * fraction of the forces. */
#define GB_TANGENT_SHARE 1e-6

/* Relative rounding error of the forces caused by an affine strain, over the forces of
 * single pairs.  In a lattice these cancel, and the remainder must not count as a load.
 */
#define GB_TANGENT_NOISE 1e-7

/* Residual, over the force scale, of the copy that is probed; and the residual from
 * which Newton's method starts.  A strain of 1e-6 changes contact forces by 1e-4 of the
 * scale, and 1e-10 is 1e-6 of that change.  Newton's method must not start further
 * away, because contacts would open or slide on the way. */
#define GB_PROBE_RESIDUAL       1e-10
#define GB_PROBE_RESIDUAL_START 1e-4
/* The same if the equilibrium is not stable; and the criterion for that: the sum of the
 * stress changes by two opposite strains, over their difference.  Larger residuals:
 * Newton's method returns to the unstable equilibrium. */
#define GB_PROBE_RESIDUAL_STABLE 1e-7
#define GB_PROBE_ASYMMETRY       0.5
/* A copy with a larger residual has no equilibrium to probe. */
#define GB_PROBE_RESIDUAL_MAX 1e-5

/* Rounding of a history in single precision.  An overlap, or the deepest overlap of a
 * bridge, has this error (d): it is the difference of two numbers near 1 with 24 bits.
 * A spring is cut up to GB_F32_CAP_SHARE below its cap.  The relative error of the cap
 * is GB_F32_CAP_POWER times that of the overlap, because the cap grows with up to its
 * square.  The fraction is limited to GB_F32_CAP_SHARE_MAX for contacts that only just
 * touch.  Smaller: sliding springs appear to stick, and moduli of a run in single
 * precision are too high.  Larger: springs near their caps are lengthened to them. */
#define GB_F32_LENGTH        2e-7
#define GB_F32_CAP_SHARE     1e-5
#define GB_F32_CAP_POWER     2.0
#define GB_F32_CAP_SHARE_MAX 0.01

/* A copy of a world in single precision is relaxed repeatedly until its springs change
 * by less than this (d), at most this many times.  The smallest probes move contacts by
 * 1e-8. */
#define GB_PROBE_CAPS        1e-13
#define GB_PROBE_CAPS_ROUNDS 20

/* Force evaluations of FIRE on a copy. */
#define GB_PROBE_EVALUATIONS_MAX 100000

/* Force imbalance caused by rounding of positions, E d^2 over the longest edge; no
 * probe is relaxed further.  The second factor times this limit is enough when Newton's
 * method stops: FIRE would not come closer. */
#define GB_PROBE_ROUNDING      5e-16
#define GB_PROBE_ROUNDING_LEFT 100.0

/* Displacement for the finite differences in a Newton step, as a fraction of the
 * strain: a spring that slides by less counts half.  Then the displacement without a
 * strain (d), and the least displacement (d), at which rounding is 1e-5 of the
 * stiffness. */
#define GB_PROBE_TANGENT_STEP  1e-3
#define GB_PROBE_TANGENT_REST  1e-10
#define GB_PROBE_TANGENT_LEAST 1e-11

/* A Newton step is taken if the imbalance falls by at least this fraction of the
 * predicted fall. */
#define GB_PROBE_FALL 0.1
/* Growth of the imbalance that a Newton step may cause a few times. */
#define GB_PROBE_RISE 20.0

/* Force imbalance left after a probe, as a fraction of the imbalance after the affine
 * strain.  The relative error of the moduli is of the same order. */
#define GB_PROBE_SHARE 1e-6

/* Strain of the first probes, and the least strain.  C at a strain and at half of it
 * must agree to GB_PROBE_AGREEMENT of its largest element, else the strain is divided
 * by ten.  Larger strains open contacts; below the least strain rounding is 1e-6 of the
 * increments. */
#define GB_PROBE_STRAIN     1e-6
#define GB_PROBE_STRAIN_MIN 1e-8
#define GB_PROBE_AGREEMENT  1e-4

/* Elastic range: loss of the secant modulus that ends it, ratio of consecutive strains,
 * and the strain at which the search ends. */
#define GB_PROBE_LOSS      0.05
#define GB_PROBE_GROWTH    2.0
#define GB_PROBE_RANGE_MAX 0.01

/* Least length of a cell edge over the range of the neighbour list.  Below 2 a particle
 * would interact with two images of the same neighbour. */
#define GB_EDGE_OVER_RANGE_MIN 2.0

/* Largest strain step of the material of a card (measure/cap.h).  Halving it
 * changes p_x/p_z of a uniaxial path by less than 1e-4.  Larger: parameters lag behind
 * the density. */
#define GB_CAP_SUBSTEP 1e-4
/* Relative width at which its return to the yield surface ends.  Larger: the stress is
 * off the surface by that fraction of the step. */
#define GB_CAP_RETURN 1e-10

#endif
