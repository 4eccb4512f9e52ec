#ifndef GB_TUI_PANEL_PANELS_H
#define GB_TUI_PANEL_PANELS_H

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "tui/panel/list_box.h"
#include "tui/panel/plot.h"
#include "tui/panel/prompt.h"
#include "tui/panel/sphere_shading.h"
#include "tui/session/results.h"
#include "tui/session/session.h"
#include "tui/term/paint.h"
#include <stdbool.h>
#include <stddef.h>

struct gb_plot_view;

/* The four panes.  Each draws into its rectangle and handles navigation keys while it
 * has the focus.  They access the run only through the session. */

/* The message line. */
struct gb_message {
    char text[600];
    enum gb_style style;
};

/* --- parameters: panel_params.c -------------------------------- */

struct gb_panel_params {
    int focus; /* row of the field table */
    bool all;  /* also list parameters without effect on the scene */
    int top;   /* first line shown */
    int page;  /* lines visible at the last draw */
    bool editing;
    int choice; /* of a field with choices, while editing */
    struct gb_prompt prompt;
};

void gb_panel_params_draw(struct gb_panel_params *panel, const struct gb_paint *paint,
                          struct gb_session *session, enum gb_paint_focus focus);
void gb_panel_params_navigate(struct gb_panel_params *panel, struct gb_session *session,
                              enum gb_action action);
/* Switches the list between all parameters and those of the scene. */
void gb_panel_params_list_all(struct gb_panel_params *panel, struct gb_message *message);
/* Moves to a row of the field table.  If the scene does not use it, the list shows all
 * parameters. */
void gb_panel_params_go(struct gb_panel_params *panel, struct gb_session *session,
                        int field);

enum gb_panel_params_hit {
    GB_PANEL_PARAMS_MISS,
    GB_PANEL_PARAMS_KEY,
    GB_PANEL_PARAMS_VALUE
};

/* Focuses the parameter in a row of the pane; returns what the column contains. */
enum gb_panel_params_hit gb_panel_params_click(struct gb_panel_params *panel,
                                               struct gb_session *session, int row,
                                               int col);
/* Writes "contact.mu=0.1": the focused parameter as edited. */
void gb_panel_params_assignment(const struct gb_panel_params *panel,
                                struct gb_session *session, char *text, size_t size);
/* Field of the focused parameter. */
const struct gb_field *gb_panel_params_field(const struct gb_panel_params *panel);
/* Meaning and range of the focused parameter. */
void gb_panel_params_describe(const struct gb_panel_params *panel,
                              struct gb_session *session, struct gb_message *message);

/* Handles a key while a value is edited. */
void gb_panel_params_edit_key(struct gb_panel_params *panel, struct gb_session *session,
                              const struct gb_term_event *event,
                              struct gb_message *message);
/* Sets a valid value.  If it conflicts with other values it is set with a warning,
 * because the user may change the others next.  False: the value itself is invalid and
 * is not set. */
bool gb_panel_params_edit_set(struct gb_session *session, const struct gb_field *field,
                              const char *text, struct gb_message *message);
/* Call after a change of parameters: starts the quick cell, or warns about a conflict. */
void gb_panel_params_edit_changed(struct gb_session *session, struct gb_message *message);
/* Increases (1) or decreases (-1) the focused value and starts the quick cell. */
void gb_panel_params_edit_step(struct gb_panel_params *panel, struct gb_session *session,
                               int direction, struct gb_message *message);
/* Restores the value used by the run. */
void gb_panel_params_edit_revert(struct gb_panel_params *panel,
                                 struct gb_session *session, struct gb_message *message);
/* The parameters with the value being typed, if that is valid. */
struct gb_params gb_panel_params_edit_params(struct gb_panel_params *panel,
                                             struct gb_session *session);

/* --- plot: panel_plot.c ---------------------------------------- */

/* Number of contact laws drawn below the curve, if there is room. */
enum { GB_PANEL_INSETS = 2 };

