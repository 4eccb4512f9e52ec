#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "io/store.h"
#include "many/sweep/param_sweep.h"
#include "study/calibrate/calibration.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/session/run_lifecycle.h"
#include "tui/view/views.h"

/* Replicas of the scene shown, its calibration to the measured data, moduli of the run: the
 * commands `sweep`, `calibrate` and `moduli` as child processes. */

/* P1 averages ten cells; a standard error of 0.002 separates two powders of one study. */
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
        gb_screen_commands_message(
            app, GB_STYLE_WARN, "a calibration needs measured data: e loads a CSV file");
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_calibrate, default_keys);
}

/* The view of the moduli opens; where it is shown, a second key stops the measurement. */
void gb_job_commands_moduli(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    struct gb_error err = {0};
    (void)key;
    if (gb_moduli_job_runs(&session->moduli, &session->child)) {
        gb_moduli_job_stop(&session->moduli, &session->child);
        gb_screen_commands_message(app, GB_STYLE_PLAIN, "the measurement is stopped");
        return;
    }
    if (!gb_moduli_job_start(&session->moduli, session->runner,
                             gb_session_run_is_live(session), &session->child, &err)) {
        gb_screen_commands_message(app, GB_STYLE_WARN, err.text);
        return;
    }
    app->screen.plot.view = gb_views_find("S");
    gb_screen_commands_message(app, GB_STYLE_PLAIN,
                               "measuring the stored states; Y again stops");
}

/* The parameters shown as a preset file DIRECTORY/scene.ini (g_free). */
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

/* A new directory beside those of the runs: "default-replicas-1".  g_free. */
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

/* Indices of words of the child command. */
enum { SCENE = 1, DIRECTORY = 3 };

bool gb_job_commands_start(struct gb_app *app, const char *name,
                           enum gb_child_command_kind kind, const char **words)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    char *directory = new_directory(session, name);
    char *scene = write_scene(session, directory, &err);
    words[SCENE] = scene;
    words[DIRECTORY] = directory;
    const bool started =
        scene != NULL &&
        gb_child_command_start(&session->child, name, directory, kind, words, &err);
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

/* "0.002@100MPa"; NULL or blank: none. */
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
        if (gb_job_commands_start(app, "replicas", GB_CHILD_COMMAND_LONG, words)) {
            gb_replica_band_follow(band, session->child.path, gb_session_params(session));
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
    if (!gb_calibration_keys(&parsed, gb_dialog_answer(dialog), gb_session_params(session),
                            &err)) {
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
    if (gb_job_commands_start(app, "calibration", GB_CHILD_COMMAND_LONG, words)) {
        gb_screen_commands_message(app, GB_STYLE_PLAIN,
                                   "calibration started: progress among the events");
    }
    g_free(keys);
}
