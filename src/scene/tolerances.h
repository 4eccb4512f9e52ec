#ifndef GB_SCENE_TOLERANCES_H
#define GB_SCENE_TOLERANCES_H

/* Every tolerance of the engine: its meaning, and what breaks when it changes. */

/* Share of f_a(d) to which the attraction has fallen at the automatic cutoff, by
 * fidelity. Larger: attraction is lost and the force jumps where pairs cross the cutoff,
 * so that tight relaxations stall.  Smaller: longer neighbour lists, slower sweeps. */
#define GB_CUTOFF_FRACTION_FAST      3e-3
#define GB_CUTOFF_FRACTION_BALANCED  1e-3
#define GB_CUTOFF_FRACTION_REFERENCE 2e-4

/* The cutoff never lies closer than this (d): contacts need a margin to be found in time.
 */
#define GB_CUTOFF_MIN 1.05

/* Margin of the neighbour list beyond the cutoff (d).  Larger: rarer rebuilds, more pairs
 * to test in every sweep.  No result depends on it. */
#define GB_SKIN 0.08
/* The same in dynamic scenes, where particles move faster: P2's scene takes 3 % less
 * time. */
#define GB_SKIN_DYNAMIC 0.15

/* rms residual over force scale at which a strain step counts as relaxed, by fidelity. */
#define GB_TOLERANCE_FAST      2e-2
#define GB_TOLERANCE_BALANCED  1e-2
#define GB_TOLERANCE_REFERENCE 2e-3

/* The same for predict at fast and balanced; it starts near the equilibrium and reaches
 * the same accuracy at a looser tolerance.  Without bridges contacts of small overlap
 * open and close: at 3e-2 an unloaded packing of set I has 0.08 contacts per particle too
 * few. */
#define GB_PREDICT_TOLERANCE_FAST       5e-2
#define GB_PREDICT_TOLERANCE_BALANCED   3e-2
#define GB_UNBRIDGED_TOLERANCE_FAST     3e-2
#define GB_UNBRIDGED_TOLERANCE_BALANCED 2e-2

/* Largest strain that predict relaxes at once at fast and balanced, along one axis; over
 * the root of their number where several are pressed.  At 5e-4 along each of three the
 * density at 100 MPa came out 0.006 too high. */
#define GB_PREDICT_STRAIN_PART_FAST     1e-3
#define GB_PREDICT_STRAIN_PART_BALANCED 5e-4

/* Largest predicted displacement (d) and rotation (rad) of a particle over the strain
 * step: the rearrangement of a particle that moved into a void is not extrapolated.  At 2
 * the density of set II at 100 MPa comes out 0.007 too low.  Without a bound a cell takes
 * a fifth more evaluations, pressures below 20 MPa come out too low, and packings without
 * bridges end too loose. */
#define GB_PREDICT_RATIO_MAX 8.0

/* Strain step over the last one above which predict makes no prediction: the nonaffine
 * motion does not scale that far.  Smaller than 2: a step doubled again after a guard
 * starts without a prediction. */
#define GB_PREDICT_STRAIN_RATIO_MAX 2.0

/* Largest displacement (d) of a particle in one step of fire and predict.  Overlaps are a
 * few per cent: larger displacements pass contacts by, smaller ones slow the start of a
 * relaxation. */
#define GB_FIRE_DISPLACEMENT_MAX 0.01

/* steepest: displacement (d) under the largest force where h_eq = 0, without adhesion;
 * P1 (15) gives h_eq/2 otherwise.  Larger: contacts are passed by.  Smaller: slower. */
#define GB_STEEPEST_DISPLACEMENT_MIN 0.0025
/* steepest: moves between two computations of the stiffness of the packing.  More: k is
 * too large for contacts that have closed since. */
#define GB_STEEPEST_STIFFNESS_MOVES 50
/* steepest: growth of the residual between two of these computations beyond which k is
 * halved as unstable.  Near 1: harmless fluctuations halve it as well. */
