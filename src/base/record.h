#ifndef GB_BASE_RECORD_H
#define GB_BASE_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Named arrays of numbers: the contents of a checkpoint.
 *
 * Every part of the engine lists its data in one function that both saves and loads,
 * depending on `loading`; so the two cannot differ.  A record exists only in memory,
 * and io/store.h writes it to files.  Filling a record costs no more than copying the
 * data. */
enum gb_record_type {
    GB_RECORD_DOUBLE,
    GB_RECORD_INT32, /* also int and enum */
    GB_RECORD_INT64,
    GB_RECORD_BOOL /* one byte, 0 or 1 */
};

enum { GB_RECORD_ITEMS = 160, GB_RECORD_NAME = 48, GB_RECORD_UNIT = 24 };

struct gb_record_item {
    char name[GB_RECORD_NAME]; /* "world/position" */
    char unit[GB_RECORD_UNIT];
    enum gb_record_type type;
    bool f32; /* stored as floats; doubles for readers and in files */
    int columns;
    int64_t rows;
    void *data;  /* rows x columns */
    size_t room; /* allocated bytes, kept when the record is filled again */
};

struct gb_record {
    bool loading; /* direction of gb_record_array and gb_record_members */
    int count;
    struct gb_record_item item[GB_RECORD_ITEMS];
};

/* Frees the items.  A zeroed record is a valid empty record. */
void gb_record_finish(struct gb_record *record);
/* Empties the record for saving and keeps its memory for reuse. */
void gb_record_clear(struct gb_record *record);

/* Size of an item in memory, bytes. */
size_t gb_record_bytes(const struct gb_record_item *item);

/* The item with this name; NULL if there is none. */
const struct gb_record_item *gb_record_find(const struct gb_record *record,
                                            const char *name);

/* Adds an item of this shape with undefined contents.  NULL and err: out of memory, or
 * too many items. */
struct gb_record_item *gb_record_add(struct gb_record *record, const char *name,
                                     enum gb_record_type type, int64_t rows, int columns,
                                     const char *unit, struct gb_error *err);

/* The same for doubles that are stored as floats. */
struct gb_record_item *gb_record_add_f32(struct gb_record *record, const char *name,
                                         int64_t rows, int columns, const char *unit,
                                         struct gb_error *err);

/* Number k of an item of doubles, counted row by row. */
static inline double gb_record_number(const struct gb_record_item *item, int64_t k)
{
    return item->f32 ? (double)((const float *)item->data)[k]
                     : ((const double *)item->data)[k];
}

/* Copies `count` numbers of an item of doubles, from number `first`. */
void gb_record_numbers(const struct gb_record_item *item, int64_t first, int64_t count,
                       double *to);

/* Copies data into the record or, if it is loading, out of it.  Errors: GB_ERR_INPUT
 * when an item to load is missing or has another shape. */
bool gb_record_array(struct gb_record *record, const char *name, enum gb_record_type type,
                     int64_t rows, int columns, const char *unit, void *data,
                     struct gb_error *err);

/* The same for an array of floats, which is an f32 item of doubles. */
bool gb_record_f32(struct gb_record *record, const char *name, int64_t rows, int columns,
                   const char *unit, float *data, struct gb_error *err);

/* Number of rows of an array to be loaded; checks its type and columns. */
bool gb_record_rows(const struct gb_record *record, const char *name,
                    enum gb_record_type type, int columns, int64_t *rows,
                    struct gb_error *err);

/* A member of a struct: `columns` numbers at an offset. */
struct gb_record_member {
    const char *name;
    enum gb_record_type type;
    int columns;
    size_t offset;
    const char *unit;
};

/* Copies all members in the table from the object to the record, or back when loading. */
bool gb_record_members(struct gb_record *record, const struct gb_record_member *table,
                       size_t count, void *object, struct gb_error *err);

/* Copies all items of an inner record into this one, with the prefix before their
 * names.  When loading, fills the inner record from the items with this prefix. */
bool gb_record_nest(struct gb_record *record, const char *prefix, struct gb_record *inner,
                    struct gb_error *err);

/* Removes all items whose names begin with prefix. */
void gb_record_remove(struct gb_record *record, const char *prefix);

/* Name of the first item that differs, and its first row that differs.  NULL if the
 * records are bit-identical; f32 items are compared as doubles. */
const char *gb_record_difference(const struct gb_record *a, const struct gb_record *b,
                                 int64_t *row);

/* 64-bit hash of names, shapes and contents, independent of the order of items; f32
 * items count as doubles. */
uint64_t gb_record_hash(const struct gb_record *record);

/* FNV-1a hash, byte by byte; start with GB_RECORD_FNV (G.  Fowler, L.  C.  Noll, K.-P.
 * Vo). */
#define GB_RECORD_FNV       UINT64_C(14695981039346656037)
#define GB_RECORD_FNV_PRIME UINT64_C(1099511628211)

static inline uint64_t gb_record_fnv(uint64_t hash, const void *data, size_t bytes)
{
    const unsigned char *byte = data;
    for (size_t k = 0; k < bytes; k++) {
        hash = (hash ^ byte[k]) * GB_RECORD_FNV_PRIME;
    }
    return hash;
}

#endif
