#ifndef GB_MANY_SWEEP_SWEEP_SHORTFALL_H
#define GB_MANY_SWEEP_SWEEP_SHORTFALL_H

#include "many/ensemble.h"

/* What runs that are done have not reached: goals of their loading, equilibrium of points. */

/* The words of the run itself, g_free; NULL: it has reached everything, or is not done. */
char *gb_sweep_shortfall_text(const struct gb_ensemble_run *run);

/* Number of such runs among those that count. */
size_t gb_sweep_shortfall_runs(const struct gb_ensemble *ensemble);

#endif
