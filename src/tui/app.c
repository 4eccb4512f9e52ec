#include "tui/app.h"

#include <errno.h>
#include <glib.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/alloc.h"
#include "tui/saving.h"
#include "tui/screen.h"

/* At most ten frames a second; between frames the engine is asked as often for news. */
static const double frame_s = 0.1;

enum { STATUS_SIGNAL = 128 };

struct gb_app {
    struct gb_screen screen;
    bool leave, dirty;
    int status;
    double drawn; /* clock of the last frame */
};

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void tell(struct gb_app *app, enum gb_style style, const char *text)
{
    g_strlcpy(app->screen.message.text, text, sizeof app->screen.message.text);
    app->screen.message.style = style;
}

static void begin_run(struct gb_app *app)
{
    struct gb_error err = {0};
    if (gb_session_start(&app->screen.session, &err)) {
        app->screen.plot.cursor_on = false;
        app->screen.message.text[0] = '\0';
    } else {
        tell(app, GB_STYLE_BAD, err.text);
        gb_session_note(&app->screen.session, "not started: %s", err.text);
    }
}

/* What would take hours is not begun by a single key. */
static void start_run(struct gb_app *app)
{
    char question[400];
    if (gb_session_costly(&app->screen.session, question, sizeof question)) {
        gb_dialog_show(&app->screen.dialog, GB_DIALOG_COSTLY, question);
    } else {
        begin_run(app);
    }
}

static void decline_run(struct gb_app *app)
{
    gb_session_note(&app->screen.session, "not started: declined");
    tell(app, GB_STYLE_WARN, "not started: change the parameters, r asks again");
}

static void leave(struct gb_app *app, int status)
{
    app->leave = true;
    app->status = status;
}

static void ask_save(struct gb_app *app)
{
    char *name = gb_saving_suggest(app->screen.session.preset);
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_SAVE, name);
    g_free(name);
}

static void save(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_preset *preset = app->screen.session.preset;
    struct gb_error err = {0};
    char *path = gb_saving_path(gb_dialog_answer(dialog), &err);
    if (path == NULL) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    if (!dialog->warned && g_file_test(path, G_FILE_TEST_EXISTS)) {
        dialog->warned = true;
        snprintf(dialog->note, sizeof dialog->note, "%s exists: Enter again replaces it",
                 path);
    } else if (!gb_preset_save(preset, path, true, &err)) {
        dialog->warned = false;
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
    } else {
        gb_session_note(&app->screen.session, "saved %s", path);
        char *text = g_strdup_printf("saved as %s", path);
        tell(app, GB_STYLE_GOOD, text);
        g_free(text);
        gb_dialog_close(dialog);
    }
    g_free(path);
}

static void open_preset(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    const char *name = gb_dialog_answer(dialog);
    if (!gb_session_open(&app->screen.session, name, &err)) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    gb_session_note(&app->screen.session, "opened %s", name);
    gb_dialog_close(dialog);
    start_run(app);
}

static void answer(struct gb_app *app)
{
    switch (app->screen.dialog.kind) {
    case GB_DIALOG_SAVE:
        save(app);
        break;
    case GB_DIALOG_OPEN:
        open_preset(app);
        break;
    case GB_DIALOG_QUIT:
        leave(app, 0);
        break;
    case GB_DIALOG_COSTLY:
        gb_dialog_close(&app->screen.dialog);
        begin_run(app);
        break;
    case GB_DIALOG_HELP:
    case GB_DIALOG_NONE:
        break;
    }
}

static void ask_quit(struct gb_app *app)
{
    const bool seen = app->screen.layout.kind != GB_LAYOUT_TOO_SMALL;
    if (gb_session_live(&app->screen.session) && seen) {
        gb_dialog_show(&app->screen.dialog, GB_DIALOG_QUIT, NULL);
    } else {
        leave(app, 0);
    }
}

