#ifndef GB_SOLVE_LOADING_DIE_DIE_SEQUENCE_H
#define GB_SOLVE_LOADING_DIE_DIE_SEQUENCE_H

#include <stddef.h>

#include "solve/loading/die/die_state.h"

/* The order of the stages of a die scene: when one ends, and how the next one begins. */

enum gb_die_sequence_state {
    GB_DIE_SEQUENCE_CONTINUES, /* the stage continues */
    GB_DIE_SEQUENCE_ENDED,     /* it has ended and the next one has begun */
    GB_DIE_SEQUENCE_FAILED     /* neither; err says why */
};

/* Gravity is reduced twice, before flattening and behind it, by a constant factor in equal
 * times: this reduction or the next one (d/T^2, T). */
struct gb_die_sequence_ramp {
    double from, to, length;
};
struct gb_die_sequence_ramp gb_die_sequence_ramp(const struct gb_die_stages *stages);

void gb_die_sequence_enter(struct gb_die_stages *stages, enum gb_die_stages_stage stage);

/* Puts the punch on the powder and starts the ramp of pressure; the bed gets the law of
 * pressing.  Errors: as of gb_bed_evaluate. */
bool gb_die_sequence_begin_press(struct gb_die_stages *stages, struct gb_bed *bed,
                                 struct gb_error *err);

/* After a step of a stage before pressing.  text (size bytes) receives one line when a
 * stage has ended.  Errors: GB_ERR_GUARD when the funnel is clogged, and as of
 * gb_bed_evaluate. */
enum gb_die_sequence_state gb_die_sequence_check(struct gb_die_stages *stages,
                                                 struct gb_bed *bed, char *text,
                                                 size_t size, struct gb_error *err);

#endif
