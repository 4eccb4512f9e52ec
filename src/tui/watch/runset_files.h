#ifndef GB_TUI_WATCH_RUNSET_FILES_H
#define GB_TUI_WATCH_RUNSET_FILES_H

#include <glib.h>
#include <stdbool.h>

/* Files of a directory of many runs. */

/* Whether a directory, or its folder `runs`, contains runs and is no run itself. */
bool gb_runset_files_any(const char *directory);

/* Paths of the run directories in a directory, or in its folder `runs` (calibrations), by
 * name.  g_ptr_array_free. */
GPtrArray *gb_runset_files_list(const char *directory);

/* Lines of the result and of the rounds of a calibration; NULL for other directories.
 * g_strfreev. */
char **gb_runset_files_fit(const char *directory);

/* Pressures at which the table of a sweep is read on loading, Pa; returns their number, at
 * most `most`; 0 without a table. */
size_t gb_runset_files_pressures(const char *directory, double *pa, size_t most);

#endif
