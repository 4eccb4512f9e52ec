#ifndef GB_TUI_SESSION_PAST_PARAM_STEPS_H
#define GB_TUI_SESSION_PAST_PARAM_STEPS_H

#include <stdbool.h>

#include "io/preset.h"

/* Parameter sets in the order of their changes, for undo and redo. */

enum { GB_PARAM_STEPS = 100 };

struct gb_param_step {
    struct gb_preset *preset; /* that the parameters belong to; not owned */
    struct gb_params params;
};

struct gb_param_steps {
    struct gb_param_step *step[GB_PARAM_STEPS]; /* owned; NULL from count on */
    int count, at;                              /* number of steps; the one on screen */
};

/* Adds a step if preset or parameters differ from those on screen: undone steps are
 * forgotten, and the oldest where there are too many.  Out of memory: no step. */
void gb_param_steps_note(struct gb_param_steps *steps, struct gb_preset *preset);

/* The parameters before (-1) or after (1); NULL: there are none.  Their preset gets
 * them. */
struct gb_preset *gb_param_steps_move(struct gb_param_steps *steps, int direction);

/* Number of steps that can be undone (-1) or redone (1). */
int gb_param_steps_left(const struct gb_param_steps *steps, int direction);

void gb_param_steps_finish(struct gb_param_steps *steps); /* zeroed is fine */

#endif
