#ifndef GB_BASE_RECORD_H
#define GB_BASE_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Named arrays of plain numbers: what a checkpoint is made of.
 *
 * Every part of the engine lists what it needs to continue in one function, which saves
 * or loads, whichever way the record goes; so the two cannot differ.  A record is memory
 * only; src/io/store.h writes it to files.  Filling it costs no more than the copying. */
enum gb_record_type {
    GB_RECORD_DOUBLE,
    GB_RECORD_INT32, /* int and enum too */
    GB_RECORD_INT64,
    GB_RECORD_BOOL /* one byte, 0 or 1 */
};

enum { GB_RECORD_ITEMS = 160, GB_RECORD_NAME = 48, GB_RECORD_UNIT = 24 };

struct gb_record_item {
    char name[GB_RECORD_NAME]; /* "world/position" */
    char unit[GB_RECORD_UNIT];
    enum gb_record_type type;
    bool f32; /* doubles that are floats in memory, as the engine has them */
    int columns;
    int64_t rows;
    void *data;  /* rows x columns */
    size_t room; /* bytes of data; kept from one filling to the next */
};

struct gb_record {
    bool loading; /* direction of gb_record_array and gb_record_members */
    int count;
    struct gb_record_item item[GB_RECORD_ITEMS];
};

/* A zeroed record is empty. */
void gb_record_finish(struct gb_record *record);
/* Empties the record for saving; its memory is used again. */
void gb_record_clear(struct gb_record *record);

/* Bytes of an item in memory. */
size_t gb_record_bytes(const struct gb_record_item *item);

/* NULL when there is none. */
const struct gb_record_item *gb_record_find(const struct gb_record *record,
                                            const char *name);

/* Adds an item of that shape, its content unset; NULL and err without memory or room. */
struct gb_record_item *gb_record_add(struct gb_record *record, const char *name,
                                     enum gb_record_type type, int64_t rows, int columns,
                                     const char *unit, struct gb_error *err);

/* The same for doubles that are kept as floats. */
struct gb_record_item *gb_record_add_f32(struct gb_record *record, const char *name,
                                         int64_t rows, int columns, const char *unit,
                                         struct gb_error *err);

/* Number k of an item of doubles, row by row. */
static inline double gb_record_number(const struct gb_record_item *item, int64_t k)
{
    return item->f32 ? (double)((const float *)item->data)[k]
                     : ((const double *)item->data)[k];
}

/* `count` numbers of an item of doubles from `first` on. */
void gb_record_numbers(const struct gb_record_item *item, int64_t first, int64_t count,
                       double *to);

/* Copies data into the record, or out of it.  Loading, an item that is missing or of
 * another shape is GB_ERR_INPUT. */
bool gb_record_array(struct gb_record *record, const char *name, enum gb_record_type type,
                     int64_t rows, int columns, const char *unit, void *data,
                     struct gb_error *err);

/* The same for floats in memory, which are doubles of an f32 item. */
bool gb_record_f32(struct gb_record *record, const char *name, int64_t rows, int columns,
                   const char *unit, float *data, struct gb_error *err);

/* Rows of an array that is about to be loaded; its type and columns are checked. */
bool gb_record_rows(const struct gb_record *record, const char *name,
                    enum gb_record_type type, int columns, int64_t *rows,
                    struct gb_error *err);

/* A member of a struct: `columns` numbers at offset. */
struct gb_record_member {
    const char *name;
    enum gb_record_type type;
    int columns;
    size_t offset;
    const char *unit;
};

/* Copies all members of the table from the object or into it. */
bool gb_record_members(struct gb_record *record, const struct gb_record_member *table,
                       size_t count, void *object, struct gb_error *err);

/* Copies all items of an inner record into this one, their names behind the prefix, or out
 * of it; loading, the inner record is made of the items with that prefix. */
bool gb_record_nest(struct gb_record *record, const char *prefix, struct gb_record *inner,
                    struct gb_error *err);

/* Removes all items whose names begin with prefix. */
void gb_record_remove(struct gb_record *record, const char *prefix);

/* Name of the first item in which the two differ, and its first row that does; NULL when
 * they are equal to the last bit, f32 or not. */
const char *gb_record_difference(const struct gb_record *a, const struct gb_record *b,
                                 int64_t *row);

/* 64-bit hash over names, shapes and content, whatever the order of the items; f32 items
 * count as doubles. */
uint64_t gb_record_hash(const struct gb_record *record);

/* The hash FNV-1a, byte by byte, from GB_RECORD_FNV on (G. Fowler, L. C. Noll, K.-P. Vo). */
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
