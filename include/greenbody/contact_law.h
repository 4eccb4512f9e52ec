#ifndef GREENBODY_CONTACT_LAW_H
#define GREENBODY_CONTACT_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/parameters.h"
#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Contact laws by name, as `greenbody law` prints them. */

/* Name of law `index` (0, 1, ...) and its meaning, whose lines end with '\n'.  NULL after
 * the last law. */
const char *gb_contact_law_name(size_t index);
const char *gb_contact_law_doc(size_t index);

/* Columns of the rows of a law ("h,f,k"), and the name of its variable.  The variable is
 * NULL for a law with one row and no variable.  Both are NULL for an unknown law. */
const char *gb_contact_law_columns(const char *law);
const char *gb_contact_law_variable(const char *law);

enum gb_contact_law_history {
    GB_CONTACT_LAW_POINTS, /* a row per value */
    GB_CONTACT_LAW_PATH /* one contact with its history, in steps from value to value */
};

/* The points at which to evaluate a law. */
struct gb_contact_law_request {
    size_t size;         /* sizeof(struct gb_contact_law_request), set by the caller */
    const char *law;     /* "normal" */
    const char *lattice; /* for law "lattice": "sc", "fcc", "bcc", "diamond"; else NULL */
    const double *x;     /* values of the variable, in the unit of its column */
    size_t count;        /* number of x; 0 for a law without a variable */
    double h_min;        /* deepest overlap of a bridge so far, d; NaN: not given */
    int history;         /* enum gb_contact_law_history */
};

/* Rows of a request; 0 for an unknown law. */
size_t gb_contact_law_rows(const struct gb_contact_law_request *request);

/* Computes all rows into out, row by row.
 *
 * room   numbers that out can hold
 * Errors: GB_ERR_INPUT naming the key, law or value and what is expected. */
bool gb_contact_law_compute(const struct gb_contact_law_request *request,
                            const struct gb_parameters *parameters, double *out,
                            size_t room, struct gb_error *err);

#ifdef __cplusplus
}
#endif

#endif
