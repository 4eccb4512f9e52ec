#ifndef GB_CLI_OPTIONS_H
#define GB_CLI_OPTIONS_H

#include <stdbool.h>

#include <glib.h>

#include "greenbody/status.h"
#include "io/preset.h"

/* Help page of a command. */
struct gb_options_page {
    const char *usage;       /* words after the options: "PRESET [group.key=value]..." */
    const char *summary;     /* first lines */
    const char *description; /* last lines; may be NULL */
};

/* Reads a command's options (entries end with a zeroed one) and gives the words left over
 * (*words, g_strfreev).  False when the command is over: --help was printed (*status 0),
 * or a line about a bad option (*status 2). */
bool gb_options_parse(const struct gb_options_page *page, const GOptionEntry *entries,
                      int argc, char **argv, char ***words, int *status);

/* The entry of --set, to be put into a command's list. */
#define GB_OPTIONS_SET(target)                                                           \
    {                                                                                    \
        "set", 0, 0, G_OPTION_ARG_STRING_ARRAY, (target),                                \
            "give a parameter another value; may be repeated", "group.key=value"         \
    }

/* Keys of a command: the preset named by the words, or the one inside a picture that
 * greenbody wrote, a word ending in .png (no word without '=': all defaults, unless
 * needed), then the words that contain '=' and the values of --set.  sets may be
 * NULL.  The caller destroys *out. */
bool gb_options_preset(struct gb_preset **out, char **words, char **sets, bool needed,
                       struct gb_error *err);

/* The same, checked as a scene. */
bool gb_options_scene(struct gb_preset **out, char **words, char **sets, bool needed,
                      struct gb_error *err);

/* Writes "greenbody: text" to stderr and returns the exit status.  Silent for GB_OK: the
 * reader of a pipe went away. */
int gb_options_fail(const struct gb_error *err);

/* Call when writing to stdout failed, before errno changes.  Returns false. */
bool gb_options_output_failed(struct gb_error *err);

#endif
