#include "tui/app/act.h"

#include "tui/app/asks.h"
#include "tui/session/many.h"
#include "tui/session/run_lifecycle.h"

static void change_focus(struct gb_screen *screen, int step)
{
    screen->focus = (enum gb_pane)(((int)screen->focus + step + GB_PANES) % GB_PANES);
    /* in the compact layout plot and state are one place */
    if (screen->layout.kind == GB_LAYOUT_COMPACT && screen->focus == GB_PANE_STATE) {
        screen->focus = step > 0 ? GB_PANE_EVENTS : GB_PANE_PLOT;
    }
}

static void toggle_mouse(struct gb_app *app)
{
    struct gb_term *term = app->screen.term;
    const bool wanted = !gb_term_has_mouse(term);
    gb_term_mouse(term, wanted);
    gb_asks_tell(app, GB_STYLE_PLAIN,
                 gb_term_has_mouse(term)
                     ? "mouse on: clicks and the wheel; dragging with "
                       "Shift selects text as ever"
                 : wanted ? "this terminal reports no mouse"
                          : "mouse off: the terminal selects text itself");
}

/* Actions that mean the same wherever the focus is; false when it is none of them. */
static bool act_everywhere(struct gb_app *app, enum gb_action action)
{
    struct gb_screen *screen = &app->screen;
    switch (action) {
    case GB_ACTION_NEXT_PANE:
        change_focus(screen, 1);
        return true;
    case GB_ACTION_PREVIOUS_PANE:
        change_focus(screen, -1);
        return true;
    case GB_ACTION_RESTART:
        gb_asks_start_run(app);
        return true;
    case GB_ACTION_MORE:
    case GB_ACTION_LESS:
    case GB_ACTION_ALL:
        gb_panel_params_act(&screen->params, &screen->session, action, &screen->message);
        return true;
    case GB_ACTION_PAUSE:
        gb_session_toggle_pause(&screen->session);
        return true;
    case GB_ACTION_FREEZE:
        gb_session_toggle_freeze(&screen->session);
        return true;
    case GB_ACTION_TAKE_OVER:
        gb_run_lifecycle_take_over(&screen->session, &screen->message);
        return true;
    case GB_ACTION_SAVE:
        gb_asks_save(app);
        return true;
    case GB_ACTION_OPEN:
        gb_dialog_browse(&screen->dialog, gb_session_params(&screen->session));
        return true;
    case GB_ACTION_FORK:
        gb_asks_fork(app);
        return true;
    case GB_ACTION_DATA:
        gb_asks_data(app);
        return true;
    case GB_ACTION_FIND:
        gb_dialog_show(&screen->dialog, GB_DIALOG_FIND, NULL);
        return true;
    case GB_ACTION_PICTURE:
        gb_asks_errand(app, "picture", "snapshot", "/picture-", ".png");
        return true;
    case GB_ACTION_REPORT:
        gb_asks_errand(app, "report", "report", "-report-", "");
        return true;
    case GB_ACTION_CELLS:
        gb_many_ask_cells(app);
        return true;
    case GB_ACTION_FIT:
        gb_many_ask_fit(app);
        return true;
    case GB_ACTION_COMMAND:
        gb_asks_command(app);
        return true;
    case GB_ACTION_FOLLOW:
        gb_asks_toggle_follow(app);
        return true;
    case GB_ACTION_HELP:
        gb_dialog_show(&screen->dialog, GB_DIALOG_HELP, NULL);
        return true;
    case GB_ACTION_MOUSE:
        toggle_mouse(app);
        return true;
    case GB_ACTION_REPAINT:
        gb_term_repaint(screen->term);
        return true;
    case GB_ACTION_QUIT:
        gb_asks_quit(app);
        return true;
    case GB_ACTION_VIEW_CURVE:
    case GB_ACTION_VIEW_HISTOGRAM:
    case GB_ACTION_VIEW_ROSE:
    case GB_ACTION_VIEW_TIME:
    case GB_ACTION_VIEW_DISTANCES:
    case GB_ACTION_VIEW_RATIO:
    case GB_ACTION_VIEW_FORCE:
    case GB_ACTION_VIEW_STRENGTH:
    case GB_ACTION_VIEW_PACKING:
    case GB_ACTION_VIEW_CHART:
    case GB_ACTION_NEXT_VIEW:
    case GB_ACTION_PREVIOUS_VIEW:
    case GB_ACTION_LOG:
    case GB_ACTION_EARLIER:
    case GB_ACTION_GLYPHS:
        if (action >= GB_ACTION_VIEW_CURVE && action <= GB_ACTION_PREVIOUS_VIEW &&
            !gb_layout_shows(&screen->layout, GB_PANE_PLOT)) {
            screen->focus = GB_PANE_PLOT; /* a view that is asked for is shown */
        }
        return gb_panel_plot_act(&screen->plot, &screen->session, action);
    default:
        return false;
    }
}

static void act_in_pane(struct gb_app *app, enum gb_action action)
{
    struct gb_screen *screen = &app->screen;
    switch (screen->focus) {
    case GB_PANE_PARAMS:
        gb_panel_params_act(&screen->params, &screen->session, action, &screen->message);
        break;
    case GB_PANE_PLOT:
        gb_panel_plot_act(&screen->plot, &screen->session, action);
        break;
    case GB_PANE_EVENTS:
        gb_panel_events_act(&screen->events, &screen->session, action);
        break;
    case GB_PANE_STATE:
    case GB_PANES:
        break;
    }
}

void gb_act_do(struct gb_app *app, enum gb_action action)
{
    if (!act_everywhere(app, action)) {
        act_in_pane(app, action);
    }
}

void gb_act_type(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    const bool small = screen->layout.kind == GB_LAYOUT_TOO_SMALL;
    if (screen->dialog.kind != GB_DIALOG_NONE && !small) {
        const bool costly = screen->dialog.kind == GB_DIALOG_COSTLY;
        if (gb_dialog_type(&screen->dialog, event)) {
            gb_asks_answer(app);
        } else if (costly && screen->dialog.kind == GB_DIALOG_NONE) {
            gb_asks_decline(app);
        }
        return;
    }
    if (screen->params.editing && !small) {
        gb_panel_params_edit_key(&screen->params, &screen->session, event,
                                 &screen->message);
        return;
    }
    /* characters share their numbers with curses' function keys */
    if (event->kind == GB_TERM_TEXT && event->code > 126) {
        return;
    }
    screen->message.text[0] = '\0';
    const enum gb_action action = gb_keys_action(event->code);
    if (small && action != GB_ACTION_QUIT) {
        return;
    }
    gb_act_do(app, action);
}
