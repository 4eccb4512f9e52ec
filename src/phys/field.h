#ifndef GB_PHYS_FIELD_H
#define GB_PHYS_FIELD_H

#include "greenbody/params.h"

/* Text <-> one member of gb_params, by the row of the field table.  Errors of reading are
 * `group.key = given: accepted ...`; params is untouched then. */
bool gb_field_read(const struct gb_field *field, struct gb_params *params,
                   const char *text, struct gb_error *err);
char *gb_field_write(const struct gb_field *field, const struct gb_params *params,
                     char *buffer, size_t size);

/* What is accepted, for messages, help and the editor: "0 to 2", "auto, or 1 nm to 1 mm". */
char *gb_field_accepted(const struct gb_field *field, char *buffer, size_t size);

/* Is the value in memory within its range?  (Relative fields given as a length or pressure
 * are compared as the multiple they come to.) */
bool gb_field_valid(const struct gb_field *field, const struct gb_params *params);

/* SI value of a relative member: its multiple of the diameter or of Young's modulus. */
double gb_field_absolute(const struct gb_field *field, const struct gb_params *params);

#endif
