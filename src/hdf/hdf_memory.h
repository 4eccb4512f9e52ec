#ifndef GB_HDF_HDF_MEMORY_H
#define GB_HDF_HDF_MEMORY_H

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* An HDF5 file that is built in memory and outlives its close.  A large one is built in the
 * mapped temporary file that will replace the target: HDF5 sees memory either way and meets
 * no error of a disk, but only the pages in use are resident. */
struct gb_hdf_memory {
    const char *path; /* of the target; NULL: none, the image stays in memory */
    void *image;      /* after H5Fclose: the finished file */
    void *mapped;     /* image of the temporary file; NULL: it is memory */
    size_t room;      /* bytes of the image */
    char *name;       /* of the temporary file */
    int fd;
    int fault; /* errno where the temporary file could not be made or grow */
};

/* Is there memory for what HDF5 allocates in small pieces?  Where one of those fails it
 * ends the program or crashes, so that large pieces are refused before. */
bool gb_hdf_memory_left(void);

/* A new file that will go to path, or (GB_HDF_MEMORY_STAYS) nowhere; negative when there is no
 * memory.  Format 1.8:
 * checksummed headers, read by every h5py.  No times: equal packings make equal files.
 * memory and path must stay where they are until gb_hdf_memory_finish. */
enum gb_hdf_memory_end { GB_HDF_MEMORY_STORED, GB_HDF_MEMORY_STAYS };
hid_t gb_hdf_memory_create(struct gb_hdf_memory *memory, const char *path,
                           enum gb_hdf_memory_end end);

/* Bytes of the finished file. */
size_t gb_hdf_memory_size(const struct gb_hdf_memory *memory);

/* Between two calls of HDF5: no page of a mapped image is resident. */
void gb_hdf_memory_release(const struct gb_hdf_memory *memory);

/* The finished file to its path.  Errors as those of gb_file_replace. */
bool gb_hdf_memory_store(struct gb_hdf_memory *memory, struct gb_error *err);

/* Frees the image, and the temporary file if it was not stored. */
void gb_hdf_memory_finish(struct gb_hdf_memory *memory);

#endif
