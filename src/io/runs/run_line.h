#ifndef GB_IO_RUNS_RUN_LINE_H
#define GB_IO_RUNS_RUN_LINE_H

#include "io/runs/run_list.h"

/* A run of a list as a line: what stands behind its name, in columns. */

enum gb_run_line_extent {
    GB_RUN_LINE_ALL,  /* state, density, pressure, size, date */
    GB_RUN_LINE_BRIEF /* state, size, date */
};

/* g_free. */
char *gb_run_line_values(const struct gb_run_list_item *item,
                         enum gb_run_line_extent extent);
/* The head of these columns; g_free. */
char *gb_run_line_head(enum gb_run_line_extent extent);

/* "94.2 kB", with a plain blank; g_free. */
char *gb_run_line_size(int64_t bytes);

#endif
