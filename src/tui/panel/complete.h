#ifndef GB_TUI_PANEL_COMPLETE_H
#define GB_TUI_PANEL_COMPLETE_H

/* Completes a path as a shell does: to the longest common prefix of all matching names; a
 * folder ends with a slash, "~/" is the home directory.  *count (may be NULL) receives
 * the number of matches.  g_free. */
char *gb_complete_path(const char *path, int *count);

/* "~/x" with the home directory inserted; other paths unchanged.  g_free. */
char *gb_complete_home(const char *path);

#endif
