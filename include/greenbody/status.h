#ifndef GREENBODY_STATUS_H
#define GREENBODY_STATUS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Outcome of a call.  The engine never prints, exits or aborts: a function that fails
 * returns false (or NULL) and fills a struct gb_error.  "Not converged", "cancelled" and
 * "failed" are different codes. */
enum gb_status {
    GB_OK = 0,
    GB_ERR_INPUT,   /* bad usage, preset, file content: exit status 2 */
    GB_ERR_MACHINE, /* disk full, no permission, unreadable file: exit status 3 */
    GB_ERR_MEMORY,  /* out of memory: exit status 3 */
    GB_ERR_GUARD,   /* a physical or numerical guard stopped the run: exit status 1 */
    GB_ERR_NOT_CONVERGED, /* relaxation ran out of evaluations: exit status 1 */
    GB_ERR_CANCELLED      /* asked to stop: exit status 130 or 143 */
};

/* Size of an event: one line, with the text of an error in it. */
enum { GB_EVENT_TEXT = 640 };

/* Code and message of a failure; unchanged by calls that succeed.  Callers pass a zeroed
 * one, or NULL when they need neither. */
struct gb_error {
    enum gb_status code;
    char text[480]; /* one line, no newline: what, where, what is accepted */
};

/* Fills err (NULL is fine) from a printf format and returns false, so that callers write
 * `return gb_error_set(err, ...)`.  Control characters and bytes
 * that are no UTF-8 become escapes like \x1b. */
bool gb_error_set(struct gb_error *err, enum gb_status code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Process exit status that belongs to a code: 0, 1, 2, 3 (see enum), 130 for cancelled.
 */
int gb_status_exit_code(enum gb_status code);

#ifdef __cplusplus
}
#endif

#endif
