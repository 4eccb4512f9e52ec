#ifndef GREENBODY_GREENBODY_H
#define GREENBODY_GREENBODY_H

/* The library of greenbody: cold compaction of powders by discrete elements.  The page
 * docs/library.md shows it by examples.
 *
 * It keeps no state of its own between objects, never prints, exits or installs a signal
 * handler; a call that fails returns a value and fills a struct gb_error.
 *
 * Every function checks its arguments.  A missing object, text or result (NULL) is
 * GB_ERR_INPUT.  A function without an error returns NULL, 0 or false then, and one without
 * a result does nothing. */
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
 * bytes, numbers in it, and type 'd' (double), 'q' (int64_t) or 'i' (int).  False after the
 * last.  A result that is not needed may be NULL. */
bool gb_library_point_member(size_t index, const char **name, size_t *offset,
                             size_t *count, char *type);

#ifdef __cplusplus
}
#endif

#endif
