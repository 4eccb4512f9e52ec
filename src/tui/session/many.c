#include "tui/session/many.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "io/store.h"
#include "tui/app/asks.h"

/* P1 averages ten cells; at 0.002 two powders of one experiment are told apart. */
static const char default_cells[] = "10 0.002@100MPa";
static const char default_keys[] = "contact.mu,contact.alpha";

enum { REPLICAS_MAX = 1000 };

void gb_many_ask_cells(struct gb_app *app)
{
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_CELLS, default_cells);
}

void gb_many_ask_fit(struct gb_app *app)
{
    const struct gb_measured *measured = app->screen.session.measured;
    if (measured == NULL) {
        gb_asks_tell(app, GB_STYLE_WARN,
                     "a fit needs an experiment over the plot: e loads one");
        return;
    }
    gb_dialog_show(&app->screen.dialog, GB_DIALOG_FIT, default_keys);
}

/* The parameters shown as a preset of their own, DIRECTORY/scene.ini (g_free). */
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
        gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made", directory);
    } else {
        path = g_build_filename(directory, "scene.ini", NULL);
        if (!gb_preset_save(preset, path, true, err)) {
            g_clear_pointer(&path, g_free);
        }
    }
    gb_preset_destroy(preset);
    return path;
}

/* Beside the directories of the runs: "default-cells-1". */
static char *new_directory(const struct gb_session *session, const char *what)
{
    const char *path = gb_preset_path(session->preset);
    char *base = g_path_get_basename(*path != '\0' ? path : "default.ini");
    if (g_str_has_suffix(base, ".ini")) {
        base[strlen(base) - strlen(".ini")] = '\0';
    }
    char *name = g_strdup_printf("%s-%s", base, what);
    char *folder = session->folder != NULL
                       ? g_strdup(session->folder)
                       : g_build_filename(g_get_tmp_dir(), "greenbody", NULL);
    char *directory = gb_store_new_directory(folder, name);
    g_free(folder);
    g_free(name);
    g_free(base);
    return directory;
}

enum { SCENE = 1, DIRECTORY = 3 };

/* Fills in the words of the scene and the directory.  cells: their mean is shown.  True:
 * the dialog is done with. */
static bool begin(struct gb_app *app, const char *what, const char **words, bool cells)
{
    struct gb_session *session = &app->screen.session;
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_error err = {0};
    char *directory = new_directory(session, what);
    char *scene = write_scene(session, directory, &err);
    words[SCENE] = scene;
    words[DIRECTORY] = directory;
    const bool begun =
        scene != NULL &&
        gb_child_command_start(&session->child, what, directory, true, words, &err);
    if (begun) {
        gb_session_note(session, "%s: computed in %s", what, directory);
        if (cells) {
            gb_replica_band_follow(&session->band, directory, gb_session_params(session));
        }
        gb_dialog_close(dialog);
    } else {
        g_strlcpy(dialog->note, err.text, sizeof dialog->note);
    }
    g_free(scene);
    g_free(directory);
    return begun;
}

void gb_many_cells(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    char **parts = g_strsplit(g_strstrip((char *)gb_dialog_answer(dialog)), " ", 2);
    guint64 cells = 0;
    if (parts[0] == NULL ||
        !g_ascii_string_to_unsigned(parts[0], 10, 2, REPLICAS_MAX, &cells, NULL)) {
        snprintf(dialog->note, sizeof dialog->note,
                 "accepted: 2 to %d cells, and SE@PRESSURE if they shall end earlier",
                 REPLICAS_MAX);
    } else {
        const bool target = parts[1] != NULL && *g_strstrip(parts[1]) != '\0';
        const char *words[] = {"sweep",
                               NULL,
                               "-o",
                               NULL,
                               "--replicas",
                               parts[0],
                               target ? "--until-se" : NULL,
                               target ? parts[1] : NULL,
                               NULL};
        begin(app, "cells", words, true);
    }
    g_strfreev(parts);
}

void gb_many_fit(struct gb_app *app)
{
    const struct gb_session *session = &app->screen.session;
    if (session->measured == NULL) { /* taken away behind the dialog */
        gb_dialog_close(&app->screen.dialog);
        return;
    }
    char *keys = g_strdup(gb_dialog_answer(&app->screen.dialog));
    const char *words[] = {"calibrate", NULL,     "-o",
                           NULL,        "--data", session->measured->path,
                           "--free",    keys,     NULL};
    if (begin(app, "calibration", words, false)) {
        gb_asks_tell(app, GB_STYLE_PLAIN, "the events say how far it is");
    }
    g_free(keys);
}
