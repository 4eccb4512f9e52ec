#ifndef GB_TUI_APP_KEYS_H
#define GB_TUI_APP_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "tui/app/layout.h"
#include "tui/panel/list_box.h"
#include "tui/term/paint.h"

struct gb_app;

enum { GB_KEYS_PER_ROW = 4, GB_KEY_ESCAPE = 27 };

/* Where a key is valid, one bit each: focused panes and other situations. */
enum gb_key_scope {
    GB_KEY_PARAMS = 1 << GB_PANE_PARAMS,
    GB_KEY_PLOT = 1 << GB_PANE_PLOT,
    GB_KEY_STATE = 1 << GB_PANE_STATE,
    GB_KEY_EVENTS = 1 << GB_PANE_EVENTS,
    GB_KEY_LISTS = GB_KEY_PARAMS | GB_KEY_PLOT | GB_KEY_EVENTS,
    GB_KEY_ANY_PANE = GB_KEY_LISTS | GB_KEY_STATE,
    GB_KEY_TOO_SMALL = 1 << GB_PANES,    /* also on a screen that is too small */
    GB_KEY_LEGS = 1 << (GB_PANES + 1),   /* in the editor of a loading path */
    GB_KEY_COPIED = 1 << (GB_PANES + 2), /* in a dialog with something to copy */
    GB_KEY_CURVES = 1 << (GB_PANES + 3), /* in the list of curves */
    GB_KEY_ALWAYS = GB_KEY_ANY_PANE | GB_KEY_TOO_SMALL,
    GB_KEY_EVERYWHERE = GB_KEY_ALWAYS | GB_KEY_LEGS | GB_KEY_COPIED | GB_KEY_CURVES
};

/* One row per key.  Dispatch, footer, help page, `greenbody --keys` and the manual page
 * use it.  A new key needs a command function and a row. */
struct gb_key {
    int code[GB_KEYS_PER_ROW]; /* curses key codes; 0 after the last */
    const char *name;          /* as shown: "p", "Tab" */
    const char *brief;         /* text in footers; NULL: in no footer */
    const char *help;
    int scope; /* bits of enum gb_key_scope */
    void (*command)(struct gb_app *app, const struct gb_key *key);
    enum gb_action action; /* action of a navigation key */
};

/* Number of rows, including the keys of the views. */
size_t gb_keys_count(void);
struct gb_key gb_keys_at(size_t index);

/* Heading of the group that begins at this row; NULL: no group begins here. */
const char *gb_keys_heading(size_t index);

/* Names of the keys in the footer of a pane, at most GB_KEYS_FOOTER, NULL after the
 * last. */
enum { GB_KEYS_FOOTER = 16 };
const char *const *gb_keys_footer(enum gb_pane pane);

/* Finds the row with this name; false: none. */
bool gb_keys_named(const char *name, struct gb_key *key);

/* Finds the row of a curses key code whose scope has one of these bits; false: none.
 * Rows with different scopes may share a code. */
bool gb_keys_find(int code, int scope, struct gb_key *key);

/* Navigation action of a curses key code. */
enum gb_action gb_keys_action(int code);

/* The help: keys in groups and the glossary (docs/glossary.md), filtered by the typed
 * words. */
struct gb_help_list {
    struct gb_list_box box;
};

void gb_keys_help_init(struct gb_help_list *list);

/* Edits the filter or scrolls; false: another key. */
bool gb_keys_help_handle(struct gb_help_list *list, const struct gb_term_event *event);

/* Draws the lines that are in view. */
void gb_keys_help_draw(struct gb_help_list *list, const struct gb_paint *paint);

/* Entries of the glossary; word = NULL: a heading. */
struct gb_help_word {
    const char *word, *meaning;
};

const struct gb_help_word *gb_keys_glossary(size_t *count);

#endif
