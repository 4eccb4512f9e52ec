#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "io/store.h"
#include "many/param_sweep.h"
#include "scene/field/keep_points.h"
#include "scene/loading_kind.h"
#include "study/calibration.h"
#include "tui/app/app.h"
#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/session/run_lifecycle.h"
#include "tui/view/views.h"

/* Commands of background jobs: replicas, calibration, moduli, chart, stability, and the
 * cards with their results. */

/* Results of the jobs in the background, as cards. */

/* Fits equations to the curve on display, with the intervals of its view. */
static void make_fit(struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    if (shown.curve != NULL && shown.points > 1) {
        gb_results_fits_update(&session->results.fits, shown.curve, shown.points,
                               shown.state >= GB_RUN_DONE ? GB_COMPACTION_PROFILE
                                                          : GB_COMPACTION_LINEAR);
        gb_results_make(&session->results, session, GB_RESULTS_FIT);
    }
}

/* Shows the results.  The card of the present view becomes the newest one. */
void gb_job_commands_result_show(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    if (app->screen.plot.view->draw == gb_view_fit_draw) {
        make_fit(session);
    } else if (app->screen.plot.view->draw == gb_view_moduli_draw) {
        gb_results_make(&session->results, session, GB_RESULTS_MODULI);
    }
    if (session->results.count == 0) {
        gb_pane_commands_message(
            app, GB_STYLE_WARN,
            "no result yet: C, R, Y, s and x make one, and view E with a curve");
        return;
    }
    gb_dialog_show_results(&app->screen.dialog, &gb_dialogs_results, session);
}

/* Shows a new result unless the user is typing. */
void gb_job_commands_result_follow(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    struct gb_results *results = &screen->session.results;
    if (!gb_results_take_news(results)) {
        return;
    }
    app->redraw = true;
    const struct gb_dialog_type *open = screen->dialog.type;
    if ((open == NULL || open == &gb_dialogs_results) && !screen->params.editing &&
        screen->layout.kind != GB_LAYOUT_TOO_SMALL) {
        gb_dialog_show_results(&screen->dialog, &gb_dialogs_results, &screen->session);
    } else {
        char text[96];
        snprintf(text, sizeof text, "%s: the result is there, W shows it",
                 gb_results_at(results, 0)->kind->title);
        gb_pane_commands_message(app, GB_STYLE_GOOD, text);
    }
}

char *gb_job_commands_result_text(struct gb_app *app)
{
    return gb_results_card_text(
        gb_results_at(&app->screen.session.results, app->screen.dialog.focus));
}

void gb_job_commands_result_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_session *session = &app->screen.session;
    const struct gb_result_card *card = gb_results_at(&session->results, dialog->focus);
    struct gb_error err = {0};
    char *told = NULL;
    if (card->values->len == 0) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s",
                           "there is nothing to use in this result");
        return;
    }
    if (!gb_results_card_use(card, gb_session_params(session), &told, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_session_note(session, "%s used: %s", card->kind->title, told);
    gb_dialog_close(dialog);
    gb_panel_params_edit_changed(session, &app->screen.message);
    if (app->screen.message.text[0] == '\0') {
        char text[400];
        snprintf(text, sizeof text, "used: %.300s; u undoes", told);
        gb_pane_commands_message(app, GB_STYLE_GOOD, text);
    }
    g_free(told);
}

/* Opens the picture of a result in the terminal if it can show pixels; starts no other
 * program. */
static void open_result(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    const struct gb_result_card *card =
        gb_results_at(&app->screen.session.results, dialog->focus);
    const char *page = card->page != NULL ? card->page : card->path;
    struct gb_png_pixels picture = {0};
    struct gb_error err = {0};
    if (page == NULL) {
        return;
    }
    if (card->picture == NULL || gb_term_images(app->screen.term) == GB_IMAGES_NONE) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s%s",
                           card->page != NULL ? "in a browser: "
                           : card->picture != NULL
                               ? "this terminal shows no pixels: open "
                               : "in an editor: ",
                           page);
    } else if (gb_pixels_png_read(&picture, card->picture, &err)) {
        gb_dialog_show_pixels(dialog, &gb_dialogs_pixels, &picture, page);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
}

static bool is_own(int code)
{
    struct gb_key key;
    switch (gb_keys_action(code)) {
    case GB_ACTION_ENTER:
    case GB_ACTION_LEFT:
    case GB_ACTION_RIGHT:
    case GB_ACTION_UP:
    case GB_ACTION_DOWN:
    case GB_ACTION_BACK:
        return true;
    default:
        return gb_keys_find(code, GB_KEY_EVERYWHERE, &key) &&
               (key.command == gb_pane_commands_quit ||
                key.command == gb_job_commands_result_show);
    }
}