#define GB_STEEPEST_RESIDUAL_GROWTH_MAX 1.5

/* Where the mean contact force is below the adhesion f_a(d), the tolerance of predict
 * falls with the mean contact force over f_a(d) times
 * GB_PREDICT_TOLERANCE_SLOPE, down to this share of it.  A
 * larger share saves evaluations below 10 MPa and makes the pressure there come out too
 * high: at 1 the first step of set II has 5 MPa instead of 0.6. */
#define GB_PREDICT_TOLERANCE_FRACTION_MIN 0.2
#define GB_PREDICT_TOLERANCE_SLOPE        3.0

/* Tightest tolerance at which numerics.precision = auto is single.  Rounding leaves a
 * residual of 1e-5; tighter relaxations would not converge. */
#define GB_F32_TOLERANCE_MIN 5e-3

/* Largest strain relaxed at once at fidelity = reference, by any relaxer.  The error in
 * density at 100 MPa grows by 0.0015 for each 1e-3. */
#define GB_STRAIN_PART_REFERENCE 2e-4

/* Shear strength of contacts without cement (E): no limit, but finite, so that it times 0
 * is 0. */
#define GB_STRENGTH_COHESIONLESS 1e6

/* The force scale of the stopping rule never falls below f_e at this overlap (d): without
 * adhesion a loose packing carries no force at all, and a fraction of 0 cannot be
 * reached.  At 1e-4 the floor is worth about 0.1 MPa in alumina. */
#define GB_FORCE_FLOOR_OVERLAP 1e-4

/* Force evaluations after which a strain step is recorded unrelaxed.  Too few cut the
 * reference relaxer short, which takes thousands at tight tolerances. */
#define GB_EVALUATIONS_MAX 200000

/* A step recorded unrelaxed with a residual above this many tolerances stops the run. */
#define GB_RESIDUAL_STOP 30.0

/* Evaluations without the residual falling by this share after which a relaxation counts
 * as cycling, mostly between two states of a breaking bridge or of a pair at the cutoff:
 * it is restarted once and then given up.  Fewer cut the reference relaxer short. */
#define GB_STALL_EVALUATIONS 5000
#define GB_STALL_FRACTION    0.01

/* Nonaffine displacement (d) in one strain step beyond which a particle may have missed
 * contacts: the step is halved, twice at most; a larger one after that is a sudden
 * rearrangement of the packing.  At 0.1 % none of 928 steps of a cell of 1000 has one
 * beyond 0.2, at 1 % two of 94.  Smaller values halve steps without need. */
#define GB_NONAFFINE_MAX          0.2
#define GB_NONAFFINE_HALVINGS_MAX 2

/* Overlap, in diameters of the smaller particle, beyond which the contact laws do not hold:
 * h -> 1 is singular, and two centres about to cross mean that a step was too large.  The
 * centre of a particle is on a wall at this overlap, and beyond it outside of the die. */
#define GB_OVERLAP_MAX 0.5

/* Halvings of the strain step in a row after which a quasi-static run stops.  More: a run
 * that cannot continue takes longer to stop. */
#define GB_STRAIN_HALVINGS_MAX 6

/* The pressure of a quasi-static run may exceed loading.until, or a pressure of
 * loading.unload_from, by this share or by this stress (E; 1.9 MPa in alumina) at the first
 * point that reaches it: points lie a strain step apart.  At the default step that point is at
 * most 7 % beyond in the presets, 8 % at 5 MPa, and up to 1 MPa beyond 1 and 2 MPa.  Larger: a
 * run that ends elsewhere passes.  Smaller: usual steps are reported. */
#define GB_TARGET_EXCESS        0.1
#define GB_TARGET_EXCESS_STRESS 5e-6

/* Unloading ends when the pressure is below this share of where it began. */
#define GB_UNLOADED_FRACTION 1e-3

/* Growth of the edges after which an unloading branch is given up with pressure left.
 * Smaller: packings that spring back far are cut short. */
#define GB_UNLOADING_GROWTH_MAX 1.5

