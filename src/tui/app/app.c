#include "tui/app/app.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <ncurses.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/app/screen.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term.h"

/* The workbench.  Keys and mouse events go to the open dialog, the edited value or the
 * key table.  The loop in gb_app_run waits for events, refreshes the session and draws
 * at most ten frames per second.  A hang-up of the terminal ends the screen; the run
 * then continues or stops as output.on_hangup says. */

enum { WHEEL_ROWS = 3 };

static bool contains(const struct gb_rect *rect, int row, int col)
{
    return row >= rect->row && row < rect->row + rect->rows && col >= rect->col &&
           col < rect->col + rect->cols;
}

/* The pane at a cell; GB_PANES if there is none. */
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
    const struct gb_pane_type *pane = gb_screen_pane(screen->focus);
    for (int i = 0; i < times && pane->navigate != NULL; i++) {
        pane->navigate(screen, action);
    }
}

/* In dialogs and lists of choices the wheel acts like arrow keys. */
static void send_arrow(struct gb_app *app, const struct gb_term_event *event)
{
    const struct gb_term_event key = {
        .kind = GB_TERM_KEY, .code = event->code == GB_TERM_WHEEL_UP ? KEY_UP : KEY_DOWN};
    if (event->code != GB_TERM_CLICK) {
        gb_app_event(app, &key);
    }
}

static void click(struct gb_screen *screen, enum gb_pane pane, int row, int col)
{
    screen->focus = pane;
    if (gb_screen_pane(pane)->click != NULL) {
        gb_screen_pane(pane)->click(screen, row, col);
    }
}

/* Is the cell the focused value?  Only there the wheel changes it, so that scrolling
 * does not start runs. */
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

/* Calls the command of a row of the key table if the focused pane is in its scope. */
static void app_key(struct gb_app *app, const struct gb_key *key)
{
    const struct gb_screen *screen = &app->screen;
    const int here = screen->layout.kind == GB_LAYOUT_TOO_SMALL ? GB_KEY_TOO_SMALL
                                                                : 1 << screen->focus;
    if (key->scope & here) {
        key->command(app, key);
    }
}

/* Handles a mouse event.  A click focuses the pane and selects its row or point,
 * presses a key of the footer or, on the title of the plot, shows the next view.  The
 * wheel scrolls, or changes the focused value if it is over it.  Keys can do all of
 * this, too. */
static void mouse_handle(struct gb_app *app, const struct gb_term_event *event)
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
            app_key(app, &key);
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

enum { LAST_ASCII = 126 };

static void handle_dialog(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    const struct gb_dialog_type *type = dialog->type;
    struct gb_key key;
    if (gb_dialog_takes_keys(dialog) && gb_keys_find(event->code, type->scope, &key)) {
        key.command(app, &key);
        return;
    }
    if (type->press != NULL && type->press(app, event)) {
        return;
    }
    switch (gb_dialog_handle(dialog, event)) {
    case GB_DIALOG_OPEN:
        break;
    case GB_DIALOG_ACCEPTED:
        type->accept(app);
        break;
    case GB_DIALOG_CANCELLED:
        if (type->decline != NULL) {
            type->decline(app);
        }
        break;
    }
}

void gb_app_event(struct gb_app *app, const struct gb_term_event *event)
{
    struct gb_screen *screen = &app->screen;
    struct gb_key key;
    if (screen->layout.kind != GB_LAYOUT_TOO_SMALL) {
        if (screen->dialog.type != NULL) {
            handle_dialog(app, event);
            return;
        }
        if (screen->params.editing) {
            gb_panel_params_edit_key(&screen->params, &screen->session, event,
                                     &screen->message);
            return;
        }
    }
    /* code points beyond ASCII overlap with the key codes of curses */
    if (event->kind == GB_TERM_TEXT && event->code > LAST_ASCII) {
        return;
    }
    screen->message.text[0] = '\0';
    if (gb_keys_find(event->code, GB_KEY_ALWAYS, &key)) {
        app_key(app, &key);
    }
}

/* At most ten frames in any second, two with --slow.  Updates of the engine are spaced
 * more widely, so that a frame is left to answer a key. */
static const double window_s = 1.0;
static const double update_spacing_s = 0.15;
static const double key_spacing_s = 0.02; /* time to collect a function key or a paste */

enum { STATUS_SIGNAL = 128 };

/* The first Ctrl-C opens the question, the second one quits. */
static void interrupt(struct gb_app *app)
{
    if (app->screen.dialog.type == &gb_dialogs_quit ||
        !gb_session_live(&app->screen.session)) {
        gb_pane_commands_leave(app, STATUS_SIGNAL + SIGINT);
    } else {
        gb_pane_commands_ask_quit(app);
    }
}

static void handle(struct gb_app *app, const struct gb_term_event *event)
{
    app->input_pending = app->input_pending || event->kind != GB_TERM_TIMEOUT;
    app->redraw = app->redraw || app->input_pending;
    switch (event->kind) {
    case GB_TERM_TIMEOUT:
    case GB_TERM_RESIZED:
        break;
    case GB_TERM_KEY:
    case GB_TERM_TEXT:
        gb_app_event(app, event);
        break;
    case GB_TERM_MOUSE:
        mouse_handle(app, event);
        break;
    case GB_TERM_INTERRUPT:
        interrupt(app);
        break;
    case GB_TERM_TERMINATE:
        gb_pane_commands_leave(app, STATUS_SIGNAL + event->code);
        break;
    case GB_TERM_HANGUP:
        app->terminal_lost = true;
        gb_pane_commands_leave(app, STATUS_SIGNAL + SIGHUP);
        break;
    }
}

