#ifndef GB_BASE_NUMBER_H
#define GB_BASE_NUMBER_H

/* Longest text of a number, with its end. */
enum { GB_NUMBER_MAX = 32 };

/* Writes a finite number with 15 digits if they read back the same, else with 16 or 17,
 * without zeros at the end, as printf's %.15g and so on do.  Four times as fast as these
 * where it can be: a row of a curve has a dozen.  Returns buffer. */
char *gb_number_write(double value, char buffer[GB_NUMBER_MAX]);

#endif
