#ifndef GB_CLI_JSON_OUTPUT_H
#define GB_CLI_JSON_OUTPUT_H

#include <json-glib/json-glib.h>

#include "run/run_loop.h"

/* What --json prints: one object on one or more lines, ended by a newline. */

/* Of a list: {name: [...]}.  Between both the elements are added to the builder, which the
 * second prints and frees. */
JsonBuilder *gb_json_output_begin(const char *name);
void gb_json_output_end(JsonBuilder *json);

/* Of a run that has ended: the object of its status.json, with "directory". */
void gb_json_output_run(const struct gb_run_loop *loop);

#endif
