#ifndef GB_IO_STATUS_JSON_H
#define GB_IO_STATUS_JSON_H

#include "greenbody/snapshot.h"

/* Text of status.json; g_free.
 *
 * points   recorded so far */
char *gb_status_json_text(const struct gb_snapshot *snapshot, int64_t points);

/* State of a run by its word in status.json; stopped for other words. */
enum gb_run_state gb_status_json_state(const char *word);

#endif
