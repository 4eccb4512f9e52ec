/* Commands of the run and of files.  The first part starts runs, quick cells and
 * what-ifs and asks before expensive runs.  The second part opens and saves presets and
 * materials, loads measured data, makes pictures and reports as child commands, and
 * shows the shell command of the run. */
#include <glib.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "io/material.h"
#include "io/preset.h"
#include "run/cost.h"
#include "scene/loading_kind.h"
#include "scene/path/path.h"
#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/app/preset_browser.h"
#include "tui/panel/prompt.h"
#include "tui/session/previous.h"
#include "tui/session/run_lifecycle.h"
#include "tui/session/session.h"
#include "tui/view/views.h"

/* The current run, its quick cell, and what-ifs. */

enum { QUESTION = 400 };

/* A rejection stays on the message line until the next key, even if a run starts. */
static bool is_refusal(const struct gb_message *message)
{
    return message->text[0] != '\0' &&
           (message->style == GB_STYLE_WARN || message->style == GB_STYLE_BAD);
}

/* Reports that the next run uses the changes left by a what-if or a preset. */
static void tell_changes(struct gb_app *app)
{
    const char *changes = gb_session_params(&app->screen.session)->changes;
    if (changes[0] != '\0') {
        char *text = g_strdup_printf(
            "this run has the changes after step %s; D drops them", changes);
        gb_session_note(&app->screen.session, "%s", text);
        gb_pane_commands_message(app, GB_STYLE_WARN, text);
        g_free(text);
    }
}

void gb_file_commands_drop_changes(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    struct gb_params *params = gb_session_params(&screen->session);
    (void)key;
    if (params->changes[0] == '\0') {
        gb_pane_commands_message(app, GB_STYLE_WARN,
                                 "there are no changes during the run to drop");
        return;
    }
    gb_session_note(&screen->session, "dropped: the changes after step %s",
                    params->changes);
    params->changes[0] = '\0';
    gb_panel_params_edit_changed(&screen->session, &screen->message);
}

static void start_run(struct gb_app *app)
{
    struct gb_error err = {0};
    if (gb_session_start(&app->screen.session, &err)) {
        app->screen.plot.cursor_on = false;
        if (!is_refusal(&app->screen.message)) {
            app->screen.message.text[0] = '\0';
        }
        tell_changes(app);
    } else {
        gb_pane_commands_message(app, GB_STYLE_BAD, err.text);
        gb_session_note(&app->screen.session, "not started: %s", err.text);
    }
}

/* Starts the run; an expensive one only after a confirmation. */
static void start_or_ask(struct gb_app *app)
{
    char question[QUESTION];
    if (gb_session_cost_question(&app->screen.session, question, sizeof question)) {
        gb_dialog_show(&app->screen.dialog, &gb_dialogs_cost, question);
    } else {
        start_run(app);
    }
}

void gb_file_commands_start(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    start_or_ask(app);
}

void gb_file_commands_accept_cost(struct gb_app *app)
{
    gb_dialog_close(&app->screen.dialog);
    app->screen.message.text[0] = '\0';
    start_run(app);
}

void gb_file_commands_decline_cost(struct gb_app *app)
{
    gb_session_note(&app->screen.session, "not started: declined");
    gb_pane_commands_message(app, GB_STYLE_WARN,
                             "not started: change the parameters, r asks again");
}

void gb_file_commands_start_scene(struct gb_app *app)
{
    const struct gb_params *params = gb_session_params(&app->screen.session);
    if (gb_cost_is_quick(params) || !gb_session_quick_start(&app->screen.session)) {
        start_or_ask(app);
    }
}

void gb_file_commands_follow_quick(struct gb_app *app)
{
    char question[QUESTION];
    struct gb_session *session = &app->screen.session;
    if (!gb_session_quick_take_due(session)) {
        return;
    }
    if (gb_session_cost_question(session, question, sizeof question)) {
        static const char text[] = "the full cell takes long: r shows how long and asks";
        gb_session_note(session, "%s", text);
        if (!is_refusal(&app->screen.message)) {
            gb_pane_commands_message(app, GB_STYLE_WARN, text);
        }
    } else {
        start_run(app);
    }
}

