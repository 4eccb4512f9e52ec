#ifndef GB_RUN_POINT_MEASURE_H
#define GB_RUN_POINT_MEASURE_H

#include "greenbody/curve.h"
#include "greenbody/snapshot.h"
#include "solve/loading/loading.h"

/* Measures of a packing as a row of curve.csv, in SI.  The members step and seconds are
 * the caller's. */

/* What the packing is: density, pressures, contacts.  In a periodic cell iterations,
 * evaluations, time and energies are left empty. */
void gb_point_measure_packing(const struct gb_loading *loading, struct gb_point *point);

/* A recorded point: also what it took to get there, time and energies.  elastic_start:
 * elastic energy at the start of the run, E d^3. */
void gb_point_measure_step(const struct gb_loading *loading, double elastic_start,
                           struct gb_point *point);

/* Contacts, forces and solver as they are now, for the screen. */
void gb_point_measure_live(const struct gb_loading *loading,
                           struct gb_snapshot *snapshot);

#endif