/* Smallest share of an unloading step that is taken when the pressure extrapolates to
 * zero within the step.  Smaller: many tiny steps near zero.  Larger: the branch ends
 * further below zero. */
#define GB_UNLOADING_SHARE_MIN 0.02

/* Bounds of the factor of an edge in one strain step, for checkpoints: a value outside is
 * damage.  Narrower: checkpoints of long strain steps are refused. */
#define GB_STRAIN_FACTOR_MIN 0.1
#define GB_STRAIN_FACTOR_MAX 10.0

/* Largest progress of a quasi-static run by density before it has ended, and the density
 * at which curves reach 1 GPa, whatever the powder: the end that progress assumes when
 * no density is given.  Only the display depends on them. */
#define GB_PROGRESS_MAX         0.99
#define GB_PROGRESS_END_DENSITY 0.62

/* Loading paths.  Affine strain of the measured tangent.  Larger: contacts slide.
 * Smaller: rounding of single precision shows. */
#define GB_TANGENT_STRAIN 1e-5

/* A held stress is there within this share of its value, or this share of the largest
 * stress of the leg.  The contract is 0.5 % and 1e-3; larger shares break it. Smaller ones
 * take more corrections. */
#define GB_PATH_STRESS_SHARE 0.003
#define GB_PATH_STRESS_SCALE 6e-4

/* A step that goes past the end of its leg by more than this many tolerances of the end is
 * taken again, shorter, a few times: a packing that breaks jumps past any stress.  A leg that
 * ends further past it has exceeded it. */
#define GB_PATH_BEYOND          3.0
#define GB_PATH_SHORTENINGS_MAX 4

/* Share of the stress that ends a leg which counts as reached from the start.  0: in a
 * loose packing, whose stresses scatter about 0, held stresses cannot be told from that. */
#define GB_PATH_LARGEST_SHARE 0.1

/* A leg has ended within this share of the stress that ends it, or this share of the
 * largest stress of the leg.  Smaller: more short steps at the end. */
#define GB_PATH_END_SHARE 0.002
#define GB_PATH_END_SCALE 4e-4
/* The same of strains and of the logarithm of density: rounding. */
#define GB_PATH_STRAIN_TOLERANCE 1e-9

/* A leg begins with a step this many times shorter: the tangent is not known yet in its
 * direction.  Fewer: held stresses are missed by more before they are corrected. */
#define GB_PATH_FIRST_STEP_PARTS 8.0

/* Strain of a component with a held stress over the strain step, at most.  A tangent that
 * asks for more is not trusted. */
#define GB_PATH_STRAIN_RATIO_MAX 4.0

/* Corrections of held stresses in a strain step after which it is halved.  One or two are
 * usual. */
#define GB_PATH_CORRECTIONS_MAX 12

/* Largest correction of held stresses in one go, where the strain step is not longer than
 * that.  Smaller: a stress drop that needs more strain than a short step is taken for a
 * collapse. */
#define GB_PATH_CORRECTION_STRAIN 1e-3

/* Smallest correction from which the tangent of small strains learns: below it rounding
 * and the residual of the force balance decide. */
#define GB_PATH_LEARN_STRAIN_MIN 1e-6

/* Steps in which held stresses, on the way to their values, come no nearer, after which
 * these are taken as out of reach. */
#define GB_PATH_APPROACH_STEPS 40

/* Strain of the leading component over which the stress that ends a leg has not risen,
 * after which it is taken as out of reach.  Smaller: scatter of a small cell is taken for
 * a plateau. */
#define GB_PATH_PLATEAU_STRAIN 0.05

/* Dynamic scenes.  Error of the end pressure when omega * step = 1; the square of omega *
 * step scales it.  From the known 2 % at 0.5 T in P2's scene, where omega is near 2 / T
 * at the end; 20 cells at v1 agree: 2850 +- 34 MPa where 1 % is allowed, 2805 +- 25 at
 * 0.04 T. */
#define GB_STEP_ERROR_UNIT 0.02

