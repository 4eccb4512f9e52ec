#ifndef GB_STUDY_COMPACT_OFFSET_PROBE_H
#define GB_STUDY_COMPACT_OFFSET_PROBE_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "measure/yield_offset.h"
#include "scene/path/path.h"
#include "study/compact/compact.h"

/* A probe of a compact: a copy is strained along one direction from a state inside the yield
 * surface, the direction that leads along a given one of the (p, q) plane while the compact
 * is elastic.  Strain is prescribed, so that a softening compact can be followed;
 * e_x = e_y. */
struct gb_offset_probe {
    double direction; /* rad in the (p, q) plane */
    struct gb_yield_elastic elastic;
    GArray *state; /* struct gb_compact_state; the first one is that of the compact */
    enum gb_compact_outcome outcome;
    struct gb_error why; /* of a probe that a guard has stopped */
};

/* How a probe is strained. */
struct gb_offset_probe_steps {
    double step;        /* of strain */
    double strain_most; /* at which it is given up */
    double enough;      /* plastic strain at which it ends */
};

/* The leg of a strain direction (dv, dw): "strain z = 1, x = -0.5, y = -0.5 to 3 %", 3 % of the
 * axis that is strained most.  Returns buffer. */
char *gb_offset_probe_leg(double volume, double shear, double strain_most, char *buffer,
                          size_t size);

/* Follows the direction until the plastic strain is enough, or to the largest strain.
 * gb_offset_probe_finish must be called.  A guard that stops the probe is no error: its
 * states up to there are kept.
 *
 * elastic  of the compact `inside` (gb_compact_elastic) */
bool gb_offset_probe_run(struct gb_offset_probe *probe, struct gb_compact *inside,
                         double direction, const struct gb_yield_elastic *elastic,
                         const struct gb_offset_probe_steps *steps,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err);
void gb_offset_probe_finish(struct gb_offset_probe *probe); /* zeroed is fine */

/* The yield point at an offset of the plastic strain, stresses in Pa, as
 * gb_yield_offset_find.  False: the offset was not reached. */
bool gb_offset_probe_point(const struct gb_offset_probe *probe, double offset,
                           double flow_end, struct gb_yield_point *point);

#endif
