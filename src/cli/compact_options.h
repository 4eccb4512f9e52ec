#ifndef GB_CLI_COMPACT_OPTIONS_H
#define GB_CLI_COMPACT_OPTIONS_H

#include <glib.h>
#include <stdbool.h>

#include "cli/progress.h"
#include "io/preset.h"
#include "scene/field/keep_points.h"
#include "study/compact/cells.h"

/* What the commands on compacts (yield, strength) have in common: options, preset, progress
 * of the cells on stderr, signals. */
struct gb_compact_options {
    char *directory, *at, *density;
    int replicas, jobs;
    gboolean quiet;
    char *command; /* as typed */
    struct gb_preset *preset;
    struct gb_progress progress;
    struct gb_cells_callbacks callbacks; /* of the study */
};

enum { GB_COMPACT_OPTIONS_ENTRIES = 6 };

/* Fills entry[GB_COMPACT_OPTIONS_ENTRIES]. */
void gb_compact_options_entries(struct gb_compact_options *options, GOptionEntry *entry);

/* Checks --out and --jobs, reads the preset of the words and the marks (untouched where
 * neither --at nor --density is given), and installs the signals. */
bool gb_compact_options_begin(struct gb_compact_options *options, char **words,
                              char **sets, struct gb_keep_points *marks,
                              struct gb_error *err);
/* Writes scene.ini into the directory: preset.ini is the mark of a single run, in which many
 * cells are refused. */
bool gb_compact_options_keep_preset(struct gb_compact_options *options,
                                    struct gb_error *err);
void gb_compact_options_finish(struct gb_compact_options *options);

#endif
