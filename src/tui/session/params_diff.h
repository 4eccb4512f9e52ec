#ifndef GB_TUI_SESSION_PARAMS_DIFF_H
#define GB_TUI_SESSION_PARAMS_DIFF_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "io/preset.h"

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

/* The shell command that runs the parameters on screen: the preset by name or path, and
 * every value that differs from the file.
 *
 * params  the parameters on screen
 * cols    longer lines are broken at a blank, with a backslash
 *
 * g_free. */
char *gb_params_diff_command(const struct gb_preset *preset,
                             const struct gb_params *params, int cols);

#endif
