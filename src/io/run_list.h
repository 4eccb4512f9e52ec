#ifndef GB_IO_RUN_LIST_H
#define GB_IO_RUN_LIST_H

#include <glib.h>
#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"

/* The runs below a folder, as recorded in their directories. */

enum gb_run_list_engine {
    GB_RUN_LIST_NONE,    /* no process computes the run */
    GB_RUN_LIST_LIVE,    /* a process with a terminal */
    GB_RUN_LIST_DETACHED /* a process without: closed terminal, or batch job */
};

struct gb_run_list_item {
    char *directory;
    char *name; /* path below the folder */
    char *title;
    const char *state; /* word of status.json; "interrupted": killed engine;
                        * "unreadable" */
    enum gb_run_list_engine engine;
    double density, pressure_pa; /* of the last point; NaN: none yet */
    double progress;             /* 0..1 */
    int64_t bytes;               /* on the disk */
    int64_t modified_s;          /* last change of its status, s since 1970 */
};

/* Adds the runs below a folder, at most GB_RUN_LIST_DEPTH levels deep, including runs
 * of sets.  A missing folder adds nothing. list: made by gb_run_list_new, of struct
 * gb_run_list_item. */
enum { GB_RUN_LIST_DEPTH = 3 };
GPtrArray *gb_run_list_new(void); /* g_ptr_array_unref frees all */
void gb_run_list_add(GPtrArray *list, const char *folder);

/* Runs with an engine first, then the newest. */
void gb_run_list_sort(GPtrArray *list);

/* "live", "detached", "none". */
const char *gb_run_list_engine_word(enum gb_run_list_engine engine);

/* Bytes on disk of a directory tree; symbolic links are not followed. */
int64_t gb_run_list_bytes(const char *path);

/* Number of files in a directory tree; symbolic links are not followed. */
int gb_run_list_count_files(const char *directory);

/* Removes the directory of a run with all its contents, under the lock of the run, so
 * never while a process computes it.  Symbolic links are removed, not followed.
 *
 * Errors: GB_ERR_INPUT (not a run directory, an active run), GB_ERR_MACHINE. */
bool gb_run_list_delete(const char *directory, struct gb_error *err);

enum gb_run_list_extent {
    GB_RUN_LIST_LINE_ALL,  /* state, density, pressure, size, date */
    GB_RUN_LIST_LINE_BRIEF /* state, size, date */
};

/* One line of text for a run; g_free. */
char *gb_run_list_line(const struct gb_run_list_item *item,
                       enum gb_run_list_extent extent);

/* The line of column heads; g_free. */
char *gb_run_list_line_head(enum gb_run_list_extent extent);

/* "94.2 kB", with an ordinary blank; g_free. */
char *gb_run_list_size_text(int64_t bytes);

/* Density and pressure (Pa) of the last complete row of DIRECTORY/curve.csv.  It reads
 * only the beginning and the end of the file, so long runs take no longer.  False:
 * there is no row. */
bool gb_run_list_last_point(const char *directory, double *density, double *pressure_pa);

#endif