static void change_focus(struct gb_screen *screen, int step)
{
    screen->focus = (enum gb_pane)(((int)screen->focus + step + GB_PANES) % GB_PANES);
    /* in the compact layout plot and state are one place */
    if (screen->layout.kind == GB_LAYOUT_COMPACT && screen->focus == GB_PANE_STATE) {
        screen->focus = step > 0 ? GB_PANE_EVENTS : GB_PANE_PLOT;
    }
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
        start_run(app);
        return true;
    case GB_ACTION_PAUSE:
        gb_session_toggle_pause(&screen->session);
        return true;
    case GB_ACTION_FREEZE:
        gb_session_toggle_freeze(&screen->session);
        return true;
    case GB_ACTION_SAVE:
        ask_save(app);
        return true;
    case GB_ACTION_OPEN:
        gb_dialog_show(&screen->dialog, GB_DIALOG_OPEN, NULL);
        return true;
    case GB_ACTION_HELP:
        gb_dialog_show(&screen->dialog, GB_DIALOG_HELP, NULL);
        return true;
    case GB_ACTION_REPAINT:
        gb_term_repaint(screen->term);
        return true;
    case GB_ACTION_QUIT:
        ask_quit(app);
        return true;
    case GB_ACTION_VIEW_CURVE:
    case GB_ACTION_VIEW_HISTOGRAM:
    case GB_ACTION_VIEW_ROSE:
    case GB_ACTION_VIEW_TIME:
    case GB_ACTION_LOG:
    case GB_ACTION_EARLIER:
    case GB_ACTION_GLYPHS:
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

static void type(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    const bool small = screen->layout.kind == GB_LAYOUT_TOO_SMALL;
    if (screen->dialog.kind != GB_DIALOG_NONE && !small) {
        const bool costly = screen->dialog.kind == GB_DIALOG_COSTLY;
        if (gb_dialog_type(&screen->dialog, event)) {
            answer(app);
        } else if (costly && screen->dialog.kind == GB_DIALOG_NONE) {
            decline_run(app);
        }
        return;
    }
    if (screen->params.editing && !small) {
        gb_panel_params_type(&screen->params, &screen->session, event, &screen->message);
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
    if (!act_everywhere(app, action)) {
        act_in_pane(app, action);
    }
}

/* The first Ctrl-C asks, the second one leaves. */
static void interrupt(struct gb_app *app)
{
    if (app->screen.dialog.kind == GB_DIALOG_QUIT ||
        !gb_session_live(&app->screen.session)) {
        leave(app, STATUS_SIGNAL + SIGINT);
    } else {
        gb_dialog_show(&app->screen.dialog, GB_DIALOG_QUIT, NULL);
    }
}

static void handle(struct gb_app *app, const struct gb_term_event *event)
{
    app->dirty = app->dirty || event->kind != GB_TERM_NOTHING;
    switch (event->kind) {
    case GB_TERM_NOTHING:
    case GB_TERM_RESIZED:
        break;
    case GB_TERM_KEY:
    case GB_TERM_TEXT:
        type(app, event);
        break;
    case GB_TERM_INTERRUPT:
        interrupt(app);
        break;
    case GB_TERM_TERMINATE:
        leave(app, STATUS_SIGNAL + event->code);
        break;
    case GB_TERM_GONE:
        leave(app, STATUS_SIGNAL + SIGHUP);
        break;
    }
}

/* Milliseconds to sleep: until the next frame may be drawn, until the engine may have
 * news, or for ever when nothing can happen without a key. */
static int patience(const struct gb_app *app)
{
    if (app->dirty) {
        const double left = frame_s - (clock_s() - app->drawn);
        return left > 0.0 ? (int)(1000.0 * left) + 1 : 0;
    }
    return gb_session_busy(&app->screen.session) ? (int)(1000.0 * frame_s) : -1;
}

static void loop(struct gb_app *app)
{
    while (!app->leave) {
        const struct gb_term_event event = gb_term_wait(app->screen.term, patience(app));
        handle(app, &event);
        app->dirty = gb_session_refresh(&app->screen.session) || app->dirty;
        if (app->dirty && !app->leave && clock_s() - app->drawn >= frame_s) {
            gb_screen_draw(&app->screen);
            gb_term_flush(app->screen.term);
            app->drawn = clock_s();
            app->dirty = false;
        }
    }
}

/* Where only one pane fits, the curve comes first. */
static void first_focus(struct gb_screen *screen)
{
    int rows = 0;
    int cols = 0;
    gb_term_size(screen->term, &rows, &cols);
    gb_layout_make(&screen->layout, rows, cols, GB_PANE_PARAMS);
    if (screen->layout.kind < GB_LAYOUT_FULL) {
        screen->focus = GB_PANE_PLOT;
    }
}

int gb_app_run(struct gb_preset *preset, struct gb_error *err)
{
    struct gb_app *app = gb_alloc_array(1, sizeof *app, err);
    if (app == NULL) {
        return gb_status_exit_code(GB_ERR_MEMORY);
    }
    struct gb_screen *screen = &app->screen;
    if (!gb_term_start(&screen->term, err)) {
        gb_alloc_free(app);
        return gb_status_exit_code(GB_ERR_MACHINE);
    }
    app->dirty = true;
    first_focus(screen);
    gb_session_init(&screen->session, preset);
    gb_panel_plot_init(&screen->plot, screen->term);
    start_run(app);
    loop(app);
    gb_term_stop(screen->term);
    gb_session_finish(&screen->session);
    gb_panel_plot_finish(&screen->plot);
    gb_dialog_close(&screen->dialog);
    const int status = app->status;
    gb_alloc_free(app);
    return status;
}
