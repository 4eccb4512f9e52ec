#ifndef GREENBODY_SAVED_STATE_H
#define GREENBODY_SAVED_STATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/array.h"
#include "greenbody/point.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A packing that was read from a file: state.h5 or a kept state of a run directory, or a
 * file of gb_simulation_save. */
struct gb_saved_state;

/* Reads a state.  Errors, which name the path: GB_ERR_MACHINE (cannot be opened),
 * GB_ERR_INPUT (not a state). */
bool gb_saved_state_load(struct gb_saved_state **out, const char *path,
                         struct gb_error *err);
void gb_saved_state_destroy(struct gb_saved_state *saved); /* NULL is fine */

/* The recorded point of this state; valid until gb_saved_state_destroy. */
const struct gb_point *gb_saved_state_point(const struct gb_saved_state *saved);
/* Title of the preset, and seed of the run. */
const char *gb_saved_state_title(const struct gb_saved_state *saved);
uint64_t gb_saved_state_seed(const struct gb_saved_state *saved);

/* An array by its name (gb_array_name); valid until gb_saved_state_destroy.  Positions
 * are inside the periodic cell.  A die is in a box whose corner is the origin.
 * Errors: GB_ERR_INPUT for an unknown name (err lists the names) or an array that the
 * state lacks, GB_ERR_MEMORY. */
bool gb_saved_state_array(struct gb_saved_state *saved, const char *name,
                          struct gb_array *array, struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
