#ifndef GB_CLI_LAB_INPUT_H
#define GB_CLI_LAB_INPUT_H

#include <glib.h>
#include <stdbool.h>

#include "base/table.h"
#include "greenbody/status.h"

/* Measured points for a command: the common options, the line on stderr about how a
 * file was read, and the question if it can be read in several ways. */
enum { GB_LAB_INPUT_KEYS = 8 };

struct gb_lab_input {
    char *columns, *series;
    char *value[GB_LAB_INPUT_KEYS];
};

/* The options of a command (`own` ends with a zeroed entry) followed by these; g_free. */
GOptionEntry *gb_lab_input_entries(struct gb_lab_input *input, const GOptionEntry *own);

/* Name of one of the options that were given; NULL: none. */
const char *gb_lab_input_given(const struct gb_lab_input *input);

/* Reads a file (io/lab/lab_reader.h, also for `also`). path NULL: *out is NULL, and
 * options are an error.  If the file is ambiguous, asks on a terminal; without one, the
 * error tells what to give.  Errors: GB_ERR_INPUT, GB_ERR_MACHINE, GB_ERR_MEMORY.  Free
 * *out with gb_table_destroy. */
bool gb_lab_input_read(struct gb_table **out, const struct gb_lab_input *input,
                       const char *path, const char *const *also, struct gb_error *err);

void gb_lab_input_finish(struct gb_lab_input *input); /* zeroed is fine */

/* Help text of these options. */
extern const char gb_lab_input_help[];

#endif
