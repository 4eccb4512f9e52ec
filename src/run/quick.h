#ifndef GB_RUN_QUICK_H
#define GB_RUN_QUICK_H

#include <stdbool.h>

#include "greenbody/params.h"

/* The quick cell: the same powder and loading in a cell so small, strained in steps so
 * large, that the whole loading curve is computed within about two seconds.  The larger
 * steps raise the density by about 0.01 (four cells of set II, at 100 MPa: 0.010 above the
 * same cells in steps of 0.1 %); the density of one cell of 1000 particles scatters by
 * 0.005. */
enum { GB_QUICK_COUNT = 1000 };

/* Fills quick with the quick twin of checked parameters: no unloading, no stages before
 * and behind a dynamic compression, fidelity fast.  False when there is none that would
 * answer in time: a slow dynamic run, or a kind that has no small cell. */
bool gb_quick_params(const struct gb_params *full, struct gb_params *quick);

/* Whether the scene is itself about as quick as its quick twin. */
bool gb_quick_enough(const struct gb_params *full);

#endif
