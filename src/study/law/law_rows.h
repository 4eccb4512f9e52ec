#ifndef GB_STUDY_LAW_LAW_ROWS_H
#define GB_STUDY_LAW_LAW_ROWS_H

#include <stdbool.h>
#include <stddef.h>

#include "study/law/law_table.h"

/* A request for rows of a law: single points, a range or a path, as texts. */
struct gb_law_rows_request {
    const struct gb_law_table_law *law;
    const struct gb_law_table_lattice *lattice; /* of law lattice */
    char **at;                                  /* NULL-terminated "h=0.01" */
    char *range;                                /* "h=0:0.1:101" */
    char *path;                                 /* "0,0.02,-0.01" */
};

/* Takes a row; false with an error ends the request. */
typedef bool gb_law_rows_take(const double *value, int columns, void *data,
                              struct gb_error *err);

/* Rows of a path of so many corners. */
size_t gb_law_rows_of_path(size_t corners);

/* Checks a request without computing its rows.  Errors: GB_ERR_INPUT with option or key.
 */
bool gb_law_rows_check(const struct gb_law_rows_request *request,
                       const struct gb_params *params, struct gb_error *err);

/* Computes the rows for one scene.  Errors: those of gb_law_rows_check and of take. */
bool gb_law_rows_compute(const struct gb_law_rows_request *request,
                         const struct gb_params *params, gb_law_rows_take *take,
                         void *data, struct gb_error *err);

#endif
