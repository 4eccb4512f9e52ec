#ifndef GB_MANY_LAB_LABDATA_H
#define GB_MANY_LAB_LABDATA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/table.h"
#include "greenbody/params.h"
#include "io/lab/lab_quantity.h"

/* Measured compaction: quantities at pressures, of one powder or of several that differ in
 * given keys.  A table as gb_lab_reader_read gives it, with the columns
 *   p_MPa           pressure over the compressed axes
 *   density         relative; and the others of io/lab/lab_quantity.h, one or more of them,
 *                   empty where a row lacks one
 *   density_error   standard error (of one quantity: all or none; of several: all), and
 *                   those of the others
 *   weight          (optional, 1) what the row counts in the fit beside its errors
 *   series          words (optional): one only
 *   branch          load (the default), or unload: what is left after unloading from p_MPa
 *   group.key_unit  (optional, any number) what the row was pressed with, as contact.mu or
 *                   particles.diameter_nm */
struct gb_labdata_row {
    size_t scene;
    double pressure_pa;
    enum gb_lab_quantity quantity;
    bool unloaded;
};

enum { GB_LABDATA_ROWS = 4096, GB_LABDATA_SCENES = 64 };

struct gb_labdata {
    struct gb_labdata_row *row; /* one for each quantity of a row of the table */
    double *value;              /* of the rows */
    double *error, *weight;     /* of the rows; NULL: not given */
    size_t count;
    struct gb_params *scene; /* loaded as far as its rows ask */
    size_t scenes;
};

/* Takes the rows; the scenes are params with the keys of their rows, a loading that reaches
 * the greatest pressure, and unloading where rows ask for it.  Errors: GB_ERR_INPUT with
 * the line, GB_ERR_MEMORY.  gb_labdata_finish is due on success. */
bool gb_labdata_take(struct gb_labdata *measured, const struct gb_table *table,
                     const struct gb_params *params, struct gb_error *err);
/* The quantity of a row in a simulated curve; NaN: not reached. */
double gb_labdata_simulated(const struct gb_labdata_row *row,
                            const struct gb_table *curve);
void gb_labdata_finish(struct gb_labdata *measured); /* zeroed is fine */

#endif
