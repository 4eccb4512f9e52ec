#include "cli/compact_options.h"

#include <stdio.h>
#include <string.h>

#include "base/text/visible.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "many/launch.h"

enum { JOBS_MAX = 4096 };

void gb_compact_options_entries(struct gb_compact_options *options, GOptionEntry *entry)
{
    const GOptionEntry own[GB_COMPACT_OPTIONS_ENTRIES] = {
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &options->directory,
         "directory of the results", "DIR"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &options->at,
         "compacts: pressures or densities of pressing", "'100 MPa; density = 0.5'"},
        {"density", 0, 0, G_OPTION_ARG_STRING, &options->density,
         "compacts by density alone", "'0.5; 0.55'"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &options->replicas,
         "cells, from structure.seed on", "N"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &options->jobs,
         "cells at once (one per processor)", "N"},
        gb_options_quiet(&options->quiet)};
    memcpy(entry, own, sizeof own);
}

/* "0.4;0.5" as "density = 0.4; density = 0.5". */
static char *densities(const char *text)
{
    char **parts = g_strsplit_set(text, ";,", -1);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; parts[i] != NULL; i++) {
        if (*g_strstrip(parts[i]) != '\0') {
            g_string_append_printf(all, "%sdensity = %s", all->len > 0 ? "; " : "",
                                   parts[i]);
        }
    }
    g_strfreev(parts);
    return g_string_free(all, FALSE);
}

static bool read_marks(const struct gb_compact_options *options,
                       struct gb_keep_points *marks, struct gb_error *err)
{
    struct gb_error why = {0};
    if (options->at != NULL && options->density != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at and --density: expected one of them");
    }
    if (options->at == NULL && options->density == NULL) {
        return true;
    }
    char *text =
        options->at != NULL ? g_strdup(options->at) : densities(options->density);
    const bool good = gb_keep_points_parse(text, marks, &why);
    g_free(text);
    return good || gb_error_set(err, GB_ERR_INPUT, "--%s: %.300s",
                                options->at != NULL ? "at" : "density", why.text);
}

static void on_progress(void *data, const struct gb_cells_item *cell, size_t done,
                        size_t total)
{
    struct gb_compact_options *options = data;
    if (cell->error.code != GB_OK && cell->error.code != GB_ERR_CANCELLED) {
        gb_progress_say(&options->progress, "%zu of %zu  %s: %s", done, total, cell->name,
                        cell->error.text);
    } else {
        gb_progress_say(&options->progress, "%zu of %zu  %s", done, total, cell->name);
    }
}

static void on_wait(void *data, const struct gb_cells_item *cell, const char *holder)
{
    struct gb_compact_options *options = data;
    if (!options->quiet) {
        gb_visible_line(stderr, "waiting for cells/%s: %s works on it", cell->name,
                        holder);
    }
}

bool gb_compact_options_begin(struct gb_compact_options *options, char **words,
                              char **sets, struct gb_keep_points *marks,
                              struct gb_error *err)
{
    if (options->directory == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "needs --out DIR, a directory of results");
    }
    if (options->jobs < 0 || options->jobs > JOBS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--jobs %d: must be between 1 and %d, or 0 for all",
                            options->jobs, JOBS_MAX);
    }
    if (!read_marks(options, marks, err) ||
        !gb_options_scene(&options->preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err)) {
        return false;
    }
    gb_progress_init(&options->progress, options->quiet || gb_launch_read().rank > 0);
    gb_signals_install(GB_SIGNALS_HANGUP_ENDS);
    options->callbacks =
        (struct gb_cells_callbacks){gb_signals_cancelled, on_progress, on_wait, options};
    return true;
}

bool gb_compact_options_keep_preset(struct gb_compact_options *options,
                                    struct gb_error *err)
{
    char *path = g_build_filename(options->directory, "scene.ini", NULL);
    const bool good = gb_preset_save(options->preset, path, GB_PRESET_ALL_KEYS, err);
    g_free(path);
    return good;
}

void gb_compact_options_finish(struct gb_compact_options *options)
{
    gb_preset_destroy(options->preset);
    g_free(options->directory);
    g_free(options->at);
    g_free(options->density);
    g_free(options->command);
}
