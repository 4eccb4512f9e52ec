#ifndef GB_TUI_SESSION_SESSION_REFRESH_H
#define GB_TUI_SESSION_SESSION_REFRESH_H

#include "tui/session/session.h"

/* Takes over a snapshot of the run for display. */
void gb_session_refresh_show(struct gb_session *session,
                             const struct gb_snapshot *snapshot);

#endif