/* Handles keys of a card that appeared by itself: other keys act as without the card. */
bool gb_job_commands_result_press(struct gb_app *app, const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_TEXT && event->code == 'o') {
        open_result(app);
        return true;
    }
    if (is_own(event->code)) {
        return false;
    }
    gb_dialog_close(&app->screen.dialog);
    gb_app_event(app, event);
    return true;
}

/* Accuracy against cost of this scene, measured by `greenbody chart` as a child
 * process. */

/* Default answer: as many cells as the command takes, a quarter of an hour on one core.
 */
static const char default_answer[] = "4 15min";

enum { CELLS_MIN = 2, CELLS_MAX = 1000, DESCRIPTION = 160 };

/* Opens the dialog for the stability of the methods of the scene. */
static void job_commands_stability_open(struct gb_app *app)
{
    struct gb_error err = {0};
    if (!gb_loading_kind_check_cell(gb_session_params(&app->screen.session), "stability",
                                    &err)) {
        gb_pane_commands_message(app, GB_STYLE_WARN, err.text);
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_stability, "");
}

void gb_job_commands_chart_open(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    if (gb_job_chart_runs(&session->child)) {
        gb_job_stop(&session->child);
        gb_pane_commands_message(app, GB_STYLE_PLAIN,
                                 session->chart_job.stability
                                     ? "the measurement is stopped"
                                     : "the chart is stopped");
        return;
    }
    if (app->screen.plot.view->need == GB_VIEW_NEEDS_STABILITY) {
        job_commands_stability_open(app);
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_chart, default_answer);
}

/* The typed answer: cells, CPU time, pressures. */
struct answer {
    char **parts;
    char *pressures; /* NULL: the pressures of the scene */
};

static bool parse(struct answer *answer, const char *text, struct gb_error *err)
{
    guint64 cells = 0;
    double budget_s = 0.0;
    char *stripped = g_strstrip(g_strdup(text));
    answer->parts = g_strsplit(stripped, " ", 3);
    g_free(stripped);
    const bool one = answer->parts[0] != NULL;
    const bool two = one && answer->parts[1] != NULL;
    answer->pressures =
        two && answer->parts[2] != NULL ? g_strstrip(answer->parts[2]) : NULL;
    if (!one || !g_ascii_string_to_unsigned(answer->parts[0], 10, CELLS_MIN, CELLS_MAX,
                                            &cells, NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the number of cells must be between %d and %d; then, if "
                            "wanted, a CPU time and pressures: 4 15min 100MPa;1GPa",
                            CELLS_MIN, CELLS_MAX);
    }
    return !two ||
           (gb_units_parse(answer->parts[1], GB_DIM_TIME, &budget_s, NULL) &&
            budget_s > 0.0) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.40s: expected a CPU time above 0, as in 15min",
                        answer->parts[1]);
}

/* Writes the parameters on display to a preset DIRECTORY/scene.ini and returns its path
 * (g_free). */
static char *write_scene(struct gb_session *session, const char *directory,
                         struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    char *path = NULL;
    if (!gb_params_check(gb_session_params(session), err) ||
        !gb_preset_create(&preset, err)) {
        return NULL;
    }
    *gb_preset_params(preset) = *gb_session_params(session);
    if (g_mkdir_with_parents(directory, 0777) != 0) {
        gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be created", directory);
    } else {
        path = g_build_filename(directory, "scene.ini", NULL);
        if (!gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, err)) {
            g_clear_pointer(&path, g_free);
        }
    }
    gb_preset_destroy(preset);
    return path;
}

/* A new directory next to the run directories: "default-replicas-1". g_free. */
static char *new_directory(const struct gb_session *session, const char *name)
{
    const char *path = gb_preset_path(session->preset);
    char *base = g_path_get_basename(*path != '\0' ? path : "default.ini");
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    char *prefix = g_strdup_printf("%s-%s", base, name);
    char *folder = session->folder != NULL
                       ? g_strdup(session->folder)
                       : gb_run_lifecycle_folder(); /* attached to a run */
    char *directory = gb_store_new_directory(folder, prefix);
    g_free(folder);
    g_free(prefix);
    g_free(base);
    return directory;
}

/* Indices in the words of the child command. */
enum { SCENE = 1, DIRECTORY = 3 };

/* Starts a command with the scene and a new directory in words[1] and words[3].  True:
 * the dialog is closed.  False: the dialog shows the reason. */
static bool job_commands_start(struct gb_app *app, const char *name,
                               enum gb_child_command_kind kind, const char **words)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    char *directory = new_directory(session, name);
    char *scene = write_scene(session, directory, &err);
    words[SCENE] = scene;
    words[DIRECTORY] = directory;
    const bool started = scene != NULL && gb_job_start(&session->child, name, directory,
                                                       kind, words, &err);
    if (started) {
        gb_session_note(session, "%s: computed in %s", name, directory);
        gb_dialog_close(dialog);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
    g_free(scene);
    g_free(directory);
    return started;
}

