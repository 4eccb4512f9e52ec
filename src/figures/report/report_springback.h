#ifndef GB_FIGURES_REPORT_REPORT_SPRINGBACK_H
#define GB_FIGURES_REPORT_REPORT_SPRINGBACK_H

#include "many/runset.h"

/* Relative growth of the volume of a periodic cell on unloading from a pressure to the end of
 * the branch, percent: mean and standard error over the runs of a group (NaN for one).
 * Returns how many have the branch. */
size_t gb_report_springback(const struct gb_runset *set, size_t group, double from_mpa,
                            double *mean, double *error);

#endif
