#ifndef GB_CLI_RUNS_OUTPUT_H
#define GB_CLI_RUNS_OUTPUT_H

#include <glib.h>

/* A list of runs (io/runs/run_list.h) on stdout: a line each below a head, or with --json an
 * object {"runs": [{...}, ...]}, in which what is not there is null. */
void gb_runs_output_table(const GPtrArray *list);
void gb_runs_output_json(const GPtrArray *list);

#endif
