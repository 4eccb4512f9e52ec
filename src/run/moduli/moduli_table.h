#ifndef GB_RUN_MODULI_TABLE_H
#define GB_RUN_MODULI_TABLE_H

#include <stdbool.h>

#include "base/record.h"
#include "greenbody/params.h"
#include "scene/field/keep_points.h"
#include "solve/moduli/moduli.h"

/* Moduli of states as rows of numbers, and where the states come from: a run of a preset,
 * or the files of a run directory. */
enum { GB_MODULI_TABLE_COLUMNS = 63 };

/* Name of a column, with its unit; the first twelve are density, p_MPa, probe_strain and
 * nine elements of C. */
const char *gb_moduli_table_name(int column);
int gb_moduli_table_find(const char *name); /* -1: none */

struct gb_moduli_table_row {
    double value[GB_MODULI_TABLE_COLUMNS]; /* NaN where there is none */
    double c_gpa[6][6];
    bool range_open; /* the elastic range is beyond its value */
    unsigned what;   /* of a run: points of the list, end; see run/keep_walk.h */
};

/* Called with each row in the order of the run; false ends with its error.  The end of a run
 * is a row even if its state was one before. */
struct gb_moduli_table_sink {
    bool (*row)(void *data, const struct gb_moduli_table_row *row, struct gb_error *err);
    void *data;
    /* Whether the state of this step in a file is to be probed; NULL: it is. */
    bool (*wanted)(void *data, int64_t step);
    bool (*cancelled)(void *data); /* polled; NULL is fine */
    void *cancel_data;
    bool range; /* with the elastic range */
};

/* Runs a preset and probes where it first reaches each point while loading, and at its end;
 * a lattice without points as it was placed, without loading.  *missed counts points that
 * were not reached.  Errors: GB_ERR_GUARD when the run stops early (its last state has been
 * probed), and those of gb_moduli_measure. */
bool gb_moduli_table_run(const struct gb_params *params,
                         const struct gb_keep_points *points,
                         const struct gb_moduli_table_sink *sink, int *missed,
                         struct gb_error *err);

/* Probes the state in a file of a run directory, relative to it ("state.h5").  Errors:
 * GB_ERR_INPUT for a file without contact histories, or of a scene without a periodic
 * cell. */
bool gb_moduli_table_file(const char *directory, const char *name,
                          const struct gb_moduli_table_sink *sink, struct gb_error *err);

#endif
