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

/* A packing read from a file: state.h5 or a kept state of a run directory, or what
 * gb_simulation_save has written. */
struct gb_saved_state;

/* Errors: GB_ERR_MACHINE (cannot be opened), GB_ERR_INPUT (not a state), naming the path. */
bool gb_saved_state_load(struct gb_saved_state **out, const char *path,
                         struct gb_error *err);
void gb_saved_state_destroy(struct gb_saved_state *saved); /* NULL is fine */

/* Its measures; lives as long as the object. */
const struct gb_point *gb_saved_state_point(const struct gb_saved_state *saved);
/* Title of the preset and seed of its run. */
const char *gb_saved_state_title(const struct gb_saved_state *saved);
uint64_t gb_saved_state_seed(const struct gb_saved_state *saved);

/* An array by its name (gb_array_name); it lives as long as the object.  In a file positions
 * lie inside of the periodic cell, and a die stands in a box from 0.  Errors: GB_ERR_INPUT
 * for an unknown name (err lists them) or one that the state has not, GB_ERR_MEMORY. */
bool gb_saved_state_array(struct gb_saved_state *saved, const char *name,
                          struct gb_array *array, struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
