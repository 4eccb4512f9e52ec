#ifndef GB_MANY_DIE_SUMMARY_H
#define GB_MANY_DIE_SUMMARY_H

#include "many/runset.h"

/* Figures of a full die cycle, from curve.csv. */
struct gb_die_summary_row {
    const char *name; /* with its unit, as a column */
    const char *doc;
    /* NaN if the run does not have it. */
    double (*value)(const struct gb_table *table);
};

/* The table; the last row has no name. */
const struct gb_die_summary_row *gb_die_summary_table(void);

/* Mean and standard error over the runs of a group.  Returns the number of runs with a
 * value. */
size_t gb_die_summary_mean(const struct gb_die_summary_row *row,
                           const struct gb_runset *set, size_t group, double *mean,
                           double *error);

/* Errors: GB_ERR_INPUT naming the first run that is not a completed full die cycle. */
bool gb_die_summary_check(const struct gb_runset *set, struct gb_error *err);

#endif
