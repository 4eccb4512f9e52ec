#ifndef GB_IO_CURVE_CSV_H
#define GB_IO_CURVE_CSV_H

#include <glib.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "scene/loading_kind.h"

/* Text of curve.csv; g_string_free. */

/* Comment lines and the line of column names for a scene. */
GString *gb_curve_csv_head(const struct gb_params *params);

/* The row of a point, with its newline. */
GString *gb_curve_csv_row(const struct gb_point *point, enum gb_curve_columns columns);

#endif
