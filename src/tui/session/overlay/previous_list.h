#ifndef GB_TUI_SESSION_OVERLAY_PREVIOUS_LIST_H
#define GB_TUI_SESSION_OVERLAY_PREVIOUS_LIST_H

#include "tui/session/session.h"

/* The previous curves of a session, oldest first: which are kept, shown and coloured. */

/* Adds the curve of a run or quick cell, unless it has fewer than two points or memory is
 * short.  The oldest one that is not pinned makes room.  A pinned curve of the same quick
 * cell is replaced. */
void gb_previous_list_keep(struct gb_session *session, const struct gb_params *params,
                           const struct gb_runner *runner, enum gb_session_cell cell);
/* Updates the differences of the curves to these parameters. */
void gb_previous_list_describe(struct gb_session *session,
                               const struct gb_params *params);
/* The run or quick cell of these parameters is on display and no longer a previous one;
 * pinned curves of quick cells stay. */
void gb_previous_list_forget(struct gb_session *session, const struct gb_params *params,
                             bool quick);
void gb_previous_list_delete(struct gb_session *session, int index);

/* Pins or unpins the run (-1) or a previous curve.  False: GB_PREVIOUS_PINNED are pinned
 * already, so that the last run always has a place. */
enum { GB_PREVIOUS_PINNED = GB_SESSION_PREVIOUS - 1 };
bool gb_previous_list_pin(struct gb_session *session, int index, bool pinned);
/* A curve shown again takes a colour that is free. */
void gb_previous_list_hide(struct gb_session *session, int index, bool hidden);

/* Label of the run (-1) or of a previous curve. */
struct gb_curve_label *gb_previous_list_label(struct gb_session *session, int index);
/* Its name, or else its differences. */
const char *gb_previous_list_name(const struct gb_previous_curve *previous);

/* Whether a curve is drawn; hide: those that are not pinned are hidden. */
bool gb_previous_list_shown(const struct gb_previous_curve *previous, bool hide);
/* The first colour from 1 up that no shown curve has; 0: none. */
int gb_previous_list_free_colour(const struct gb_session *session);

#endif
