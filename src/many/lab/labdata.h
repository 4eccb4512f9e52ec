#ifndef GB_MANY_LAB_LABDATA_H
#define GB_MANY_LAB_LABDATA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/table.h"
#include "greenbody/params.h"

/* Measured compaction: densities at pressures, of one powder or of several that differ in
 * given keys.  A table as gb_lab_reader_read gives it, with the columns
 *   p_MPa           pressure over the compressed axes
 *   density         relative
 *   density_error   standard error (optional; all or none)
 *   series          words (optional): one only
 *   branch          load (the default), or unload: density left after unloading from
 * p_MPa group.key_unit  (optional, any number) what the row was pressed with, as
 * contact.mu or particles.diameter_nm */
struct gb_labdata_row {
    size_t scene;
    double pressure_pa, density;
    bool unloaded;
};

enum { GB_LABDATA_ROWS = 4096, GB_LABDATA_SCENES = 64 };

struct gb_labdata {
    struct gb_labdata_row *row;
    double *density, *error; /* of the rows as arrays; error NULL: not given */
    size_t count;
    struct gb_params *scene; /* loaded as far as its rows ask */
    size_t scenes;
};

/* Takes the rows; the scenes are params with the keys of their rows, a loading that reaches
 * the greatest pressure, and unloading where rows ask for it.  Errors: GB_ERR_INPUT with
 * the line, GB_ERR_MEMORY.  gb_labdata_finish is due on success. */
bool gb_labdata_take(struct gb_labdata *measured, const struct gb_table *table,
                     const struct gb_params *params, struct gb_error *err);
void gb_labdata_finish(struct gb_labdata *measured); /* zeroed is fine */

#endif
