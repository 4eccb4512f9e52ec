#ifndef GB_CLI_OPTIONS_H
#define GB_CLI_OPTIONS_H

#include <stdbool.h>

#include <glib.h>

#include "greenbody/status.h"
#include "io/preset.h"
#include "scene/field/keep_points.h"

/* Help page of a command. */
struct gb_options_page {
    const char *usage;       /* words after the options: "PRESET [group.key=value]..." */
    const char *summary;     /* first lines */
    const char *description; /* last lines; may be NULL */
};

/* Reads the options of a command (entries end with a zeroed one) and returns the
 * remaining words (*words, g_strfreev).  False when the command ends here: --help was
 * printed or a word completed (*status 0), or the error of an option (*status 2). */
bool gb_options_parse(const struct gb_options_page *page, const GOptionEntry *entries,
                      int argc, char **argv, char ***words, int *status);

/* The entry of --set. */
GOptionEntry gb_options_set(char ***sets);
/* The entry of --quiet, of commands with progress on stderr. */
GOptionEntry gb_options_quiet(gboolean *quiet);

/* The entry of --json, of commands whose result other programs read. */
GOptionEntry gb_options_json(gboolean *json);

enum gb_options_preset {
    GB_OPTIONS_PRESET_OPTIONAL, /* all defaults where no word names a preset */
    GB_OPTIONS_PRESET_NEEDED
};

/* The preset that the words name, or the one stored in a picture of this program (a word
 * ending in .png); then the assignments among the words and the values of --set.  sets may
 * be NULL.  The caller destroys *out. */
bool gb_options_preset(struct gb_preset **out, char **words, char **sets,
                       enum gb_options_preset need, struct gb_error *err);

/* The same, checked as a scene. */
bool gb_options_scene(struct gb_preset **out, char **words, char **sets,
                      enum gb_options_preset need, struct gb_error *err);

/* Points of --at (NULL: none), in the form of output.snapshots_at; "p=" before a pressure is
 * accepted.  Errors: GB_ERR_INPUT. */
bool gb_options_points(struct gb_keep_points *points, const char *at,
                       struct gb_error *err);

/* The only word of a command that takes one run directory; NULL after an error. */
const char *gb_options_directory(char **words, const char *command, struct gb_error *err);

/* The command as typed, quoted for a shell, in one line behind a head; g_free. */
char *gb_options_command(const char *head, int argc, char **argv);

/* Writes "greenbody: text" to stderr and returns the exit status.  Silent for GB_OK: the
 * reader of a pipe has closed it. */
int gb_options_fail(const struct gb_error *err);

/* Prints a text on stdout and frees it.  Errors: of gb_options_output_failed. */
bool gb_options_print(GString *text, struct gb_error *err);

/* Call when writing to stdout failed, before errno changes.  Returns false. */
bool gb_options_output_failed(struct gb_error *err);

#endif
