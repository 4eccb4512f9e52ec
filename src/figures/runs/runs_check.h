#ifndef GB_FIGURES_RUNS_RUNS_CHECK_H
#define GB_FIGURES_RUNS_RUNS_CHECK_H

#include "many/runset.h"

/* All runs are dynamic.  Errors: GB_ERR_INPUT with the first other run. */
bool gb_runs_check_dynamic(const struct gb_runset *set, const char *figure,
                           struct gb_error *err);
/* All runs are dies. */
bool gb_runs_check_die(const struct gb_runset *set, const char *figure,
                       struct gb_error *err);

#endif
