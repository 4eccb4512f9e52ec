#ifndef GB_IO_POINT_COLUMNS_H
#define GB_IO_POINT_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"
#include "greenbody/point.h"
#include "scene/loading_kind.h"

/* The columns of a recorded point: one row per member of struct gb_point, in its order.
 * curve.csv, status.json, state.h5, checkpoints, the library and Python iterate over
 * these rows.  A new quantity needs a member, a row, and the line that measures it
 * (run/experiment.c). */

/* Kinds of scenes: bits of enum gb_curve_columns. */
enum {
    GB_POINT_STILL = 1 << GB_COLUMNS_COMMON,
    GB_POINT_MOVING = 1 << GB_COLUMNS_ENERGY,
    GB_POINT_DIE = 1 << GB_COLUMNS_DIE,
    GB_POINT_CELL = GB_POINT_STILL | GB_POINT_MOVING, /* periodic cells */
    GB_POINT_TIMED = GB_POINT_MOVING | GB_POINT_DIE,
    GB_POINT_ALL = GB_POINT_CELL | GB_POINT_DIE
};

struct gb_point_column {
    const char *member; /* its name in C and Python, with the SI unit */
    size_t offset, count;
    char type;       /* 'd' (double), 'q' (int64_t), 'i' (int) */
    unsigned scenes; /* scenes that measure it and have its columns; else NaN */
    /* Names in curve.csv with their unit, one per number, separated by commas; NULL:
     * none.  Values are divided by `si`, one unit in SI.  If `times` is given they are
     * multiplied by it instead, which is exact to the last digit. */
    const char *columns;
    double si, times;
    int decimals; /* 0: as many as the number needs */
    /* Item of a checkpoint, its unit, and the scenes whose checkpoints have it.
     * Successive rows with the same item share it. */
    const char *item, *unit;
    unsigned kept;
    /* Name in state.h5 (NULL: none). finite: a state with an infinite value is
     * rejected. */
    const char *state;
    bool finite;
    const char *status; /* name in status.json; NULL: none */
};

/* Row `index`; NULL after the last. */
const struct gb_point_column *gb_point_columns_at(size_t index);

/* Number k of the member, in the unit of its column.  Not for the branch. */
double gb_point_columns_value(const struct gb_point_column *row,
                              const struct gb_point *point, size_t k);
/* Sets number k from a value in that unit. */
void gb_point_columns_set(const struct gb_point_column *row, struct gb_point *point,
                          size_t k, double value);

/* Sets every member that some kind of scene lacks to NaN. */
void gb_point_columns_clear(struct gb_point *point);

/* Saves the point as items "prefix/density" and so on. */
bool gb_point_columns_save(const struct gb_point *point, const char *prefix,
                           enum gb_curve_columns scene, struct gb_record *record,
                           struct gb_error *err);
/* Loads the members that this kind of scene measures; other members do not change.
 * Errors: GB_ERR_INPUT. */
bool gb_point_columns_load(struct gb_point *point, const char *prefix,
                           enum gb_curve_columns scene, const struct gb_record *record,
                           struct gb_error *err);

#endif
