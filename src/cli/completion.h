#ifndef GB_CLI_COMPLETION_H
#define GB_CLI_COMPLETION_H

#include <glib.h>
#include <stdbool.h>

#include "cli/options.h"

/* Completion of a command line: the scripts of bash, zsh and fish (src/cli/completions) hand
 * the words over as `greenbody --complete WORD... PREFIX` and get a line "candidate TAB
 * description" for each continuation of PREFIX.  A candidate that ends in one of = / . , ;
 * is the beginning of a word.  Nothing is listed twice: options come from the table of the
 * command, positions from its usage line, keys, units and choices from the field table. */

/* The first word of the hidden command line. */
#define GB_COMPLETION_WORD "--complete"

/* Is this a request for the completion of a command's own words? */
bool gb_completion_requested(int argc, char **argv);

/* argv is COMMAND --complete WORD... PREFIX. */
void gb_completion_command(const struct gb_options_page *page,
                           const GOptionEntry *entries, int argc, char **argv);

/* First word of the command line: commands, presets, options of the program. */
void gb_completion_first(const char *prefix);

#endif
