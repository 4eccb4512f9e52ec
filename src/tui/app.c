#include "tui/app.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/alloc.h"
#include "run/quick.h"
#include "tui/complete.h"
#include "tui/life.h"
#include "tui/repeat.h"
#include "tui/saving.h"
#include "tui/screen.h"
#include "tui/whatif.h"

/* At most ten frames within any second.  News of the engine alone is drawn less often, so
 * that a key nearly always finds a frame free and is answered at once. */
enum { FRAMES = 10 };
static const double second_s = 1.0;
static const double news_s = 0.15;
static const double key_s = 0.02; /* a function key or a paste comes in one piece */

enum { STATUS_SIGNAL = 128 };

struct gb_app {
    struct gb_screen screen;
    bool leave, dirty;
    bool gone;   /* the terminal */
    bool urgent; /* a key waits for its frame */
    int status;
    double frame[FRAMES]; /* clock of the last frames, the next one takes the oldest */
    int frames;
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

/* A scene that is opened answers with its quick cell first, unless it is quick itself. */
static void start_scene(struct gb_app *app)
{
    const struct gb_params *params = gb_session_params(&app->screen.session);
    if (gb_quick_enough(params) || !gb_session_try(&app->screen.session)) {
        start_run(app);
    }
}

/* The quick curve is there: the full cell follows.  What takes hours waits for r. */
static void follow(struct gb_app *app)
{
    char question[400];
    if (!gb_session_take_due(&app->screen.session)) {
        return;
    }
    if (gb_session_costly(&app->screen.session, question, sizeof question)) {
        tell(app, GB_STYLE_WARN, "the full cell takes long: r tells how long and asks");
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
    start_scene(app);
}

static void ask_data(struct gb_app *app)
{
    const struct gb_measured *measured = app->screen.session.measured;
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_DATA,
                   measured != NULL ? measured->path : "");
}

static void load_data(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    char *path = gb_complete_home(gb_dialog_answer(dialog));
    const struct gb_choices *before = app->screen.session.choices;
    if (!gb_session_load_data(&app->screen.session, path, &err)) {
        dialog->warned = false;
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
    } else {
        const bool chart = app->screen.session.choices != before;
        gb_session_note(&app->screen.session, *path != '\0' ? "loaded %s" : "no data%s",
                        path);
        gb_dialog_close(dialog);
        app->screen.plot.view = chart ? GB_VIEW_CHART : GB_VIEW_CURVE;
        app->screen.focus = GB_PANE_PLOT;
    }
    g_free(path);
}

/* Begins with the parameter that has the focus. */
static void ask_fork(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    char text[GB_PARAMS_VALUE_MAX + 64];
    if (!gb_session_run_is_live(&screen->session)) {
        tell(app, GB_STYLE_WARN, "a what-if needs a run under way: r starts one");
        return;
    }
    gb_panel_params_quote(&screen->params, &screen->session, text, sizeof text);
    gb_dialog_show(&screen->dialog, GB_DIALOG_FORK, text);
}

static void fork_run(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (!gb_whatif_ask(&app->screen.session, gb_dialog_answer(dialog), &err)) {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
        return;
    }
    gb_dialog_close(dialog);
    tell(app, GB_STYLE_PLAIN, "goes on with that from its next point of the loading");
}

static void find(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    if (gb_panel_params_find(&app->screen.params, &app->screen.session,
                             gb_dialog_answer(dialog))) {
        app->screen.focus = GB_PANE_PARAMS;
        gb_dialog_close(dialog);
    } else {
        snprintf(dialog->note, sizeof dialog->note, "no parameter has that in its name");
    }
}

/* Another command of this program makes it from the run's directory, beside the screen.
 * Its path: the directory, middle, a number that is free, end. */
static void run_errand(struct gb_app *app, const char *what, const char *command,
                       const char *middle, const char *end)
{
    struct gb_session *session = &app->screen.session;
    const char *directory =
        session->runner != NULL ? gb_runner_directory(session->runner) : NULL;
    struct gb_error err = {0};
    if (directory == NULL) {
        tell(app, GB_STYLE_WARN, "there is no stored run yet: r starts one");
        return;
    }
    char *path = NULL;
    for (int i = 1; path == NULL || g_file_test(path, G_FILE_TEST_EXISTS); i++) {
        g_free(path);
        path = g_strdup_printf("%s%s%d%s", directory, middle, i, end);
    }
    const char *const words[] = {command, directory, "-o", path, NULL};
    if (gb_errand_start(&session->errand, what, path, words, &err)) {
        tell(app, GB_STYLE_PLAIN, "is being made: the events will say where it is");
    } else {
        tell(app, GB_STYLE_BAD, err.text);
    }
    g_free(path);
}

static void show_command(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    int rows = 0;
    int cols = 0;
    gb_term_size(app->screen.term, &rows, &cols);
    char *text = gb_repeat_command(session->preset, gb_session_params(session), cols - 1);
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_COMMAND, text);
    g_free(text);
}

