#ifndef GB_STUDY_STABILITY_H
#define GB_STUDY_STABILITY_H

#include <glib.h>
#include <stdbool.h>

#include "base/listing.h"
#include "greenbody/params.h"
#include "pack/cell/world.h"
#include "scene/field/keep_points.h"
#include "scene/model.h"

enum gb_stability_packing {
    GB_STABILITY_PAIR,
    GB_STABILITY_CHAIN,
    GB_STABILITY_LATTICE,
    GB_STABILITY_PACKING
};

enum gb_stability_law { GB_STABILITY_ROD, GB_STABILITY_FRICTION, GB_STABILITY_BRIDGE };

/* Alumina of 9.7 nm at rest, every pair at its equilibrium distance, and its fastest
 * mode. */
struct gb_stability_scene {
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *rest;
    double inertia;   /* rotational, m d^2 */
    double *mass;     /* count; NULL: all are 1 */
    double *mode;     /* count x 6: moves, then turns, both times the root of the
                       * inertia; of length 1 */
    double frequency; /* of the mode */
};

/* inertia: 0.1 of a sphere, or what a relaxer takes. */
bool gb_stability_scene_init(struct gb_stability_scene *scene,
                             enum gb_stability_packing packing, enum gb_stability_law law,
                             double inertia, struct gb_error *err);

void gb_stability_scene_finish(struct gb_stability_scene *scene);

/* Back to rest, the forces evaluated. */
bool gb_stability_scene_reset(struct gb_stability_scene *scene, struct gb_error *err);

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
    /* of a state of a run, which has no scene and law: */
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

/* Longest stable steps of the methods of a scene, velocity Verlet or the relaxers, in the
 * states of its run: the packing with its histories, brought to rest on a copy, is
 * disturbed along its fastest mode. */

struct gb_stability_sink {
    /* Called with each row in the order of the run; false ends it with its error. */
    bool (*row)(void *data, const struct gb_stability_row *row, struct gb_error *err);
    /* A state that cannot be measured, and why. */
    void (*skipped)(void *data, double p_pa, const char *why);
    void *data;
    bool (*cancelled)(void *data); /* polled; NULL is fine */
};

/* How many points there are where none are given. */
enum { GB_STABILITY_RUN_POINTS = 3 };

/* Presses a scene without unloading and measures where it first reaches each point (NULL:
 * 1, 10 and 100 MPa, as far as the run goes) and at its end.  *missed counts points that
 * were not reached.  Errors: GB_ERR_INPUT for scenes without a periodic cell, and where no
 * state could be measured; those of the run. */
bool gb_stability_run(const struct gb_params *params, const struct gb_keep_points *points,
                      const struct gb_stability_sink *sink, int *missed,
                      struct gb_error *err);

/* Whether the method is stable with the step that it takes. */
bool gb_stability_stable(const struct gb_stability_row *row);

/* A table, for rows of gb_stability_add; comment: lines above it.  gb_listing_free. */
struct gb_listing *gb_stability_table(const char *comment);
void gb_stability_add(struct gb_listing *listing, const struct gb_stability_row *row);

#endif
