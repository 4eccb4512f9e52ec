#define _GNU_SOURCE /* mremap */
#include "hdf/hdf.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <hdf5.h>
#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/file.h"
#include "greenbody/status.h"

/* An HDF5 file that is built in memory and remains after H5Fclose.  A large file is
 * built in a mapped temporary file, which will replace the target.  HDF5 sees memory in
 * both cases and meets no disk errors, but only the pages in use are resident. */
struct image {
    const char *path; /* the target; NULL: none, the image stays in memory */
    void *image;      /* the finished file, after H5Fclose */
    void *mapped;     /* mapping of the temporary file; NULL: the image is in memory */
    size_t room;      /* allocated bytes */
    char *name;       /* of the temporary file */
    int fd;
    int fault; /* errno if the temporary file could not be created or extended */
};

struct gb_hdf {
    hid_t file;
    char *path;
    struct image memory; /* of a file under construction */
    bool locked;         /* its thread holds the HDF5 lock */
};

/* Largest ratio of deflate.  A dataset that claims more is damaged; allocating its
 * memory would let a small file exhaust the memory. */
static const double packing_limit = 1032.0;

enum image_end { IMAGE_STORED, IMAGE_STAYS };

/* Order of this file: the image of a file being written, number types, the lock,
 * opening and closing, attributes of the root, datasets, lists of datasets, groups. */

enum { IMAGE_STEP = 1 << 20 }; /* growth of the image */
enum { MARGIN = 8 << 20 };     /* reserve for small allocations */

/* Larger images are mapped files, which grow by FILE_STEP. */
enum { IMAGE_MAX = 1 << 20, FILE_STEP = 2 << 20 };

/* Is there memory for `size` more bytes and for the small allocations of HDF5?  The
 * test maps pages and never writes them, which is free; with malloc, MALLOC_PERTURB_
 * would fill them. */
