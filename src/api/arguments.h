#ifndef GB_API_ARGUMENTS_H
#define GB_API_ARGUMENTS_H

#include <stddef.h>

#include "greenbody/status.h"

/* Checks that every public function makes first. */

/* Fails for a NULL object, text or result. */
static inline bool gb_arguments_given(const void *argument, const char *name,
                                      struct gb_error *err)
{
    return argument != NULL ||
           gb_error_set(err, GB_ERR_INPUT, "%s = NULL: expected a pointer", name);
}

/* Fails if the caller's buffer has less room than `needed` bytes or numbers. */
static inline bool gb_arguments_fit(size_t given, size_t needed, const char *name,
                                    struct gb_error *err)
{
    return given >= needed ||
           gb_error_set(err, GB_ERR_INPUT, "%s = %zu: expected at least %zu", name, given,
                        needed);
}

#endif