void gb_file_commands_pause(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_session_toggle_pause(&app->screen.session);
}

void gb_file_commands_freeze(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_session_toggle_freeze(&app->screen.session);
}

void gb_file_commands_take_over(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_run_lifecycle_take_over(&app->screen.session, &app->screen.message);
}

void gb_file_commands_auto_start(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    session->auto_start = !session->auto_start;
    gb_pane_commands_message(app, GB_STYLE_PLAIN,
                             session->auto_start
                                 ? "the full cell follows the quick one automatically"
                                 : "the full cell waits for r");
}

/* Replaces semicolons, which separate assignments here; legs of a path are separated by
 * `then`. */
static void separate_legs(char *text, size_t size)
{
    char **legs = gb_path_parse_split(text);
    if (strncmp(text, "loading.path=", strlen("loading.path=")) == 0) {
        char *joined = g_strjoinv(" then ", legs);
        g_strlcpy(text, joined, size);
        g_free(joined);
    }
    g_strfreev(legs);
}

void gb_file_commands_what_if(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    char text[GB_PARAMS_VALUE_MAX + 64];
    const struct gb_runner *run = screen->session.runner;
    const struct gb_params *params =
        run != NULL ? gb_runner_params(run) : gb_session_params(&screen->session);
    (void)key;
    if (!gb_loading_kind_of(params)->changes) {
        gb_pane_commands_message(
            app, GB_STYLE_WARN,
            "a what-if continues from an equilibrium, which only quasi-static runs have: "
            "change the parameter and start again with r");
        return;
    }
    if (!gb_session_run_is_live(&screen->session)) {
        gb_pane_commands_message(app, GB_STYLE_WARN,
                                 "a what-if needs a live run: r starts one");
        return;
    }
    gb_panel_params_assignment(&screen->params, &screen->session, text, sizeof text);
    separate_legs(text, sizeof text);
    gb_dialog_show(&screen->dialog, &gb_dialogs_what_if, text);
}

void gb_file_commands_accept_what_if(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    if (!gb_session_whatif_request(&app->screen.session, gb_dialog_answer(dialog),
                                   &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_dialog_close(dialog);
    gb_pane_commands_message(app, GB_STYLE_PLAIN,
                             "continues with these values from the next loading point");
}

/* Presets, materials, measured data, pictures, reports. */

/* The user's presets. */

/* Suggested name for saving a preset.  A preset of the user keeps its name; others get
 * the prefix "my-", so that an installed preset is not hidden by accident. g_free. */
static char *user_presets_suggest(const struct gb_preset *preset)
{
    const char *path = gb_preset_path(preset);
    char *base = g_path_get_basename(*path != '\0' ? path : "preset.ini");
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    const bool own = g_str_has_prefix(path, g_get_user_config_dir());
    char *name = g_strdup_printf("%s%s", own ? "" : "my-", base);
    g_free(base);
    return name;
}

/* Path of a name in the folder of user presets, which is created if missing, or the
 * name itself if it has a slash.  NULL and GB_ERR_INPUT for an invalid name. g_free. */
static char *user_presets_file(const char *name, struct gb_error *err)
{
    if (strchr(name, '/') != NULL) {
        return g_strdup(name);
    }
    if (*name == '\0' || *name == '.' || *name == '-') {
        gb_error_set(err, GB_ERR_INPUT,
                     "a name is needed that does not begin with '.' or '-'");
        return NULL;
    }
    char *folder =
        g_build_filename(g_get_user_config_dir(), "greenbody", "presets", NULL);
    char *file = g_strconcat(name, g_str_has_suffix(name, ".ini") ? "" : ".ini", NULL);
    char *path = g_build_filename(folder, file, NULL);
    g_mkdir_with_parents(folder, 0700);
    g_free(file);
    g_free(folder);
    return path;
}

void gb_file_commands_save(struct gb_app *app, const struct gb_key *key)
{
    char *name = user_presets_suggest(app->screen.session.preset);
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_save, name);
    g_free(name);
}

/* An existing file is replaced if Enter is pressed twice. */
void gb_file_commands_accept_save(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_preset *preset = app->screen.session.preset;
    struct gb_error err = {0};
    char *path = user_presets_file(gb_dialog_answer(dialog), &err);
    const bool warned = dialog->kind == GB_DIALOG_NOTE_WARNING;
    if (path == NULL) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    } else if (!warned && g_file_test(path, G_FILE_TEST_EXISTS)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING,
                           "%s exists: Enter again replaces it", path);
    } else if (!gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    } else {
        char *text = g_strdup_printf("saved as %s", path);
        gb_session_note(&app->screen.session, "saved %s", path);
        gb_pane_commands_message(app, GB_STYLE_GOOD, text);
        g_free(text);
        gb_dialog_close(dialog);
    }
    g_free(path);
}

