#ifndef GB_SCENE_FIELD_H
#define GB_SCENE_FIELD_H

#include "greenbody/params.h"

/* Reads text into one member of gb_params, by its row of the field table.  Errors are
 * "group.key = given: must be ..."; params does not change then. */
bool gb_field_read(const struct gb_field *field, struct gb_params *params,
                   const char *text, struct gb_error *err);
char *gb_field_write(const struct gb_field *field, const struct gb_params *params,
                     char *buffer, size_t size);

/* Writes the expected values for lists: "0 to 2", "auto, or 1 nm to 1 mm".  Returns
 * buffer. */
char *gb_field_accepted(const struct gb_field *field, char *buffer, size_t size);
/* Writes them for use after "must be": "between 0 and 2".  Returns buffer. */
char *gb_field_accepted_sentence(const struct gb_field *field, char *buffer, size_t size);

/* Is the value in memory within its range?  A relative field that was given as a
 * length, pressure or time is divided by its reference first. */
bool gb_field_valid(const struct gb_field *field, const struct gb_params *params);

/* Bounds of loading.until = density; the table row has the bounds of the pressure. */
#define GB_FIELD_DENSITY_MIN 0.02
#define GB_FIELD_DENSITY_MAX 0.99

/* Does the value stand for "auto"? */
bool gb_field_is_auto(const struct gb_field *field, double value);
/* The number in a member of type number, relative or integer; false for other types. */
bool gb_field_number(const struct gb_field *field, const void *member, double *number);
/* Is the number finite and within the row's range? */
bool gb_field_in_range(const struct gb_field *field, double value);
/* Are the least and largest size of a checked table within the row's range? */
bool gb_field_sizes_in_range(const struct gb_field *field,
                             const struct gb_sizetable *table);
/* Index of the choice with this name, or -1. */
int gb_field_find_choice(const struct gb_field *field, const char *text);
/* Stored value of a choice: names that are numbers ("3", "2") are stored as that
 * number, others as their index. */
int gb_field_choice_value(const struct gb_field *field, int index);
/* Does the field affect scenes with these parameters?  The editor hides other fields;
 * presets may contain them. */
bool gb_field_applies(const struct gb_field *field, const struct gb_params *params);
/* Is the text valid UTF-8 without control characters? */
bool gb_field_plain_text(const char *text);

/* SI value of a relative member: its multiple of the diameter, of Young's modulus or of
 * the reduced time. */
double gb_field_absolute(const struct gb_field *field, const struct gb_params *params);

#endif