static void chart_commands_start(struct gb_app *app, const struct answer *answer)
{
    struct gb_session *session = &app->screen.session;
    const bool budget = answer->parts[1] != NULL;
    const char *words[] = {"chart",
                           NULL,
                           "-o",
                           NULL,
                           "--seeds",
                           answer->parts[0],
                           budget ? "--budget" : NULL,
                           answer->parts[1],
                           answer->pressures != NULL ? "--at" : NULL,
                           answer->pressures,
                           NULL};
    if (job_commands_start(app, "chart", GB_CHILD_COMMAND_QUIET, words)) {
        g_clear_pointer(&session->chart, gb_job_chart_csv_destroy);
        gb_job_chart_follow(&session->chart_job, session->child.path, false);
        app->screen.plot.view = gb_views_with(GB_VIEW_NEEDS_CHART);
        app->screen.plot.setting_on = NULL;
        app->screen.focus = GB_PANE_PLOT;
        gb_pane_commands_message(app, GB_STYLE_PLAIN,
                                 "measuring the settings; X again stops");
    }
}

void gb_job_commands_chart_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct answer answer;
    struct gb_error err = {0};
    if (parse(&answer, gb_dialog_answer(dialog), &err)) {
        chart_commands_start(app, &answer);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
    g_strfreev(answer.parts);
}

/* Sets the method under the cursor, or its time step, in the parameters. */
static void job_commands_stability_apply(struct gb_screen *screen, size_t row)
{
    struct gb_session *session = &screen->session;
    struct gb_error err = {0};
    char text[64];
    if (!gb_job_stability_apply(session->stability, row, gb_session_params(session), text,
                                sizeof text, &err)) {
        screen->message.style = GB_STYLE_WARN;
        snprintf(screen->message.text, sizeof screen->message.text, "%s", err.text);
        return;
    }
    gb_session_note(session, "stable method: %s", text);
    gb_panel_params_edit_changed(session, &screen->message);
    if (screen->message.text[0] == '\0') {
        screen->message.style = GB_STYLE_GOOD;
        snprintf(screen->message.text, sizeof screen->message.text,
                 "applied: %s; u undoes", text);
    }
}

void gb_job_commands_chart_apply(struct gb_screen *screen)
{
    struct gb_session *session = &screen->session;
    char text[DESCRIPTION];
    size_t row = 0;
    if (!gb_panel_plot_settings_at(&screen->plot, session, &row)) {
        return;
    }
    if (screen->plot.view->need == GB_VIEW_NEEDS_STABILITY) {
        job_commands_stability_apply(screen, row);
        return;
    }
    const struct gb_chart_setting *setting = &session->chart->setting[row];
    screen->message.style = GB_STYLE_WARN;
    if (setting->relaxer[0] == '\0') {
        snprintf(screen->message.text, sizeof screen->message.text,
                 "this chart.csv has no settings to apply");
        return;
    }
    gb_job_chart_csv_apply(session->chart, row, gb_session_params(session));
    gb_chart_describe(setting, text, sizeof text);
    gb_session_note(session, "setting of the chart: %s", text);
    gb_panel_params_edit_changed(session, &screen->message);
    if (screen->message.text[0] == '\0') {
        screen->message.style = GB_STYLE_GOOD;
        snprintf(screen->message.text, sizeof screen->message.text,
                 "applied: %s; u undoes", text);
    }
}

/* Stability of the methods of this scene, measured by a child command `greenbody
 * stability`.  Key and cursor are the same as for the chart. */

static void start(struct gb_app *app, char *points)
{
    struct gb_session *session = &app->screen.session;
    const char *words[] = {"stability", NULL, "-o", NULL, *points != '\0' ? "--at" : NULL,
                           points,      NULL};
    if (job_commands_start(app, "stability", GB_CHILD_COMMAND_QUIET, words)) {
        g_clear_pointer(&session->stability, gb_job_stability_destroy);
        gb_job_chart_follow(&session->chart_job, session->child.path, true);
        app->screen.plot.view = gb_views_with(GB_VIEW_NEEDS_STABILITY);
        app->screen.plot.setting_on = NULL;
        app->screen.focus = GB_PANE_PLOT;
        gb_pane_commands_message(app, GB_STYLE_PLAIN,
                                 "measuring the methods; X again stops");
    }
}

