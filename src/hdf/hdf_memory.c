#include "hdf/hdf_memory.h"

#include <glib.h>
#include <stdlib.h>
#include <string.h>

enum { IMAGE_STEP = 1 << 20 }; /* growth of the image */
enum { MARGIN = 8 << 20 };     /* left for small pieces */

bool gb_hdf_memory_left(void)
{
    void *volatile margin = malloc(MARGIN); /* volatile: or compilers leave both out */
    free(margin);
    return margin != NULL;
}

/* The memory of a file under construction.  H5Fget_file_image would copy it, and in 1.10
 * clears a flag of the header without renewing its checksum; so the close hands over the
 * finished image instead of freeing it. */
static void *image_malloc(size_t size, H5FD_file_image_op_t why, void *data)
{
    (void)why;
    (void)data;
    return gb_hdf_memory_left() ? malloc(size) : NULL;
}

static void *image_realloc(void *image, size_t size, H5FD_file_image_op_t why, void *data)
{
    (void)why;
    (void)data;
    void *volatile larger = malloc(size > MARGIN ? size + MARGIN : MARGIN);
    if (larger == NULL) {
        return NULL;
    }
    free(larger);
    return realloc(image, size);
}

static herr_t image_free(void *image, H5FD_file_image_op_t why, void *data)
{
    struct gb_hdf_memory *memory = data;
    if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
        free(memory->image);
        memory->image = image;
    } else {
        free(image);
    }
    return 0;
}

static void *same_data(void *data)
{
    return data;
}

static herr_t keep_data(void *data)
{
    (void)data;
    return 0;
}

hid_t gb_hdf_memory_create(struct gb_hdf_memory *memory, const char *path)
{
    H5FD_file_image_callbacks_t calls = {.image_malloc = image_malloc,
                                         .image_realloc = image_realloc,
                                         .image_free = image_free,
                                         .udata_copy = same_data,
                                         .udata_free = keep_data,
                                         .udata = memory};
    /* HDF5 reads a file of that name if there is one, and distinguishes files in memory
     * by their names only */
    char *name = g_strdup_printf("%s.%p.memory", path, (void *)memory);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    const hid_t create = H5Pcreate(H5P_FILE_CREATE);
    hid_t id = H5I_INVALID_HID;
    if (H5Pset_fapl_core(access, IMAGE_STEP, false) >= 0 &&
        H5Pset_file_image_callbacks(access, &calls) >= 0 &&
        H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0 &&
        H5Pset_obj_track_times(create, false) >= 0) {
        id = H5Fcreate(name, H5F_ACC_TRUNC, create, access);
    }
    H5Pclose(create);
    H5Pclose(access);
    g_free(name);
    return id;
}

/* Size of a finished image.  Known only after the close, which gives back spare room at
 * the end; it is the end-of-file address in the header (format 1.8: superblock 2, byte
 * 28). */
size_t gb_hdf_memory_size(const struct gb_hdf_memory *memory)
{
    uint64_t size = 0;
    memcpy(&size, (const char *)memory->image + 28, sizeof size);
    return (size_t)GUINT64_FROM_LE(size);
}
