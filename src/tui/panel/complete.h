#ifndef GB_TUI_PANEL_COMPLETE_H
#define GB_TUI_PANEL_COMPLETE_H

/* Completes a path as a shell does: to the longest beginning that all fitting names
 * share; a folder ends with a slash, "~/" is the home.  *count (may be NULL) says how
 * many names fit.  g_free. */
char *gb_complete_path(const char *path, int *count);

/* "~/x" with the home in place; anything else as it is.  g_free. */
char *gb_complete_home(const char *path);

#endif
