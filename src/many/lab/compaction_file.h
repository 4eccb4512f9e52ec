#ifndef GB_MANY_LAB_COMPACTION_FILE_H
#define GB_MANY_LAB_COMPACTION_FILE_H

#include "base/table.h"
#include "many/lab/compaction_data.h"

/* A table of measured points, as gb_lab_reader_read gives it, for the equations of
 * compaction: ascending in pressure, with the errors of the densities where every point
 * has one above 0.  Rows of a column `branch` other than "load" are left out; of a column
 * `series` only the rows of one word (series; NULL: there must be one only).
 * gb_compaction_data_finish is due on success.
 * Errors: those of gb_measured_take; GB_ERR_INPUT for several series or samples (columns
 * as particles.diameter_nm that are not constant) and for a window without points. */
bool gb_compaction_file(struct gb_compaction_data *data, const struct gb_table *table,
                        const char *series, const struct gb_compaction_window *window,
                        struct gb_error *err);

#endif