/* The same where nothing is driven (relaxing, holding): what remains is far slower than the
 * stiffest mode.  Fifty holds of 400 discs at v1 from the same states: p 60 ps on differs by
 * (0.2 +- 1) 1e-4 at omega step = 1 from that at a quarter of it, 20 ps on by (0.6 +- 0.1)
 * 1e-4. */
#define GB_STEP_ERROR_UNIT_FREE 1e-4

/* Strain of the cell in an automatic time step of pressing at most; P2's fastest rate
 * strains it by up to 1e-4.  The balance of energies is of first order in it, since viscous
 * forces jump as pressing begins: pressing at 1e12 1/s from density 0.30 to 0.36
 * (/motion/fast) in steps of 1e-2 loses 0.60 % of the work, and 39 % of that of the first
 * points; in steps of 1e-3 0.07 and 3 %, of 2e-4 0.013 and 0.6 %.  With p2-3d-v3 at 1e12
 * 1/s steps of 1e-3 lose 28 % of the first 0.2 % of density, of 2e-4 5 %. */
#define GB_STEP_STRAIN_MAX 2e-4

/* Share of the critical step that is taken where the guard has to choose.  Friction caps
 * hide instabilities closer to 1. */
#define GB_STEP_CRITICAL_FRACTION 0.5

/* Share of sliding contacts above which the time step is checked against half of it.
 * P2's scene at v1 has 0.03 in the loose state and up to 0.24 near density 0.9 (0.35
 * with relative_motion = full), the same at 0.04 T and at 0.5 T; unstable steps reach 0.7
 * to 1 within 200 steps while the kinetic energy stays normal. */
#define GB_SLIDING_FRACTION_MAX 0.4
/* If half the step keeps this much of the share, friction is the cause (small mu without
 * bridges: 0.41 at any step), not the step. */
#define GB_SLIDING_RATIO_UNCHANGED 0.8

/* Halvings of the time step after which a dynamic run stops. */
#define GB_STEP_HALVINGS_MAX 6

/* A stage of a dynamic run has ended when less than this reduced time is left.  0: the
 * rounding of the sum of the steps leaves a last step of 1e-12.  Above a time step: the
 * stage ends early. */
#define GB_STAGE_END_TOLERANCE 1e-9

/* Excess over a whole number of time steps, as a share of a step, that is taken as
 * rounding.  0: intervals that are a multiple of the step get one step more, all of them
 * shorter.  Larger: steps exceed the allowed one by this share over their number. */
#define GB_STEP_COUNT_TOLERANCE 1e-9

/* Relative distance to the final density at which a loading has ended.  0: the rounding
 * of the products of strains leaves one more step of no length. */
#define GB_DENSITY_END_TOLERANCE 1e-12

/* The automatic time step assumes at least this circular frequency (1/T): packings without
 * contacts have none.  Larger than the frequencies of loose packings: their steps are
 * shorter than needed. */
#define GB_FREQUENCY_MIN 1e-3

/* How far the shares of a table of sizes may be from summing to 1; they are then scaled.
 * Smaller: tables written with three or four digits are refused.  Larger: a forgotten
 * row passes. */
#define GB_SIZE_FRACTIONS_TOLERANCE 2e-3

/* Pairs per sphere, on average, beyond which a search for neighbours is given up.  Dense
 * packings have 5 to 10 with a usual skin; spheres that all lie at one point would fill
 * the memory. */
#define GB_HGRID_PAIRS_PER_SPHERE_MAX 100

/* Die scenes.  Share of the critical time step by fidelity.  0.9 and 0.5 press the same
 * bed of p3-hertz-mu0 to densities within 0.0003 of each other up to 50 MPa; poured and pressed
 * at 0.1, 0.5 and 0.9 it has 0.6573, 0.6587 and 0.6585 there (2, 3 and 3 beds, each within
 * 0.0017).  Above 1 chains of spheres are unstable. */
