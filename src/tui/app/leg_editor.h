#ifndef GB_TUI_APP_LEG_EDITOR_H
#define GB_TUI_APP_LEG_EDITOR_H

#include <glib.h>

#include "scene/path/path.h"
#include "tui/panel/plot.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* Draws the planned path into a plot.  The (p, q) plane is used if leg `focus` (from 1;
 * 0: any leg) follows from the text; otherwise the strain of the leading component of
 * each leg; otherwise a sentence.  Each leg has its number at its end. */
void gb_leg_editor_sketch(const struct gb_path *path, int dimension, int focus,
                          struct gb_plot *plot);

/* Mark of a leg (from 1): '1' to '9', then 'a' to 'o'; also used without colours. */
int gb_leg_editor_mark(int leg);

/* The path as far as it follows from the text; NaN where it depends on the packing.  A
 * packing under isotropic strain is assumed to be isotropic, and a packing that was not
 * sheared to have no shear stress. */
enum { GB_LEG_PLAN_STATES = 5 * GB_PATH_LEGS_MAX + 1 };

struct gb_leg_plan_state {
    int leg;       /* from 1; 0: before the first */
    double p, q;   /* Pa */
    double strain; /* strain of the leading component since the leg began */
};

struct gb_leg_plan {
    int count;
    struct gb_leg_plan_state state[GB_LEG_PLAN_STATES];
};

void gb_leg_editor_plan(struct gb_leg_plan *plan, const struct gb_path *path,
                        int dimension);

/* The legs of loading.path, one line each, and what they do.  While a leg is typed,
 * matching shorthands are offered and its error is shown below it. */

enum gb_leg_editor_typing {
    GB_LEG_EDITOR_LIST,   /* nothing is typed */
    GB_LEG_EDITOR_CHANGE, /* the focused leg */
    GB_LEG_EDITOR_INSERT, /* a new leg in front of the focused line */
    GB_LEG_EDITOR_WHOLE   /* all legs as one text */
};

enum { GB_LEG_LIST_MAX = 64 }; /* more than a path allows; the excess is an error */

struct gb_leg_list {
    GPtrArray *text;            /* char *; owned */
    GPtrArray *former;          /* joined texts before each change, for undo; owned */
    int dimension;              /* of the scene */
    struct gb_path path;        /* the valid legs */
    int index[GB_LEG_LIST_MAX]; /* index of a text in path; -1: invalid */
    struct gb_error error[GB_LEG_LIST_MAX]; /* why it is invalid, and what is expected */
    int errors;
};

struct gb_leg_editor {
    struct gb_leg_list list;
    int focus; /* a leg, or their number for the line below them */
    int top, page;
    enum gb_leg_editor_typing typing;
    struct gb_prompt prompt;
    int offer; /* focused one of the matching shorthands */
    enum gb_plot_glyphs glyphs;
    struct gb_plot plot;
};

void gb_leg_editor_init(struct gb_leg_editor *editor, const char *text, int dimension,
                        enum gb_plot_glyphs glyphs);
void gb_leg_editor_finish(struct gb_leg_editor *editor); /* zeroed is fine */

void gb_leg_editor_draw(struct gb_leg_editor *editor, const struct gb_paint *inside);

/* Handles an event while a leg is typed; false: nothing is typed. */
bool gb_leg_editor_type(struct gb_leg_editor *editor, const struct gb_term_event *event);

/* Commands while nothing is typed. */
void gb_leg_editor_go(struct gb_leg_editor *editor, int by);
void gb_leg_editor_change(struct gb_leg_editor *editor); /* Enter */
void gb_leg_editor_insert(struct gb_leg_editor *editor, int behind);
void gb_leg_editor_whole(struct gb_leg_editor *editor);
void gb_leg_editor_delete(struct gb_leg_editor *editor);
void gb_leg_editor_move(struct gb_leg_editor *editor, int by);
void gb_leg_editor_undo(struct gb_leg_editor *editor);

/* What a leg does, in words, one line each. */
enum { GB_LEG_WORDS = 160 };

struct gb_leg_words {
    char leads[GB_LEG_WORDS]; /* "xz by strain" */
    char held[GB_LEG_WORDS];  /* "z at 50 MPa, x = 0.5 z" */
    char fixed[GB_LEG_WORDS]; /* "x, y, xy, yz" */
    char ends[GB_LEG_WORDS];  /* "at a strain of 20 % of xz" */
};

void gb_leg_editor_words(const struct gb_leg *leg, int dimension,
                         struct gb_leg_words *words);

void gb_leg_editor_list_init(struct gb_leg_list *list, const char *text, int dimension);

void gb_leg_editor_list_finish(struct gb_leg_list *list); /* zeroed is fine */

/* The leg at a position; NULL: it is invalid. */
const struct gb_leg *gb_leg_editor_list_leg(const struct gb_leg_list *list, int at);

/* The whole path, "isotropic to 50 MPa; unload"; g_free. */
char *gb_leg_editor_list_join(const struct gb_leg_list *list);

/* Changes, each of which can be undone.  A text with ';' or `then` becomes several
 * legs, an empty text none.  Returns the number of legs inserted. */
int gb_leg_editor_list_insert(struct gb_leg_list *list, int at, const char *text);

int gb_leg_editor_list_replace(struct gb_leg_list *list, int at, const char *text);

void gb_leg_editor_list_remove(struct gb_leg_list *list, int at);

/* Exchanges a leg with the next (1) or previous (-1) one; false: there is none. */
bool gb_leg_editor_list_move(struct gb_leg_list *list, int at, int by);

void gb_leg_editor_list_set(struct gb_leg_list *list, const char *text);

/* Restores the list before the last change; false: there was none. */
bool gb_leg_editor_list_undo(struct gb_leg_list *list);

/* Checks a text in place of the leg at a position, or after the last one. leg: receives
 * its meaning if it is valid. */
bool gb_leg_editor_list_try(const struct gb_leg_list *list, int at, const char *text,
                            struct gb_leg *leg, struct gb_error *err);

#endif