static void toggle_follow(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    session->follow = !session->follow;
    tell(app, GB_STYLE_PLAIN,
         session->follow ? "the full cell follows the quick one by itself"
                         : "the full cell waits for r");
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
    case GB_DIALOG_DATA:
        load_data(app);
        break;
    case GB_DIALOG_FIND:
        find(app);
        break;
    case GB_DIALOG_FORK:
        fork_run(app);
        break;
    case GB_DIALOG_COMMAND:
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
        gb_life_take_over(&screen->session, &screen->message);
        return true;
    case GB_ACTION_SAVE:
        ask_save(app);
        return true;
    case GB_ACTION_OPEN:
        gb_dialog_browse(&screen->dialog, gb_session_params(&screen->session));
        return true;
    case GB_ACTION_FORK:
        ask_fork(app);
        return true;
    case GB_ACTION_DATA:
        ask_data(app);
        return true;
    case GB_ACTION_FIND:
        gb_dialog_show(&screen->dialog, GB_DIALOG_FIND, NULL);
        return true;
    case GB_ACTION_PICTURE:
        run_errand(app, "picture", "snapshot", "/picture-", ".png");
        return true;
    case GB_ACTION_REPORT:
        run_errand(app, "report", "report", "-report-", "");
        return true;
    case GB_ACTION_COMMAND:
        show_command(app);
        return true;
    case GB_ACTION_FOLLOW:
        toggle_follow(app);
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
    app->urgent = app->urgent || event->kind != GB_TERM_NOTHING;
    app->dirty = app->dirty || app->urgent;
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
        app->gone = true;
        leave(app, STATUS_SIGNAL + SIGHUP);
        break;
    }
}

/* Seconds until the next frame may be drawn. */
static double frame_wait(const struct gb_app *app)
{
    const double now = clock_s();
    const double last = app->frame[(app->frames + FRAMES - 1) % FRAMES];
    const double oldest = app->frame[app->frames % FRAMES];
    const double spacing = app->urgent ? key_s : news_s;
    return fmax(last + spacing, oldest + second_s) - now;
}

/* Milliseconds to sleep: until the next frame may be drawn, until the engine may have
 * news, or for ever when nothing can happen without a key. */
static int patience(const struct gb_app *app)
{
    if (app->dirty) {
        const double left = frame_wait(app);
        return left > 0.0 ? (int)(1000.0 * left) + 1 : 0;
    }
    return gb_session_busy(&app->screen.session) ? (int)(1000.0 * news_s) : -1;
}

static void draw(struct gb_app *app)
{
    gb_screen_draw(&app->screen);
    gb_term_flush(app->screen.term);
    app->frame[app->frames++ % FRAMES] = clock_s();
    app->dirty = app->urgent = false;
}

static void loop(struct gb_app *app)
{
    while (!app->leave) {
        const struct gb_term_event event = gb_term_wait(app->screen.term, patience(app));
        handle(app, &event);
        app->dirty = gb_session_refresh(&app->screen.session) || app->dirty;
        follow(app);
        if (app->dirty && !app->leave && frame_wait(app) <= 0.0) {
            draw(app);
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

/* The scene of the preset, or the run that is attached. */
static bool open_first(struct gb_app *app, struct gb_error *err)
{
    struct gb_session *session = &app->screen.session;
    if (session->attached != NULL) {
        return gb_life_attach(session, err);
    }
    start_scene(app);
    return true;
}

/* Gives the terminal back, if there still is one. */
static void close_screen(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    if (app->gone) {
        gb_term_abandon(screen->term);
        app->status = gb_life_detached(&screen->session);
    } else {
        gb_term_stop(screen->term);
        gb_life_farewell(&screen->session);
    }
}

int gb_app_run(struct gb_preset *preset, const char *folder, const char *attached,
               struct gb_error *err)
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
    app->dirty = app->urgent = true;
    first_focus(screen);
    gb_session_init(&screen->session, preset);
    screen->session.folder = folder;
    screen->session.attached = attached;
    gb_panel_plot_init(&screen->plot, screen->term);
    if (open_first(app, err)) {
        loop(app);
    }
    close_screen(app);
    gb_session_finish(&screen->session);
    gb_panel_plot_finish(&screen->plot);
    gb_dialog_close(&screen->dialog);
    const int status = app->status;
    gb_alloc_free(app);
    return status;
}
