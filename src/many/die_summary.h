#ifndef GB_MANY_DIE_SUMMARY_H
#define GB_MANY_DIE_SUMMARY_H

#include "many/runset.h"

/* Numbers of a full die cycle, from curve.csv. */
struct gb_die_summary_row {
    const char *name; /* with its unit, as a column */
    const char *doc;
    /* NaN where the run has none. */
    double (*value)(const struct gb_table *table);
};

/* THE table; the last row has no name. */
const struct gb_die_summary_row *gb_die_summary_table(void);

/* Mean and standard error over the runs of a group.  Returns how many have a value. */
size_t gb_die_summary_mean(const struct gb_die_summary_row *row,
                           const struct gb_runset *set, size_t group, double *mean,
                           double *error);

/* Errors: GB_ERR_INPUT naming the first run that is no full die cycle that has ended. */
bool gb_die_summary_check(const struct gb_runset *set, struct gb_error *err);

#endif
