#ifndef GB_BASE_NUMBER_H
#define GB_BASE_NUMBER_H

/* Longest text of a number, including the final '\0'. */
enum { GB_NUMBER_MAX = 32 };

/* Writes a finite number with 15 digits if they read back the same, else with 16 or 17,
 * without trailing zeros, as printf's %.15g and so on would.  In most cases it is four
 * times as fast as printf; a row of a curve has a dozen numbers.  Returns buffer. */
char *gb_number_write(double value, char buffer[GB_NUMBER_MAX]);

/* Formats a number for a table that people read, with a format for one double such as
 * "%.3f"; "-" if it is not finite.  Returns buffer. */
char *gb_number_shown(const char *format, double value, char buffer[GB_NUMBER_MAX]);

/* Longest text of a number with its error, including the final '\0'. */
enum { GB_NUMBER_ERROR_MAX = 96 };

/* Writes "0.4062 +- 0.0065": the error with `digits` significant digits, the value to
 * the same decimal place, `sign` between them.  An error that is zero or not finite is
 * omitted, and the value then has two more digits.  A value that is not finite is "-".
 * Values far from 1 have a common power of ten: "(1.23 +- 0.05)e-09".  Returns buffer. */
char *gb_number_error(double value, double error, int digits, const char *sign,
                      char buffer[GB_NUMBER_ERROR_MAX]);

/* Largest of 1, 2, 5 x 10^k that is at most `max`; max must be positive. */
double gb_number_round_below(double max);

/* Smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 x 10^k that is at least `min`; min must be
 * positive. */
double gb_number_round_above(double min);

/* The value of 1, 2, 5, 10 x 10^k nearest to a positive step. */
double gb_number_nearest_step(double rough);

#endif
