#ifndef GB_HDF_HDF_TYPES_H
#define GB_HDF_HDF_TYPES_H

#include <hdf5.h>
#include <stdbool.h>

#include "hdf/hdf.h"

/* HDF5's name of a number type in memory, and in files: little-endian on any machine. */
hid_t gb_hdf_types_memory(enum gb_hdf_type type);
hid_t gb_hdf_types_file(enum gb_hdf_type type);

/* Bytes of a number in memory. */
size_t gb_hdf_types_bytes(enum gb_hdf_type type);

/* Same class, size and sign as in written files; HDF5 converts the byte order. */
bool gb_hdf_types_fit(hid_t type, enum gb_hdf_type wanted);

#endif
