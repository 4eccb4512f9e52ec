#include "tui/app/app.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/app/dispatch.h"
#include "tui/app/mouse.h"
#include "tui/session/run_lifecycle.h"
#include "tui/term/term_tty.h"

/* At most ten frames within any second, two with --slow.  Updates of the engine are
 * spaced wider, so that a frame is left for the answer to a key. */
static const double window_s = 1.0;
static const double update_spacing_s = 0.15;
static const double key_spacing_s = 0.02; /* collects a function key or a paste */

enum { STATUS_SIGNAL = 128 };

/* The first Ctrl-C opens the question, the second one quits. */
static void interrupt(struct gb_app *app)
{
    if (app->screen.dialog.type == &gb_dialogs_quit ||
        !gb_session_live(&app->screen.session)) {
        gb_screen_commands_leave(app, STATUS_SIGNAL + SIGINT);
    } else {
        gb_screen_commands_ask_quit(app);
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
        gb_dispatch_event(app, event);
        break;
    case GB_TERM_MOUSE:
        gb_mouse_handle(app, event);
        break;
    case GB_TERM_INTERRUPT:
        interrupt(app);
        break;
    case GB_TERM_TERMINATE:
        gb_screen_commands_leave(app, STATUS_SIGNAL + event->code);
        break;
    case GB_TERM_HANGUP:
        app->terminal_lost = true;
        gb_screen_commands_leave(app, STATUS_SIGNAL + SIGHUP);
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

/* Milliseconds to sleep: until the next frame may be drawn, until the engine or an image may
 * have an update; -1 (for ever) when only a key can change the screen. */
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
    if (gb_term_image_before(&screen->image, screen->term, &picture)) {
        gb_term_repaint(screen->term);
    }
    gb_term_flush(screen->term);
    gb_term_image_after(&screen->image, screen->term, &picture, gb_clock_s());
    app->frame_s[app->frames++ % app->frames_max] = gb_clock_s();
    app->redraw = app->input_pending = false;
}

/* Whether standard error had a new line. */
static bool poll_stderr(struct gb_app *app)
{
    char line[160];
    const bool found = gb_stderr_tail_poll(&app->stderr_tail, line, sizeof line);
    if (found) {
        gb_session_note(&app->screen.session, "library message: %s", line);
    }
    return found;
}

static void loop(struct gb_app *app)
{
    while (!app->leave) {
        const struct gb_term_event event =
            gb_term_wait(app->screen.term, wait_timeout_ms(app));
        handle(app, &event);
        app->redraw = gb_session_refresh(&app->screen.session) || app->redraw ||
                      gb_term_image_due(&app->screen.image, gb_clock_s());
        app->redraw = poll_stderr(app) || app->redraw;
        gb_run_commands_follow_quick(app);
        gb_result_commands_follow(app);
        if (app->redraw && !app->leave && frame_wait(app) <= 0.0) {
            draw(app);
        }
    }
}

/* Where only one pane fits, the plot has the focus at first. */
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

/* Starts the scene of the preset, or attaches to the run. */
static bool open_first(struct gb_app *app, struct gb_error *err)
{
    struct gb_session *session = &app->screen.session;
    struct gb_error log = {0};
    if (!gb_term_tty_check_log(&log)) {
        gb_session_note(session, "%s", log.text);
    }
    if (session->attached != NULL) {
        return gb_run_lifecycle_attach(session, err);
    }
    gb_run_commands_start_scene(app);
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

/* Ends the engines of this process; a run that is left goes on from its checkpoint. */
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
    gb_stderr_tail_init(&app->stderr_tail);
    app->frames_max = settings->slow ? GB_APP_FRAMES_SLOW : GB_APP_FRAMES;
    first_focus(screen);
    gb_session_init(&screen->session, preset);
    screen->session.folder = folder;
    screen->session.attached = attached;
    gb_panel_plot_init(&screen->plot, screen->term, settings->graph);
    gb_term_image_init(&screen->image, gb_term_images(screen->term));
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
