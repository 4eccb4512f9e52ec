#ifndef GB_TUI_APP_CURVE_LIST_H
#define GB_TUI_APP_CURVE_LIST_H

#include "tui/panel/list_box.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"

/* The run and the previous curves, a line each, with their density at one pressure. */
struct gb_curve_list {
    struct gb_list_box box;
    bool naming; /* the name in focus is typed */
    struct gb_prompt prompt;
    double pressure_pa; /* of the densities */
};

/* pressure_pa: typed by the user; 0: none, the usual one. */
void gb_curve_list_init(struct gb_curve_list *list, const struct gb_session *session,
                        double pressure_pa);
void gb_curve_list_draw(struct gb_curve_list *list, const struct gb_session *session,
                        const struct gb_paint *paint);
void gb_curve_list_navigate(struct gb_curve_list *list, const struct gb_session *session,
                            enum gb_action action);
/* Begins to type the name in focus. */
void gb_curve_list_rename(struct gb_curve_list *list, struct gb_session *session);
/* Takes an event while a name is typed; false: nothing is typed, or it ends. */
bool gb_curve_list_type(struct gb_curve_list *list, const struct gb_term_event *event);

enum { GB_CURVE_LIST_RUN = -1, GB_CURVE_LIST_NONE = -2 };

/* Index of the previous curve in focus, or one of these. */
int gb_curve_list_focused(struct gb_curve_list *list, const struct gb_session *session);

#endif