struct gb_plot_range {
    bool typed; /* false: automatic */
    double low, high;
};

enum gb_plot_range_of {
    GB_PLOT_RANGE_PRESSURE,   /* Pa */
    GB_PLOT_RANGE_DENSITY,    /* relative density */
    GB_PLOT_RANGE_TIME,       /* ns, or recorded steps */
    GB_PLOT_RANGE_RATIO,      /* lateral-to-axial stress ratio */
    GB_PLOT_RANGE_DIFFERENCE, /* of densities */
    GB_PLOT_RANGES
};

struct gb_plot_ranges {
    struct gb_plot_range of[GB_PLOT_RANGES];
};

struct gb_panel_plot {
    const struct gb_plot_view *view;
    bool log, hide_previous;
    bool shades; /* shades of one hue are available */
    bool utf8;   /* UTF-8, not ASCII only */
    bool pixels; /* the packing is a pixel image; its cells stay empty */
    enum gb_plot_glyphs glyphs;
    struct gb_packing_look look; /* how the packing is shown */
    bool cursor_on;
    size_t cursor;                         /* point of the curve */
    double at_pa;                          /* typed pressure; 0: none */
    const struct gb_plot_view *setting_on; /* view whose cursor is on; NULL: none */
    size_t setting;                        /* row under that cursor */
    double unit_pa;                        /* unit of the pressure axis */
    struct gb_plot_ranges ranges;          /* typed ranges of the axes */
    struct gb_rect field;                  /* the view's cells on the screen */
    struct gb_plot plot, inset[GB_PANEL_INSETS];
    struct gb_plot *target;  /* target of the current drawing: plot or an inset */
    struct gb_params edited; /* gb_panel_params_edit_params */
    struct gb_compaction_cache fits;
    double *x, *y; /* series under construction */
    size_t capacity;
};

/* graph: enum gb_settings_graph. */
void gb_panel_plot_init(struct gb_panel_plot *panel, const struct gb_term *term,
                        int graph);
void gb_panel_plot_finish(struct gb_panel_plot *panel);
void gb_panel_plot_draw(struct gb_panel_plot *panel, const struct gb_paint *paint,
                        const struct gb_session *session, enum gb_paint_focus focus);
/* The next (1) or previous (-1) view of the scene. */
void gb_panel_plot_step_view(struct gb_panel_plot *panel, int step);
/* Allocates x and y for count points; false: out of memory. */
bool gb_panel_plot_reserve(struct gb_panel_plot *panel, size_t count);
/* "relax", "compress" or "hold": stage of a point of a dynamic run. */
const char *gb_panel_plot_stage(int branch);

/* Moves the cursor along the points of the curve. */
void gb_panel_plot_cursor_navigate(struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   enum gb_action action);
/* Moves the cursor to the point nearest to a cell of the pane. */
void gb_panel_plot_cursor_click(struct gb_panel_plot *panel,
                                const struct gb_session *session, int row, int col);
/* Puts the cursor at a pressure.  If the present view has no pressure axis, switches to
 * the view of pressure against density. */
void gb_panel_plot_pressure_set(struct gb_panel_plot *panel,
                                const struct gb_session *session, double pressure_pa);
/* Is the cursor at a typed pressure? */
bool gb_panel_plot_pressure_shown(const struct gb_panel_plot *panel);
/* Density of the first curve that has reached this pressure; NaN: none. */
double gb_panel_plot_pressure_density(const struct gb_panel_plot *panel,
                                      const struct gb_session *session);

/* Row of the settings under the cursor; false: none. */
bool gb_panel_plot_settings_at(const struct gb_panel_plot *panel,
                               const struct gb_session *session, size_t *row);
/* x coordinate of a point in the view: relative density, ns or step. */
double gb_panel_plot_cursor_x(const struct gb_panel_plot *panel,
                              const struct gb_session *session,
                              const struct gb_point *point);
/* Are there values at the cursor? */
bool gb_panel_plot_cursor_shown(const struct gb_panel_plot *panel,
                                const struct gb_session *session);
