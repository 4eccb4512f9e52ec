#ifndef GB_CLI_SCREEN_OPTIONS_H
#define GB_CLI_SCREEN_OPTIONS_H

#include <glib.h>

#include "tui/term/settings.h"

/* Options of the commands that open a screen. */
struct gb_screen_options {
    char *color, *theme, *graph, *images, *clipboard, *mouse; /* owned; NULL: not given */
    gboolean ascii, slow, diagnose;
};

/* Puts their entries into a command's list, from *entry on. */
enum { GB_SCREEN_OPTIONS_ENTRIES = 9 };
void gb_screen_options_entries(struct gb_screen_options *options, GOptionEntry *entry);

/* The settings of the file, overruled by the options. */
bool gb_screen_options_settings(const struct gb_screen_options *options,
                                struct gb_settings *settings, struct gb_error *err);
void gb_screen_options_finish(struct gb_screen_options *options);

/* Removes these options and --batch from the words of a command without a screen; returns
 * the number of words left. */
int gb_screen_options_drop(int argc, char **argv);

/* Whether `word` is among the words before a "--". */
bool gb_screen_options_has(int argc, char **argv, const char *word);

#endif
