#ifndef GB_HDF_HDF_PRIVATE_H
#define GB_HDF_HDF_PRIVATE_H

#include <hdf5.h>

#include "hdf/hdf.h"
#include "hdf/hdf_memory.h"

/* The inside of gb_hdf, for hdf.c (owner) and hdf_list.c. */
struct gb_hdf {
    hid_t file;
    char *path;
    struct gb_hdf_memory memory; /* of a file under construction */
    bool locked;                 /* its thread is the one that may call HDF5 */
};

/* HDF5 prints its error stack to stderr unless told otherwise.  The setting belongs to the
 * calling thread: every entry point sets it. */
static inline void gb_hdf_mute(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

#endif
