#ifndef GB_BASE_UNITS_H
#define GB_BASE_UNITS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* What a number measures.  A unit of another dimension is refused. */
enum gb_dimension {
    GB_DIM_NONE,         /* pure number; "%" is accepted for GB_DIM_FRACTION only */
    GB_DIM_FRACTION,     /* "0.1 %" or "0.001" */
    GB_DIM_LENGTH,       /* m, mm, um, nm, A(ngstrom), pm */
    GB_DIM_PRESSURE,     /* Pa, kPa, MPa, GPa */
    GB_DIM_TIME,         /* s, ms, us, ns, ps, fs, min, h */
    GB_DIM_RATE,         /* 1/s, 1/ms, 1/us, 1/ns, 1/ps */
    GB_DIM_MASS_DENSITY, /* kg/m3, g/cm3 */
    GB_DIM_ENERGY,       /* J, eV, kB (times one kelvin: "1224 kB") */
    GB_DIM_VISCOSITY,    /* Pa s, mPa s */
    GB_DIM_FORCE,        /* N, mN, uN, nN */
};

/* Reads "10.4 nm", "10.4nm", "1e-8 m", "100 MPa", "0.1 %", "1224 kB" into SI.
 *
 * text       the number and its unit; blanks around and between are fine
 * dimension  what is accepted; a bare number is accepted only for GB_DIM_NONE and
 *            GB_DIM_FRACTION
 * value_si   result, untouched on error
 * Errors: GB_ERR_INPUT with what was read and which units are accepted; nan, inf, hex
 * floats and trailing text are refused.  Always uses '.' as the decimal point. */
bool gb_units_parse(const char *text, enum gb_dimension dimension, double *value_si,
                    struct gb_error *err);

/* Writes value_si with the unit of its dimension that gives a mantissa in [1, 1000), with
 * the fewest digits that read back to the same double ("10.4 nm").  Zero takes the first
 * display unit.  Returns buffer. */
char *gb_units_format(double value_si, enum gb_dimension dimension, char *buffer,
                      size_t size);

/* The same with at most `digits` significant digits, for the screen. */
char *gb_units_format_short(double value_si, enum gb_dimension dimension, int digits,
                            char *buffer, size_t size);

/* "nm, um, mm, m, ..." for messages and help; "none" for pure numbers. */
const char *gb_units_accepted(enum gb_dimension dimension);

/* Strict decimal number without unit; locale-independent.  *end as in strtod. */
bool gb_units_number(const char *text, const char **end, double *value);

/* Boltzmann constant, J/K (exact, SI 2019). */
#define GB_BOLTZMANN_J_K 1.380649e-23

#endif
