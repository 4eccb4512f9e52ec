#include "tui/app/mouse.h"

#include <ncurses.h>

#include "tui/app/act.h"

enum { WHEEL_ROWS = 3 };

static bool contains(const struct gb_rect *rect, int row, int col)
{
    return row >= rect->row && row < rect->row + rect->rows && col >= rect->col &&
           col < rect->col + rect->cols;
}

/* GB_PANES: none. */
static enum gb_pane pane_at(const struct gb_layout *layout, int row, int col)
{
    for (enum gb_pane pane = GB_PANE_PARAMS; pane < GB_PANES; pane++) {
        if (contains(&layout->pane[pane], row, col)) {
            return pane;
        }
    }
    return GB_PANES;
}

static void repeat(struct gb_app *app, enum gb_action action, int times)
{
    for (int i = 0; i < times; i++) {
        gb_act_do(app, action);
    }
}

/* Dialogs and choices take the wheel as arrows. */
static void type_arrow(struct gb_app *app, const struct gb_term_event *event)
{
    const struct gb_term_event key = {
        .kind = GB_TERM_KEY, .code = event->code == GB_TERM_WHEEL_UP ? KEY_UP : KEY_DOWN};
    if (event->code != GB_TERM_CLICK) {
        gb_act_type(app, &key);
    }
}

static void click(struct gb_app *app, enum gb_pane pane, int row, int col)
{
    struct gb_screen *screen = &app->screen;
    bool value = false;
    screen->focus = pane;
    if (pane == GB_PANE_PARAMS) {
        gb_panel_params_click(&screen->params, &screen->session, row, col, &value);
    } else if (pane == GB_PANE_PLOT && row == 0) {
        gb_act_do(app, GB_ACTION_NEXT_VIEW);
    } else if (pane == GB_PANE_PLOT) {
        gb_panel_plot_click(&screen->plot, &screen->session, row, col);
    }
}

/* Turning what is not in focus would begin runs by accident. */
static bool over_value(struct gb_app *app, int row, int col)
{
    struct gb_panel_params probe = app->screen.params;
    bool value = false;
    return gb_panel_params_click(&probe, &app->screen.session, row, col, &value) &&
           value && probe.focus == app->screen.params.focus;
}

static void wheel(struct gb_app *app, enum gb_pane pane, int row, int col, bool up)
{
    struct gb_screen *screen = &app->screen;
    const bool knob =
        pane == GB_PANE_PARAMS && screen->focus == pane && over_value(app, row, col);
    screen->focus = pane;
    if (knob) {
        gb_act_do(app, up ? GB_ACTION_MORE : GB_ACTION_LESS);
    } else if (pane == GB_PANE_PLOT) {
        gb_act_do(app, up ? GB_ACTION_LEFT : GB_ACTION_RIGHT);
    } else {
        repeat(app, up ? GB_ACTION_UP : GB_ACTION_DOWN, WHEEL_ROWS);
    }
}

void gb_mouse_handle(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    const enum gb_pane pane = pane_at(&screen->layout, event->row, event->col);
    if (screen->layout.kind == GB_LAYOUT_TOO_SMALL) {
        return;
    }
    if (screen->dialog.kind != GB_DIALOG_NONE || screen->params.editing) {
        type_arrow(app, event);
        return;
    }
    screen->message.text[0] = '\0';
    if (pane == GB_PANES) {
        const struct gb_key *key = event->code == GB_TERM_CLICK
                                       ? gb_screen_key_at(screen, event->row, event->col)
                                       : NULL;
        if (key != NULL) {
            gb_act_do(app, key->action);
        }
        return;
    }
    const int row = event->row - screen->layout.pane[pane].row;
    const int col = event->col - screen->layout.pane[pane].col;
    if (event->code == GB_TERM_CLICK) {
        click(app, pane, row, col);
    } else {
        wheel(app, pane, row, col, event->code == GB_TERM_WHEEL_UP);
    }
}
