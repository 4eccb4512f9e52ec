#ifndef GB_STUDY_SENSITIVITY_H
#define GB_STUDY_SENSITIVITY_H

#include <glib.h>

#include "many/param_sweep.h"
#include "measure/surrogate.h"

/* One figure at one pressure. */
struct gb_sensitivity_item {
    size_t branch, pressure, quantity; /* indices as in many/param_sweep.h */
    struct gb_sobol_indices indices;
};

struct gb_sensitivity {
    struct gb_sensitivity_item *item;
    size_t count;
};

/* Over the runs of a sweep with a design that are done.  Figures that too few points
 * reached, or that do not vary, are left out.
 * Errors: GB_ERR_INPUT (fewer points than a quadratic has terms), GB_ERR_MEMORY.
 * gb_sensitivity_finish is due in any case. */
bool gb_sensitivity_init(struct gb_sensitivity *sensitivity, struct gb_param_sweep *sweep,
                         struct gb_error *err);

void gb_sensitivity_finish(struct gb_sensitivity *sensitivity);

/* Does the design have the points for a quadratic of its keys?  Errors: GB_ERR_INPUT. */
bool gb_sensitivity_check(const struct gb_axes *axes, struct gb_error *err);

/* sensitivity.csv: a row per figure, pressure and key.  g_string_free. */
GString *gb_sensitivity_table(const struct gb_sensitivity *sensitivity,
                              const struct gb_param_sweep *sweep);

/* The density at the highest pressure that has it on loading, for people; empty: none.
 * g_string_free. */
GString *gb_sensitivity_lines(const struct gb_sensitivity *sensitivity,
                              const struct gb_param_sweep *sweep);

#endif
