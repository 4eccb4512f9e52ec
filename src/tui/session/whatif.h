#ifndef GB_TUI_SESSION_WHATIF_H
#define GB_TUI_SESSION_WHATIF_H

#include "tui/session/session.h"

/* What if: the run under way goes on from its next point with other values, given as
 * gb_changes_add (scene/field/changes.h) takes them; what it has been stays as an earlier
 * curve.  Errors: GB_ERR_INPUT. */
bool gb_whatif_ask(struct gb_session *session, const char *text, struct gb_error *err);

/* Goes on with the changed values once the state has come. */
void gb_whatif_refresh(struct gb_session *session);

#endif
