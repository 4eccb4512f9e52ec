#ifndef GB_TUI_LEGS_LEG_EDITOR_H
#define GB_TUI_LEGS_LEG_EDITOR_H

#include "tui/legs/leg_list.h"
#include "tui/panel/prompt.h"
#include "tui/term/paint.h"

/* The legs of loading.path, one line each, and what they will do.  While a leg is typed
 * the shorthands that fit are offered, and what is wrong stands below it. */

enum gb_leg_editor_typing {
    GB_LEG_EDITOR_LIST,   /* nothing is typed */
    GB_LEG_EDITOR_CHANGE, /* the focused leg */
    GB_LEG_EDITOR_INSERT, /* a new leg in front of the focused line */
    GB_LEG_EDITOR_WHOLE   /* all legs as one text */
};

struct gb_leg_editor {
    struct gb_leg_list list;
    int focus; /* a leg; their number: the line below them */
    int top, page;
    enum gb_leg_editor_typing typing;
    struct gb_prompt prompt;
    int offer; /* focused one of the shorthands that fit */
    enum gb_plot_glyphs glyphs;
    struct gb_plot plot;
};

void gb_leg_editor_init(struct gb_leg_editor *editor, const char *text, int dimension,
                        enum gb_plot_glyphs glyphs);
void gb_leg_editor_finish(struct gb_leg_editor *editor); /* zeroed is fine */

void gb_leg_editor_draw(struct gb_leg_editor *editor, const struct gb_paint *inside);

/* Takes an event while a leg is typed; false: nothing is typed. */
bool gb_leg_editor_type(struct gb_leg_editor *editor, const struct gb_term_event *event);

/* The index-th shorthand that fits what is typed; false: there are no more. */
bool gb_leg_editor_offer(struct gb_leg_editor *editor, int index, const char **usage,
                         const char **doc);

/* Commands while nothing is typed. */
void gb_leg_editor_go(struct gb_leg_editor *editor, int by);
void gb_leg_editor_change(struct gb_leg_editor *editor); /* Enter */
void gb_leg_editor_insert(struct gb_leg_editor *editor, int behind);
void gb_leg_editor_whole(struct gb_leg_editor *editor);
void gb_leg_editor_delete(struct gb_leg_editor *editor);
void gb_leg_editor_move(struct gb_leg_editor *editor, int by);
void gb_leg_editor_undo(struct gb_leg_editor *editor);

#endif
