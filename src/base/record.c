#include "base/record.h"

#include <stdio.h>
#include <string.h>

#include "base/alloc.h"

void gb_record_finish(struct gb_record *record)
{
    for (int k = 0; k < GB_RECORD_ITEMS; k++) {
        gb_alloc_free(record->item[k].data);
    }
    memset(record, 0, sizeof *record);
}

void gb_record_clear(struct gb_record *record)
{
    record->loading = false;
    record->count = 0;
}

static size_t type_size(enum gb_record_type type)
{
    switch (type) {
    case GB_RECORD_INT32:
        return sizeof(int32_t);
    case GB_RECORD_BOOL:
        return sizeof(bool);
    default:
        return sizeof(double);
    }
}

size_t gb_record_bytes(const struct gb_record_item *item)
{
    return (size_t)item->rows * (size_t)item->columns *
           (item->f32 ? sizeof(float) : type_size(item->type));
}

const struct gb_record_item *gb_record_find(const struct gb_record *record,
                                            const char *name)
{
    for (int k = 0; k < record->count; k++) {
        if (strcmp(record->item[k].name, name) == 0) {
            return &record->item[k];
        }
    }
    return NULL;
}

/* Type of the numbers of an item. */
struct content {
    enum gb_record_type type;
    bool f32;
};

static struct gb_record_item *add(struct gb_record *record, const char *name,
                                  struct content content, int64_t rows, int columns,
                                  const char *unit, struct gb_error *err)
{
    const size_t length = strlen(name);
    const size_t unit_length = strlen(unit);
    if (record->count == GB_RECORD_ITEMS || length >= GB_RECORD_NAME ||
        unit_length >= sizeof record->item[0].unit) {
        gb_error_set(err, GB_ERR_INPUT, "%s: a checkpoint has at most %d arrays", name,
                     GB_RECORD_ITEMS);
        return NULL;
    }
    struct gb_record_item *item = &record->item[record->count];
    memcpy(item->name, name, length + 1); /* about 100 items at every recorded point */
    memcpy(item->unit, unit, unit_length + 1);
    item->type = content.type;
    item->f32 = content.f32;
    item->rows = rows;
    item->columns = columns;
    const size_t bytes = gb_record_bytes(item);
    if (!item->data || bytes > item->room) {
        gb_alloc_free(item->data);
        item->room = bytes + bytes / 16; /* room for more contacts */
        item->data = gb_alloc_array(item->room + 1, 1, err);
        if (!item->data) {
            item->room = 0;
            return NULL;
        }
    }
    record->count++;
    return item;
}

struct gb_record_item *gb_record_add(struct gb_record *record, const char *name,
                                     enum gb_record_type type, int64_t rows, int columns,
                                     const char *unit, struct gb_error *err)
{
    return add(record, name, (struct content){type, false}, rows, columns, unit, err);
}

struct gb_record_item *gb_record_add_f32(struct gb_record *record, const char *name,
                                         int64_t rows, int columns, const char *unit,
                                         struct gb_error *err)
{
    return add(record, name, (struct content){GB_RECORD_DOUBLE, true}, rows, columns,
               unit, err);
}

void gb_record_numbers(const struct gb_record_item *item, int64_t first, int64_t count,
                       double *to)
{
    for (int64_t k = 0; k < count; k++) {
        to[k] = gb_record_number(item, first + k);
    }
}

static bool check_shape(const struct gb_record_item *item, const char *name,
                        enum gb_record_type type, int columns, struct gb_error *err)
{
    if (!item) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is missing", name);
    }
    return (item->type == type && item->columns == columns) ||
           gb_error_set(err, GB_ERR_INPUT, "%s: has another shape or number type", name);
}

bool gb_record_rows(const struct gb_record *record, const char *name,
                    enum gb_record_type type, int columns, int64_t *rows,
                    struct gb_error *err)
{
    const struct gb_record_item *item = gb_record_find(record, name);
    if (!check_shape(item, name, type, columns, err)) {
        return false;
    }
    *rows = item->rows;
    return true;
}

