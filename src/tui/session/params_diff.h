#ifndef GB_TUI_SESSION_PARAMS_DIFF_H
#define GB_TUI_SESSION_PARAMS_DIFF_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Differences between two sets of parameters, compared as text of a preset. */

enum { GB_PARAMS_DIFF_TEXT = 96 };

/* Whether both have the same value of a field. */
bool gb_params_diff_same(const struct gb_params *a, const struct gb_params *b,
                         const struct gb_field *field);

/* Number of different fields, the title excepted. */
int gb_params_diff_count(const struct gb_params *a, const struct gb_params *b);

/* "mu 0.1, alpha 0.24": the different values of `own`, or "same parameters".  Returns
 * text. */
char *gb_params_diff_describe(const struct gb_params *own, const struct gb_params *other,
                              char *text, size_t size);

#endif
