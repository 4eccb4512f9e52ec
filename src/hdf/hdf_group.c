#include "hdf/hdf_group.h"

#include <string.h>

#include "hdf/hdf_private.h"

static bool unwritten(const struct gb_hdf *file, const char *name, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MEMORY, "%s: %s: out of memory", file->path, name);
}

bool gb_hdf_group_create(struct gb_hdf *file, const char *group, struct gb_error *err)
{
    gb_hdf_mute();
    const hid_t create = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(create, false);
    const hid_t id = H5Gcreate2(file->file, group, H5P_DEFAULT, create, H5P_DEFAULT);
    H5Pclose(create);
    return (id >= 0 && H5Gclose(id) >= 0) || unwritten(file, group, err);
}

/* An attribute of that type and space; closes both. */
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
    return done || unwritten(file, name, err);
}

bool gb_hdf_group_numbers(struct gb_hdf *file, const char *group, const char *name,
                          int count, const int64_t *numbers, struct gb_error *err)
{
    gb_hdf_mute();
    const hsize_t shape = (hsize_t)count;
    return put(file, group, name, H5T_STD_I64LE, H5Screate_simple(1, &shape, NULL),
               H5T_NATIVE_INT64, numbers, err);
}

bool gb_hdf_group_text(struct gb_hdf *file, const char *group, const char *name,
                       const char *text, struct gb_error *err)
{
    gb_hdf_mute();
    const hid_t type = H5Tcopy(H5T_C_S1);
    /* ParaView 5.11 knows no type with a byte behind it; HDF5 has no text of no bytes */
    H5Tset_size(type, text[0] != '\0' ? strlen(text) : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const bool done =
        put(file, group, name, type, H5Screate(H5S_SCALAR), type, text, err);
    H5Tclose(type);
    return done;
}

bool gb_hdf_group_image(struct gb_hdf *file, GString *bytes, struct gb_error *err)
{
    gb_hdf_mute();
    const bool flushed = H5Fflush(file->file, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(file->file) >= 0;
    file->file = H5I_INVALID_HID;
    if (!flushed || !closed || file->memory.image == NULL) {
        return unwritten(file, "/", err);
    }
    g_string_append_len(bytes, file->memory.image,
                        (gssize)gb_hdf_memory_size(&file->memory));
    return true;
}
