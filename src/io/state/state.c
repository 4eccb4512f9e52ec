#include "io/state/state.h"

#include <glib.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "hdf/hdf.h"
#include "hdf/hdf_record.h"
#include "io/point_columns.h"
#include "io/state/state_array.h"
#include "io/state/state_check.h"
#include "io/state/state_optional.h"
#include "io/state/state_source.h"

/* Raised when a reader of another layout would misunderstand this one; no other is read. */
static const int32_t layout_number = 6;

/* Beyond this a file is nonsense rather than large. */
static const int64_t count_max = 200000000;

/* What a row of an array belongs to. */
enum row_of { PARTICLE, PAIR, WALL, ROW_KINDS };

/* An array of the file and its place in the struct. */
struct array_row {
    const char *name;
    enum gb_hdf_type type;
    int columns;
    enum row_of row_of;
    size_t offset;
    const char *unit;
};

static const struct array_row arrays[] = {
    {"/position", GB_HDF_DOUBLE, 3, PARTICLE, offsetof(struct gb_state, position), "d"},
    {"/radius", GB_HDF_DOUBLE, 1, PARTICLE, offsetof(struct gb_state, radius), "d"},
    {"/contacts", GB_HDF_INT32, 1, PARTICLE, offsetof(struct gb_state, contacts), "1"},
    {"/pair", GB_HDF_INT32, 2, PAIR, offsetof(struct gb_state, pair), "1"},
    {"/pair_force", GB_HDF_DOUBLE, 3, PAIR, offsetof(struct gb_state, pair_force),
     "E d^2"},
    {"/pair_normal", GB_HDF_DOUBLE, 1, PAIR, offsetof(struct gb_state, pair_normal),
     "E d^2"},
    {"/pair_bridged", GB_HDF_UINT8, 1, PAIR, offsetof(struct gb_state, pair_bridged),
     "1"},
    {"/wall", GB_HDF_INT32, 2, WALL, offsetof(struct gb_state, wall), "1"},
    {"/wall_force", GB_HDF_DOUBLE, 3, WALL, offsetof(struct gb_state, wall_force),
     "E d^2"},
};

/* A number of the file's root group: unit in the name, as in curve.csv and the struct.
 * Numbers of the point are rows of io/point_columns.h. */
struct number_row {
    const char *name;
    enum gb_hdf_type type;
    int count;
    size_t offset;
};

static const struct number_row numbers[] = {
    {"cell_d", GB_HDF_DOUBLE, 3, offsetof(struct gb_state, cell)},
    {"cell_tilt_d", GB_HDF_DOUBLE, 3, offsetof(struct gb_state, tilt)},
    {"die_radius_d", GB_HDF_DOUBLE, 1, offsetof(struct gb_state, die_radius)},
    {"die_top_d", GB_HDF_DOUBLE, 1, offsetof(struct gb_state, die_top)},
    {"metre_per_length", GB_HDF_DOUBLE, 1, offsetof(struct gb_state, metre_per_length)},
    {"pascal_per_stress", GB_HDF_DOUBLE, 1, offsetof(struct gb_state, pascal_per_stress)},
    {"seed", GB_HDF_UINT64, 1, offsetof(struct gb_state, seed)},
};

enum {
    ARRAY_COUNT = sizeof arrays / sizeof arrays[0],
    NUMBER_COUNT = sizeof numbers / sizeof numbers[0],
    DIGEST_SIZE = 65
};

/* The pointer member that a row describes. */
static void **array_member(struct gb_state *state, const struct array_row *row)
{
    return (void **)(void *)((char *)state + row->offset);
}

static struct gb_hdf_array shape_of(const struct array_row *row,
                                    const struct gb_state *state)
{
    const int64_t rows[ROW_KINDS] = {state->count, state->pair_count, state->wall_count};
    return (struct gb_hdf_array){
        .name = row->name,
        .type = row->type,
        .rows = rows[row->row_of],
        .columns = row->columns,
        .unit = row->unit,
    };
}

static struct gb_state_array array_of(const struct gb_state *state,
                                      const struct array_row *row)
{
    return (struct gb_state_array){state, row->offset, shape_of(row, state)};
}

static bool allocate(struct gb_state *state, const struct array_row *row,
                     struct gb_error *err)
{
    const struct gb_hdf_array shape = shape_of(row, state);
    /* one spare row, so that an empty array is still memory */
    void *memory =
        gb_alloc_array((size_t)(shape.rows + 1), gb_hdf_row_bytes(&shape), err);
    if (memory == NULL) {
        return false;
    }
    gb_alloc_free(*array_member(state, row));
    *array_member(state, row) = memory;
    return true;
}

static bool allocate_kind(struct gb_state *state, enum row_of kind, struct gb_error *err)
{
    bool good = true;
    for (int k = 0; k < ARRAY_COUNT && good; k++) {
        good = arrays[k].row_of != kind || allocate(state, &arrays[k], err);
    }
    return good;
}

