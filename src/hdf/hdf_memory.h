#ifndef GB_HDF_HDF_MEMORY_H
#define GB_HDF_HDF_MEMORY_H

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>

/* An HDF5 file that is built in memory and outlives its close. */
struct gb_hdf_memory {
    void *image; /* after H5Fclose: the finished file, to be freed by the owner */
};

/* Is there memory for what HDF5 allocates in small pieces?  Where one of those fails it
 * ends the program or crashes, so that large pieces are refused before. */
bool gb_hdf_memory_left(void);

/* A new file that will go to path; negative when there is no memory.  Format 1.8:
 * checksummed headers, read by every h5py.  No times: equal packings make equal files.
 * memory must stay where it is until H5Fclose. */
hid_t gb_hdf_memory_create(struct gb_hdf_memory *memory, const char *path);

/* Bytes of the finished file. */
size_t gb_hdf_memory_size(const struct gb_hdf_memory *memory);

#endif
