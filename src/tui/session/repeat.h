#ifndef GB_TUI_SESSION_REPEAT_H
#define GB_TUI_SESSION_REPEAT_H

#include "io/preset.h"

/* The shell command that runs what is on the screen: the preset by name or path, and
 * every value that is not the file's.
 *
 * params  as run
 * cols    longer lines are broken behind a blank, with a backslash
 * g_free. */
char *gb_repeat_command(const struct gb_preset *preset, const struct gb_params *params,
                        int cols);

#endif
