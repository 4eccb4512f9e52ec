#ifndef GB_FIGURES_REPORT_REPORT_CONDITIONS_H
#define GB_FIGURES_REPORT_REPORT_CONDITIONS_H

#include "many/runset.h"

/* What a scene was computed with, for captions and the table of conditions. */
enum { GB_REPORT_CONDITIONS = 7 };

/* material, particles, cells, seeds, contact law, loading, fidelity */
extern const char *const gb_report_conditions_heads[GB_REPORT_CONDITIONS];

/* Of a group, plain text; g_free. */
char *gb_report_conditions_of(const struct gb_runset *set, size_t group, int condition);

/* "Conditions: alumina; ...", of all groups, for a caption: a condition in which more than
 * three groups differ refers to the table.  g_free. */
char *gb_report_conditions_caption(const struct gb_runset *set);

#endif