void gb_job_commands_stability_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_keep_points points;
    struct gb_error err = {0};
    char *answer = g_strstrip(g_strdup(gb_dialog_answer(dialog)));
    if (gb_keep_points_parse(answer, &points, &err) && points.every == 0) {
        start(app, answer);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR,
                           "%.40s: expected pressures or densities, as 10 MPa; "
                           "density=0.5, or nothing",
                           answer);
    }
    g_free(answer);
}

/* Replicas of the scene on display, its calibration to the measured data, and moduli of
 * the run: child commands `sweep`, `calibrate` and `moduli`. */

/* Default answer.  P1 averages ten cells; a standard error of 0.002 distinguishes two
 * powders of a study. */
static const char default_replicas[] = "10 0.002@100MPa";
static const char default_keys[] = "mu,alpha";

enum { REPLICAS_MIN = 2, REPLICAS_MAX = 1000 };

void gb_job_commands_replicas(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_replicas, default_replicas);
}

void gb_job_commands_calibrate(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    if (app->screen.session.measured == NULL) {
        gb_pane_commands_message(app, GB_STYLE_WARN,
                                 "a calibration needs measured data: e loads a CSV file");
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_calibrate, default_keys);
}

/* Opens the view of the moduli.  If it is open, stops the measurement. */
void gb_job_commands_moduli(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    struct gb_error err = {0};
    (void)key;
    if (gb_job_moduli_runs(&session->moduli, &session->child)) {
        gb_job_moduli_stop(&session->moduli, &session->child);
        gb_pane_commands_message(app, GB_STYLE_PLAIN, "the measurement is stopped");
        return;
    }
    if (!gb_job_moduli_start(&session->moduli, session->runner,
                             gb_session_run_is_live(session), &session->child, &err)) {
        gb_pane_commands_message(app, GB_STYLE_WARN, err.text);
        return;
    }
    app->screen.plot.view = gb_views_find("S");
    gb_pane_commands_message(app, GB_STYLE_PLAIN,
                             "measuring the stored states; Y again stops");
}

/* Reads "0.002@100MPa"; NULL or blank: no target. */
static bool is_target(const char *text, struct gb_sweep_target *target,
                      struct gb_error *err)
{
    const bool good =
        text == NULL || *text == '\0' || gb_param_sweep_target(target, text, err);
    gb_param_sweep_target_finish(target);
    return good;
}

void gb_job_commands_accept_replicas(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    char *answer = g_strdup(gb_dialog_answer(dialog));
    char **parts = g_strsplit(g_strstrip(answer), " ", 2);
    guint64 cells = 0;
    struct gb_sweep_target wanted = {0};
    struct gb_error err = {0};
    if (parts[0] == NULL || !g_ascii_string_to_unsigned(parts[0], 10, REPLICAS_MIN,
                                                        REPLICAS_MAX, &cells, NULL)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR,
                           "the number of cells must be between %d and %d; then, if "
                           "wanted, a standard error at a pressure: 0.002@100MPa",
                           REPLICAS_MIN, REPLICAS_MAX);
    } else if (parts[1] != NULL && !is_target(g_strstrip(parts[1]), &wanted, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    } else {
        const bool target = parts[1] != NULL && *parts[1] != '\0';
        const char *words[] = {"sweep",
                               NULL,
                               "-o",
                               NULL,
                               "--replicas",
                               parts[0],
                               target ? "--until-se" : NULL,
                               target ? parts[1] : NULL,
                               NULL};
        struct gb_session *session = &app->screen.session;
        struct gb_replica_band *band = &session->replica_band;
        if (job_commands_start(app, "replicas", GB_CHILD_COMMAND_LONG, words)) {
            gb_job_replicas_follow(band, session->child.path, gb_session_params(session));
            band->target = wanted.standard_error;
            band->target_pa = wanted.pressure_pa;
        }
    }
    g_strfreev(parts);
    g_free(answer);
}

void gb_job_commands_accept_calibrate(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_free_keys parsed;
    struct gb_error err = {0};
    if (session->measured == NULL) { /* removed while the dialog was open */
        gb_dialog_close(dialog);
        return;
    }
    if (!gb_calibration_keys(&parsed, gb_dialog_answer(dialog),
                             gb_session_params(session), &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    char *keys = g_strdup(gb_dialog_answer(dialog));
    const bool read = *session->reading != '\0';
    const char *words[] = {"calibrate",
                           NULL,
                           "-o",
                           NULL,
                           "--data",
                           session->measured->path,
                           "--free",
                           keys,
                           read ? "--columns" : NULL,
                           read ? session->reading : NULL,
                           NULL};
    if (job_commands_start(app, "calibration", GB_CHILD_COMMAND_LONG, words)) {
        gb_pane_commands_message(app, GB_STYLE_PLAIN,
                                 "calibration started: progress among the events");
    }
    g_free(keys);
}
