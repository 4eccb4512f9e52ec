#include "hdf/hdf.h"

#include <errno.h>
#include <glib.h>
#include <hdf5.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/alloc.h"
#include "base/file.h"
#include "hdf/hdf_attributes.h"
#include "hdf/hdf_private.h"
#include "hdf/hdf_types.h"

/* Largest ratio of deflate: a dataset that claims to be larger is damaged, and allocating
 * it would let a small file exhaust the memory. */
static const double packing_limit = 1032.0;

/* Many builds of HDF5 may only be called by one thread at a time: a thread has it for as long
 * as it has a file. */
static pthread_mutex_t one_thread;
static pthread_once_t prepared = PTHREAD_ONCE_INIT;

/* One thread may have several files. */
static void make_lock(void)
{
    pthread_mutexattr_t kind;
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
    pthread_mutex_init(&one_thread, &kind);
    pthread_mutexattr_destroy(&kind);
}

/* Around fork: no other thread is inside HDF5, whose state the child inherits.  The mutex of
 * the child has an owner that does not exist there. */
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

static struct gb_hdf *wrap(const char *path, struct gb_error *err)
{
    struct gb_hdf *file = gb_alloc_array(1, sizeof *file, err);
    if (file != NULL) {
        pthread_once(&prepared, prepare);
        pthread_mutex_lock(&one_thread);
        file->locked = true;
        gb_hdf_mute();
        file->file = H5I_INVALID_HID;
        file->path = g_strdup(path);
    }
    return file;
}

/* HDF5 is called no more for this file. */
static void unlock(struct gb_hdf *file)
{
    if (file->locked) {
        file->locked = false;
        pthread_mutex_unlock(&one_thread);
    }
}

void gb_hdf_skip_exit(void)
{
    (void)H5dont_atexit();
}

static bool create(struct gb_hdf **out, const char *path, enum gb_hdf_memory_end end,
                   struct gb_error *err)
{
    if (!gb_hdf_memory_left()) {
        *out = NULL;
        return gb_error_set(err, GB_ERR_MEMORY, "%s: out of memory for a state", path);
    }
    *out = wrap(path, err);
    if (*out == NULL) {
        return false;
    }
    (*out)->file = gb_hdf_memory_create(&(*out)->memory, (*out)->path, end);
    if ((*out)->file < 0) {
        gb_hdf_unwritten(*out, "/", err);
        gb_hdf_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

bool gb_hdf_create(struct gb_hdf **out, const char *path, struct gb_error *err)
{
    *out = NULL;
    return gb_file_check_target(path, err) &&
           create(out, path, GB_HDF_MEMORY_STORED, err);
}

bool gb_hdf_create_image(struct gb_hdf **out, const char *name, struct gb_error *err)
{
    return create(out, name, GB_HDF_MEMORY_STAYS, err);
}

bool gb_hdf_store(struct gb_hdf *file, struct gb_error *err)
{
    gb_hdf_mute();
    const bool flushed = H5Fflush(file->file, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(file->file) >= 0;
    file->file = H5I_INVALID_HID;
    if (!flushed || !closed || file->memory.image == NULL) {
        return gb_hdf_unwritten(file, "/", err);
    }
    unlock(file); /* a slow disk makes no other thread wait */
    return gb_hdf_memory_store(&file->memory, err);
}

bool gb_hdf_open(struct gb_hdf **out, const char *path, struct gb_error *err)
{
    struct stat info;
    *out = NULL;
    /* A pipe or a device would block the open for ever. */
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
    /* No lock: a state is only ever replaced as a whole, and network file systems refuse
     * locks. */
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
        gb_hdf_mute();
        H5Fclose(file->file);
    }
    unlock(file);
    gb_hdf_memory_finish(&file->memory);
    g_free(file->path);
    gb_alloc_free(file);
}

/* Rows begin .. end - 1 of a dataset. */
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
        H5Dwrite(set, gb_hdf_types_memory(array->type), from, to, H5P_DEFAULT, data) >= 0;
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
    return (size_t)array->columns * gb_hdf_types_bytes(array->type);
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
        return H5Dwrite(set, gb_hdf_types_memory(array->type), H5S_ALL, H5S_ALL,
                        H5P_DEFAULT, rows.at(rows.data, 0, array->rows)) >= 0;
    }
    for (int64_t at = 0; at < array->rows && done; at += slab) {
        const int64_t end = at + slab < array->rows ? at + slab : array->rows;
        done = write_rows(set, array, at, end, rows.at(rows.data, at, end));
        gb_hdf_memory_release(&file->memory);
    }
    return done;
}