void gb_file_commands_open(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show_presets(&app->screen.dialog, &gb_dialogs_open,
                           &gb_preset_browser_kinds_presets,
                           gb_session_params(&app->screen.session));
}

void gb_file_commands_accept_open(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    const char *name = gb_dialog_answer(dialog);
    if (!gb_session_open(&app->screen.session, name, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_session_note(&app->screen.session, "opened %s", name);
    gb_dialog_close(dialog);
    gb_file_commands_start_scene(app);
}

void gb_file_commands_material(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show_presets(&app->screen.dialog, &gb_dialogs_material,
                           &gb_preset_browser_kinds_materials,
                           gb_session_params(&app->screen.session));
}

/* Applies the material and starts the quick cell, as any change of parameters does. */
void gb_file_commands_accept_material(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_session *session = &app->screen.session;
    struct gb_error err = {0};
    const char *name = gb_dialog_answer(dialog);
    if (!gb_material_apply(gb_session_params(session), name, &err)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    }
    gb_session_note(session, "material %s", name);
    gb_dialog_close(dialog);
    gb_panel_params_edit_changed(session, &app->screen.message);
}

void gb_file_commands_data(struct gb_app *app, const struct gb_key *key)
{
    const struct gb_measured *measured = app->screen.session.measured;
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_data,
                   measured != NULL ? measured->path : "");
}

/* Asks how to read a file: an input line with the first answer in it. */
static void ask_reading(struct gb_dialog *dialog, const char *path,
                        const struct gb_lab_report *report)
{
    gb_dialog_show(dialog, &gb_dialogs_reading,
                   report->choices > 0 ? report->choice[0] : "");
    dialog->text = g_strdup(path);
    gb_dialog_set_note(dialog, GB_DIALOG_NOTE_WARNING, "%s", report->question);
}

/* Adds notes on how the file was read, one clause each, because the pane shows short
 * lines in full. */
static void note_data(struct gb_session *session, const char *path, const char *told)
{
    if (*path == '\0') {
        gb_session_note(session, "measured data removed");
    } else if (*told == '\0') {
        gb_session_note(session, "loaded %s", path);
    } else {
        char *name = g_path_get_basename(path);
        char **clauses = g_strsplit(told, "; ", -1);
        for (size_t i = 0; clauses[i] != NULL; i++) {
            char **parts = g_strsplit(clauses[i], ", ", i == 0 ? -1 : 1);
            for (size_t k = 0; parts[k] != NULL; k++) {
                gb_session_note(session, "%s: %s", name, parts[k]);
            }
            g_strfreev(parts);
        }
        g_strfreev(clauses);
        g_free(name);
    }
}

/* Loads the data and switches to the view that shows them. */
static void load_data(struct gb_app *app, const char *path, const char *reading)
{
    struct gb_screen *screen = &app->screen;
    struct gb_session *session = &screen->session;
    struct gb_lab_report report;
    struct gb_error err = {0};
    const struct gb_chart_csv *chart = session->chart;
    switch (gb_session_load_data(session, path, reading, &report, &err)) {
    case GB_LAB_FAILED:
        gb_dialog_set_note(&screen->dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
        return;
    case GB_LAB_QUESTION:
        ask_reading(&screen->dialog, path, &report);
        return;
    case GB_LAB_READ:
        break;
    }
    note_data(session, path, report.told);
    gb_dialog_close(&screen->dialog);
    screen->plot.view =
        session->chart != chart ? gb_views_with(GB_VIEW_NEEDS_CHART) : gb_views_at(0);
    screen->focus = GB_PANE_PLOT;
}

void gb_file_commands_accept_data(struct gb_app *app)
{
    char *path = gb_prompt_complete_home(gb_dialog_answer(&app->screen.dialog));
    load_data(app, path, "");
    g_free(path);
}

void gb_file_commands_accept_reading(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    char *path = g_strdup(dialog->text);
    char *reading = g_strdup(gb_dialog_answer(dialog));
    load_data(app, path, reading);
    g_free(path);
    g_free(reading);
}

/* Directory of the run; NULL, with a message, if it is not stored. */
static const char *run_directory(struct gb_app *app)
{
    const struct gb_session *session = &app->screen.session;
    const char *directory =
        session->runner != NULL ? gb_runner_directory(session->runner) : NULL;
    if (directory == NULL) {
        gb_pane_commands_message(app, GB_STYLE_WARN, "no stored run yet: r starts one");
    }
    return directory;
}

/* A free path: directory, middle, number, end; g_free. */
static char *free_path(const char *directory, const char *middle, const char *end)
{
    char *path = NULL;
    for (int i = 1; path == NULL || g_file_test(path, G_FILE_TEST_EXISTS); i++) {
        g_free(path);
        path = g_strdup_printf("%s%s%d%s", directory, middle, i, end);
    }
    return path;
}

/* Starts a child command that creates the file `path`. */
static void make(struct gb_app *app, const char *name, const char *path,
                 const char *const *words, const char *started)
{
    struct gb_error err = {0};
    if (gb_job_start(&app->screen.session.child, name, path, GB_CHILD_COMMAND_SHORT,
                     words, &err)) {
        gb_pane_commands_message(app, GB_STYLE_PLAIN, started);
        app->screen.making = started;
    } else {
        gb_pane_commands_message(app, GB_STYLE_BAD, err.text);
    }
}

void gb_file_commands_picture(struct gb_app *app, const struct gb_key *key)
{
    const char *directory = run_directory(app);
    (void)key;
    if (directory != NULL) {
        char *path = free_path(directory, "/picture-", ".png");
        gb_dialog_show_picture(&app->screen.dialog, &gb_dialogs_picture, path);
        g_free(path);
    }
}

void gb_file_commands_accept_picture(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    const char *directory = run_directory(app);
    const char *words[4 + GB_PICTURE_FORM_WORDS + 1] = {"snapshot", directory, "-o"};
    char *path = gb_prompt_complete_home(gb_prompt_text(&dialog->picture.file));
    if (directory == NULL) {
        gb_dialog_close(dialog);
    } else if (*path == '\0' || g_file_test(path, G_FILE_TEST_EXISTS)) {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR,
                           *path == '\0' ? "file: a name that ends in .png%s"
                                         : "%s exists: expected a new name",
                           path);
        dialog->picture.row = GB_PICTURE_FORM_FILE;
    } else {
        words[3] = path;
        gb_dialog_words(&dialog->picture, words + 4);
        make(app, "picture", path, words, "rendering...");
        gb_dialog_close(dialog);
    }
    g_free(path);
}

void gb_file_commands_report(struct gb_app *app, const struct gb_key *key)
{
    const char *directory = run_directory(app);
    (void)key;
    if (directory != NULL) {
        char *path = free_path(directory, "-report-", "");
        const char *const words[] = {"report", directory, "-o", path, NULL};
        make(app, "report", path, words, "writing the report...");
        g_free(path);
    }
}

char *gb_file_commands_shell_text(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    return gb_previous_command(session->preset, gb_session_params(session), INT_MAX);
}

void gb_file_commands_shell(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    int rows = 0;
    int cols = 0;
    (void)key;
    gb_term_size(app->screen.term, &rows, &cols);
    char *text =
        gb_previous_command(session->preset, gb_session_params(session), cols - 1);
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_shell, text);
    g_free(text);
}
