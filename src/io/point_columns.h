#ifndef GB_IO_POINT_COLUMNS_H
#define GB_IO_POINT_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"
#include "greenbody/curve.h"

/* The last columns of curve.csv: those of the tensors of a periodic cell, behind them in
 * the table those of a die and of strain steps.  One table for writing, reading and
 * checkpoints. */
enum {
    GB_POINT_COLUMNS = 22,     /* of a cell */
    GB_POINT_DIE_COLUMNS = 10, /* of a die */
    GB_POINT_STEP_COLUMNS = 1, /* of strain steps */
    GB_POINT_DIE_END = GB_POINT_COLUMNS + GB_POINT_DIE_COLUMNS,
    GB_POINT_ALL_COLUMNS = GB_POINT_DIE_END + GB_POINT_STEP_COLUMNS
};

/* Name of column k < GB_POINT_ALL_COLUMNS, with its unit. */
const char *gb_point_columns_name(size_t k);
/* Its unit in that of the point's member. */
double gb_point_columns_factor(size_t k);
/* The point's member. */
double *gb_point_columns_member(struct gb_point *point, size_t k);
/* Those of a cell as one item of a record, out of the point or into it, those of a die, and
 * those of strain steps.  The last two are NaN from a record that has none. */
bool gb_point_columns_record(struct gb_point *point, const char *name,
                             struct gb_record *record, struct gb_error *err);
bool gb_point_columns_record_die(struct gb_point *point, const char *name,
                                 struct gb_record *record, struct gb_error *err);
bool gb_point_columns_record_step(struct gb_point *point, const char *name,
                                  struct gb_record *record, struct gb_error *err);
/* The value in the unit of the column. */
double gb_point_columns_value(const struct gb_point *point, size_t k);

#endif
