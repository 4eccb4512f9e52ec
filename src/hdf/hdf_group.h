#ifndef GB_HDF_HDF_GROUP_H
#define GB_HDF_HDF_GROUP_H

#include <glib.h>

#include "hdf/hdf.h"

/* Groups with attributes, as other programs want them, and the file as bytes. */

/* A group of the root, "/VTKHDF". */
bool gb_hdf_group_create(struct gb_hdf *file, const char *group, struct gb_error *err);

/* An attribute of a group: count numbers as an array, or a text of fixed length. */
bool gb_hdf_group_numbers(struct gb_hdf *file, const char *group, const char *name,
                          int count, const int64_t *numbers, struct gb_error *err);
bool gb_hdf_group_text(struct gb_hdf *file, const char *group, const char *name,
                       const char *text, struct gb_error *err);

/* The finished file behind what is in bytes, instead of gb_hdf_store.  After that only
 * gb_hdf_destroy may be called. */
bool gb_hdf_group_image(struct gb_hdf *file, GString *bytes, struct gb_error *err);

#endif