/* Checks that bools are 0 or 1; any other byte in a bool is undefined behaviour. */
static bool check_bools(const struct gb_record_item *item)
{
    const unsigned char *byte = item->data;
    for (size_t k = 0; item->type == GB_RECORD_BOOL && k < gb_record_bytes(item); k++) {
        if (byte[k] > 1) {
            return false;
        }
    }
    return true;
}

/* The item if it has this shape; else NULL and err. */
static const struct gb_record_item *item_to_load(const struct gb_record *record,
                                                 const char *name,
                                                 enum gb_record_type type, int64_t rows,
                                                 int columns, struct gb_error *err)
{
    const struct gb_record_item *item = gb_record_find(record, name);
    if (!check_shape(item, name, type, columns, err)) {
        return NULL;
    }
    if (item->rows != rows) {
        gb_error_set(err, GB_ERR_INPUT, "%s: has %lld rows instead of %lld", name,
                     (long long)item->rows, (long long)rows);
        return NULL;
    }
    if (!check_bools(item)) {
        gb_error_set(err, GB_ERR_INPUT, "%s: is neither 0 nor 1", name);
        return NULL;
    }
    return item;
}

static bool load(const struct gb_record *record, const char *name,
                 enum gb_record_type type, int64_t rows, int columns, void *data,
                 struct gb_error *err)
{
    const struct gb_record_item *item =
        item_to_load(record, name, type, rows, columns, err);
    if (item && item->f32) {
        gb_record_numbers(item, 0, rows * columns, data);
    } else if (item && rows > 0) {
        memcpy(data, item->data, gb_record_bytes(item));
    }
    return item != NULL;
}

bool gb_record_array(struct gb_record *record, const char *name, enum gb_record_type type,
                     int64_t rows, int columns, const char *unit, void *data,
                     struct gb_error *err)
{
    if (record->loading) {
        return load(record, name, type, rows, columns, data, err);
    }
    struct gb_record_item *item =
        gb_record_add(record, name, type, rows, columns, unit, err);
    if (!item) {
        return false;
    }
    if (rows > 0) {
        memcpy(item->data, data, gb_record_bytes(item));
    }
    return true;
}

bool gb_record_f32(struct gb_record *record, const char *name, int64_t rows, int columns,
                   const char *unit, float *data, struct gb_error *err)
{
    const int64_t count = rows * columns;
    const bool loading = record->loading;
    const struct gb_record_item *item =
        loading ? item_to_load(record, name, GB_RECORD_DOUBLE, rows, columns, err)
                : gb_record_add_f32(record, name, rows, columns, unit, err);
    if (item && !loading && count > 0) {
        memcpy(item->data, data, gb_record_bytes(item));
    }
    for (int64_t k = 0; item && loading && k < count; k++) {
        data[k] = (float)gb_record_number(item, k);
    }
    return item != NULL;
}

bool gb_record_members(struct gb_record *record, const struct gb_record_member *table,
                       size_t count, void *object, struct gb_error *err)
{
    for (size_t k = 0; k < count; k++) {
        const struct gb_record_member *row = &table[k];
        if (!gb_record_array(record, row->name, row->type, 1, row->columns, row->unit,
                             (char *)object + row->offset, err)) {
            return false;
        }
    }
    return true;
}

/* Copies an item under another name. */
static bool add_copy(struct gb_record *record, const char *name,
                     const struct gb_record_item *from, struct gb_error *err)
{
    struct gb_record_item *item =
        add(record, name, (struct content){from->type, from->f32}, from->rows,
            from->columns, from->unit, err);
    if (item && from->rows > 0) {
        memcpy(item->data, from->data, gb_record_bytes(from));
    }
    return item != NULL;
}

bool gb_record_nest(struct gb_record *record, const char *prefix, struct gb_record *inner,
                    struct gb_error *err)
{
    const size_t length = strlen(prefix);
    if (record->loading) {
        gb_record_clear(inner);
    }
    const struct gb_record *from = record->loading ? record : inner;
    for (int k = 0; k < from->count; k++) {
        const char *name = from->item[k].name;
        char outer[2 * GB_RECORD_NAME];
        if (record->loading && strncmp(name, prefix, length) != 0) {
            continue;
        }
        snprintf(outer, sizeof outer, "%s%s", prefix, name);
        if (!(record->loading ? add_copy(inner, name + length, &from->item[k], err)
                              : add_copy(record, outer, &from->item[k], err))) {
            return false;
        }
    }
    return true;
}

