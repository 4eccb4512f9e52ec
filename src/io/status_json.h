#ifndef GB_IO_STATUS_JSON_H
#define GB_IO_STATUS_JSON_H

#include <json-glib/json-glib.h>
#include <stddef.h>

#include "greenbody/snapshot.h"
#include "greenbody/stage.h"
#include "greenbody/status.h"

/* Prints a tree, indented; g_free.  Every number is valid JSON, whereas json-glib alone
 * writes 1e-08 as "1e-08.0". */
char *gb_status_json_print(JsonNode *root);

/* Text of status.json; g_free.
 *
 * points   recorded so far */
char *gb_status_json_text(const struct gb_snapshot *snapshot, int64_t points);

/* Reads a status.json with limits, since the file is not trusted: at most a megabyte,
 * an object, and no deeper brackets than a status has (json-glib recurses for each).
 * g_object_unref.  NULL and err: GB_ERR_INPUT with path and reason, GB_ERR_MACHINE,
 * GB_ERR_MEMORY. */
JsonParser *gb_status_json_open(const char *path, struct gb_error *err);

/* Is the run of this status.json done? */
bool gb_status_json_is_done(const char *path);

/* The word of a state in status.json: "running", "done", ... */
const char *gb_status_json_word(enum gb_run_state state);
/* State of a run from its word in status.json; GB_RUN_STOPPED for unknown words. */
enum gb_run_state gb_status_json_state(const char *word);

/* "filling", "coming to rest", ...; "" without a stage.  Settling has the same word
 * under both gravities. */
const char *gb_status_json_stage_name(enum gb_stage stage);

/* The first stage with this name, and the measure with this quantity; none if unknown. */
enum gb_stage gb_status_json_stage_find(const char *name);

enum gb_stage_measure gb_status_json_stage_quantity(const char *quantity);

/* "812 of 1751", "35 x limit", "12.3 MPa of 50 MPa"; "" without a measure.  Returns
 * text. */
char *gb_status_json_stage_value(const struct gb_stage_report *report, char *text,
                                 size_t size);

/* "filling: particles poured 812 of 1751", "pressing: 12.3 MPa of 50 MPa".  Returns
 * text. */
char *gb_status_json_stage_line(const struct gb_stage_report *report, char *text,
                                size_t size);

#endif
