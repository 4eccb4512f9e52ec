#ifndef GB_HDF_HDF_RECORD_H
#define GB_HDF_HDF_RECORD_H

#include "base/record.h"
#include "hdf/hdf.h"

/* Writes a record to an HDF5 file.  Its items become the datasets
 * /checkpoint/PART/NAME, with numbers of a struct as one row and the unit as an
 * attribute. checkpoint_layout and checkpoint_hash are attributes of the root. */
bool gb_hdf_record_put(struct gb_hdf *file, const struct gb_record *record,
                       struct gb_error *err);

/* Reads the record of the state file at path.  Errors name the path: GB_ERR_MACHINE if
 * it cannot be opened; GB_ERR_INPUT for a file without a checkpoint, with another
 * layout, or damaged. */
bool gb_hdf_record_read(struct gb_record *record, const char *path, struct gb_error *err);

#endif
