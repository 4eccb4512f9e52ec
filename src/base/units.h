#ifndef GB_BASE_UNITS_H
#define GB_BASE_UNITS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/dimension.h"
#include "greenbody/status.h"

/* Reads "10.4 nm", "10.4nm", "1e-8 m", "100 MPa", "0.1 %", "1224 kB" into SI units.
 *
 * text       the number and its unit; blanks around and between are fine
 * dimension  expected dimension; only GB_DIM_NONE and GB_DIM_FRACTION allow a number
 *            without a unit
 * value_si   result, unchanged on error
 * Errors: GB_ERR_INPUT with what was read and which units are possible. nan, inf,
 * hexadecimal numbers and trailing text are errors.  The decimal point is always '.'. */
bool gb_units_parse(const char *text, enum gb_dimension dimension, double *value_si,
                    struct gb_error *err);

/* Writes value_si in the unit that gives a mantissa in [1, 1000), with the fewest
 * digits that read back to the same double ("10.4 nm").  Zero uses the first display
 * unit.  Returns buffer. */
char *gb_units_format(double value_si, enum gb_dimension dimension, char *buffer,
                      size_t size);

/* The same with at most `digits` significant digits, for the screen. */
char *gb_units_format_short(double value_si, enum gb_dimension dimension, int digits,
                            char *buffer, size_t size);

/* "nm, um, mm, m, ..." for messages and help; "none" for pure numbers. */
const char *gb_units_accepted(enum gb_dimension dimension);

/* For a number with a comma among its digits, such as "0,15" or "1,000 MPa", writes the
 * advice "decimals have a point, thousands no mark: 0.15"; "" for other texts.  Returns
 * buffer. */
char *gb_units_comma(const char *text, char *buffer, size_t size);

/* Reads a strict decimal number without unit, independent of the locale. *end as in
 * strtod. */
bool gb_units_number(const char *text, const char **end, double *value);

/* Boltzmann constant, J/K (exact, SI 2019). */
#define GB_BOLTZMANN_J_K 1.380649e-23

#endif
