#ifndef GREENBODY_STATUS_H
#define GREENBODY_STATUS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Outcome of a call.  The engine never prints, exits or aborts.  A function that fails
 * returns false (or NULL) and fills a struct gb_error. */
enum gb_status {
    GB_OK = 0,
    GB_ERR_INPUT,   /* bad usage, preset, file content: exit status 2 */
    GB_ERR_MACHINE, /* disk full, no permission, unreadable file: exit status 3 */
    GB_ERR_MEMORY,  /* out of memory: exit status 3 */
    GB_ERR_GUARD,   /* a physical or numerical guard stopped the run: exit status 1 */
    GB_ERR_NOT_CONVERGED, /* relaxation ran out of evaluations: exit status 1 */
    GB_ERR_CANCELLED      /* stopped on request: exit status 130 or 143 */
};

/* Buffer size of an event: one line, which may contain the text of an error. */
enum { GB_EVENT_TEXT = 640 };

/* Code and message of a failure.  Pass a zeroed struct, or NULL if you need neither.
 * Calls that succeed do not change it. */
struct gb_error {
    enum gb_status code;
    char text[480]; /* one line without a newline: what, where, what is expected */
};

/* Fills err (NULL is fine) from a printf format.  Returns false, so that callers can
 * write `return gb_error_set(err, ...)`.  Control characters and invalid UTF-8 become
 * escapes like \x1b. */
bool gb_error_set(struct gb_error *err, enum gb_status code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Exit status of a process for a code: see the enum; 130 for GB_ERR_CANCELLED. */
int gb_status_exit_code(enum gb_status code);

#ifdef __cplusplus
}
#endif

#endif