void gb_record_remove(struct gb_record *record, const char *prefix)
{
    int kept = 0;
    for (int k = 0; k < record->count; k++) {
        if (strncmp(record->item[k].name, prefix, strlen(prefix)) == 0) {
            continue;
        }
        const struct gb_record_item item = record->item[kept]; /* its memory stays */
        record->item[kept++] = record->item[k];
        record->item[k] = item;
    }
    record->count = kept;
}

/* Compares two items of doubles, of which at least one is stored as floats. */
static bool numbers_differ(const struct gb_record_item *a, const struct gb_record_item *b,
                           int64_t row)
{
    for (int64_t k = row * a->columns; k < (row + 1) * a->columns; k++) {
        const double one = gb_record_number(a, k), other = gb_record_number(b, k);
        if (memcmp(&one, &other, sizeof one) != 0) {
            return true;
        }
    }
    return false;
}

static bool rows_differ(const struct gb_record_item *a, const struct gb_record_item *b,
                        int64_t row)
{
    if (a->f32 || b->f32) {
        return numbers_differ(a, b, row);
    }
    const size_t bytes = (size_t)a->columns * type_size(a->type);
    return memcmp((const char *)a->data + (size_t)row * bytes,
                  (const char *)b->data + (size_t)row * bytes, bytes) != 0;
}

static int64_t first_other_row(const struct gb_record_item *a,
                               const struct gb_record_item *b)
{
    const int64_t rows = a->rows < b->rows ? a->rows : b->rows;
    for (int64_t i = 0; i < rows; i++) {
        if (rows_differ(a, b, i)) {
            return i;
        }
    }
    return a->rows == b->rows ? -1 : rows;
}

const char *gb_record_difference(const struct gb_record *a, const struct gb_record *b,
                                 int64_t *row)
{
    const struct gb_record *longer = a->count >= b->count ? a : b;
    *row = 0;
    for (int k = 0; k < longer->count; k++) {
        const char *name = longer->item[k].name;
        const struct gb_record_item *one = gb_record_find(a, name);
        const struct gb_record_item *other = gb_record_find(b, name);
        if (!one || !other || one->type != other->type ||
            one->columns != other->columns) {
            return name;
        }
        const int64_t at = first_other_row(one, other);
        if (at >= 0) {
            *row = at;
            return name;
        }
    }
    return NULL;
}

static uint64_t hash_word(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * GB_RECORD_FNV_PRIME;
    return hash ^ hash >> 32;
}

/* FNV-1a over words of eight bytes.  Byte by byte it would take as long as writing the
 * file. */
static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const char *byte = data;
    size_t i = 0;
    for (; i + 8 <= size; i += 8) {
        uint64_t word;
        memcpy(&word, byte + i, sizeof word);
        hash = hash_word(hash, word);
    }
    return gb_record_fnv(hash, byte + i, size - i);
}

/* Hashes an item; an f32 item hashes as the doubles that its file contains. */
static uint64_t hash_content(uint64_t hash, const struct gb_record_item *item)
{
    if (!item->f32) {
        return hash_bytes(hash, item->data, gb_record_bytes(item));
    }
    for (int64_t k = 0; k < item->rows * item->columns; k++) {
        const double number = gb_record_number(item, k);
        uint64_t word;
        memcpy(&word, &number, sizeof word);
        hash = hash_word(hash, word);
    }
    return hash;
}

uint64_t gb_record_hash(const struct gb_record *record)
{
    uint64_t sum = 0;
    for (int k = 0; k < record->count; k++) {
        const struct gb_record_item *item = &record->item[k];
        const int64_t shape[3] = {(int64_t)item->type, item->rows, item->columns};
        uint64_t hash = GB_RECORD_FNV;
        hash = hash_bytes(hash, item->name, strlen(item->name));
        hash = hash_bytes(hash, shape, sizeof shape);
        hash = hash_content(hash, item);
        sum += hash;
    }
    return sum;
}
