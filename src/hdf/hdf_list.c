#include "hdf/hdf_list.h"

#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "hdf/hdf_private.h"

enum { DEEPEST = 2 };

static bool refuse(const struct gb_hdf *file, const char *name, const char *what,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: %s", file->path, name, what);
}

bool gb_hdf_list_has(struct gb_hdf *file, const char *name)
{
    gb_hdf_mute();
    return H5Lexists(file->file, name, H5P_DEFAULT) > 0;
}

/* What the object of that name is; H5I_BADID for what is not of this very file. */
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
                               : refuse(file, name, "is a group too deep", err);
    case H5I_DATASET:
        if (list->count == most) {
            return refuse(file, name, "is one array too many", err);
        }
        g_strlcpy(list->name[list->count++], name, GB_HDF_LIST_NAME);
        return true;
    default:
        return refuse(file, name, "is neither a group nor a dataset", err);
    }
}

static bool read_group(struct gb_hdf *file, const char *group, int depth,
                       struct gb_hdf_list *list, struct gb_error *err)
{
    H5G_info_t info;
    if (kind_of(file, group) != H5I_GROUP ||
        H5Gget_info_by_name(file->file, group, &info, H5P_DEFAULT) < 0) {
        return refuse(file, group, "is not a group", err);
    }
    /* in the order of the file: sorted by name HDF5 1.10 frees what it has not read when
     * a group claims more names than it has */
    for (hsize_t k = 0; k < info.nlinks; k++) {
        char child[GB_HDF_LIST_NAME], name[2 * GB_HDF_LIST_NAME];
        const ssize_t length =
            H5Lget_name_by_idx(file->file, group, H5_INDEX_NAME, H5_ITER_NATIVE, k, child,
                               sizeof child, H5P_DEFAULT);
        if (length <= 0 || (size_t)length >= sizeof child) {
            return refuse(file, group, "has a name that is too long", err);
        }
        snprintf(name, sizeof name, "%s/%s", group, child);
        if (strlen(name) >= GB_HDF_LIST_NAME) {
            return refuse(file, name, "has a name that is too long", err);
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
    gb_hdf_mute();
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
    gb_hdf_mute();
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
    return fits || refuse(file, array->name, "is no table of numbers", err);
}
