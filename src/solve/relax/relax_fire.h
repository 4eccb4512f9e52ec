#ifndef GB_SOLVE_RELAX_RELAX_FIRE_H
#define GB_SOLVE_RELAX_RELAX_FIRE_H

#include "solve/relax/relax.h"

/* The motion of FIRE, for relaxers that build on it: velocities in vectors 0 and 1 of the
 * relaxation, everything else here. */
struct gb_relax_fire_state {
    double step, mixing;
    double speed2; /* sum of v^2 and, times the inertia, of the angular velocities^2 */
    int downhill;
};

/* Lengths of steps in sqrt(m / (E d)), shares of the velocity that follow the force. */
struct gb_relax_fire_tuning {
    double step_first, step_most, shrink;
    double mixing_first, mixing_decay;
    int delay; /* moves downhill before the step grows */
};

/* Of fire and predict. */
extern const struct gb_relax_fire_tuning gb_relax_fire_plain, gb_relax_predict_tuning;

/* Brings the particles to rest. */
void gb_relax_fire_rest(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning,
                        struct gb_world *world);
/* One move, after gb_relax_evaluate. */
void gb_relax_fire_move(struct gb_relax *relax, struct gb_relax_fire_state *fire,
                        const struct gb_relax_fire_tuning *tuning,
                        struct gb_world *world);

#endif
