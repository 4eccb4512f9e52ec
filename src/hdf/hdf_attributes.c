/* Attributes of the root group, declared in hdf.h. */
#include "hdf/hdf_attributes.h"

#include <glib.h>
#include <string.h>

#include "hdf/hdf_private.h"
#include "hdf/hdf_types.h"

enum { TEXT_MAX = 4096 }; /* longest text attribute that is read */

bool gb_hdf_attributes_add_text(hid_t object, const char *name, const char *text)
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

bool gb_hdf_attributes_put_numbers(struct gb_hdf *file, const char *name,
                                   enum gb_hdf_type type, int count, const void *data,
                                   struct gb_error *err)
{
    gb_hdf_mute();
    const hsize_t shape = (hsize_t)count;
    const hid_t space =
        count > 1 ? H5Screate_simple(1, &shape, NULL) : H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(file->file, name, gb_hdf_types_file(type), space,
                                       H5P_DEFAULT, H5P_DEFAULT);
    const bool done =
        attribute >= 0 && H5Awrite(attribute, gb_hdf_types_memory(type), data) >= 0;
    if (attribute >= 0) {
        H5Aclose(attribute);
    }
    H5Sclose(space);
    return done || gb_hdf_unwritten(file, name, err);
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

bool gb_hdf_attributes_get_numbers(struct gb_hdf *file, const char *name,
                                   enum gb_hdf_type type, int count, void *data,
                                   struct gb_error *err)
{
    gb_hdf_mute();
    hid_t id[3];
    const char *fault = NULL;
    if (!open_attribute(file, name, id)) {
        fault = "is missing";
    } else if (!gb_hdf_types_fit(id[1], type)) {
        fault = "has another number type";
    } else if (H5Sget_simple_extent_npoints(id[2]) != count) {
        fault = "has another length";
    } else if (H5Aread(id[0], gb_hdf_types_memory(type), data) < 0) {
        fault = "cannot be read";
    }
    close_attribute(id);
    return fault == NULL || gb_hdf_broken(file, name, fault, err);
}

bool gb_hdf_attributes_put_text(struct gb_hdf *file, const char *name, const char *text,
                                struct gb_error *err)
{
    gb_hdf_mute();
    return gb_hdf_attributes_add_text(file->file, name, text) ||
           gb_hdf_unwritten(file, name, err);
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

bool gb_hdf_attributes_get_text(struct gb_hdf *file, const char *name, char *text,
                                size_t size, struct gb_error *err)
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
    return fault == NULL || gb_hdf_broken(file, name, fault, err);
}
