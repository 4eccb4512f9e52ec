#ifndef GB_STUDY_SENSITIVITY_SENSITIVITY_TEXT_H
#define GB_STUDY_SENSITIVITY_SENSITIVITY_TEXT_H

#include "study/sensitivity/sensitivity.h"

/* sensitivity.csv: a row per figure, pressure and key.  g_string_free. */
GString *gb_sensitivity_text_table(const struct gb_sensitivity *sensitivity,
                                   const struct gb_param_sweep *sweep);

/* The density at the highest pressure that has it on loading, for people; empty: none.
 * g_string_free. */
GString *gb_sensitivity_text_lines(const struct gb_sensitivity *sensitivity,
                                   const struct gb_param_sweep *sweep);

#endif
