#ifndef GREENBODY_PARAMETERS_H
#define GREENBODY_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parameters of a run.  Their keys are the keys of preset files and of the command line
 * (`greenbody params`): "contact.mu", or "mu" where only one group has the key.
 *
 * Functions that fail return false and fill err (NULL is fine).  Do not change an object
 * in one thread while another thread uses it. */
struct gb_parameters;

/* Reads a preset.
 *
 * preset   its name or the path of its file, such as preset.ini of a run directory; NULL:
 *          all defaults
 * Errors: GB_ERR_INPUT naming file, line, key and what is expected; GB_ERR_MACHINE. */
bool gb_parameters_create(struct gb_parameters **out, const char *preset,
                          struct gb_error *err);
bool gb_parameters_copy(struct gb_parameters **out,
                        const struct gb_parameters *parameters, struct gb_error *err);
void gb_parameters_destroy(struct gb_parameters *parameters); /* NULL is fine */

/* Sets "group.key=value" or "key=value", where the value has its unit, as in
 * "loading.until=100 MPa".  "material=yttria", with a name or a file, sets all keys of
 * [material].
 * Errors: GB_ERR_INPUT with what is expected; the parameters do not change. */
bool gb_parameters_set(struct gb_parameters *parameters, const char *assignment,
                       struct gb_error *err);

/* Writes a value as in a preset: "9.7 nm", "0.008 d", "auto".
 *
 * size   of the buffer; GB_PARAMETERS_VALUE is enough for every value
 * Errors: GB_ERR_INPUT for an unknown key, or a buffer that is too small. */
enum { GB_PARAMETERS_VALUE = 8192 };
bool gb_parameters_get(const struct gb_parameters *parameters, const char *key,
                       char *buffer, size_t size, struct gb_error *err);

/* Writes a value as in the directory names of a sweep: "9.7nm".  The text has letters,
 * digits, '.', '+' and '-'.  In words any other byte becomes "~" and two hexadecimal
 * digits.  Different values have different texts.  Size and errors: see
 * gb_parameters_get. */
bool gb_parameters_label(const struct gb_parameters *parameters, const char *key,
                         char *buffer, size_t size, struct gb_error *err);

/* Checks all values and the relations between them, as gb_simulation_create does.
 * Errors: GB_ERR_INPUT naming the keys. */
bool gb_parameters_check(const struct gb_parameters *parameters, struct gb_error *err);

/* Checks that `cells` cells can differ by structure.seed alone.  Lattices and packings
 * from a file give the same cell for every seed, so they allow one cell only.
 * Errors: GB_ERR_INPUT. */
bool gb_parameters_check_cells(const struct gb_parameters *parameters, size_t cells,
                               struct gb_error *err);

/* Writes a preset file and replaces an old one as a whole.  The file has the keys that
 * differ from their defaults, and all keys and comments of the file that was read. */
bool gb_parameters_save(struct gb_parameters *parameters, const char *path,
                        struct gb_error *err);

/* The table of all keys: writes one text about key `index` (0, 1, ...).  False after the
 * last key. */
enum gb_parameters_text {
    GB_PARAMETERS_KEY,     /* "contact.mu" */
    GB_PARAMETERS_TYPE,    /* "number", "integer", "choice", "text" or "list" */
    GB_PARAMETERS_UNIT,    /* "m, mm, um, nm, A, pm"; pure numbers: "" */
    GB_PARAMETERS_DEFAULT, /* as typed in a preset */
    GB_PARAMETERS_RANGE,   /* expected values: "0 to 2", "auto, or 1 nm to 1 mm" */
    GB_PARAMETERS_CHOICES, /* "rod;hertz;storakers", or "" */
    GB_PARAMETERS_DOC,     /* meaning, one sentence */
    GB_PARAMETERS_SOURCE   /* paper and equation, or "numerical" */
};
bool gb_parameters_text(size_t index, enum gb_parameters_text what, char *buffer,
                        size_t size);

/* Writes the names of all presets that are found, one per line.  Cuts the text to the
 * buffer; returns the size that the whole text and its final '\0' need. */
size_t gb_parameters_presets(char *buffer, size_t size);

#ifdef __cplusplus
}
#endif

#endif
