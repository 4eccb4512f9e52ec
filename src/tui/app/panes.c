#include "tui/app/panes.h"

#include <glib.h>
#include <stdio.h>

#include "tui/app/command/key_commands.h"
#include "tui/view/views.h"

static void draw_params(struct gb_screen *screen, const struct gb_paint *paint,
                        enum gb_paint_focus focus)
{
    gb_panel_params_draw(&screen->params, paint, &screen->session, focus);
}

static void navigate_params(struct gb_screen *screen, enum gb_action action)
{
    const struct gb_field *field = gb_panel_params_field(&screen->params);
    if (action == GB_ACTION_ENTER && field == gb_params_find("loading", "path")) {
        gb_leg_commands_open(screen);
        return;
    }
    gb_panel_params_navigate(&screen->params, &screen->session, action);
}

static void click_params(struct gb_screen *screen, int row, int col)
{
    gb_panel_params_click(&screen->params, &screen->session, row, col);
}

static void describe_params(struct gb_screen *screen, struct gb_message *message)
{
    gb_panel_params_describe(&screen->params, &screen->session, message);
}

static char *copied_params(struct gb_screen *screen)
{
    char text[GB_PARAMS_VALUE_MAX + 64];
    gb_panel_params_assignment(&screen->params, &screen->session, text, sizeof text);
    return g_strdup(text);
}

static void draw_plot(struct gb_screen *screen, const struct gb_paint *paint,
                      enum gb_paint_focus focus)
{
    screen->plot.edited = gb_panel_params_edit_params(&screen->params, &screen->session);
    gb_panel_plot_draw(&screen->plot, paint, &screen->session, focus);
}

static void navigate_plot(struct gb_screen *screen, enum gb_action action)
{
    if (screen->plot.view->navigate != NULL) {
        screen->plot.view->navigate(&screen->plot, action);
        return;
    }
    if (action == GB_ACTION_ENTER) {
        gb_chart_commands_apply(screen);
        return;
    }
    gb_panel_plot_cursor_navigate(&screen->plot, &screen->session, action);
}

/* A click on the title shows the next view, one on the field moves the cursor. */
static void click_plot(struct gb_screen *screen, int row, int col)
{
    if (row == 0) {
        gb_panel_plot_step_view(&screen->plot, 1);
    } else {
        gb_panel_plot_cursor_click(&screen->plot, &screen->session, row, col);
    }
}

static void describe_plot(struct gb_screen *screen, struct gb_message *message)
{
    gb_panel_plot_cursor_describe(&screen->plot, &screen->session, message);
}

static char *copied_plot(struct gb_screen *screen)
{
    struct gb_message message = {.text = ""};
    if (!gb_panel_plot_cursor_shown(&screen->plot, &screen->session)) {
        return NULL;
    }
    gb_panel_plot_cursor_describe(&screen->plot, &screen->session, &message);
    return g_strdup(message.text);
}

static void draw_state(struct gb_screen *screen, const struct gb_paint *paint,
                       enum gb_paint_focus focus)
{
    gb_panel_state_draw(paint, &screen->session, focus);
}

/* The error of a failed run. */
static void describe_run(struct gb_screen *screen, struct gb_message *message)
{
    if (screen->session.now.error.text[0] != '\0') {
        snprintf(message->text, sizeof message->text, "%s",
                 screen->session.now.error.text);
        message->style = GB_STYLE_WARN;
    }
}

static void draw_events(struct gb_screen *screen, const struct gb_paint *paint,
                        enum gb_paint_focus focus)
{
    gb_panel_events_draw(&screen->events, paint, &screen->session, focus);
}

static void navigate_events(struct gb_screen *screen, enum gb_action action)
{
    gb_panel_events_navigate(&screen->events, &screen->session, action);
}

/* The newest line shown. */
static char *copied_events(struct gb_screen *screen)
{
    return g_strdup(gb_session_event_line(&screen->session, screen->events.back));
}

static const struct gb_pane_type panes[GB_PANES] = {
    [GB_PANE_PARAMS] = {draw_params, navigate_params, click_params, describe_params,
                        copied_params},
    [GB_PANE_PLOT] = {draw_plot, navigate_plot, click_plot, describe_plot, copied_plot},
    [GB_PANE_STATE] = {draw_state, NULL, NULL, describe_run, NULL},
    [GB_PANE_EVENTS] = {draw_events, navigate_events, NULL, describe_run, copied_events},
};

const struct gb_pane_type *gb_panes_type(enum gb_pane pane)
{
    return &panes[pane];
}
