#ifndef GB_SOLVE_LOADING_PATH_LEG_GOAL_H
#define GB_SOLVE_LOADING_PATH_LEG_GOAL_H

#include "solve/loading/path/leg_run.h"

/* The ends of a leg under way: how far they are, whether they are reached, and whether they
 * can be. */

/* The way to the ends begins at this density and the present stress. */
void gb_leg_goal_begin(struct gb_leg_run *run, const struct gb_model *model,
                       double density);
/* Values and slopes at an accepted state. */
void gb_leg_goal_follow(struct gb_leg_run *run, const struct gb_model *model,
                        double density);
/* Leading strain of the next step: shortened to end at an end.  e: the end ahead. */
double gb_leg_goal_next_lead(const struct gb_leg_run *run, const struct gb_leg *leg,
                             int e, int ends);
/* One of the ends is reached; of a cycle, end e. */
bool gb_leg_goal_reached(const struct gb_leg_run *run, const struct gb_leg *leg, int e);
/* The leg, or half of a cycle, ends here: notes an end that is exceeded by more than
 * GB_PATH_BEYOND tolerances. */
void gb_leg_goal_note_excess(struct gb_leg_run *run, const struct gb_leg *leg, int e);
/* "exceeded: leg 2 (isotropic to 1 MPa) ends at pressure = 25 MPa", of the first that was
 * noted. */
void gb_leg_goal_excess(const struct gb_leg_run *run, const struct gb_model *model,
                        char *text, size_t size);
/* The stress that ends the leg has not risen over a long strain: it never will.  text (size
 * bytes) says so.  Legs with a second end that always comes go on to that one. */
bool gb_leg_goal_out_of_reach(struct gb_leg_run *run, const struct gb_model *model, int e,
                              char *text, size_t size);
/* The step went past a stress that ends the leg; run->shorter: how far it may go. */
bool gb_leg_goal_beyond(struct gb_leg_run *run, const struct gb_model *model,
                        const double stress[6]);

#endif