bool gb_state_allocate_pairs(struct gb_state *state, struct gb_error *err)
{
    return allocate_kind(state, PAIR, err);
}

bool gb_state_create_particles(struct gb_state **out, int64_t count, int64_t pair_count,
                               struct gb_error *err)
{
    *out = NULL;
    if (count < 0 || pair_count < 0) {
        return gb_error_set(err, GB_ERR_INPUT, "a packing of negative size");
    }
    struct gb_state *state = gb_alloc_array(1, sizeof *state, err);
    if (state == NULL) {
        return false;
    }
    state->dimension = 3;
    state->count = count;
    state->pair_count = pair_count;
    state->die_top = state->second_per_time = state->punch_height = (double)NAN;
    if (!allocate_kind(state, PARTICLE, err) || !allocate_kind(state, WALL, err)) {
        gb_state_destroy(state);
        return false;
    }
    *out = state;
    return true;
}

bool gb_state_create(struct gb_state **out, int64_t count, int64_t pair_count,
                     struct gb_error *err)
{
    if (!gb_state_create_particles(out, count, pair_count, err)) {
        return false;
    }
    if (!gb_state_allocate_pairs(*out, err)) {
        gb_state_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

bool gb_state_allocate_walls(struct gb_state *state, int64_t count, struct gb_error *err)
{
    const int64_t before = state->wall_count;
    state->wall_count = count;
    const bool good = allocate_kind(state, WALL, err);
    state->wall_count = good ? count : before;
    return good;
}

struct gb_cell gb_state_cell(const struct gb_state *state)
{
    struct gb_cell cell;
    gb_cell_init(&cell, state->dimension, state->cell);
    memcpy(cell.tilt, state->tilt, sizeof cell.tilt);
    return cell;
}

void gb_state_destroy(struct gb_state *state)
{
    if (state == NULL) {
        return;
    }
    for (int k = 0; k < ARRAY_COUNT; k++) {
        gb_alloc_free(*array_member(state, &arrays[k]));
    }
    gb_state_optional_free(state);
    gb_state_source_destroy(state->source);
    gb_alloc_free(state);
}

/* SHA-256 of all arrays in the order of the table.  HDF5 checks its headers but not plain
 * data. */
static void digest(const struct gb_state *state, char text[DIGEST_SIZE])
{
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (int k = 0; k < ARRAY_COUNT; k++) {
        const struct gb_state_array array = array_of(state, &arrays[k]);
        gb_state_array_sum(&array, sum);
    }
    g_strlcpy(text, g_checksum_get_string(sum), DIGEST_SIZE);
    g_checksum_free(sum);
}

static enum gb_hdf_type type_of(const struct gb_point_column *row)
{
    return row->type == 'q' ? GB_HDF_INT64 : GB_HDF_DOUBLE;
}

static bool write_numbers(const struct gb_state *state, struct gb_hdf *file,
                          struct gb_error *err)
{
    const int32_t dimension = state->dimension;
    const int32_t branch = state->point.branch;
    char sum[DIGEST_SIZE];
    digest(state, sum);
    if (!gb_hdf_put_numbers(file, "layout", GB_HDF_INT32, 1, &layout_number, err) ||
        !gb_hdf_put_numbers(file, "dimension", GB_HDF_INT32, 1, &dimension, err) ||
        !gb_hdf_put_numbers(file, "branch", GB_HDF_INT32, 1, &branch, err) ||
        !gb_hdf_put_text(file, "title", state->preset, err) ||
        !gb_hdf_put_text(file, "version", state->version, err) ||
        !gb_hdf_put_text(file, "sha256", sum, err)) {
        return false;
    }
    for (int k = 0; k < NUMBER_COUNT; k++) {
        const struct number_row *row = &numbers[k];
        if (!gb_hdf_put_numbers(file, row->name, row->type, row->count,
                                (const char *)state + row->offset, err)) {
            return false;
        }
    }
    const struct gb_point_column *row;
    for (size_t k = 0; (row = gb_point_columns_at(k)) != NULL; k++) {
        if (row->state != NULL &&
            !gb_hdf_put_numbers(file, row->state, type_of(row), (int)row->count,
                                (const char *)&state->point + row->offset, err)) {
            return false;
        }
    }
    return true;
}

bool gb_state_write(const struct gb_state *state, const struct gb_record *record,
                    const char *path, struct gb_error *err)
{
    struct gb_hdf *file = NULL;
    if (!gb_hdf_create(&file, path, err)) {
        return false;
    }
    bool done = write_numbers(state, file, err);
    for (int k = 0; k < ARRAY_COUNT && done; k++) {
        const struct gb_state_array array = array_of(state, &arrays[k]);
        done = gb_state_array_put(&array, file, err);
    }
    done = done && gb_state_optional_write(state, file, err) &&
           (record == NULL || gb_hdf_record_put(file, record, err)) &&
           gb_hdf_store(file, err);
    gb_hdf_destroy(file);
    return done;
}

static bool read_layout(struct gb_hdf *file, const char *path, struct gb_error *err)
{
    int32_t layout = 0;
    if (!gb_hdf_get_numbers(file, "layout", GB_HDF_INT32, 1, &layout, err)) {
        return false;
    }
    if (layout != layout_number) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: layout = %d: written by another version of greenbody, "
                            "expected %d",
                            path, layout, layout_number);
    }
    return true;
}

