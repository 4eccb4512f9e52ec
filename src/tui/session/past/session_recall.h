#ifndef GB_TUI_SESSION_PAST_SESSION_RECALL_H
#define GB_TUI_SESSION_PAST_SESSION_RECALL_H

#include "tui/session/session.h"

/* Results that are kept in memory, and the steps of the parameters. */

/* After a change of the parameters: shows the run or quick cell of these parameters that
 * is kept in memory, else starts a quick cell.  A run that was stopped by being replaced
 * continues where its directory holds it. */
void gb_session_recall_answer(struct gb_session *session);

/* Goes to the parameters before (-1) or after (1) a change and answers; text receives what
 * has changed, or that there is nothing.  False: nothing has changed. */
bool gb_session_recall_step(struct gb_session *session, int direction, char *text,
                            size_t size);

/* Keeps the run, or the quick cell if it has finished, in memory and takes it from the
 * session. */
void gb_session_recall_keep_run(struct gb_session *session);
void gb_session_recall_keep_quick(struct gb_session *session);

#endif
