#ifndef GB_IO_EXPORT_EXPORT_SERIES_H
#define GB_IO_EXPORT_EXPORT_SERIES_H

#include <stdint.h>

#include <glib.h>

#include "greenbody/status.h"

/* Several states in a format that has one: numbered files, and a list of them that
 * ParaView opens as one.  "run.vtkhdf" stands for run-0000.vtkhdf, run-0001.vtkhdf, ...
 * and run.vtkhdf.series. */

/* The name of a file, from 0; g_free. */
char *gb_export_series_name(const char *path, int64_t index);
/* The name of the list; g_free. */
char *gb_export_series_list_name(const char *path);

/* The list of files with the step of each in place of a time.  Errors: those of
 * gb_file_replace. */
bool gb_export_series_put_list(const char *path, const int64_t *steps, int64_t count,
                               struct gb_error *err);

#endif