bool gb_hdf_put_rows(struct gb_hdf *file, const struct gb_hdf_array *array,
                     struct gb_hdf_rows rows, struct gb_error *err)
{
    if (!gb_hdf_memory_left()) { /* others have taken it since the file was made */
        return gb_error_set(err, GB_ERR_MEMORY, "%s: out of memory for a state",
                            file->path);
    }
    gb_hdf_mute();
    const hsize_t shape[2] = {(hsize_t)array->rows, (hsize_t)array->columns};
    const int rank = array->columns > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, shape, NULL);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_obj_track_times(create, false);
    H5Pset_create_intermediate_group(link, 1);
    const hid_t set = H5Dcreate2(file->file, array->name, gb_hdf_types_file(array->type),
                                 space, link, create, H5P_DEFAULT);
    bool done = set >= 0 && gb_hdf_attributes_add_text(set, "unit", array->unit);
    if (done && array->rows > 0) {
        done = write_array(file, set, array, rows);
        gb_hdf_memory_release(&file->memory);
    }
    if (set >= 0) {
        done = H5Dclose(set) >= 0 && done;
    }
    H5Pclose(link);
    H5Pclose(create);
    H5Sclose(space);
    return done || gb_hdf_unwritten(file, array->name, err);
}

/* Rows of an array in memory. */
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

/* What is wrong with the way the data of a dataset is kept, or NULL. */
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
    } else if (!gb_hdf_types_fit(type, array->type)) {
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

/* Opens a dataset of this very file whose type and columns fit; negative on error. */
static hid_t open_set(struct gb_hdf *file, const struct gb_hdf_array *array,
                      int64_t *rows, struct gb_error *err)
{
    H5L_info_t link;
    if (H5Lget_info(file->file, array->name, &link, H5P_DEFAULT) < 0) {
        gb_hdf_broken(file, array->name, "is missing", err);
        return H5I_INVALID_HID;
    }
    if (link.type != H5L_TYPE_HARD) {
        gb_hdf_broken(file, array->name, "is a link", err);
        return H5I_INVALID_HID;
    }
    const hid_t set = H5Dopen2(file->file, array->name, H5P_DEFAULT);
    if (set < 0) {
        gb_hdf_broken(file, array->name, "is not a dataset", err);
        return H5I_INVALID_HID;
    }
    const char *fault = shape_fault(set, array, rows);
    if (fault != NULL) {
        gb_hdf_broken(file, array->name, fault, err);
        H5Dclose(set);
        return H5I_INVALID_HID;
    }
    return set;
}

bool gb_hdf_rows(struct gb_hdf *file, const struct gb_hdf_array *array, int64_t *rows,
                 struct gb_error *err)
{
    gb_hdf_mute();
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
    gb_hdf_mute();
    int64_t rows = 0;
    const hid_t set = open_set(file, array, &rows, err);
    if (set < 0) {
        return false;
    }
    bool done = rows == array->rows;
    if (!done) {
        gb_error_set(err, GB_ERR_INPUT, "%s: %s: has %lld rows instead of %lld",
                     file->path, array->name, (long long)rows, (long long)array->rows);
    } else if (rows > 0 && H5Dread(set, gb_hdf_types_memory(array->type), H5S_ALL,
                                   H5S_ALL, H5P_DEFAULT, data) < 0) {
        done = gb_hdf_broken(file, array->name, "cannot be read (damaged?)", err);
    }
    H5Dclose(set);
    return done;
}
