#ifndef GB_IO_CURVE_CSV_H
#define GB_IO_CURVE_CSV_H

#include <glib.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "scene/loading_kind.h"

/* The file curve.csv; its columns are the rows of io/point_columns.h. */

/* Comment lines and the line of column names for a scene; g_string_free. */
GString *gb_curve_csv_head(const struct gb_params *params);

/* The row of a point, with its newline; g_string_free. */
GString *gb_curve_csv_row(const struct gb_point *point, enum gb_curve_columns scene);

/* Appends the rows of a run directory that the curve lacks, except an incomplete last
 * row.  Members without a column in the file become NaN, integers 0. */
bool gb_curve_csv_read(const char *directory, const struct gb_params *params,
                       struct gb_curve *curve, struct gb_error *err);

#endif
