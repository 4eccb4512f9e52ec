#ifndef GB_TUI_APP_KEYS_H
#define GB_TUI_APP_KEYS_H

#include <stddef.h>

/* What a key asks for.  Panes and dialogs read the same actions. */
enum gb_action {
    GB_ACTION_NONE,
    GB_ACTION_UP,
    GB_ACTION_DOWN,
    GB_ACTION_LEFT,
    GB_ACTION_RIGHT,
    GB_ACTION_PAGE_UP,
    GB_ACTION_PAGE_DOWN,
    GB_ACTION_HOME,
    GB_ACTION_END,
    GB_ACTION_NEXT_PANE,
    GB_ACTION_PREVIOUS_PANE,
    GB_ACTION_ENTER,
    GB_ACTION_BACK,
    GB_ACTION_FIND,
    GB_ACTION_MORE,
    GB_ACTION_LESS,
    GB_ACTION_UNDO,
    GB_ACTION_RESTART,
    GB_ACTION_PAUSE,
    GB_ACTION_FREEZE,
    GB_ACTION_VIEW_CURVE,
    GB_ACTION_VIEW_HISTOGRAM,
    GB_ACTION_VIEW_ROSE,
    GB_ACTION_VIEW_TIME,
    GB_ACTION_VIEW_DISTANCES,
    GB_ACTION_VIEW_RATIO,
    GB_ACTION_VIEW_FORCE,
    GB_ACTION_VIEW_STRENGTH,
    GB_ACTION_VIEW_PACKING,
    GB_ACTION_VIEW_CHART,
    GB_ACTION_NEXT_VIEW,
    GB_ACTION_PREVIOUS_VIEW,
    GB_ACTION_LOG,
    GB_ACTION_EARLIER,
    GB_ACTION_GLYPHS,
    GB_ACTION_FORK,
    GB_ACTION_FOLLOW,
    GB_ACTION_ALL,
    GB_ACTION_DATA,
    GB_ACTION_COMMAND,
    GB_ACTION_PICTURE,
    GB_ACTION_REPORT,
    GB_ACTION_CELLS,
    GB_ACTION_FIT,
    GB_ACTION_TAKE_OVER,
    GB_ACTION_SAVE,
    GB_ACTION_OPEN,
    GB_ACTION_MOUSE,
    GB_ACTION_REPAINT,
    GB_ACTION_HELP,
    GB_ACTION_QUIT
};

enum { GB_KEYS_PER_ROW = 4, GB_KEY_ESCAPE = 27 };

/* The one table behind dispatch, help screen and footer. */
struct gb_key {
    int code[GB_KEYS_PER_ROW]; /* curses key codes, 0 ends */
    const char *name;          /* as shown: "p", "Tab" */
    const char *brief;         /* in the footer; NULL: only in the help screen */
    const char *help;
    enum gb_action action;
};

const struct gb_key *gb_keys_table(size_t *count);

/* Action of a curses key code. */
enum gb_action gb_keys_action(int code);

#endif