static bool read_numbers(struct gb_state *state, struct gb_hdf *file,
                         struct gb_error *err)
{
    int32_t dimension = 0;
    int32_t branch = 0;
    if (!gb_hdf_get_numbers(file, "dimension", GB_HDF_INT32, 1, &dimension, err) ||
        !gb_hdf_get_numbers(file, "branch", GB_HDF_INT32, 1, &branch, err) ||
        !gb_hdf_get_text(file, "title", state->preset, sizeof state->preset, err) ||
        !gb_hdf_get_text(file, "version", state->version, sizeof state->version, err)) {
        return false;
    }
    state->dimension = dimension;
    state->point.branch = branch;
    for (int k = 0; k < NUMBER_COUNT; k++) {
        const struct number_row *row = &numbers[k];
        if (!gb_hdf_get_numbers(file, row->name, row->type, row->count,
                                (char *)state + row->offset, err)) {
            return false;
        }
    }
    const struct gb_point_column *row;
    for (size_t k = 0; (row = gb_point_columns_at(k)) != NULL; k++) {
        if (row->state != NULL &&
            !gb_hdf_get_numbers(file, row->state, type_of(row), (int)row->count,
                                (char *)&state->point + row->offset, err)) {
            return false;
        }
    }
    return true;
}

static bool check_digest(const struct gb_state *state, struct gb_hdf *file,
                         const char *path, struct gb_error *err)
{
    char kept[DIGEST_SIZE];
    char sum[DIGEST_SIZE];
    if (!gb_hdf_get_text(file, "sha256", kept, sizeof kept, err)) {
        return false;
    }
    digest(state, sum);
    return strcmp(kept, sum) == 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: is damaged: the checksum sha256 does not match the data",
                        path);
}

static bool check(const struct gb_state *state, const char *path, struct gb_error *err)
{
    int64_t row = 0;
    const char *fault = gb_state_check(state, &row);
    if (fault == NULL) {
        return true;
    }
    if (fault[0] == '/') {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %s: row %lld is out of range", path,
                            fault, (long long)row);
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: is out of range", path, fault);
}

/* Sizes before memory: every dataset must agree with the first of its kind. */
static bool read_sizes(struct gb_hdf *file, const char *path, int64_t size[ROW_KINDS],
                       struct gb_error *err)
{
    for (int k = 0; k < ROW_KINDS; k++) {
        size[k] = -1;
    }
    for (int k = 0; k < ARRAY_COUNT; k++) {
        const struct gb_hdf_array shape = {
            .name = arrays[k].name, .type = arrays[k].type, .columns = arrays[k].columns};
        int64_t *known = &size[arrays[k].row_of];
        int64_t rows = 0;
        if (!gb_hdf_rows(file, &shape, &rows, err)) {
            return false;
        }
        *known = *known < 0 ? rows : *known;
        if (rows != *known ||
            (arrays[k].row_of == PARTICLE && (rows < 1 || rows > count_max))) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%s: %s: %lld rows do not fit a packing of %lld", path,
                                arrays[k].name, (long long)rows, (long long)*known);
        }
    }
    return true;
}

bool gb_state_read(struct gb_state **out, const char *path, struct gb_error *err)
{
    struct gb_hdf *file = NULL;
    struct gb_state *state = NULL;
    int64_t size[ROW_KINDS];
    *out = NULL;
    if (!gb_hdf_open(&file, path, err)) {
        return false;
    }
    bool done = read_layout(file, path, err) && read_sizes(file, path, size, err) &&
                gb_state_create(&state, size[PARTICLE], size[PAIR], err) &&
                gb_state_allocate_walls(state, size[WALL], err) &&
                read_numbers(state, file, err);
    for (int k = 0; k < ARRAY_COUNT && done; k++) {
        const struct gb_hdf_array shape = shape_of(&arrays[k], state);
        done = gb_hdf_get_array(file, &shape, *array_member(state, &arrays[k]), err);
    }
    done = done && check(state, path, err) && check_digest(state, file, path, err) &&
           gb_state_optional_read(state, file, path, err);
    gb_hdf_destroy(file);
    if (!done) {
        gb_state_destroy(state);
        return false;
    }
    *out = state;
    return true;
}
