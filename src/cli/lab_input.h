#ifndef GB_CLI_LAB_INPUT_H
#define GB_CLI_LAB_INPUT_H

#include <glib.h>
#include <stdbool.h>

#include "base/table.h"
#include "greenbody/status.h"

/* Measured points for a command: the options of all commands that take them, the line on
 * stderr that says how a file was read, and the question where it can be read in several
 * ways. */
enum { GB_LAB_INPUT_KEYS = 8 };

struct gb_lab_input {
    char *columns, *series;
    char *value[GB_LAB_INPUT_KEYS];
};

/* The options of a command (`own` ends with a zeroed one) and these behind them; g_free. */
GOptionEntry *gb_lab_input_entries(struct gb_lab_input *input, const GOptionEntry *own);

/* One of the options that were given; NULL: none. */
const char *gb_lab_input_given(const struct gb_lab_input *input);

/* Reads a file (io/lab/lab_reader.h; `also` as there); path NULL: *out is NULL, and options
 * are an error.  A question is asked on a terminal;
 * without one it is an error that says what to give.  Errors: GB_ERR_INPUT, GB_ERR_MACHINE,
 * GB_ERR_MEMORY.  *out is for gb_table_destroy. */
bool gb_lab_input_read(struct gb_table **out, const struct gb_lab_input *input,
                       const char *path, const char *const *also, struct gb_error *err);

void gb_lab_input_finish(struct gb_lab_input *input); /* zeroed is fine */

/* For the help of these commands. */
extern const char gb_lab_input_help[];

#endif
