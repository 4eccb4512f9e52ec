#ifndef GB_CLI_PACK_PACK_BED_H
#define GB_CLI_PACK_PACK_BED_H

#include <glib.h>

#include "greenbody/params.h"
#include "io/state/state.h"

/* A bed of a die scene, poured, settled and flattened, as `run` begins to press it. */
struct gb_pack_bed {
    struct gb_state *state;
    GPtrArray *filling; /* struct gb_state of the powder that falls, in order */
};

/* every_s   simulated time between kept states until all powder is poured; 0: none
 * Prints a line to stderr when a stage of the filling ends.  Errors: GB_ERR_INPUT (more than
 * GB_PACK_BED_STATES states), those of the run, GB_ERR_CANCELLED by a signal. */
bool gb_pack_bed_fill(struct gb_pack_bed *bed, const struct gb_params *params,
                      double every_s, struct gb_error *err);
void gb_pack_bed_finish(struct gb_pack_bed *bed); /* zeroed is fine; the state stays */

enum { GB_PACK_BED_STATES = 1000 };

/* The states of the filling as DIRECTORY/snapshots/filling-000001.h5 ... */
bool gb_pack_bed_write(const struct gb_pack_bed *bed, const char *directory,
                       struct gb_error *err);

/* Particles, height, densities and coordination on stdout. */
void gb_pack_bed_print(const struct gb_state *state);

#endif
