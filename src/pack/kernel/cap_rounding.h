#ifndef GB_PACK_KERNEL_CAP_ROUNDING_H
#define GB_PACK_KERNEL_CAP_ROUNDING_H

#include <stdbool.h>

#include "greenbody/status.h"

struct gb_world;

/* Contacts that a world in double precision has from one in single precision.  A spring
 * that slides stays just below its cap there, and rounding hides that: a small strain would
 * find it sticking both ways.  The same holds for a bridge at its deepest overlap, and for
 * one that peels.
 *
 * Springs within the rounding of single precision of their caps are lengthened to them, and
 * such bridges put where they are.  The laws of the world's own sweep decide, so this holds
 * for every law and size.  3D; right after an evaluation, and another must follow.
 *
 * most     largest change of a spring or a bridge, d
 * Errors: GB_ERR_MEMORY. */
bool gb_cap_rounding_undo(struct gb_world *world, double *most, struct gb_error *err);

#endif
