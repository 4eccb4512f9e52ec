#include "hdf/hdf_record.h"

#include <stdio.h>
#include <string.h>

#include "hdf/hdf.h"

/* Increased whenever members of a record change their meaning.  Other layouts are not
 * read, because a resumed run must be the same run. */
static const int32_t layout_number = 3;

static const char group[] = "/checkpoint";

static const struct {
    enum gb_record_type record;
    enum gb_hdf_type hdf;
} types[] = {
    {GB_RECORD_DOUBLE, GB_HDF_DOUBLE},
    {GB_RECORD_INT32, GB_HDF_INT32},
    {GB_RECORD_INT64, GB_HDF_INT64},
    {GB_RECORD_BOOL, GB_HDF_UINT8},
};

enum { TYPES = sizeof types / sizeof types[0] };

static enum gb_hdf_type hdf_type(enum gb_record_type type)
{
    int k = 0;
    while (types[k].record != type) {
        k++;
    }
    return types[k].hdf;
}

static bool record_type(enum gb_hdf_type type, enum gb_record_type *out)
{
    for (int k = 0; k < TYPES; k++) {
        if (types[k].hdf == type) {
            *out = types[k].record;
            return true;
        }
    }
    return false;
}

bool gb_hdf_record_put(struct gb_hdf *file, const struct gb_record *record,
                       struct gb_error *err)
{
    const uint64_t hash = gb_record_hash(record);
    bool done = gb_hdf_put_numbers(file, "checkpoint_layout", GB_HDF_INT32, 1,
                                   &layout_number, err) &&
                gb_hdf_put_numbers(file, "checkpoint_hash", GB_HDF_UINT64, 1, &hash, err);
    for (int k = 0; k < record->count && done; k++) {
        const struct gb_record_item *item = &record->item[k];
        char name[GB_HDF_LIST_NAME];
        snprintf(name, sizeof name, "%s/%s", group, item->name);
        const struct gb_hdf_array array = {.name = name,
                                           .type = item->f32 ? GB_HDF_FLOAT
                                                             : hdf_type(item->type),
                                           .rows = item->rows,
                                           .columns = item->columns,
                                           .unit = item->unit};
        done = gb_hdf_put_array(file, &array, item->data, err);
    }
    return done;
}

static bool read_layout(struct gb_hdf *file, const char *path, struct gb_error *err)
{
    int32_t layout = 0;
    if (!gb_hdf_list_has(file, group)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: keeps a packing but no checkpoint, so no run can "
                            "continue from it (written by pack)",
                            path);
    }
    if (!gb_hdf_get_numbers(file, "checkpoint_layout", GB_HDF_INT32, 1, &layout, err)) {
        return false;
    }
    if (layout != layout_number) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: checkpoint_layout: %d was written by another version of "
                            "greenbody, this one continues %d only",
                            path, layout, layout_number);
    }
    return true;
}

/* Reads one dataset into one item.  Its size is checked against the stored data before
 * memory is allocated. */
static bool read_item(struct gb_hdf *file, const char *path, const char *name,
                      struct gb_record *record, struct gb_error *err)
{
    struct gb_hdf_array array = {.name = name};
    enum gb_record_type type = GB_RECORD_DOUBLE;
    if (!gb_hdf_list_probe(file, &array, err)) {
        return false;
    }
    if (!record_type(array.type, &type) || strlen(name) < sizeof group) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %s: has another number type", path,
                            name);
    }
    struct gb_error why = {0};
    if (!gb_hdf_rows(file, &array, &array.rows, err)) {
        return false;
    }
    struct gb_record_item *item = gb_record_add(record, name + sizeof group, type,
                                                array.rows, array.columns, "", &why);
    if (item == NULL) {
        return gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    return gb_hdf_get_array(file, &array, item->data, err);
}

static bool check_hash(const struct gb_record *record, struct gb_hdf *file,
                       const char *path, struct gb_error *err)
{
    uint64_t kept = 0;
    return gb_hdf_get_numbers(file, "checkpoint_hash", GB_HDF_UINT64, 1, &kept, err) &&
           (kept == gb_record_hash(record) ||
            gb_error_set(err, GB_ERR_INPUT,
                         "%s: is damaged: checkpoint_hash does not match the data",
                         path));
}

bool gb_hdf_record_read(struct gb_record *record, const char *path, struct gb_error *err)
{
    struct gb_hdf *file = NULL;
    struct gb_hdf_list list;
    gb_record_clear(record);
    if (!gb_hdf_open(&file, path, err)) {
        return false;
    }
    bool done = read_layout(file, path, err) && gb_hdf_list_read(file, group, &list, err);
    for (int k = 0; done && k < list.count; k++) {
        done = read_item(file, path, list.name[k], record, err);
    }
    done = done && check_hash(record, file, path, err);
    gb_hdf_destroy(file);
    return done;
}
