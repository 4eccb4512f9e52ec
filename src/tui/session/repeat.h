#ifndef GB_TUI_SESSION_REPEAT_H
#define GB_TUI_SESSION_REPEAT_H

#include "io/preset.h"

/* The shell command that runs the parameters on screen: the preset by name or path, and
 * every value that differs from the file.
 *
 * params  the parameters on screen
 * cols    longer lines are broken at a blank, with a backslash
 *
 * g_free. */
char *gb_repeat_command(const struct gb_preset *preset, const struct gb_params *params,
                        int cols);

#endif
