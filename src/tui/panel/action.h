#ifndef GB_TUI_PANEL_ACTION_H
#define GB_TUI_PANEL_ACTION_H

/* Navigation keys, whose meaning depends on the pane, dialog or list. */
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
    GB_ACTION_ENTER,
    GB_ACTION_BACK
};

#endif
