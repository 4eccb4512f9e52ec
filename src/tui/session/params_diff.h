#ifndef GB_TUI_SESSION_PARAMS_DIFF_H
#define GB_TUI_SESSION_PARAMS_DIFF_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Differences between two sets of parameters, compared as a preset writes their values. */

enum { GB_PARAMS_DIFF_TEXT = 96 };

/* Whether both have the same value of a field. */
bool gb_params_diff_same(const struct gb_params *a, const struct gb_params *b,
                         const struct gb_field *field);

/* Number of fields, without the title, in which they differ. */
int gb_params_diff_count(const struct gb_params *a, const struct gb_params *b);

/* "mu 0.1, alpha 0.24": the values of `own` where they differ from those of `other`;
 * "same parameters" where they do not.  Returns text. */
char *gb_params_diff_describe(const struct gb_params *own, const struct gb_params *other,
                              char *text, size_t size);

#endif
