#ifndef GB_TUI_SESSION_SESSION_QUICK_H
#define GB_TUI_SESSION_SESSION_QUICK_H

#include "tui/session/session.h"

/* The quick cell of a session, and the full run after it. */

/* Starts the quick cell of the edited parameters; the engine of the current run waits for
 * it.  Nothing is computed for scenes without a quick cell and for the parameters of the
 * current run.  False: no quick cell was started. */
bool gb_session_quick_start(struct gb_session *session);

/* Whether the full run is due after its quick cell; clears the flag. */
bool gb_session_quick_take_due(struct gb_session *session);

/* Whether the quick cell belongs to these parameters. */
bool gb_session_quick_matches(const struct gb_session *session,
                              const struct gb_params *params);

/* Cost of the full run, estimated from the quick cell; NaN: no estimate.  True: it needs a
 * confirmation, whose text is in text. */
bool gb_session_quick_cost(const struct gb_session *session, double *seconds, char *text,
                           size_t size);

/* Keeps the curve of the quick cell as a previous one unless the full run of its scene has
 * been started. */
void gb_session_quick_keep_curve(struct gb_session *session);

/* After the end of the quick cell: reports it, and decides on the full run. */
void gb_session_quick_finish(struct gb_session *session);

#endif
