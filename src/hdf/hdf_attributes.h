#ifndef GB_HDF_HDF_ATTRIBUTES_H
#define GB_HDF_HDF_ATTRIBUTES_H

#include <hdf5.h>
#include <stdbool.h>

/* A text attribute of fixed length on any object. */
bool gb_hdf_attributes_add_text(hid_t object, const char *name, const char *text);

#endif
