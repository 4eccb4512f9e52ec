#ifndef GREENBODY_GREENBODY_H
#define GREENBODY_GREENBODY_H

/* The library of greenbody: cold compaction of powders by discrete elements.
 * docs/library.md has examples.
 *
 * The library has no global state.  It never prints, exits or installs a signal
 * handler.  A function that fails returns false and fills a struct gb_error.
 *
 * Every function checks its arguments.  A missing object, text or result (NULL) is
 * GB_ERR_INPUT.  Functions that report no error return NULL, 0 or false in this case;
 * functions that return nothing do nothing. */
#include "greenbody/array.h"
#include "greenbody/contact_law.h"
#include "greenbody/outcome.h"
#include "greenbody/parameters.h"
#include "greenbody/point.h"
#include "greenbody/recorded_run.h"
#include "greenbody/saved_state.h"
#include "greenbody/simulation.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* "0.2.0" */
const char *gb_library_version(void);

/* Member `index` of struct gb_point, for other languages: its name ("p_pa"), offset in
 * bytes, count of numbers, and type 'd' (double), 'q' (int64_t) or 'i' (int).  False
 * after the last.  Pass NULL for a result that you do not need. */
bool gb_library_point_member(size_t index, const char **name, size_t *offset,
                             size_t *count, char *type);

#ifdef __cplusplus
}
#endif

#endif
