#ifndef GB_CLI_OPTIONS_H
#define GB_CLI_OPTIONS_H

#include <glib.h>
#include <json-glib/json-glib.h>
#include <stdbool.h>

#include "greenbody/status.h"
#include "io/preset.h"
#include "run/run_loop.h"
#include "scene/field/keep_points.h"
#include "tui/term/settings.h"

/* Options of the commands that open a screen. */
struct gb_screen_options {
    char *color, *theme, *graph, *images, *clipboard, *mouse; /* owned; NULL: not given */
    gboolean ascii, slow, diagnose;
};

/* Adds these options to a command's entries, beginning at *entry. */
enum { GB_SCREEN_OPTIONS_ENTRIES = 9 };

void gb_options_screen_entries(struct gb_screen_options *options, GOptionEntry *entry);

/* The settings from the file, with the options taking precedence. */
bool gb_options_screen_settings(const struct gb_screen_options *options,
                                struct gb_settings *settings, struct gb_error *err);

void gb_options_screen_finish(struct gb_screen_options *options);

/* Removes these options and --batch from the words of a command without a screen.
 * Returns the number of remaining words. */
int gb_options_screen_drop(int argc, char **argv);

/* Is `word` among the words before a "--"? */
bool gb_options_has(int argc, char **argv, const char *word);

/* Options for the size of pictures and figures: pixels, or a width in print. */
struct gb_page_options {
    char *size, *width; /* NULL: not given; owned */
    int per_inch;       /* 0: not given */
};

#define GB_PAGE_OPTIONS_ENTRIES(options)                                                 \
    {"size",        0, 0, G_OPTION_ARG_STRING, &(options)->size, "pixels (1600x1200)",   \
     "WIDTHxHEIGHT"},                                                                    \
        {"width",                                                                        \
         0,                                                                              \
         0,                                                                              \
         G_OPTION_ARG_STRING,                                                            \
         &(options)->width,                                                              \
         "in print, as in 8cm, 80mm or a journal's column, as elsevier: letters of 6 "   \
         "to 9 points there",                                                            \
         "WIDTH"},                                                                       \
    {                                                                                    \
        "dpi", 0, 0, G_OPTION_ARG_INT, &(options)->per_inch,                             \
            "pixels per inch of print, with --width (300)", "N"                          \
    }

/* Sets pixels and pixels per inch from the options that were given.  Errors:
 * GB_ERR_INPUT with what is expected. */
bool gb_options_page_take(const struct gb_page_options *options, int *width, int *height,
                          int *per_inch, struct gb_error *err);

/* Column widths of journals for the help of a command, with a heading; g_free. */
char *gb_options_page_journals(void);

void gb_options_page_finish(struct gb_page_options *options);

/* For a list {name: [...]}: add the elements to the builder between the two calls.  The
 * second prints and frees it. */
JsonBuilder *gb_options_json_begin(const char *name);

void gb_options_json_end(JsonBuilder *json);

/* Prints the result of a run: the object of its status.json with "directory". */
void gb_options_json_run(const struct gb_run_loop *loop);

/* Help page of a command. */
struct gb_options_page {
    const char *usage;       /* words after the options: "PRESET [group.key=value]..." */
    const char *summary;     /* first lines */
    const char *description; /* last lines; may be NULL */
};

/* Reads the options of a command (entries end with a zeroed one) and returns the
 * remaining words (*words, g_strfreev).  False if the command ends here: after --help
 * or a completion (*status 0), or after an error in an option (*status 2). */
bool gb_options_parse(const struct gb_options_page *page, const GOptionEntry *entries,
                      int argc, char **argv, char ***words, int *status);

/* The entry of --set. */
GOptionEntry gb_options_set(char ***sets);
/* The entry of --quiet, for commands with progress on stderr. */
GOptionEntry gb_options_quiet(gboolean *quiet);

/* The entry of --json, for commands with results for other programs. */
GOptionEntry gb_options_json(gboolean *json);

enum gb_options_preset {
    GB_OPTIONS_PRESET_OPTIONAL, /* all defaults if no word names a preset */
    GB_OPTIONS_PRESET_NEEDED
};

/* Reads the preset that the words name, or the preset stored in a picture of this
 * program (a word ending in .png).  Then applies the assignments among the words and
 * the values of --set; sets may be NULL.  The caller destroys *out. */
bool gb_options_preset(struct gb_preset **out, char **words, char **sets,
                       enum gb_options_preset need, struct gb_error *err);

/* The same, and checks it as a scene. */
bool gb_options_scene(struct gb_preset **out, char **words, char **sets,
                      enum gb_options_preset need, struct gb_error *err);

/* Points of --at (NULL: none) in the form of output.snapshots_at; "p=" before a
 * pressure is allowed.  Errors: GB_ERR_INPUT. */
bool gb_options_points(struct gb_keep_points *points, const char *at,
                       struct gb_error *err);

/* The only word of a command that takes one run directory; NULL after an error. */
const char *gb_options_directory(char **words, const char *command, struct gb_error *err);

/* The command as typed, quoted for a shell, on one line after a head; g_free. */
char *gb_options_command(const char *head, int argc, char **argv);

/* Writes "greenbody: text" to stderr and returns the exit status.  Silent for GB_OK,
 * when the reader of a pipe has closed it. */
int gb_options_fail(const struct gb_error *err);

/* Prints a text on stdout and frees it.  Errors: see gb_options_output_failed. */
bool gb_options_print(GString *text, struct gb_error *err);

/* Call this when writing to stdout failed, before errno changes.  Returns false. */
bool gb_options_output_failed(struct gb_error *err);

#endif
