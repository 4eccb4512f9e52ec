#ifndef GB_CLI_COMPLETION_H
#define GB_CLI_COMPLETION_H

#include <glib.h>
#include <stdbool.h>

#include "cli/options.h"

/* Completion of a command line.  The scripts of bash, zsh and fish
 * (src/cli/completions) call `greenbody --complete WORD...  PREFIX` and get a line
 * "candidate TAB description" for each continuation of PREFIX.  A candidate that ends
 * in one of = / . , ; is only the beginning of a word.  Everything comes from existing
 * tables: options from the command, positions from its usage line, keys, units and
 * choices from the field table. */

/* The first word of the hidden command line. */
#define GB_COMPLETION_WORD "--complete"

/* Does the command line ask for a completion of a command's own words? */
bool gb_completion_requested(int argc, char **argv);

/* argv is COMMAND --complete WORD... PREFIX. */
void gb_completion_command(const struct gb_options_page *page,
                           const GOptionEntry *entries, int argc, char **argv);

/* Completes the first word: commands, presets, options of the program. */
void gb_completion_first(const char *prefix);

#endif
