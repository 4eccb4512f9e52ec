#include "tui/app/mouse.h"

#include <ncurses.h>

#include "tui/app/dispatch.h"
#include "tui/app/panes.h"

enum { WHEEL_ROWS = 3 };

static bool contains(const struct gb_rect *rect, int row, int col)
{
    return row >= rect->row && row < rect->row + rect->rows && col >= rect->col &&
           col < rect->col + rect->cols;
}

/* The pane at a cell; GB_PANES: none. */
static enum gb_pane pane_at(const struct gb_layout *layout, int row, int col)
{
    for (enum gb_pane pane = GB_PANE_PARAMS; pane < GB_PANES; pane++) {
        if (contains(&layout->pane[pane], row, col)) {
            return pane;
        }
    }
    return GB_PANES;
}

static void navigate(struct gb_screen *screen, enum gb_action action, int times)
{
    const struct gb_pane_type *pane = gb_panes_type(screen->focus);
    for (int i = 0; i < times && pane->navigate != NULL; i++) {
        pane->navigate(screen, action);
    }
}

/* In dialogs and lists of choices the wheel acts as arrow keys. */
static void send_arrow(struct gb_app *app, const struct gb_term_event *event)
{
    const struct gb_term_event key = {
        .kind = GB_TERM_KEY, .code = event->code == GB_TERM_WHEEL_UP ? KEY_UP : KEY_DOWN};
    if (event->code != GB_TERM_CLICK) {
        gb_dispatch_event(app, &key);
    }
}

static void click(struct gb_screen *screen, enum gb_pane pane, int row, int col)
{
    screen->focus = pane;
    if (gb_panes_type(pane)->click != NULL) {
        gb_panes_type(pane)->click(screen, row, col);
    }
}

/* The wheel changes the focused value only, so that scrolling does not start runs. */
static bool over_value(struct gb_screen *screen, int row, int col)
{
    struct gb_panel_params probe = screen->params;
    return gb_panel_params_click(&probe, &screen->session, row, col) ==
               GB_PANEL_PARAMS_VALUE &&
           probe.focus == screen->params.focus;
}

static void wheel(struct gb_screen *screen, enum gb_pane pane, int row, int col, bool up)
{
    const bool value =
        pane == GB_PANE_PARAMS && screen->focus == pane && over_value(screen, row, col);
    screen->focus = pane;
    if (value) {
        gb_panel_params_edit_step(&screen->params, &screen->session, up ? 1 : -1,
                                  &screen->message);
    } else if (pane == GB_PANE_PLOT) {
        navigate(screen, up ? GB_ACTION_LEFT : GB_ACTION_RIGHT, 1);
    } else {
        navigate(screen, up ? GB_ACTION_UP : GB_ACTION_DOWN, WHEEL_ROWS);
    }
}

void gb_mouse_handle(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    const enum gb_pane pane = pane_at(&screen->layout, event->row, event->col);
    struct gb_key key;
    if (screen->layout.kind == GB_LAYOUT_TOO_SMALL) {
        return;
    }
    if (screen->dialog.type != NULL || screen->params.editing) {
        send_arrow(app, event);
        return;
    }
    screen->message.text[0] = '\0';
    if (pane == GB_PANES) {
        if (event->code == GB_TERM_CLICK &&
            gb_screen_key_at(screen, event->row, event->col, &key)) {
            gb_dispatch_key(app, &key);
        }
        return;
    }
    const int row = event->row - screen->layout.pane[pane].row;
    const int col = event->col - screen->layout.pane[pane].col;
    if (event->code == GB_TERM_CLICK) {
        click(screen, pane, row, col);
    } else {
        wheel(screen, pane, row, col, event->code == GB_TERM_WHEEL_UP);
    }
}
