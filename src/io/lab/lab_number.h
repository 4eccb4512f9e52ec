#ifndef GB_IO_LAB_LAB_NUMBER_H
#define GB_IO_LAB_LAB_NUMBER_H

#include <stdbool.h>

/* A cell as a number, with the decimal point and with the decimal comma.  The other mark,
 * blanks and apostrophes may group thousands: 1.234,56 or 1 234.5.  A percent sign may
 * follow; the number is not divided by it. */
struct gb_lab_number {
    bool is_point, is_comma; /* whether it can be read so */
    double point, comma;
    bool grouped_point, grouped_comma; /* the other mark groups thousands */
    bool percent;
};

/* False: no number in either reading. */
bool gb_lab_number_scan(const char *text, struct gb_lab_number *out);

/* The reading by a decimal mark, '.' or ','; false: there is none. */
bool gb_lab_number_read(const struct gb_lab_number *number, char decimal, double *value);

#endif
