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
#include "hdf/hdf_private.h"

enum { TEXT_MAX = 4096 }; /* longest text attribute that is read */

/* Largest ratio of deflate: a dataset that claims to be larger is damaged, and allocating
 * it would let a small file exhaust the memory. */
static const double packing_limit = 1032.0;

static hid_t memory_type(enum gb_hdf_type type)
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
    default:
        return H5T_NATIVE_UINT8;
    }
}

static hid_t file_type(enum gb_hdf_type type)
{
    switch (type) {
    case GB_HDF_DOUBLE:
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

static bool broken(const struct gb_hdf *file, const char *name, const char *what,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: %s", file->path, name, what);
}

static bool unwritten(const struct gb_hdf *file, const char *name, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MEMORY, "%s: %s: HDF5 cannot hold it in memory",
                        file->path, name);
}

/* Many builds of HDF5 may only be called by one thread at a time: a thread has it for as long
 * as it has a file. */
static pthread_mutex_t one_thread;
static pthread_once_t prepared = PTHREAD_ONCE_INIT;

/* One thread may have several files. */
static void prepare(void)
{
    pthread_mutexattr_t kind;
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
    pthread_mutex_init(&one_thread, &kind);
    pthread_mutexattr_destroy(&kind);
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

bool gb_hdf_create(struct gb_hdf **out, const char *path, struct gb_error *err)
{
    if (!gb_hdf_memory_left()) {
        *out = NULL;
        return gb_error_set(err, GB_ERR_MEMORY, "%s: out of memory for a state", path);
    }
    *out = gb_file_check_target(path, err) ? wrap(path, err) : NULL;
    if (*out == NULL) {
        return false;
    }
    (*out)->file = gb_hdf_memory_create(&(*out)->memory, path);
    if ((*out)->file < 0) {
        unwritten(*out, "/", err);
        gb_hdf_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

bool gb_hdf_store(struct gb_hdf *file, struct gb_error *err)
{
    gb_hdf_mute();
    const bool flushed = H5Fflush(file->file, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(file->file) >= 0;
    file->file = H5I_INVALID_HID;
    if (!flushed || !closed || file->memory.image == NULL) {
        return unwritten(file, "/", err);
    }
    unlock(file); /* a slow disk makes no other thread wait */
    return gb_file_replace(file->path, file->memory.image,
                           gb_hdf_memory_size(&file->memory), err);
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
    free(file->memory.image);
    g_free(file->path);
    gb_alloc_free(file);
}

/* A text attribute of fixed length on any object. */
static bool put_text_on(hid_t object, const char *name, const char *text)
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

bool gb_hdf_put_array(struct gb_hdf *file, const struct gb_hdf_array *array,
                      const void *data, struct gb_error *err)
{
    gb_hdf_mute();
    const hsize_t shape[2] = {(hsize_t)array->rows, (hsize_t)array->columns};
    const int rank = array->columns > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, shape, NULL);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t link = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_obj_track_times(create, false);
    H5Pset_create_intermediate_group(link, 1);
    const hid_t set = H5Dcreate2(file->file, array->name, file_type(array->type), space,
                                 link, create, H5P_DEFAULT);
    bool done = set >= 0 && put_text_on(set, "unit", array->unit);
    if (done && array->rows > 0) {
        done = H5Dwrite(set, memory_type(array->type), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                        data) >= 0;
    }
    if (set >= 0) {
        done = H5Dclose(set) >= 0 && done;
    }
    H5Pclose(link);
    H5Pclose(create);
    H5Sclose(space);
    return done || unwritten(file, array->name, err);
}

/* Same class, size and sign as in written files; HDF5 converts the byte order. */
static bool type_fits(hid_t type, enum gb_hdf_type wanted)
{
    const hid_t model = file_type(wanted);
    const H5T_class_t class = H5Tget_class(type);
    return class == H5Tget_class(model) && H5Tget_size(type) == H5Tget_size(model) &&
           (class != H5T_INTEGER || H5Tget_sign(type) == H5Tget_sign(model));
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
    return stored * packing_limit < bytes ? "is shorter than it says" : NULL;
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
    } else if (!type_fits(type, array->type)) {
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
    } else if (rows > 0 && H5Dread(set, memory_type(array->type), H5S_ALL, H5S_ALL,
                                   H5P_DEFAULT, data) < 0) {
        done = broken(file, array->name, "cannot be read (damaged?)", err);
    }
    H5Dclose(set);
    return done;
}

bool gb_hdf_put_numbers(struct gb_hdf *file, const char *name, enum gb_hdf_type type,
                        int count, const void *data, struct gb_error *err)
{
    gb_hdf_mute();
    const hsize_t shape = (hsize_t)count;
    const hid_t space =
        count > 1 ? H5Screate_simple(1, &shape, NULL) : H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(file->file, name, file_type(type), space, H5P_DEFAULT, H5P_DEFAULT);
    const bool done = attribute >= 0 && H5Awrite(attribute, memory_type(type), data) >= 0;
    if (attribute >= 0) {
        H5Aclose(attribute);
    }
    H5Sclose(space);
    return done || unwritten(file, name, err);
}

/* Opens an attribute, its type and its space; false when one is missing. */
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
    gb_hdf_mute();
    hid_t id[3];
    const char *fault = NULL;
    if (!open_attribute(file, name, id)) {
        fault = "is missing";
    } else if (!type_fits(id[1], type)) {
        fault = "has another number type";
    } else if (H5Sget_simple_extent_npoints(id[2]) != count) {
        fault = "has another length";
    } else if (H5Aread(id[0], memory_type(type), data) < 0) {
        fault = "cannot be read";
    }
    close_attribute(id);
    return fault == NULL || broken(file, name, fault, err);
}

bool gb_hdf_put_text(struct gb_hdf *file, const char *name, const char *text,
                     struct gb_error *err)
{
    gb_hdf_mute();
    return put_text_on(file->file, name, text) || unwritten(file, name, err);
}

/* A title ends up in terminals and captions: no escape sequences, whole characters only.
 */
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
    gb_hdf_mute();
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
