#define _GNU_SOURCE /* mremap */
#include "hdf/hdf_memory.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/file.h"

enum { IMAGE_STEP = 1 << 20 }; /* growth of the image */
enum { MARGIN = 8 << 20 };     /* left for small pieces */

/* Beyond this an image is a mapped file, which grows by FILE_STEP. */
enum { IMAGE_MAX = 1 << 20, FILE_STEP = 2 << 20 };

/* Whether there is room for so much more, and for small pieces, without which HDF5 ends the
 * program.  Pages that are mapped and never written cost nothing; the heap may fill what it
 * hands out (MALLOC_PERTURB_). */
static bool left_beside(size_t size)
{
    void *margin = mmap(NULL, size + MARGIN, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return margin != MAP_FAILED && munmap(margin, size + MARGIN) == 0;
}

bool gb_hdf_memory_left(void)
{
    return left_beside(0);
}

/* The memory of a file under construction.  H5Fget_file_image would copy it, and in 1.10
 * clears a flag of the header without renewing its checksum; so the close hands over the
 * finished image instead of freeing it. */
static void *image_malloc(size_t size, H5FD_file_image_op_t why, void *data)
{
    struct gb_hdf_memory *memory = data;
    (void)why;
    memory->room = size;
    return gb_hdf_memory_left() ? malloc(size) : NULL;
}

static void *grow_memory(struct gb_hdf_memory *memory, void *image, size_t size)
{
    if (!left_beside(size)) {
        return NULL;
    }
    memory->room = size;
    return realloc(image, size);
}

/* Blocks of the disk for the whole image: a write to a page without one is a signal, not
 * an error. */
static bool reserve_blocks(struct gb_hdf_memory *memory, size_t from, size_t to)
{
    int why = gb_file_may_write() ? EINTR : ENOSPC;
    while (why == EINTR) {
        why = posix_fallocate(memory->fd, (off_t)from, (off_t)(to - from));
    }
    memory->fault = why;
    return why == 0;
}

static size_t file_room(size_t size)
{
    return (size + FILE_STEP - 1) / FILE_STEP * FILE_STEP;
}

/* No temporary file, or none that can be mapped. */
static void *give_up_file(struct gb_hdf_memory *memory)
{
    memory->fault = 0;
    if (memory->fd >= 0) {
        (void)unlink(memory->name);
        (void)close(memory->fd);
    }
    g_free(memory->name);
    memory->name = NULL;
    memory->fd = -1;
    return NULL;
}

/* The image moves into a temporary file; NULL: it stays in memory. */
static void *move_to_file(struct gb_hdf_memory *memory, void *image, size_t size)
{
    const size_t room = file_room(size);
    if (!left_beside(room)) {
        return NULL;
    }
    memory->name = g_strdup_printf("%s.XXXXXX", memory->path);
    memory->fd = g_mkstemp_full(memory->name, O_RDWR | O_CLOEXEC, 0666);
    if (memory->fd < 0 || !reserve_blocks(memory, 0, room)) {
        return give_up_file(memory);
    }
    void *mapped = mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_SHARED, memory->fd, 0);
    if (mapped == MAP_FAILED) { /* some file systems of networks */
        return give_up_file(memory);
    }
    if (image != NULL) {
        memcpy(mapped, image, memory->room);
        free(image);
    }
    memory->mapped = mapped;
    memory->room = room;
    return mapped;
}

static void *grow_file(struct gb_hdf_memory *memory, size_t size)
{
    const size_t room = file_room(size);
    if (room > memory->room) {
        if (!left_beside(room - memory->room) ||
            !reserve_blocks(memory, memory->room, room)) {
            return NULL; /* with a fault */
        }
        void *mapped = mremap(memory->mapped, memory->room, room, MREMAP_MAYMOVE);
        if (mapped == MAP_FAILED) {
            return NULL;
        }
        memory->mapped = mapped;
        memory->room = room;
    }
    return memory->mapped;
}

static void *image_realloc(void *image, size_t size, H5FD_file_image_op_t why, void *data)
{
    struct gb_hdf_memory *memory = data;
    (void)why;
    if (memory->mapped != NULL) {
        return grow_file(memory, size);
    }
    void *moved = memory->path != NULL && size > IMAGE_MAX
                      ? move_to_file(memory, image, size)
                      : NULL;
    return moved != NULL ? moved : grow_memory(memory, image, size);
}

static herr_t image_free(void *image, H5FD_file_image_op_t why, void *data)
{
    struct gb_hdf_memory *memory = data;
    if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
        if (image != memory->image) {
            free(memory->image);
        }
        memory->image = image;
    } else if (image != memory->mapped) {
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

hid_t gb_hdf_memory_create(struct gb_hdf_memory *memory, const char *path,
                           enum gb_hdf_memory_end end)
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
    memory->path = end == GB_HDF_MEMORY_STORED ? path : NULL;
    memory->fd = -1;
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

void gb_hdf_memory_release(const struct gb_hdf_memory *memory)
{
    if (memory->mapped != NULL) { /* what was written is in the file */
        (void)madvise(memory->mapped, memory->room, MADV_DONTNEED);
    }
}

bool gb_hdf_memory_store(struct gb_hdf_memory *memory, struct gb_error *err)
{
    const size_t size = gb_hdf_memory_size(memory);
    if (memory->mapped == NULL) {
        return gb_file_replace(memory->path, memory->image, size, err);
    }
    gb_hdf_memory_release(memory);
    return gb_file_replace_by(memory->path, memory->name, memory->fd, size, err);
}

/* HDF5 has an image that it could not close, and may still look at it: empty memory in its
 * place, so that the disk gets its room back. */
static void leave_to_hdf5(const struct gb_hdf_memory *memory)
{
    (void)mmap(memory->mapped, memory->room, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED | MAP_NORESERVE, -1, 0);
}

void gb_hdf_memory_finish(struct gb_hdf_memory *memory)
{
    if (memory->mapped == NULL) {
        free(memory->image);
    } else {
        if (memory->image == NULL) {
            leave_to_hdf5(memory);
        } else {
            (void)munmap(memory->mapped, memory->room);
        }
        (void)give_up_file(memory);
    }
    *memory = (struct gb_hdf_memory){.fd = -1};
}