#define GB_SAFETY_FAST      0.9
#define GB_SAFETY_BALANCED  0.5
#define GB_SAFETY_REFERENCE 0.1

/* Share of the safety at which a step resolves an impact, of the critical step 2 T/pi of a
 * spring that pushes back in Hertz' time T.  A particle that is seen late is too deep by up to 1.9
 * times the product of this and the safety, of the deepest it would be.  Larger: such particles
 * are given more energy than they bring.  Smaller: pouring takes longer. */
#define GB_IMPACT_SHARE 0.5

/* Radii of the smallest particle that the fastest one moves in a step of a die scene at most.
 * Larger: where nothing is near, one step leads far into what it meets.  Smaller: it bounds steps
 * that resolve every impact. */
#define GB_STEP_TRAVEL_MAX 0.1

/* A step of a die scene is at most this many times the last one: contacts that close
 * stiffen over many steps, and none is met at full stiffness.  Larger: the first steps
 * of an impact are above the critical one. */
#define GB_STEP_GROWTH_MAX 1.05

/* Longest automatic step (T) of die scenes, and of dynamic ones by the smallest diameter:
 * nothing else bounds it while no contact is stiff.  In 1 T sound crosses a particle of
 * diameter d.  Longer: particles are deep in each other before a contact is seen; without
 * attraction the energies of collisions differ by 20 times the work (/motion/free). */
#define GB_FREE_STEP_MAX 1.0

/* Powder is at rest when its mean kinetic energy is below a fall by this (d)
 * and ... */
#define GB_REST_FALL 1e-4
/* ... the rms resultant force is below this share of the mean contact force ... */
#define GB_REST_UNBALANCED 0.02
/* ... in this many consecutive checks.  Fewer: particles still fall while the height is
 * taken. */
#define GB_REST_CHECKS 4
/* Time steps between two checks.  Fewer: the checks cost time, and GB_REST_CHECKS of them
 * lie within one vibration.  More: a stage ends later. */
#define GB_REST_CHECK_STEPS 256

/* Time steps between two numberings of powder that is poured.  Fewer: each takes as long as
 * some ten steps.  More: neighbours in space lie apart in memory, and steps take longer. */
#define GB_RENUMBER_STEPS 4096

/* Time steps between checks for particles outside the die, which are also made at each
 * point and at the end of a stage.  More: an escaped particle moves the bed before a guard
 * acts. */
#define GB_ESCAPE_CHECK_STEPS 16

/* A cell that is higher than wide by the first and whose height (d) times
 * numerics.tolerance is above the second is told to be out of equilibrium: with 0.03, the
 * density at 100 MPa of p1-set2-9.7nm is 0.7 % low where the cell begins with 215 d, 4 % with
 * 430 d, right with 54 d; with 0.01 it is right at 215 d.
 * Larger: such cells pass.  Smaller: cells that agree with cubes are complained of. */
#define GB_COLUMN_ASPECT     3.0
#define GB_COLUMN_UNBALANCED 2.0

/* Falls through the height of the die in which powder has to come to rest.  Fewer: beds without
 * friction, which creep for some ten falls, are given up.  More: a bed that an unstable step
 * keeps moving is given up later. */
#define GB_REST_FALLS_MAX 100.0

/* The same two while pouring, to detect that no particle falls any more. */
#define GB_POURED_FALL       0.1
#define GB_POURED_UNBALANCED 0.2

/* And the highest particle rests on others: its contacts carry at least this share of its
 * weight.  The means above do not see one small particle that still falls, and it would
 * be taken for the top of the powder: punch and height are set by it.  One that falls has
 * 0, one at rest 1.  Smaller: one that slides down the wall passes.  Near 1: rest is not
 * detected while the highest particle vibrates. */
#define GB_REST_SUPPORT_MIN 0.5

/* Force on the floor over force on the punch: further from 1 than this, inertia carries
 * a part of the pressure and the point is not quasi-static. */
#define GB_FLOOR_OVER_PUNCH_TOLERANCE 0.05

