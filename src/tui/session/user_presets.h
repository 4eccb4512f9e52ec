#ifndef GB_TUI_SESSION_USER_PRESETS_H
#define GB_TUI_SESSION_USER_PRESETS_H

#include "io/preset.h"

/* The user's presets. */

/* Suggested name for saving a preset: its own for a preset of the user, otherwise with
 * the prefix "my-", so that an installed preset is not hidden by accident.  g_free. */
char *gb_user_presets_suggest(const struct gb_preset *preset);

/* Path of a name in the folder of the user's presets, which is created, or the name
 * itself if it has a slash.  NULL and GB_ERR_INPUT for an invalid name.  g_free. */
char *gb_user_presets_file(const char *name, struct gb_error *err);

#endif