static bool left_beside(size_t size)
{
    void *margin = mmap(NULL, size + MARGIN, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return margin != MAP_FAILED && munmap(margin, size + MARGIN) == 0;
}

/* Is there memory for the small allocations of HDF5?  If one of them fails, HDF5 aborts
 * or crashes, so large allocations are refused in advance. */
static bool image_left(void)
{
    return left_beside(0);
}

/* Allocates the memory of a file being written.  H5Fget_file_image would copy it, and
 * in version 1.10 changes a flag of the header without updating its checksum.  Instead
 * H5Fclose hands over the finished image through these callbacks. */
static void *image_malloc(size_t size, H5FD_file_image_op_t why, void *data)
{
    struct image *memory = data;
    (void)why;
    memory->room = size;
    return image_left() ? malloc(size) : NULL;
}

static void *grow_memory(struct image *memory, void *image, size_t size)
{
    if (!left_beside(size)) {
        return NULL;
    }
    memory->room = size;
    return realloc(image, size);
}

/* Reserves disk blocks for the whole image: a write to a mapped page without a block
 * would raise a signal instead of an error. */
static bool reserve_blocks(struct image *memory, size_t from, size_t to)
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

/* Falls back to memory: the temporary file could not be created or mapped. */
static void *give_up_file(struct image *memory)
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

/* Moves the image to a temporary file; NULL: it stays in memory. */
static void *move_to_file(struct image *memory, void *image, size_t size)
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
    if (mapped == MAP_FAILED) { /* on some network file systems */
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

static void *grow_file(struct image *memory, size_t size)
{
    const size_t room = file_room(size);
    if (room > memory->room) {
        if (!left_beside(room - memory->room) ||
            !reserve_blocks(memory, memory->room, room)) {
            return NULL; /* memory->fault is set */
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
    struct image *memory = data;
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
    struct image *memory = data;
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

/* Creates a file for path, or with IMAGE_STAYS one that is not stored.  Negative: out
 * of memory.  Format 1.8 has checksummed headers and is read by every h5py.  Objects
 * have no times, so equal packings make equal files. memory and path must not move
 * until image_finish. */
static hid_t image_create(struct image *memory, const char *path, enum image_end end)
{
    H5FD_file_image_callbacks_t calls = {.image_malloc = image_malloc,
                                         .image_realloc = image_realloc,
                                         .image_free = image_free,
                                         .udata_copy = same_data,
                                         .udata_free = keep_data,
                                         .udata = memory};
    /* HDF5 would read an existing file of this name, and distinguishes files in memory
     * only by name */
    char *name = g_strdup_printf("%s.%p.memory", path, (void *)memory);
    memory->path = end == IMAGE_STORED ? path : NULL;
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

/* Size of a finished image, known only after the close, which releases spare room at
 * the end.  It is the end-of-file address in the header (format 1.8: superblock 2, byte
 * 28). */
static size_t image_size(const struct image *memory)
{
    uint64_t size = 0;
    memcpy(&size, (const char *)memory->image + 28, sizeof size);
    return (size_t)GUINT64_FROM_LE(size);
}

/* Drops the resident pages of a mapped image between two calls of HDF5. */
static void image_release(const struct image *memory)
{
    if (memory->mapped != NULL) { /* written data are in the file */
        (void)madvise(memory->mapped, memory->room, MADV_DONTNEED);
    }
}

/* Stores the finished file at its path.  Errors: see gb_file_replace. */
static bool image_store(struct image *memory, struct gb_error *err)
{
    const size_t size = image_size(memory);
    if (memory->mapped == NULL) {
        return gb_file_replace(memory->path, memory->image, size, err);
    }
    image_release(memory);
    return gb_file_replace_by(memory->path, memory->name, memory->fd, size, err);
}

/* If HDF5 could not close an image it may still access it.  Maps empty memory in its
 * place, so that the disk space of the file is released. */
static void leave_to_hdf5(const struct image *memory)
{
    (void)mmap(memory->mapped, memory->room, PROT_READ | PROT_WRITE,
               MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED | MAP_NORESERVE, -1, 0);
}

/* Frees the image, and the temporary file if it was not stored. */
static void image_finish(struct image *memory)
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
    *memory = (struct image){.fd = -1};
}

/* Stops HDF5 from printing its error stack to stderr.  The setting is per thread, so
 * every entry point calls this. */
static void mute(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static bool broken(const struct gb_hdf *file, const char *name, const char *what,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: %s", file->path, name, what);
}

static bool unwritten(const struct gb_hdf *file, const char *name, struct gb_error *err)
{
    if (file->memory.fault != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", file->path,
                            g_strerror(file->memory.fault));
    }
    return gb_error_set(err, GB_ERR_MEMORY, "%s: %s: HDF5 cannot hold it in memory",
                        file->path, name);
}

static bool no_memory(const struct gb_hdf *file, const char *name, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MEMORY, "%s: %s: out of memory", file->path, name);
}

static hid_t type_memory(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_DOUBLE:
        return H5T_NATIVE_DOUBLE;
    case GB_HDF_INT32:
        return H5T_NATIVE_INT32;
    case GB_HDF_INT64:
        return H5T_NATIVE_INT64;
    case GB_HDF_UINT64:
        return H5T_NATIVE_UINT64;
    case GB_HDF_FLOAT:
        return H5T_NATIVE_FLOAT;
    default:
        return H5T_NATIVE_UINT8;
    }
}

static hid_t type_file(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_DOUBLE:
    case GB_HDF_FLOAT:
        return H5T_IEEE_F64LE;
    case GB_HDF_INT32:
        return H5T_STD_I32LE;
    case GB_HDF_INT64:
        return H5T_STD_I64LE;
    case GB_HDF_UINT64:
        return H5T_STD_U64LE;
    default:
        return H5T_STD_U8LE;
    }
}

/* Bytes per number in memory. */
static size_t type_bytes(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_INT32:
    case GB_HDF_FLOAT:
        return 4;
    case GB_HDF_UINT8:
        return 1;
    default:
        return 8;
    }
}

static bool type_fit(hid_t type, enum gb_hdf_type wanted)
{
    const hid_t model = type_file(wanted);
    const H5T_class_t class = H5Tget_class(type);
    return class == H5Tget_class(model) && H5Tget_size(type) == H5Tget_size(model) &&
           (class != H5T_INTEGER || H5Tget_sign(type) == H5Tget_sign(model));
}

/* Many builds of HDF5 allow only one thread at a time.  A thread holds this lock as
 * long as it has a file. */
static pthread_mutex_t one_thread;
static pthread_once_t prepared = PTHREAD_ONCE_INIT;

/* Recursive, because one thread may have several files. */
static void make_lock(void)
{
    pthread_mutexattr_t kind;
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
    pthread_mutex_init(&one_thread, &kind);
    pthread_mutexattr_destroy(&kind);
}

/* Around fork: waits until no other thread is inside HDF5, because the child inherits
 * its state.  The child makes a new mutex, since the owner of the inherited one does
 * not exist there. */
static void before_fork(void)
{
    pthread_mutex_lock(&one_thread);
}

static void in_parent(void)
{
    pthread_mutex_unlock(&one_thread);
}

static void prepare(void)
{
    make_lock();
    (void)pthread_atfork(before_fork, in_parent, make_lock);
}

void gb_hdf_skip_exit(void)
{
    (void)H5dont_atexit();
}

static struct gb_hdf *wrap(const char *path, struct gb_error *err)
{
    struct gb_hdf *file = gb_alloc_array(1, sizeof *file, err);
    if (file != NULL) {
        pthread_once(&prepared, prepare);
        pthread_mutex_lock(&one_thread);
        file->locked = true;
        mute();
        file->file = H5I_INVALID_HID;
        file->path = g_strdup(path);
    }
    return file;
}

/* Releases the lock after the last HDF5 call for this file. */
static void unlock(struct gb_hdf *file)
{
    if (file->locked) {
        file->locked = false;
        pthread_mutex_unlock(&one_thread);
    }
}

static bool create(struct gb_hdf **out, const char *path, enum image_end end,
                   struct gb_error *err)
{
    if (!image_left()) {
        *out = NULL;
        return gb_error_set(err, GB_ERR_MEMORY, "%s: out of memory for a state", path);
    }
    *out = wrap(path, err);
    if (*out == NULL) {
        return false;
    }
    (*out)->file = image_create(&(*out)->memory, (*out)->path, end);
    if ((*out)->file < 0) {
        unwritten(*out, "/", err);
        gb_hdf_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

bool gb_hdf_create(struct gb_hdf **out, const char *path, struct gb_error *err)
{
    *out = NULL;
    return gb_file_check_target(path, err) && create(out, path, IMAGE_STORED, err);
}

bool gb_hdf_create_image(struct gb_hdf **out, const char *name, struct gb_error *err)
{
    return create(out, name, IMAGE_STAYS, err);
}

bool gb_hdf_store(struct gb_hdf *file, struct gb_error *err)
{
    mute();
    const bool flushed = H5Fflush(file->file, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(file->file) >= 0;
    file->file = H5I_INVALID_HID;
    if (!flushed || !closed || file->memory.image == NULL) {
        return unwritten(file, "/", err);
    }
    unlock(file); /* before the write, so that a slow disk blocks no other thread */
    return image_store(&file->memory, err);
}

bool gb_hdf_open(struct gb_hdf **out, const char *path, struct gb_error *err)
{
    struct stat info;
    *out = NULL;
    /* Opening a pipe or a device could block forever. */
    if (stat(path, &info) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: %s", path, g_strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is not a regular file", path);
    }
    FILE *probe = fopen(path, "rb");
    if (probe == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: %s", path, g_strerror(errno));
    }
    fclose(probe);
    *out = wrap(path, err);
    if (*out == NULL) {
        return false;
    }
    /* No file locking: a state is only replaced as a whole, and network file systems
     * refuse locks. */
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_file_locking(access, false, true);
    (*out)->file = H5Fopen(path, H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if ((*out)->file < 0) {
        gb_error_set(err, GB_ERR_INPUT, "%s: is not a complete HDF5 file", path);
        gb_hdf_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

void gb_hdf_destroy(struct gb_hdf *file)
{
    if (file == NULL) {
        return;
    }
    if (file->file >= 0) {
        mute();
        H5Fclose(file->file);
    }
    unlock(file);
    image_finish(&file->memory);
    g_free(file->path);
    gb_alloc_free(file);
}

enum { TEXT_MAX = 4096 }; /* longest text attribute that is read */

/* Writes a text attribute of fixed length on any object. */
static bool add_text(hid_t object, const char *name, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text) + 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool done = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    if (attribute >= 0) {
        H5Aclose(attribute);
    }
    H5Sclose(space);
    H5Tclose(type);
    return done;
}

bool gb_hdf_put_numbers(struct gb_hdf *file, const char *name, enum gb_hdf_type type,
                        int count, const void *data, struct gb_error *err)
{
    mute();
    const hsize_t shape = (hsize_t)count;
    const hid_t space =
        count > 1 ? H5Screate_simple(1, &shape, NULL) : H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(file->file, name, type_file(type), space, H5P_DEFAULT, H5P_DEFAULT);
    const bool done = attribute >= 0 && H5Awrite(attribute, type_memory(type), data) >= 0;
    if (attribute >= 0) {
        H5Aclose(attribute);
    }
    H5Sclose(space);
    return done || unwritten(file, name, err);
}

/* Opens an attribute with its type and its dataspace; false if one is missing. */
static bool open_attribute(struct gb_hdf *file, const char *name, hid_t id[3])
{
    id[0] = H5Aopen(file->file, name, H5P_DEFAULT);
    id[1] = id[0] >= 0 ? H5Aget_type(id[0]) : H5I_INVALID_HID;
    id[2] = id[0] >= 0 ? H5Aget_space(id[0]) : H5I_INVALID_HID;
    return id[0] >= 0 && id[1] >= 0 && id[2] >= 0;
}

static void close_attribute(const hid_t id[3])
{
    if (id[2] >= 0) {
        H5Sclose(id[2]);
    }
    if (id[1] >= 0) {
        H5Tclose(id[1]);
    }
    if (id[0] >= 0) {
        H5Aclose(id[0]);
    }
}

bool gb_hdf_get_numbers(struct gb_hdf *file, const char *name, enum gb_hdf_type type,
                        int count, void *data, struct gb_error *err)
{
    mute();
    hid_t id[3];
    const char *fault = NULL;
    if (!open_attribute(file, name, id)) {
        fault = "is missing";
    } else if (!type_fit(id[1], type)) {
        fault = "has another number type";
    } else if (H5Sget_simple_extent_npoints(id[2]) != count) {
        fault = "has another length";
    } else if (H5Aread(id[0], type_memory(type), data) < 0) {
        fault = "cannot be read";
    }
    close_attribute(id);
    return fault == NULL || broken(file, name, fault, err);
}

bool gb_hdf_put_text(struct gb_hdf *file, const char *name, const char *text,
                     struct gb_error *err)
{
    mute();
    return add_text(file->file, name, text) || unwritten(file, name, err);
}

/* Makes a text safe for terminals and captions: no control characters, only whole
 * characters. */
static void clean_text(char *text)
{
    const char *end = NULL;
    if (!g_utf8_validate(text, -1, &end)) {
        text[end - text] = '\0';
    }
    for (char *c = text; *c != '\0'; c = g_utf8_next_char(c)) {
        const gunichar u = g_utf8_get_char(c);
        if (u < 0x20 || u == 0x7f) {
            *c = '?';
        } else if (u >= 0x80 && u < 0xa0) {
            c[0] = '?';
            c[1] = '?';
        }
    }
}

bool gb_hdf_get_text(struct gb_hdf *file, const char *name, char *text, size_t size,
                     struct gb_error *err)
{
    mute();
    hid_t id[3];
    char buffer[TEXT_MAX + 1] = "";
    const char *fault = NULL;
    if (!open_attribute(file, name, id)) {
        fault = "is missing";
    } else if (H5Tget_class(id[1]) != H5T_STRING || H5Tis_variable_str(id[1]) != 0 ||
               H5Tget_size(id[1]) > TEXT_MAX ||
               H5Sget_simple_extent_npoints(id[2]) != 1) {
        fault = "is not a short text of fixed length";
    } else if (H5Aread(id[0], id[1], buffer) < 0) {
        fault = "cannot be read";
    } else {
        g_strlcpy(text, buffer, size);
        clean_text(text);
    }
    close_attribute(id);
    return fault == NULL || broken(file, name, fault, err);
}

/* Writes rows begin .. end - 1 of a dataset. */
static bool write_rows(hid_t set, const struct gb_hdf_array *array, int64_t begin,
                       int64_t end, const void *data)
{
    const hsize_t start[2] = {(hsize_t)begin, 0};
    const hsize_t count[2] = {(hsize_t)(end - begin), (hsize_t)array->columns};
    const int rank = array->columns > 1 ? 2 : 1;
    const hid_t to = H5Dget_space(set), from = H5Screate_simple(rank, count, NULL);
    const bool done =
        to >= 0 && from >= 0 &&
        H5Sselect_hyperslab(to, H5S_SELECT_SET, start, NULL, count, NULL) >= 0 &&
        H5Dwrite(set, type_memory(array->type), from, to, H5P_DEFAULT, data) >= 0;
    if (from >= 0) {
        H5Sclose(from);
    }
    if (to >= 0) {
        H5Sclose(to);
    }
    return done;
}

size_t gb_hdf_row_bytes(const struct gb_hdf_array *array)
{
    return (size_t)array->columns * type_bytes(array->type);
}

int64_t gb_hdf_slab_rows(const struct gb_hdf_array *array)
{
    return (int64_t)(GB_HDF_SLAB / gb_hdf_row_bytes(array)) + 1;
}

static bool write_array(struct gb_hdf *file, hid_t set, const struct gb_hdf_array *array,
                        struct gb_hdf_rows rows)
{
    const int64_t slab = gb_hdf_slab_rows(array);
    bool done = true;
    if (array->rows <= slab) {
        return H5Dwrite(set, type_memory(array->type), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                        rows.at(rows.data, 0, array->rows)) >= 0;
    }
    for (int64_t at = 0; at < array->rows && done; at += slab) {
        const int64_t end = at + slab < array->rows ? at + slab : array->rows;
        done = write_rows(set, array, at, end, rows.at(rows.data, at, end));
        image_release(&file->memory);
    }
    return done;
}

bool gb_hdf_put_rows(struct gb_hdf *file, const struct gb_hdf_array *array,
                     struct gb_hdf_rows rows, struct gb_error *err)
{
    if (!image_left()) { /* memory may have been used since the file was created */
        return gb_error_set(err, GB_ERR_MEMORY, "%s: out of memory for a state",
                            file->path);
    }
    mute();
    const hsize_t shape[2] = {(hsize_t)array->rows, (hsize_t)array->columns};
    const int rank = array->columns > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, shape, NULL);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_obj_track_times(create, false);
    H5Pset_create_intermediate_group(link, 1);
    const hid_t set = H5Dcreate2(file->file, array->name, type_file(array->type), space,
                                 link, create, H5P_DEFAULT);
    bool done = set >= 0 && add_text(set, "unit", array->unit);
    if (done && array->rows > 0) {
        done = write_array(file, set, array, rows);
        image_release(&file->memory);
    }
    if (set >= 0) {
        done = H5Dclose(set) >= 0 && done;
    }
    H5Pclose(link);
    H5Pclose(create);
    H5Sclose(space);
    return done || unwritten(file, array->name, err);
}

/* An array that is completely in memory, for rows_of_whole. */
struct whole {
    const char *data;
    size_t row_bytes;
};

static const void *rows_of_whole(void *data, int64_t begin, int64_t end)
{
    const struct whole *whole = data;
    (void)end;
    return whole->data + (size_t)begin * whole->row_bytes;
}

bool gb_hdf_put_array(struct gb_hdf *file, const struct gb_hdf_array *array,
                      const void *data, struct gb_error *err)
{
    struct whole whole = {data, gb_hdf_row_bytes(array)};
    return gb_hdf_put_rows(file, array, (struct gb_hdf_rows){rows_of_whole, &whole}, err);
}

/* What is wrong with the storage of a dataset, or NULL. */
static const char *storage_fault(hid_t set, double bytes)
{
    const hid_t create = H5Dget_create_plist(set);
    if (create < 0) {
        return "cannot be read";
    }
    const bool elsewhere =
        H5Pget_external_count(create) != 0 || H5Pget_layout(create) == H5D_VIRTUAL;
    H5Pclose(create);
    if (elsewhere) {
        return "keeps its data in another file";
    }
    const double stored = (double)H5Dget_storage_size(set);
    return stored * packing_limit < bytes ? "is shorter than its header states" : NULL;
}

/* What is wrong with the type and shape of an open dataset, or NULL; sets *rows. */
static const char *shape_fault(hid_t set, const struct gb_hdf_array *array, int64_t *rows)
{
    const hid_t type = H5Dget_type(set);
    const hid_t space = H5Dget_space(set);
    const int rank = array->columns > 1 ? 2 : 1;
    hsize_t shape[2] = {0, 1};
    const char *fault = NULL;
    if (type < 0 || space < 0) {
        fault = "cannot be read";
    } else if (!type_fit(type, array->type)) {
        fault = "has another number type";
    } else if (H5Sget_simple_extent_type(space) != H5S_SIMPLE ||
               H5Sget_simple_extent_ndims(space) != rank ||
               H5Sget_simple_extent_dims(space, shape, NULL) != rank ||
               shape[1] != (hsize_t)array->columns || shape[0] > INT32_MAX) {
        fault = "has another shape";
    } else {
        *rows = (int64_t)shape[0];
        fault = storage_fault(set, (double)shape[0] * (double)shape[1] *
                                       (double)H5Tget_size(type));
    }
    if (space >= 0) {
        H5Sclose(space);
    }
    if (type >= 0) {
        H5Tclose(type);
    }
    return fault;
}

/* Opens a dataset that is in this file and has the expected type and columns; negative
 * on error. */
static hid_t open_set(struct gb_hdf *file, const struct gb_hdf_array *array,
                      int64_t *rows, struct gb_error *err)
{
    H5L_info_t link;
    if (H5Lget_info(file->file, array->name, &link, H5P_DEFAULT) < 0) {
        broken(file, array->name, "is missing", err);
        return H5I_INVALID_HID;
    }
    if (link.type != H5L_TYPE_HARD) {
        broken(file, array->name, "is a link", err);
        return H5I_INVALID_HID;
    }
    const hid_t set = H5Dopen2(file->file, array->name, H5P_DEFAULT);
    if (set < 0) {
        broken(file, array->name, "is not a dataset", err);
        return H5I_INVALID_HID;
    }
    const char *fault = shape_fault(set, array, rows);
    if (fault != NULL) {
        broken(file, array->name, fault, err);
        H5Dclose(set);
        return H5I_INVALID_HID;
    }
    return set;
}

bool gb_hdf_rows(struct gb_hdf *file, const struct gb_hdf_array *array, int64_t *rows,
                 struct gb_error *err)
{
    mute();
    const hid_t set = open_set(file, array, rows, err);
    if (set < 0) {
        return false;
    }
    H5Dclose(set);
    return true;
}

bool gb_hdf_get_array(struct gb_hdf *file, const struct gb_hdf_array *array, void *data,
                      struct gb_error *err)
{
    mute();
    int64_t rows = 0;
    const hid_t set = open_set(file, array, &rows, err);
    if (set < 0) {
        return false;
    }
    bool done = rows == array->rows;
    if (!done) {
        gb_error_set(err, GB_ERR_INPUT, "%s: %s: has %lld rows instead of %lld",
                     file->path, array->name, (long long)rows, (long long)array->rows);
    } else if (rows > 0 && H5Dread(set, type_memory(array->type), H5S_ALL, H5S_ALL,
                                   H5P_DEFAULT, data) < 0) {
        done = broken(file, array->name, "cannot be read (damaged?)", err);
    }
    H5Dclose(set);
    return done;
}

enum { DEEPEST = 2 }; /* depth of nested groups */

bool gb_hdf_list_has(struct gb_hdf *file, const char *name)
{
    mute();
    return H5Lexists(file->file, name, H5P_DEFAULT) > 0;
}

/* Type of the object with this name; H5I_BADID for links to other files. */
static H5I_type_t kind_of(const struct gb_hdf *file, const char *name)
{
    H5L_info_t link;
    if (H5Lget_info(file->file, name, &link, H5P_DEFAULT) < 0 ||
        link.type != H5L_TYPE_HARD) {
        return H5I_BADID;
    }
    const hid_t object = H5Oopen(file->file, name, H5P_DEFAULT);
    const H5I_type_t kind = object >= 0 ? H5Iget_type(object) : H5I_BADID;
    if (object >= 0) {
        H5Oclose(object);
    }
    return kind;
}

static bool read_group(struct gb_hdf *file, const char *group, int depth,
                       struct gb_hdf_list *list, struct gb_error *err);

static bool read_child(struct gb_hdf *file, const char *name, int depth,
                       struct gb_hdf_list *list, struct gb_error *err)
{
    const int most = (int)(sizeof list->name / sizeof list->name[0]);
    switch (kind_of(file, name)) {
    case H5I_GROUP:
        return depth < DEEPEST ? read_group(file, name, depth + 1, list, err)
                               : broken(file, name, "is a group too deep", err);
    case H5I_DATASET:
        if (list->count == most) {
            return broken(file, name, "is one array too many", err);
        }
        g_strlcpy(list->name[list->count++], name, GB_HDF_LIST_NAME);
        return true;
    default:
        return broken(file, name, "is neither a group nor a dataset", err);
    }
}

static bool read_group(struct gb_hdf *file, const char *group, int depth,
                       struct gb_hdf_list *list, struct gb_error *err)
{
    H5G_info_t info;
    if (kind_of(file, group) != H5I_GROUP ||
        H5Gget_info_by_name(file->file, group, &info, H5P_DEFAULT) < 0) {
        return broken(file, group, "is not a group", err);
    }
    /* in the order of the file: with sorted names HDF5 1.10 frees memory that it has
     * not read if a group claims more names than it has */
    for (hsize_t k = 0; k < info.nlinks; k++) {
        char child[GB_HDF_LIST_NAME], name[2 * GB_HDF_LIST_NAME];
        const ssize_t length =
            H5Lget_name_by_idx(file->file, group, H5_INDEX_NAME, H5_ITER_NATIVE, k, child,
                               sizeof child, H5P_DEFAULT);
        if (length <= 0 || (size_t)length >= sizeof child) {
            return broken(file, group, "has a name that is too long", err);
        }
        snprintf(name, sizeof name, "%s/%s", group, child);
        if (strlen(name) >= GB_HDF_LIST_NAME) {
            return broken(file, name, "has a name that is too long", err);
        }
        if (!read_child(file, name, depth, list, err)) {
            return false;
        }
    }
    return true;
}

bool gb_hdf_list_read(struct gb_hdf *file, const char *group, struct gb_hdf_list *list,
                      struct gb_error *err)
{
    mute();
    list->count = 0;
    return read_group(file, group, 1, list, err);
}

static bool type_of(hid_t type, enum gb_hdf_type *out)
{
    const H5T_class_t class = H5Tget_class(type);
    const size_t size = H5Tget_size(type);
    const bool is_signed = class == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_2;
    if (class == H5T_FLOAT && size == 8) {
        *out = GB_HDF_DOUBLE;
    } else if (class == H5T_INTEGER && size == 4 && is_signed) {
        *out = GB_HDF_INT32;
    } else if (class == H5T_INTEGER && size == 8) {
        *out = is_signed ? GB_HDF_INT64 : GB_HDF_UINT64;
    } else if (class == H5T_INTEGER && size == 1 && !is_signed) {
        *out = GB_HDF_UINT8;
    } else {
        return false;
    }
    return true;
}

bool gb_hdf_list_probe(struct gb_hdf *file, struct gb_hdf_array *array,
                       struct gb_error *err)
{
    mute();
    hsize_t shape[2] = {0, 1};
    const hid_t set = H5Dopen2(file->file, array->name, H5P_DEFAULT);
    const hid_t type = set >= 0 ? H5Dget_type(set) : H5I_INVALID_HID;
    const hid_t space = set >= 0 ? H5Dget_space(set) : H5I_INVALID_HID;
    const int rank = space >= 0 && H5Sget_simple_extent_type(space) == H5S_SIMPLE
                         ? H5Sget_simple_extent_ndims(space)
                         : -1;
    const bool fits = type >= 0 && type_of(type, &array->type) && rank >= 1 &&
                      rank <= 2 &&
                      H5Sget_simple_extent_dims(space, shape, NULL) == rank &&
                      shape[0] <= INT32_MAX && shape[1] >= 1 && shape[1] <= 1024;
    array->rows = (int64_t)shape[0];
    array->columns = (int)(fits ? shape[1] : 1);
    if (space >= 0) {
        H5Sclose(space);
    }
    if (type >= 0) {
        H5Tclose(type);
    }
    if (set >= 0) {
        H5Dclose(set);
    }
    return fits || broken(file, array->name, "is no table of numbers", err);
}

bool gb_hdf_group_create(struct gb_hdf *file, const char *group, struct gb_error *err)
{
    mute();
    const hid_t create = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(create, false);
    const hid_t id = H5Gcreate2(file->file, group, H5P_DEFAULT, create, H5P_DEFAULT);
    H5Pclose(create);
    return (id >= 0 && H5Gclose(id) >= 0) || no_memory(file, group, err);
}

/* Writes an attribute of this type and space; closes both. */
static bool put(struct gb_hdf *file, const char *group, const char *name, hid_t type,
                hid_t space, hid_t memory, const void *data, struct gb_error *err)
{
    const hid_t attribute = H5Acreate_by_name(file->file, group, name, type, space,
                                              H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    bool done = attribute >= 0 && H5Awrite(attribute, memory, data) >= 0;
    if (attribute >= 0) {
        done = H5Aclose(attribute) >= 0 && done;
    }
    H5Sclose(space);
    return done || no_memory(file, name, err);
}

bool gb_hdf_group_numbers(struct gb_hdf *file, const char *group, const char *name,
                          int count, const int64_t *numbers, struct gb_error *err)
{
    mute();
    const hsize_t shape = (hsize_t)count;
    return put(file, group, name, H5T_STD_I64LE, H5Screate_simple(1, &shape, NULL),
               H5T_NATIVE_INT64, numbers, err);
}

bool gb_hdf_group_text(struct gb_hdf *file, const char *group, const char *name,
                       const char *text, struct gb_error *err)
{
    mute();
    const hid_t type = H5Tcopy(H5T_C_S1);
    /* ParaView 5.11 cannot read texts with an additional byte; HDF5 has no texts of
     * length 0 */
    H5Tset_size(type, text[0] != '\0' ? strlen(text) : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const bool done =
        put(file, group, name, type, H5Screate(H5S_SCALAR), type, text, err);
    H5Tclose(type);
    return done;
}

bool gb_hdf_group_image(struct gb_hdf *file, GString *bytes, struct gb_error *err)
{
    mute();
    const bool flushed = H5Fflush(file->file, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(file->file) >= 0;
    file->file = H5I_INVALID_HID;
    if (!flushed || !closed || file->memory.image == NULL) {
        return no_memory(file, "/", err);
    }
    g_string_append_len(bytes, file->memory.image, (gssize)image_size(&file->memory));
    return true;
}
