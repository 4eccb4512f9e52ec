#ifndef GREENBODY_PARAMETERS_H
#define GREENBODY_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parameters of a run by their keys, which are those of preset files and of the command
 * line (`greenbody params`): "contact.mu", or "mu" where only one group has the key.
 *
 * Functions that fail return false and fill err (NULL is fine).  The same object must not
 * be changed by one thread while another uses it. */
struct gb_parameters;

/* preset   name of a preset or path of its file, also preset.ini of a run directory; NULL:
 *          all defaults
 * Errors: GB_ERR_INPUT with file, line, key and what is accepted; GB_ERR_MACHINE. */
bool gb_parameters_create(struct gb_parameters **out, const char *preset,
                          struct gb_error *err);
bool gb_parameters_copy(struct gb_parameters **out,
                        const struct gb_parameters *parameters, struct gb_error *err);
void gb_parameters_destroy(struct gb_parameters *parameters); /* NULL is fine */

/* Sets "group.key=value" or "key=value", the value with its unit: "loading.until=100 MPa";
 * "material=yttria", a name or a file, sets all keys of [material].
 * Errors: GB_ERR_INPUT with what is accepted; the parameters are unchanged then. */
bool gb_parameters_set(struct gb_parameters *parameters, const char *assignment,
                       struct gb_error *err);

/* The value as a preset would have it: "9.7 nm", "0.008 d", "auto".
 *
 * size   of the buffer; GB_PARAMETERS_VALUE is enough for every value
 * Errors: GB_ERR_INPUT for an unknown key, or a buffer that is too small. */
enum { GB_PARAMETERS_VALUE = 8192 };
bool gb_parameters_get(const struct gb_parameters *parameters, const char *key,
                       char *buffer, size_t size, struct gb_error *err);

/* The value as the names of a sweep's directories have it, "9.7nm": letters, digits, '.', '+'
 * and '-'; in words every other byte as "~" and two hexadecimal digits.  Two values have two
 * such texts.  Size and errors: as of gb_parameters_get. */
bool gb_parameters_label(const struct gb_parameters *parameters, const char *key,
                         char *buffer, size_t size, struct gb_error *err);

/* Checks each value and their relations, as creating a simulation does.  Errors:
 * GB_ERR_INPUT naming the keys. */
bool gb_parameters_check(const struct gb_parameters *parameters, struct gb_error *err);

/* Checks a plan of several cells that differ by structure.seed only.  Lattices and packings
 * from a file are the same cell for every seed.  Errors: GB_ERR_INPUT. */
bool gb_parameters_check_cells(const struct gb_parameters *parameters, size_t cells,
                               struct gb_error *err);

/* Writes a preset file, replaced as a whole: keys that differ from their defaults, and those
 * of the file that it was read from, with their comments. */
bool gb_parameters_save(struct gb_parameters *parameters, const char *path,
                        struct gb_error *err);

/* The table of all keys.  A text of key `index` (0, 1, ...) into the buffer; false behind
 * the last key. */
enum gb_parameters_text {
    GB_PARAMETERS_KEY,     /* "contact.mu" */
    GB_PARAMETERS_TYPE,    /* "number", "integer", "choice", "text" or "list" */
    GB_PARAMETERS_UNIT,    /* "m, mm, um, nm, A, pm"; "" of pure numbers */
    GB_PARAMETERS_DEFAULT, /* as typed in a preset */
    GB_PARAMETERS_RANGE,   /* what is accepted: "0 to 2", "auto, or 1 nm to 1 mm" */
    GB_PARAMETERS_CHOICES, /* "rod;hertz;storakers"; "" where there are none */
    GB_PARAMETERS_DOC,     /* meaning, one sentence */
    GB_PARAMETERS_SOURCE   /* paper and equation, or "numerical" */
};
bool gb_parameters_text(size_t index, enum gb_parameters_text what, char *buffer,
                        size_t size);

/* Names of all presets that are found, one a line, into the buffer as far as they fit;
 * returns the size that all need with the end. */
size_t gb_parameters_presets(char *buffer, size_t size);

#ifdef __cplusplus
}
#endif

#endif