/* Describes the values at the cursor, or the misfit to the measured data, or the view's
 * hint. */
void gb_panel_plot_cursor_describe(const struct gb_panel_plot *panel,
                                   const struct gb_session *session,
                                   struct gb_message *message);

/* --- state: panel_state.c -------------------------------------- */

void gb_panel_state_draw(const struct gb_paint *paint, const struct gb_session *session,
                         enum gb_paint_focus focus);
/* "running" with a symbol; *style is its colour. error: text of the snapshot's error.
 * A run that is done with an error has missed a goal. */
const char *gb_panel_state_word(enum gb_run_state state, const char *error,
                                enum gb_style *style);
/* Writes "filling 812 of 1751", or only the stage if that is wider than cols, for an
 * active run in a die.  False: no stage, or no room. */
bool gb_panel_state_stage(const struct gb_snapshot *now, enum gb_run_state state,
                          int cols, char *text, size_t size);

/* --- events ------------------------------------------------------------------------- */

struct gb_panel_events {
    int back; /* lines scrolled back from the newest */
    int page;
};

void gb_panel_state_events_draw(struct gb_panel_events *panel,
                                const struct gb_paint *paint,
                                const struct gb_session *session,
                                enum gb_paint_focus focus);
void gb_panel_state_events_navigate(struct gb_panel_events *panel,
                                    const struct gb_session *session,
                                    enum gb_action action);

/* The next value of a parameter upwards (1) or downwards (-1), as preset text.  Numbers
 * change by 4 to 10 % and keep their unit, choices are cyclic, a seed changes by 1.
 * False: there is no next value (a text, a list, "auto").  The result may be out of
 * range; gb_params_set checks it. */
bool gb_panel_params_next_value(const struct gb_field *field, const char *value,
                                int direction, char *text, size_t size);

enum { GB_PARAM_LIST_MAX = 160 };

/* The parameters listed in the pane, with their lines: those with an effect on the
 * scene, or all.  Every group has a heading, with a blank line before all but the
 * first. */
struct gb_param_list {
    int count;
    int field[GB_PARAM_LIST_MAX]; /* rows of the field table, ascending */
    int line[GB_PARAM_LIST_MAX];
    bool first[GB_PARAM_LIST_MAX]; /* first of its group; the heading is one line above */
};

void gb_panel_params_list_init(struct gb_param_list *list, const struct gb_params *params,
                               bool all);

/* Index in the list of a row of the field table.  For a row that is not listed, the
 * index of the last listed row before it, or 0. */
int gb_panel_params_list_index(const struct gb_param_list *list, int field);

/* Ranges of axes typed by the user, by the quantity on the axis. */

/* Reads "p=10 MPa:500 MPa rho=0.3:0.6"; quantities that are not named are automatic.
 * Errors: GB_ERR_INPUT; the ranges do not change. */
bool gb_panel_plot_ranges_parse(struct gb_plot_ranges *ranges, const char *text,
                                struct gb_error *err);
/* Writes the text that sets these ranges. */
void gb_panel_plot_ranges_write(const struct gb_plot_ranges *ranges, char *text,
                                size_t size);
bool gb_panel_plot_ranges_any(const struct gb_plot_ranges *ranges);

/* Is a value inside the typed range, or is the axis automatic? */
bool gb_panel_plot_ranges_inside(const struct gb_plot_ranges *ranges,
                                 enum gb_plot_range_of of, double value);

/* Call before gb_plot_axes: sets the ends of the x and y axes to the typed ends, which
 * are kept exactly. unit: unit of the axis, in the unit of the range. */
void gb_panel_plot_ranges_x(const struct gb_plot_ranges *ranges, enum gb_plot_range_of of,
                            double unit, struct gb_plot *plot, double ends[2]);
void gb_panel_plot_ranges_y(const struct gb_plot_ranges *ranges, enum gb_plot_range_of of,
                            double unit, struct gb_plot *plot, double ends[2]);

#endif
