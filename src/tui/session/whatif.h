#ifndef GB_TUI_SESSION_WHATIF_H
#define GB_TUI_SESSION_WHATIF_H

#include "tui/session/session.h"

/* A what-if: the current run continues from its next point with other values, in the
 * syntax of gb_changes_add (scene/field/changes.h); its curve so far becomes a previous
 * curve.  Errors: GB_ERR_INPUT. */
bool gb_whatif_request(struct gb_session *session, const char *text,
                       struct gb_error *err);

/* Starts the continuation when the state of the next point has arrived. */
void gb_whatif_refresh(struct gb_session *session);

#endif
