#ifndef GB_TUI_SESSION_USER_PRESETS_H
#define GB_TUI_SESSION_USER_PRESETS_H

#include "io/preset.h"

/* Where presets of the user are kept. */

/* A name to save a preset under: its own when it is the user's, else "my-" and its own,
 * so that a shipped preset is not hidden by accident.  g_free. */
char *gb_user_presets_suggest(const struct gb_preset *preset);

/* Path of a name among the user's presets (the folder is made), or the name itself when
 * it has a slash.  NULL and GB_ERR_INPUT when it cannot be a name.  g_free. */
char *gb_user_presets_file(const char *name, struct gb_error *err);

#endif
