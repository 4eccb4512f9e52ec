#ifndef GB_HDF_HDF_LIST_H
#define GB_HDF_HDF_LIST_H

#include "hdf/hdf.h"

/* Names of datasets that are not known beforehand. */
enum { GB_HDF_LIST_NAME = 64 };

struct gb_hdf_list {
    int count;
    char name[256][GB_HDF_LIST_NAME]; /* "/checkpoint/world/position" */
};

/* Is there an object of that name? */
bool gb_hdf_list_has(struct gb_hdf *file, const char *name);

/* Names of all datasets in the subgroups of a group, two levels deep.  Errors:
 * GB_ERR_INPUT for links, other objects, names too long and more than 256 of them. */
bool gb_hdf_list_read(struct gb_hdf *file, const char *group, struct gb_hdf_list *list,
                      struct gb_error *err);

/* Number type, rows and columns of a dataset; array->name is given.  The size is not yet
 * to be trusted: gb_hdf_rows checks it. */
bool gb_hdf_list_probe(struct gb_hdf *file, struct gb_hdf_array *array,
                       struct gb_error *err);

#endif
