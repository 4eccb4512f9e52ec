#ifndef GB_HDF_HDF_H
#define GB_HDF_HDF_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* HDF5 files with one-line errors.  Files are written to memory first and stored as a
 * whole, because after an I/O error HDF5 could not close a file.  Files that are read
 * are not trusted: types, ranks and sizes are checked before memory is allocated, and
 * links, external data and virtual data are refused.
 *
 * Only one thread at a time can have files.  Others wait in gb_hdf_create and
 * gb_hdf_open until it has stored or destroyed all of its files. */
struct gb_hdf;

enum gb_hdf_type {
    GB_HDF_DOUBLE,
    GB_HDF_INT32,
    GB_HDF_INT64,
    GB_HDF_UINT64,
    GB_HDF_UINT8,
    GB_HDF_FLOAT /* doubles in the file, floats in memory */
};

/* Creates an empty file in memory, which gb_hdf_store writes to path.  After that only
 * gb_hdf_destroy may be called. */
bool gb_hdf_create(struct gb_hdf **out, const char *path, struct gb_error *err);
bool gb_hdf_store(struct gb_hdf *file, struct gb_error *err);
/* The same for gb_hdf_group_image; name is used in errors. */
bool gb_hdf_create_image(struct gb_hdf **out, const char *name, struct gb_error *err);
/* Opens an existing file for reading. */
bool gb_hdf_open(struct gb_hdf **out, const char *path, struct gb_error *err);
void gb_hdf_destroy(struct gb_hdf *file); /* NULL is fine */

/* Call this before all other functions: HDF5 then does not close files at exit, which
 * would crash if a file could not be closed for lack of memory. */
void gb_hdf_skip_exit(void);

/* A dataset of rows x columns (rank 1 if columns is 1), with its unit as an attribute. */
struct gb_hdf_array {
    const char *name; /* "/position" */
    enum gb_hdf_type type;
    int64_t rows;
    int columns;
    const char *unit;
};

bool gb_hdf_put_array(struct gb_hdf *file, const struct gb_hdf_array *array,
                      const void *data, struct gb_error *err);

/* Callback that provides the rows of a dataset.  It is called in order for rows begin
 * .. end - 1, which must stay valid until the next call. */
struct gb_hdf_rows {
    const void *(*at)(void *data, int64_t begin, int64_t end);
    void *data;
};
bool gb_hdf_put_rows(struct gb_hdf *file, const struct gb_hdf_array *array,
                     struct gb_hdf_rows rows, struct gb_error *err);

/* Bytes of a row in memory, and the number of rows in one call of gb_hdf_rows.at:
 * GB_HDF_SLAB bytes, but at least one row. */
enum { GB_HDF_SLAB = 1 << 20 };
size_t gb_hdf_row_bytes(const struct gb_hdf_array *array);
int64_t gb_hdf_slab_rows(const struct gb_hdf_array *array);
/* Number of rows of a dataset with the type and columns of array; array->rows is
 * ignored. */
bool gb_hdf_rows(struct gb_hdf *file, const struct gb_hdf_array *array, int64_t *rows,
                 struct gb_error *err);
/* Reads a dataset that has exactly the shape of array. */
bool gb_hdf_get_array(struct gb_hdf *file, const struct gb_hdf_array *array, void *data,
                      struct gb_error *err);

/* Attributes of the root group: `count` numbers of one type, or a text.  A text that is
 * read is cut to size and made valid UTF-8 without control characters. */
bool gb_hdf_put_numbers(struct gb_hdf *file, const char *name, enum gb_hdf_type type,
                        int count, const void *data, struct gb_error *err);
bool gb_hdf_get_numbers(struct gb_hdf *file, const char *name, enum gb_hdf_type type,
                        int count, void *data, struct gb_error *err);
bool gb_hdf_put_text(struct gb_hdf *file, const char *name, const char *text,
                     struct gb_error *err);
bool gb_hdf_get_text(struct gb_hdf *file, const char *name, char *text, size_t size,
                     struct gb_error *err);

/* List of datasets whose names are not known in advance. */
enum { GB_HDF_LIST_NAME = 64 };

struct gb_hdf_list {
    int count;
    char name[256][GB_HDF_LIST_NAME]; /* "/checkpoint/world/position" */
};

/* Does an object with this name exist? */
bool gb_hdf_list_has(struct gb_hdf *file, const char *name);

/* Names of all datasets in the subgroups of a group, two levels deep.  Errors:
 * GB_ERR_INPUT for links, other objects, names that are too long, and more than 256
 * names. */
bool gb_hdf_list_read(struct gb_hdf *file, const char *group, struct gb_hdf_list *list,
                      struct gb_error *err);

/* Reads number type, rows and columns of the dataset array->name.  Do not trust the
 * size before gb_hdf_rows has checked it. */
bool gb_hdf_list_probe(struct gb_hdf *file, struct gb_hdf_array *array,
                       struct gb_error *err);

/* Groups with attributes, as other programs need them, and the file as bytes. */

/* Creates a group of the root, such as "/VTKHDF". */
bool gb_hdf_group_create(struct gb_hdf *file, const char *group, struct gb_error *err);

/* Writes an attribute of a group: `count` numbers as an array, or a text of fixed
 * length. */
bool gb_hdf_group_numbers(struct gb_hdf *file, const char *group, const char *name,
                          int count, const int64_t *numbers, struct gb_error *err);

bool gb_hdf_group_text(struct gb_hdf *file, const char *group, const char *name,
                       const char *text, struct gb_error *err);

/* Appends the finished file to bytes, instead of gb_hdf_store.  After that only
 * gb_hdf_destroy may be called. */
bool gb_hdf_group_image(struct gb_hdf *file, GString *bytes, struct gb_error *err);

#endif
