#ifndef GB_STUDY_STABILITY_STABILITY_H
#define GB_STUDY_STABILITY_STABILITY_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "pack/cell/world.h"

/* Where the integrator and the relaxers fail: a small disturbance of a packing at rest
 * grows when the step is longer than a bound.  Theory: from the highest frequency of the
 * linearised packing, which power iteration finds; the measurement lets the method itself
 * run, and bisects. */
struct gb_stability_row {
    const char *method; /* verlet, fire, predict; steepest: its "step" is k of P1 (15) */
    const char *scene;  /* pair, chain, lattice (simple cubic), packing */
    const char *law;    /* rod, friction, bridge */
    double damping;     /* share of critical in the fastest mode */
    double theory, measured; /* sqrt(m/(E d)); for steepest 1/(E d) */
    double exact;            /* the same in closed form; NaN where there is none */
    double used;             /* longest step that the method takes here by itself */
    /* of a state of a run (stability_run.h), which has no scene and law: */
    double density, p_pa;
    bool in_use; /* the run moves by this method */
};

/* How many rows there are. */
int gb_stability_rows(void);

/* Row `index`.  Errors: those of the engine. */
bool gb_stability_measure(int index, struct gb_stability_row *row, struct gb_error *err);

/* Does a disturbance grow at a step of `share` times the theoretical bound? */
bool gb_stability_grows(int index, double share, bool *grows, struct gb_error *err);

/* Methods of a scene: *first and how many after it. */
int gb_stability_methods(const struct gb_params *params, int *first);
/* Such a method at a copy of a world right after an evaluation, brought to rest.  Errors:
 * those of gb_probe_create. */
bool gb_stability_measure_world(int method, const struct gb_world *world,
                                struct gb_stability_row *row, struct gb_error *err);

#endif
