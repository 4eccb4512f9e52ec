#ifndef GB_CLI_LAW_LAW_ROWS_H
#define GB_CLI_LAW_LAW_ROWS_H

#include <stdbool.h>

#include "cli/law/law_table.h"

/* Which rows of a law are wanted. */
struct gb_law_rows_request {
    const struct gb_law_table_law *law;
    const struct gb_law_table_lattice *lattice; /* of law lattice */
    char **at;
    char *range;
    char *path;
    const char *column; /* value of the varied key, printed before each row; or NULL */
};

/* The rows of one scene on stdout.  dry: only checked, so that nothing is printed before
 * all of a request is understood.  Errors: GB_ERR_INPUT naming option or key, and what
 * gb_options_output_failed says of stdout. */
bool gb_law_rows_print(const struct gb_law_rows_request *request,
                       const struct gb_params *params, bool dry, struct gb_error *err);

#endif
