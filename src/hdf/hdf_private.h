#ifndef GB_HDF_HDF_PRIVATE_H
#define GB_HDF_HDF_PRIVATE_H

#include <glib.h>
#include <hdf5.h>

#include "hdf/hdf.h"
#include "hdf/hdf_memory.h"

/* The inside of gb_hdf, for the files of this folder; owner: hdf.c. */
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

static inline bool gb_hdf_broken(const struct gb_hdf *file, const char *name,
                                 const char *what, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: %s", file->path, name, what);
}

static inline bool gb_hdf_unwritten(const struct gb_hdf *file, const char *name,
                                    struct gb_error *err)
{
    if (file->memory.fault != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", file->path,
                            g_strerror(file->memory.fault));
    }
    return gb_error_set(err, GB_ERR_MEMORY, "%s: %s: HDF5 cannot hold it in memory",
                        file->path, name);
}

#endif