/* Seconds until the next frame may be drawn. */
static double frame_wait(const struct gb_app *app)
{
    const double now = gb_clock_s();
    const double last =
        app->frame_s[(app->frames + app->frames_max - 1) % app->frames_max];
    const double oldest = app->frame_s[app->frames % app->frames_max];
    const double spacing = app->input_pending ? key_spacing_s : update_spacing_s;
    return fmax(last + spacing, oldest + window_s) - now;
}

/* Milliseconds to sleep: until the next frame may be drawn, or until the engine or an
 * image may have an update. -1 (forever) if only a key can change the screen. */
static int wait_timeout_ms(const struct gb_app *app)
{
    if (app->redraw) {
        const double left = frame_wait(app);
        return left > 0.0 ? (int)(1000.0 * left) + 1 : 0;
    }
    return gb_session_busy(&app->screen.session) || app->screen.image.waiting
               ? (int)(1000.0 * update_spacing_s)
               : -1;
}

static void draw(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    gb_screen_draw(screen);
    const struct gb_term_picture picture = gb_screen_picture(screen);
    if (gb_pixels_image_before(&screen->image, screen->term, &picture)) {
        gb_term_repaint(screen->term);
    }
    gb_term_flush(screen->term);
    gb_pixels_image_after(&screen->image, screen->term, &picture, gb_clock_s());
    app->frame_s[app->frames++ % app->frames_max] = gb_clock_s();
    app->redraw = app->input_pending = false;
}

/* Has standard error a new line? */
static bool poll_stderr(struct gb_app *app)
{
    char line[160];
    const bool found = gb_term_tail_poll(&app->stderr_tail, line, sizeof line);
    if (found) {
        gb_session_note(&app->screen.session, "library message: %s", line);
    }
    return found;
}

/* A key edits the parameters, and the session starts a quick cell with them.  A refresh reads
 * the snapshots of the engines, and a frame draws them. */
static void loop(struct gb_app *app)
{
    while (!app->leave) {
        const struct gb_term_event event =
            gb_term_wait(app->screen.term, wait_timeout_ms(app));
        handle(app, &event);
        app->redraw = gb_session_refresh(&app->screen.session) || app->redraw ||
                      gb_pixels_image_due(&app->screen.image, gb_clock_s());
        app->redraw = poll_stderr(app) || app->redraw;
        gb_file_commands_follow_quick(app);
        gb_job_commands_result_follow(app);
        if (app->redraw && !app->leave && frame_wait(app) <= 0.0) {
            draw(app);
        }
    }
}

/* If only one pane fits, the plot has the focus at first. */
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

/* Starts the scene of the preset, or attaches to a run. */
static bool open_first(struct gb_app *app, struct gb_error *err)
{
    struct gb_session *session = &app->screen.session;
    struct gb_error log = {0};
    if (!gb_term_check_log(&log)) {
        gb_session_note(session, "%s", log.text);
    }
    if (session->attached != NULL) {
        return gb_run_lifecycle_attach(session, err);
    }
    gb_file_commands_start_scene(app);
    return true;
}

/* Restores the terminal; after a hang-up only detaches from it. */
static void close_screen(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    if (app->terminal_lost) {
        gb_term_abandon(screen->term);
        app->status = gb_run_lifecycle_run_detached(&screen->session);
    } else {
        gb_term_stop(screen->term);
        if (!app->detach) {
            gb_run_lifecycle_print_resume_hint(&screen->session);
        }
    }
}

/* Ends the engines of this process.  A run that is left can be resumed from its
 * checkpoint. */
static void end_session(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    char *directory = app->detach && session->runner != NULL
                          ? g_strdup(gb_runner_directory(session->runner))
                          : NULL;
    gb_session_finish(session);
    if (directory != NULL) {
        gb_run_lifecycle_detach(directory);
    }
    g_free(directory);
}

int gb_app_run(struct gb_preset *preset, const char *folder, const char *attached,
               const struct gb_settings *settings, struct gb_error *err)
{
    struct gb_app *app = gb_alloc_array(1, sizeof *app, err);
    if (app == NULL) {
        return gb_status_exit_code(GB_ERR_MEMORY);
    }
    struct gb_screen *screen = &app->screen;
    if (!gb_term_start(&screen->term, settings, err)) {
        gb_alloc_free(app);
        return gb_status_exit_code(GB_ERR_MACHINE);
    }
    app->redraw = app->input_pending = true;
    gb_term_tail_init(&app->stderr_tail);
    app->frames_max = settings->slow ? GB_APP_FRAMES_SLOW : GB_APP_FRAMES;
    first_focus(screen);
    gb_session_init(&screen->session, preset);
    screen->session.folder = folder;
    screen->session.attached = attached;
    gb_panel_plot_init(&screen->plot, screen->term, settings->graph);
    gb_pixels_image_init(&screen->image, gb_term_images(screen->term));
    if (open_first(app, err)) {
        loop(app);
    }
    close_screen(app);
    end_session(app);
    gb_panel_plot_finish(&screen->plot);
    gb_dialog_close(&screen->dialog);
    gb_term_destroy(screen->term);
    const int status = app->status;
    gb_alloc_free(app);
    return status;
}