/* Share of loading.until that the largest recorded pressure may lie below it, or above: points
 * are means over time, and the last one is before the end of the ramp.  Larger: a goal that
 * was missed passes.  0: every run misses it. */
#define GB_DIE_GOAL_TOLERANCE 0.05

/* Relative density, of a cell or under the punch, that ends a run: contacts deform one by
 * one, and spheres that overlap by more than all pores have no such contacts.  Larger: points
 * without a meaning are recorded. */
#define GB_DENSITY_MAX 1.0

/* Rise of a pressing punch above the height where it began, as a share of that, beyond
 * which the powder has thrown it off.  Smaller: the bounce of a light punch at the first
 * touch halves the time step.  Larger: points without contact are recorded. */
#define GB_PUNCH_RISE_MAX 0.1

/* Mean pressure carried since the last point, over that of the ramp at the point, below
 * which the powder does not follow the punch, and the mean is not moved on to the pressure
 * of the point.  Of a ramp with the square of time the first mean is a third: above that,
 * first points of every die are recorded as means.  0: a punch that touches nothing carries
 * half the ramp. */
#define GB_PUNCH_FOLLOWS_MIN 0.25

/* Time constants of a drag on the powder while gravity is reduced and while it comes to rest,
 * as shares of the time of the reduction; the second is that under gravity at rest and goes
 * with one over the root of a higher one.  Without drag a bed of smooth spheres rotates about
 * the axis of the die without end: spheres at the wall roll, and no friction stops the others.
 * At the safety 0.8 beds of p3-hertz-mu0 come to rest in 41 to 78 us behind flattening with 0.3 (8
 * beds), in 42 to 522 with 1 (11), in 56 to 80 with 3 (8), all of the same density at 0.5 MPa
 * within 0.0007.
 * Stronger: loose particles take long to fall. */
#define GB_GRAVITY_RAMP_DRAG 0.1
#define GB_REST_DRAG         0.3

/* Time constant of a drag on the powder from the withdrawal of the punch on, as a share of
 * loading.rest_time.  Without it the compact vibrates in the die and loose particles are
 * thrown off.  Stronger: it delays the springback. */
#define GB_CYCLE_DRAG 0.1

/* Powder is flattened under the gravity at rest times this power of the ratio of that of
 * filling to it; its times go with one over the root of gravity.  0: most time steps of a
 * filled die are those of flattening and of the rest behind it.  1: the weight of the bed
 * presses about as much as the punch, and the top of the bed rises again behind it: the whole
 * density is 0.002 to 0.006 lower, that of the central sphere the same. */
#define GB_FLATTEN_GRAVITY (2.0 / 3.0)

/* A particle pushed by the flattening punch rises by up to a quarter of this (d).
 * Larger: faster, and particles are thrown up. */
#define GB_FLATTEN_RISE 0.2

/* Moduli.  Displacement (d) and rotation of the differences that make the tangent of a
 * pair.  Larger: light contacts open within the difference.  Smaller: rounding. */
#define GB_PAIR_TANGENT_STEP 1e-7

/* Weak spring that holds directions without stiffness, as a share of the stiffness of the
 * particle: without it the blocks of rattlers are singular.  Larger: slower solutions. */
#define GB_TANGENT_HOLD 1e-9

/* Residual of the linear equations for the response to a strain, as a share of the
 * forces. */
#define GB_TANGENT_SHARE 1e-6

/* Rounding of the forces by an affine strain, over those of the pairs alone.  In a lattice
 * they cancel, and what is left of them is no load. */
#define GB_TANGENT_NOISE 1e-7

/* Residual, over the force scale, of the copy that is probed, and that from which Newton's
 * method starts.  A strain of 1e-6 changes contact forces by 1e-4 of the scale: a residual
 * of 1e-10 is 1e-6 of that.  A start further away has contacts that open or slide on the
 * way. */
#define GB_PROBE_RESIDUAL       1e-10
#define GB_PROBE_RESIDUAL_START 1e-4
/* The same where the equilibrium is not stable, and what tells that it is not: the sum of
 * the changes of stress by two opposite strains, over their difference.  Larger residuals:
 * Newton's method finds it again. */
