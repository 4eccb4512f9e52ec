#ifndef GB_SOLVE_LOADING_DIE_DIE_CYCLE_H
#define GB_SOLVE_LOADING_DIE_DIE_CYCLE_H

#include <stddef.h>

#include "solve/loading/die/die_state.h"

/* Translational kinetic energy (E d^3) and the limit of that of a small fall, resultant over
 * contact forces and its limit: powder at rest is below both, and its highest particle is
 * supported.  Rotation is left out: nothing damps the spin of a smooth sphere. */
struct gb_die_cycle_rest_state {
    double kinetic, kinetic_limit, unbalanced, unbalanced_limit;
};

struct gb_die_cycle_rest_state gb_die_cycle_rest_state(const struct gb_die_stages *stages,
                                                       const struct gb_bed *bed);

/* Particles above the die. */
int64_t gb_die_cycle_in_funnel(const struct gb_bed *bed);

enum gb_die_sequence_state {
    GB_DIE_SEQUENCE_CONTINUES, /* the stage continues */
    GB_DIE_SEQUENCE_ENDED,     /* it has ended and the next one has begun */
    GB_DIE_SEQUENCE_FAILED     /* neither; err says why */
};

/* Gravity is reduced twice, before flattening and behind it, by a constant factor in equal
 * times: this reduction or the next one (d/T^2, T). */
struct gb_die_cycle_ramp {
    double from, to, length;
};

struct gb_die_cycle_ramp gb_die_cycle_ramp(const struct gb_die_stages *stages);

/* Puts the punch on the powder and starts the ramp of pressure; the bed gets the law of
 * pressing.  Errors: as of gb_bed_evaluate. */
bool gb_die_cycle_begin_press(struct gb_die_stages *stages, struct gb_bed *bed,
                              struct gb_error *err);

/* After a step of a stage before pressing.  text (size bytes) receives one line when a
 * stage has ended.  Errors: GB_ERR_GUARD when the funnel is clogged, and as of
 * gb_bed_evaluate. */
enum gb_die_sequence_state gb_die_cycle_check(struct gb_die_stages *stages,
                                              struct gb_bed *bed, char *text, size_t size,
                                              struct gb_error *err);

/* The stages of a die scene that record points: pressing and, in a full cycle, what follows
 * it.  The pressure falls the way it rose; the punch is drawn off; the compact rests in
 * the die; a lower punch pushes it through the open upper end, which lies at the height
 * of the powder before pressing; it rests outside.  The floor is that lower punch and
 * stands still: the die sinks past it at die.eject_speed.  From the withdrawal on a drag
 * takes up what the compact releases. */

/* Is this a stage of the table? */
bool gb_die_cycle_contains(enum gb_die_stages_stage stage);

/* Does the pressure of the punch rise or fall in this stage? */
bool gb_die_cycle_presses(const struct gb_die_stages *stages);

/* Height of the powder: of the punch, of the highest particle before pressing, or of the
 * compact by its springback. */
double gb_die_cycle_height(const struct gb_die_stages *stages, const struct gb_bed *bed);

/* Height of the powder against the side, above 0. */
double gb_die_cycle_wall(const struct gb_die_stages *stages, const struct gb_bed *bed);

/* After a step of a stage of the table: has it come to a recorded point? */
bool gb_die_cycle_due(struct gb_die_stages *stages, const struct gb_bed *bed);

/* After that point: the next stage begins where this one has ended.  text (size bytes)
 * receives one line then.  Errors: as of gb_bed_welds_form. */
bool gb_die_cycle_after_point(struct gb_die_stages *stages, struct gb_bed *bed,
                              char *text, size_t size, struct gb_error *err);

/* Height of the compact over that under the full pressure, and its outer radius over that of
 * the bore, less 1; NaN before the full pressure.  Elastic particles enter wall and punch
 * by their overlap, which counts as growth under load. */
void gb_die_cycle_springback(const struct gb_die_stages *stages, const struct gb_bed *bed,
                             double *axial, double *radial);

/* Share of the present stage that is done, 0 to 1, where it is one of the table. */
double gb_die_cycle_share(const struct gb_die_stages *stages, const struct gb_bed *bed);

#endif
