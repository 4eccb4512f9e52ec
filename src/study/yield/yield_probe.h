#ifndef GB_STUDY_YIELD_YIELD_PROBE_H
#define GB_STUDY_YIELD_YIELD_PROBE_H

#include <glib.h>
#include <stdbool.h>

#include "measure/yield_offset.h"
#include "scene/path/path.h"
#include "study/compact/compact.h"
#include "study/yield/yield_options.h"

/* A probe: a copy of an unloaded compact, strained along one direction: in the one that
 * leads along a direction of the (p, q) plane while the compact is elastic.  Strain is
 * prescribed, so that a softening compact can be followed; e_x = e_y. */
struct gb_yield_probe {
    double direction; /* rad in the (p, q) plane */
    struct gb_yield_elastic elastic;
    GArray *state; /* struct gb_compact_state; the first one is that of the compact */
    enum gb_compact_outcome outcome;
    struct gb_error why; /* of a probe that a guard has stopped */
};

/* The leg of a strain direction (dv, dw): "strain z = 1, x = -0.5, y = -0.5 to 3 %", 3 % of the
 * axis that is strained most.  Returns buffer. */
char *gb_yield_probe_leg(double volume, double shear, double strain_most, char *buffer,
                         size_t size);

/* The stiffness of the compact, by two short probes of volume strain and of shear.  Errors:
 * GB_ERR_GUARD when it has none. */
bool gb_yield_probe_elastic(struct gb_yield_elastic *elastic, struct gb_compact *inside,
                            const struct gb_yield_options *options,
                            const struct gb_pool_callbacks *callbacks,
                            struct gb_error *err);

/* Follows the direction until the plastic strain is beyond what the largest offset needs,
 * or to the largest strain.  gb_yield_probe_finish is due.  A guard that stops the probe is
 * no error: its states up to there are kept. */
bool gb_yield_probe_run(struct gb_yield_probe *probe, struct gb_compact *inside,
                        double direction, const struct gb_yield_elastic *elastic,
                        const struct gb_yield_options *options,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err);
void gb_yield_probe_finish(struct gb_yield_probe *probe);

/* The yield point at an offset of the plastic strain; stresses in Pa.  False: the offset was
 * not reached. */
bool gb_yield_probe_point(const struct gb_yield_probe *probe, double offset,
                          struct gb_yield_point *point);

#endif
