#ifndef GB_TUI_PANEL_PANELS_H
#define GB_TUI_PANEL_PANELS_H

#include "tui/app/keys.h"
#include "tui/panel/prompt.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"

/* The four panes.  Each draws into its rectangle and answers actions while it has the
 * focus.  They see the run only through the session. */

/* What stands on the message line, and how serious it is. */
struct gb_message {
    char text[600];
    enum gb_style style;
};

/* [parameters] */
struct gb_panel_params {
    int focus; /* row of the field table */
    bool all;  /* also those that mean nothing to the scene */
    int top;   /* first line shown */
    int page;  /* lines shown by the last draw */
    bool editing;
    int choice; /* of a field with choices, while editing */
    struct gb_prompt prompt;
};

void gb_panel_params_draw(struct gb_panel_params *panel, const struct gb_paint *paint,
                          struct gb_session *session, bool focus);
/* False when the action is not for this pane. */
bool gb_panel_params_act(struct gb_panel_params *panel, struct gb_session *session,
                         enum gb_action action, struct gb_message *message);
/* Moves to the next parameter whose name, or group.name, has that text in it; one that is
 * called so comes first.  All are listed when the scene does not use it.  False: there is
 * none. */
bool gb_panel_params_find(struct gb_panel_params *panel, struct gb_session *session,
                          const char *name);
/* The parameter in a row of the pane gets the focus; false: there is none.  *value tells
 * whether the column is one of its value. */
bool gb_panel_params_click(struct gb_panel_params *panel, struct gb_session *session,
                           int row, int col, bool *value);
/* "contact.mu=0.1": the parameter with the focus, as edited. */
void gb_panel_params_assignment(const struct gb_panel_params *panel,
                                struct gb_session *session, char *text, size_t size);
/* A key while editing. */
void gb_panel_params_edit_key(struct gb_panel_params *panel, struct gb_session *session,
                              const struct gb_term_event *event,
                              struct gb_message *message);
/* The parameters, with the value being typed where it is a good one. */
struct gb_params gb_panel_params_edited(struct gb_panel_params *panel,
                                        struct gb_session *session);
/* Meaning and range of the parameter with the focus. */
void gb_panel_params_describe(const struct gb_panel_params *panel,
                              struct gb_session *session, struct gb_message *message);

/* [plot] */
/* In the order of their keys 1, 2, ... 9, 0. */
enum gb_plot_view {
    GB_VIEW_CURVE,
    GB_VIEW_HISTOGRAM,
    GB_VIEW_ROSE,
    GB_VIEW_TIME,
    GB_VIEW_DISTANCES,
    GB_VIEW_RATIO,
    GB_VIEW_FORCE,
    GB_VIEW_STRENGTH,
    GB_VIEW_PACKING,
    GB_VIEW_CHART,
    GB_VIEWS
};

/* Laws below the curve, where there is room. */
enum { GB_PANEL_INSETS = 2 };

struct gb_panel_plot {
    enum gb_plot_view view;
    bool log, hide_previous;
    bool shades; /* the screen can shade a relief */
    bool utf8;   /* and has more than ASCII */
    bool pixels; /* the packing is shown as a picture: its cells stay empty */
    enum gb_plot_glyphs glyphs;
    bool cursor_on;
    size_t cursor;        /* point of the curve */
    double unit_pa;       /* of the pressure axis */
    struct gb_rect field; /* cells of the screen that the view fills */
    struct gb_plot plot, inset[GB_PANEL_INSETS];
    struct gb_plot *target;  /* the one a law is being drawn into */
    struct gb_params edited; /* with the value being typed, if it is a good one */
    double *x, *y;           /* series under construction */
    size_t capacity;
};

/* graph: GB_GRAPH_AUTO or what is asked for. */
void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term,
                        int graph);
void gb_panel_plot_finish(struct gb_panel_plot *panel);
void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, bool focus);
bool gb_panel_plot_act(struct gb_panel_plot *panel, const struct gb_session *session,
                       enum gb_action action);
/* The cursor goes to the point of the curve that is nearest to a cell of the pane. */
void gb_panel_plot_click(struct gb_panel_plot *panel, const struct gb_session *session,
                         int row, int col);
/* Room for count points in x and y. */
bool gb_panel_plot_reserve(struct gb_panel_plot *panel, size_t count);
/* "relax", "compress" or "hold": the branch of a point of a dynamic run. */
const char *gb_panel_plot_stage(int branch);
/* The point under the cursor, or what the view shows. */
void gb_panel_plot_describe(const struct gb_panel_plot *panel,
                            const struct gb_session *session, struct gb_message *message);

/* [state] */
void gb_panel_state_draw(const struct gb_paint *paint, const struct gb_session *session,
                         bool focus);
/* "running", with its sign; the style says the same in colour. */
const char *gb_panel_state_word(int state, enum gb_style *style);

/* [events] */
struct gb_panel_events {
    int back; /* lines scrolled back from the last */
    int page;
};

void gb_panel_events_draw(struct gb_panel_events *panel, const struct gb_paint *paint,
                          const struct gb_session *session, bool focus);
bool gb_panel_events_act(struct gb_panel_events *panel, const struct gb_session *session,
                         enum gb_action action);

#endif