#define GB_PROBE_RESIDUAL_STABLE 1e-7
#define GB_PROBE_ASYMMETRY       0.5
/* A copy with a larger one has no equilibrium to probe. */
#define GB_PROBE_RESIDUAL_MAX 1e-5

/* Rounding of a history in single precision.  An overlap, or the deepest one of a bridge,
 * is off by up to this (d): the difference of two numbers near 1 with 24 bits.  A spring is
 * cut up to GB_F32_CAP_SHARE below its cap, and the cap is off by GB_F32_CAP_POWER times
 * the relative error of the overlap: it grows with up to its square.  The share is not
 * above GB_F32_CAP_SHARE_MAX where contacts only just touch.  Smaller: springs that slide
 * are found sticking, and moduli of a run in single precision are too high.  Larger:
 * springs near their caps are lengthened to them. */
#define GB_F32_LENGTH        2e-7
#define GB_F32_CAP_SHARE     1e-5
#define GB_F32_CAP_POWER     2.0
#define GB_F32_CAP_SHARE_MAX 0.01

/* The copy of a world in single precision is put in equilibrium again until springs change
 * by less than this (d), or this often: the smallest probes move contacts by 1e-8. */
#define GB_PROBE_CAPS        1e-13
#define GB_PROBE_CAPS_ROUNDS 20

/* Force evaluations of FIRE on a copy. */
#define GB_PROBE_EVALUATIONS_MAX 100000

/* Imbalance of forces by the rounding of positions, E d^2 over the longest edge: no probe
 * is relaxed further.  And so many times that where Newton's method ends by itself: FIRE
 * would not come closer. */
#define GB_PROBE_ROUNDING      5e-16
#define GB_PROBE_ROUNDING_LEFT 100.0

/* Displacement of the differences in a Newton step, as a share of the strain: a spring that
 * slides by less than it counts half.  And that without a strain, and the least one, where
 * rounding makes 1e-5 of the stiffness, d. */
#define GB_PROBE_TANGENT_STEP  1e-3
#define GB_PROBE_TANGENT_REST  1e-10
#define GB_PROBE_TANGENT_LEAST 1e-11

/* A Newton step is taken if the imbalance falls by this share of what it predicts. */
#define GB_PROBE_FALL 0.1
/* Rise of the imbalance that a Newton step may cause a few times. */
#define GB_PROBE_RISE 20.0

/* Imbalance left after a probe, as a share of that of the affine strain: the relative
 * error of the moduli by it is of the same order. */
#define GB_PROBE_SHARE 1e-6

/* Strain of the first probes, and the least.  C at a strain and at half of it agree to
 * GB_PROBE_AGREEMENT of its largest element, else the strain is divided by ten.  Larger
 * strains open contacts; below the least, rounding is 1e-6 of the increments. */
#define GB_PROBE_STRAIN     1e-6
#define GB_PROBE_STRAIN_MIN 1e-8
#define GB_PROBE_AGREEMENT  1e-4

/* Elastic range: loss of the secant modulus that ends it, ratio of consecutive strains,
 * and the strain at which the search ends. */
#define GB_PROBE_LOSS      0.05
#define GB_PROBE_GROWTH    2.0
#define GB_PROBE_RANGE_MAX 0.01

/* Length of a cell edge over the reach of the neighbour list: below 2 a particle would
 * interact with two images of the same neighbour. */
#define GB_EDGE_OVER_RANGE_MIN 2.0

/* Largest strain that the material of a card (measure/cap.h) takes at once.
 * Halving it changes p_x/p_z of a uniaxial path by less than 1e-4; larger: parameters lag
 * behind the density. */
#define GB_CAP_SUBSTEP 1e-4
/* Relative width at which its return to the yield surface ends.  Larger: the stress is off
 * the surface by that share of the step. */
#define GB_CAP_RETURN 1e-10

#endif
