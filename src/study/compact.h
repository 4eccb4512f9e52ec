#ifndef GB_STUDY_COMPACT_H
#define GB_STUDY_COMPACT_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"
#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "many/pool.h"
#include "measure/yield_point.h"
#include "scene/field/keep_points.h"
#include "scene/path/path.h"

/* A pressed packing in memory.  Copies of it follow other loading paths; it does not
 * change itself. */
struct gb_compact {
    struct gb_params params; /* of the run that made it */
    struct gb_record record;
    struct gb_point point; /* the recorded one that it was taken at */
    bool sheared;          /* its cell can be tilted: set before it is
                       * pressed; its paths go on with a leg of shear, which is not for
                       * the caller */
    double tolerance;      /* of the residual on copies; NaN: that of the parameters */
};

/* Called at each recorded point; false: enough. */
typedef bool gb_compact_take(void *data, const struct gb_point *point);

enum gb_compact_outcome {
    GB_COMPACT_TAKEN,   /* the callback said enough */
    GB_COMPACT_ENDED,   /* the path ended before that */
    GB_COMPACT_STOPPED, /* a guard ended it, or a stress is out of reach; err says why */
    GB_COMPACT_FAILED   /* cancelled, no memory, bad parameters; err */
};

/* A run on the way to a compact, or from one.  Any member may be NULL. */
struct gb_compact_walk {
    gb_compact_take *take;
    void *data;
    const struct gb_pool_callbacks *callbacks; /* cancelled is polled */
};

/* Parameters that press a packing to a mark: the preset's own path, or its geometry (axes
 * are strained alike, the others are fixed).  Unloading and changes of the preset are left
 * out.  Errors: GB_ERR_INPUT for scenes other than a quasi-static 3D cell, and for
 * powders that neither attraction nor bridges hold together. */
bool gb_compact_params(struct gb_params *params, const struct gb_params *preset,
                       struct gb_error *err);

/* Presses a packing until a mark is reached.  gb_compact_finish is due, also after an error.
 * Errors: GB_ERR_GUARD when the run ends before. */
bool gb_compact_press(struct gb_compact *compact, const struct gb_params *params,
                      const struct gb_keep_point *mark,
                      const struct gb_pool_callbacks *callbacks, struct gb_error *err);

/* Follows legs ("hold x = y = z = 0 MPa", separated by "then") on a copy, in strain steps
 * of `step`.  to (NULL: none): the compact at the last point taken, if TAKEN; it has to be
 * there for the next path to go on, so that its path must not have ended. */
enum gb_compact_outcome gb_compact_follow(struct gb_compact *from, const char *path,
                                          double step, const struct gb_compact_walk *walk,
                                          struct gb_compact *to, struct gb_error *err);

/* Takes a copy to equal pressures on all axes, Pa, after it has come to rest at the tolerance
 * of copies: by equal strains where its stresses are
 * about equal, else along a straight line of the (p, q) plane. */
bool gb_compact_unload(struct gb_compact *from, double pressure_pa,
                       const struct gb_pool_callbacks *callbacks, struct gb_compact *to,
                       struct gb_error *err);

/* Elastic constants of a compact in the state it is in, by gb_moduli_measure: the numbers
 * of `greenbody moduli` at that state. */
struct gb_compact_elastic {
    double bulk, shear_modulus;    /* K and G of gb_elastic_average, Pa */
    struct gb_yield_elastic plane; /* compliance of the (p, q) plane, 1/Pa */
};

/* Errors: GB_ERR_GUARD where the compact has no equilibrium or no stiffness,
 * GB_ERR_CANCELLED, GB_ERR_MEMORY. */
bool gb_compact_elastic(struct gb_compact_elastic *elastic, struct gb_compact *compact,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err);

void gb_compact_finish(struct gb_compact *compact); /* zeroed is fine */

/* q = p_z - (p_x + p_y)/2, mean pressure, and the strains conjugate to both (see
 * measure/yield_point.h); Pa. */
struct gb_compact_state {
    double p, q, volume, shear;
};
struct gb_compact_state gb_compact_state_of(const struct gb_point *point);

/* A probe of a compact: a copy is strained along one direction from a state inside the yield
 * surface, the direction that leads along a given one of the (p, q) plane while the compact
 * is elastic.  Strain is prescribed, so that a softening compact can be followed;
 * e_x = e_y. */
struct gb_compact_probe {
    double direction; /* rad in the (p, q) plane */
    struct gb_yield_elastic elastic;
    GArray *state; /* struct gb_compact_state; the first one is that of the compact */
    enum gb_compact_outcome outcome;
    struct gb_error why; /* of a probe that a guard has stopped */
};

/* How a probe is strained. */
struct gb_compact_probe_steps {
    double step;        /* of strain */
    double strain_most; /* at which it is given up */
    double enough;      /* plastic strain at which it ends */
};

/* The leg of a strain direction (dv, dw): "strain z = 1, x = -0.5, y = -0.5 to 3 %", 3 % of the
 * axis that is strained most.  Returns buffer. */
char *gb_compact_probe_leg(double volume, double shear, double strain_most, char *buffer,
                           size_t size);

/* Follows the direction until the plastic strain is enough, or to the largest strain.
 * gb_compact_probe_finish must be called.  A guard that stops the probe is no error: its
 * states up to there are kept.
 *
 * elastic  of the compact `inside` (gb_compact_elastic) */
bool gb_compact_probe_run(struct gb_compact_probe *probe, struct gb_compact *inside,
                          double direction, const struct gb_yield_elastic *elastic,
                          const struct gb_compact_probe_steps *steps,
                          const struct gb_pool_callbacks *callbacks,
                          struct gb_error *err);

void gb_compact_probe_finish(struct gb_compact_probe *probe); /* zeroed is fine */

/* The yield point at an offset of the plastic strain, stresses in Pa, as
 * gb_yield_point_find.  False: the offset was not reached. */
bool gb_compact_probe_point(const struct gb_compact_probe *probe, double offset,
                            double flow_end, struct gb_yield_point *point);

#endif
