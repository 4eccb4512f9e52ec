#ifndef GB_CLI_RUNS_FOLDERS_H
#define GB_CLI_RUNS_FOLDERS_H

#include <glib.h>

/* The runs (io/runs/run_list.h) below the folders named, or, where there are none, below that of
 * the workbench and `runs` in the working folder, in which `run` without --out keeps its
 * own; sorted.  g_ptr_array_unref. */
GPtrArray *gb_runs_folders_list(char **folders);

/* The same, those with an engine only. */
GPtrArray *gb_runs_folders_live(void);

/* Directory of a run of the workbench by its name, where nothing else has that name; else
 * the name.  g_free. */
char *gb_runs_folders_find(const char *name);

/* The default folders as text: "DIR and runs".  g_free. */
char *gb_runs_folders_text(void);

#endif
