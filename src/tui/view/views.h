#ifndef GB_TUI_VIEW_VIEWS_H
#define GB_TUI_VIEW_VIEWS_H

#include "tui/panel/panels.h"

/* Data that a view needs; if they are missing, a text is drawn instead. */
enum gb_view_need {
    GB_VIEW_NEEDS_NOTHING,
    GB_VIEW_NEEDS_POINTS,   /* two points of the curve */
    GB_VIEW_NEEDS_CONTACTS, /* a packing with contacts */
    GB_VIEW_NEEDS_SAMPLE,   /* positions of particles */
    GB_VIEW_NEEDS_CHART,    /* a chart.csv */
    GB_VIEW_NEEDS_STABILITY /* a stability.csv */
};

/* x axis of the views of curve points, on which the cursor moves.  In views with
 * another x axis, the mouse does not move the cursor. */
enum gb_view_abscissa {
    GB_VIEW_NO_CURSOR,
    GB_VIEW_DENSITY,
    GB_VIEW_ELAPSED,
    GB_VIEW_OWN,     /* the x axis of the view itself */
    GB_VIEW_SETTINGS /* rows of a chart or of the stability instead of points */
};

/* Longest texts that fit into 80 columns. */
enum { GB_VIEW_TITLE = 43, GB_VIEW_HINT = 120 };

enum gb_view_option {
    GB_VIEW_PRESSURE_AXIS = 1,   /* y is the pressure: L switches its axis */
    GB_VIEW_PRESSURE_ACROSS = 2, /* x is the pressure: L switches its axis */
    GB_VIEW_INSET = 4            /* also drawn below the curve, if there is room */
};

/* One row per view; key, help, title, footer hint, cursor, insets and `v` use it.  CONTRIBUTING.md
 * has the recipe for a new view. */
struct gb_plot_view {
    const char *key;   /* digit or letter */
    const char *help;  /* in the list of keys, at most 49 characters */
    const char *title; /* of the pane, at most GB_VIEW_TITLE characters */
    const char
        *title_by_step; /* title where x is the step, not the time; NULL: the same */
    const char *hint;   /* message, at most GB_VIEW_HINT characters */
    enum gb_view_need need;
    enum gb_view_abscissa abscissa;
    int options; /* bits of enum gb_view_option */
    void (*draw)(struct gb_panel_plot *panel, const struct gb_session *session);
    /* Handles the navigation keys of the pane; NULL: they move the cursor. */
    void (*navigate)(struct gb_panel_plot *panel, enum gb_action action);
    bool (*applies)(const struct gb_params *params); /* scenes of the view; NULL: all */
    const char *excluded;                            /* reason for the other scenes */
};

size_t gb_views_count(void);
const struct gb_plot_view *gb_views_at(size_t index);
/* The view of a key; NULL: none. */
const struct gb_plot_view *gb_views_find(const char *key);
/* The first view that needs this; the first of all if there is none. */
const struct gb_plot_view *gb_views_with(enum gb_view_need need);
/* The next (1) or previous (-1) view that applies to the scene. */
const struct gb_plot_view *gb_views_step(const struct gb_plot_view *view, int step,
                                         const struct gb_params *params);

/* Ink of a run: 0 dim, 1 to GB_CURVE_COLOURS as in its label.  The run on display has
 * GB_PLOT_INK_SERIES. */
int gb_views_curve_ink(int colour);

/* Text instead of a view whose data are missing; NULL: it can be drawn. */
const char *gb_views_missing(const struct gb_plot_view *view,
                             const struct gb_session *session,
                             const struct gb_params *edited);

/* --- drawing functions, by file ----------------------------------------------------- */

/* Draws pressure against relative density or time: previous curves, unloading branches,
 * loading branch on top; the stages of a dynamic run. */
void gb_view_curve_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Distribution of the coordination number. */
void gb_view_structure_histogram(struct gb_panel_plot *panel,
                                 const struct gb_session *session);

/* Mean normal force against the angle to z, as a closed line around the origin. */
void gb_view_structure_rose(struct gb_panel_plot *panel,
                            const struct gb_session *session);

/* Radial distribution function of the packing. */
void gb_view_structure_distances(struct gb_panel_plot *panel,
                                 const struct gb_session *session);

/* Lateral-to-axial stress ratio against relative density, P1 Fig. 13. */
void gb_view_curve_ratio(struct gb_panel_plot *panel, const struct gb_session *session);

/* Draws laws of the edited parameters, and dim the laws of the run, into panel->target:
 * normal force of two particles (P1 Fig. 1), bridge strength (P1 Fig. 2). */
void gb_view_law_force(struct gb_panel_plot *panel, const struct gb_session *session);
void gb_view_law_strength(struct gb_panel_plot *panel, const struct gb_session *session);

/* Draws compaction equations fitted to the loading branch, together with the branch. */
void gb_view_fit_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Density of each curve minus that of the run, at equal pressure. */
void gb_view_difference_draw(struct gb_panel_plot *panel,
                             const struct gb_session *session);

/* The packing along y: shaded spheres, darker with depth; discs in 2D. */
void gb_view_packing_draw(struct gb_panel_plot *panel, const struct gb_session *session);
/* Arrow keys turn the packing; Home and Esc return to the front. */
void gb_view_packing_navigate(struct gb_panel_plot *panel, enum gb_action action);

/* Per leg: the path in the plane of mean pressure and deviatoric stress; deviatoric
 * stress and volume strain against the main strain of the path. */
void gb_view_curve_stress_path(struct gb_panel_plot *panel,
                               const struct gb_session *session);
void gb_view_curve_stress_strain(struct gb_panel_plot *panel,
                                 const struct gb_session *session);
void gb_view_curve_volume_strain(struct gb_panel_plot *panel,
                                 const struct gb_session *session);

/* Elastic moduli of the run's states against density, numbers of the last one. */
void gb_view_moduli_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Accuracy against cost of the numerical settings in the loaded chart. */
void gb_view_chart_draw(struct gb_panel_plot *panel, const struct gb_session *session);

/* Longest stable step of each method over the step that it takes, against pressure. */
void gb_view_chart_stability(struct gb_panel_plot *panel,
                             const struct gb_session *session);

#endif
