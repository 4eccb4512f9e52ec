#include "io/state.h"

#include <glib.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/record.h"
#include "hdf/hdf.h"
#include "hdf/hdf_record.h"
#include "io/point_columns.h"
#include "io/state_record.h"
#include "pack/die/die.h"
#include "scene/path/path.h"

/* A state and its file state.h5.  Order of this file: arrays that every state has,
 * optional arrays, checks of the contents of a file, writing, reading. */

/* Increased when older readers would misunderstand a file; other layouts are not read. */
static const int32_t layout_number = 6;

/* A file with more rows than this is damaged. */
static const int64_t count_max = 200000000;

/* What the rows of an array belong to. */
enum row_of { PARTICLE, PAIR, WALL, ROW_KINDS };

/* An array of the file and its member of the struct. */
struct array_row {
    const char *name;
    enum gb_hdf_type type;
    int columns;
    enum row_of row_of;
    size_t offset;
    const char *unit;
};

enum { BED_COLUMNS = 4 };

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

/* A number in the file's root group; its name contains the unit.  Numbers of the point
 * are rows of io/point_columns.h. */
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

/* An array to be written: in memory, or generated some rows at a time by the state's
 * source. */
struct state_array {
    const struct gb_state *state;
    size_t member; /* offset of its pointer in gb_state */
    struct gb_hdf_array shape;
};

static const char *in_memory(const struct state_array *array)
{
    return *(const char *const *)(const void *)((const char *)array->state +
                                                array->member);
}

static bool array_exists(const struct state_array *array)
{
    return in_memory(array) != NULL ||
           gb_state_record_has(array->state->source, array->member);
}

/* Rows begin .. end - 1, valid until the next call. */
static const void *rows_at(void *data, int64_t begin, int64_t end)
{
    const struct state_array *array = data;
    const char *memory = in_memory(array);
    return memory != NULL ? memory + (size_t)begin * gb_hdf_row_bytes(&array->shape)
                          : gb_state_record_rows(array->state, array->member, begin, end);
}

static void array_sum(const struct state_array *array, GChecksum *sum)
{
    struct state_array of = *array;
    const int64_t rows = array->shape.rows, slab = gb_hdf_slab_rows(&array->shape);
    for (int64_t at = 0; at < rows; at += slab) {
        const int64_t end = at + slab < rows ? at + slab : rows;
        const size_t bytes = (size_t)(end - at) * gb_hdf_row_bytes(&array->shape);
        g_checksum_update(sum, rows_at(&of, at, end), (gssize)bytes);
    }
}

static bool array_put(const struct state_array *array, struct gb_hdf *file,
                      struct gb_error *err)
{
    struct state_array of = *array;
    return gb_hdf_put_rows(file, &array->shape, (struct gb_hdf_rows){rows_at, &of}, err);
}

/* An optional array, and the record items that contain it. */
struct optional_row {
    const char *name; /* of the dataset */
    const char *unit;
    int columns;
    bool of_pairs;
    size_t member;
    const char *cell, *bed; /* items: of a periodic cell, of a die; NULL: none */
    int power; /* of the length in arcs: diameter in a cell, radius in a die */
};

/* Only scenes with time have velocities; only states of a run have resultants and
 * contact radii. */
static const struct optional_row optional_rows[] = {
    {"/velocity", "d/T", 3, false, offsetof(struct gb_state, velocity), "motion/velocity",
     "bed/speed", 0},
    {"/spin", "1/T", 3, false, offsetof(struct gb_state, spin), "motion/spin", "bed/roll",
     -1},
    {"/force", "E d^2", 3, false, offsetof(struct gb_state, force), "world/force",
     "bed/force", 0},
    {"/torque", "E d^3", 3, false, offsetof(struct gb_state, torque), "world/torque",
     "bed/moment", 1},
    {"/contact_radius", "d", 1, true, offsetof(struct gb_state, contact_radius), NULL,
     NULL, 0},
};
enum { OPTIONAL_ROWS = sizeof optional_rows / sizeof optional_rows[0] };

static const char time_name[] = "second_per_time", sum_name[] = "sha256_optional";

/* Optional numbers with the limits of their ranges. */
static const struct {
    const char *name;
    int count;
    size_t member;
    double low, high;
} optional_numbers[] = {
    {"attraction_strength", 1, offsetof(struct gb_state, attraction_strength), 0.0, 1e9},
    {"attraction_shift_d", 1, offsetof(struct gb_state, attraction_shift), 0.0, 1e9},
    {"attraction_cutoff_d", 1, offsetof(struct gb_state, attraction_cutoff), 0.0, 1e9},
    {"pressed_axes", 3, offsetof(struct gb_state, pressed), 0.0, 1.0},
    {"punch_height_d", 1, offsetof(struct gb_state, punch_height), 0.0, 1e9},
    {"funnel_height_d", 1, offsetof(struct gb_state, funnel_height), 0.0, 1e9},
    {"funnel_outlet_d", 1, offsetof(struct gb_state, funnel_outlet), 0.0, 1e9},
    {"funnel_slope", 1, offsetof(struct gb_state, funnel_slope), 0.0, 1e3},
};
enum {
    OPTIONAL_NUMBERS = sizeof optional_numbers / sizeof optional_numbers[0],
    NUMBER_MAX = 3
};

static double **member_of(struct gb_state *state, const struct optional_row *row)
{
    return (double **)(void *)((char *)state + row->member);
}

static const double *data_of(const struct gb_state *state, const struct optional_row *row)
{
    return *(double *const *)(const void *)((const char *)state + row->member);
}

static const struct optional_row *row_at(size_t member)
{
    size_t k = 0;
    while (optional_rows[k].member != member) {
        k++;
    }
    return &optional_rows[k];
}

static struct gb_hdf_array optional_shape_of(const struct gb_state *state,
                                             const struct optional_row *row)
{
    return (struct gb_hdf_array){.name = row->name,
                                 .type = GB_HDF_DOUBLE,
                                 .rows = row->of_pairs ? state->pair_count : state->count,
                                 .columns = row->columns,
                                 .unit = row->unit};
}

static struct state_array optional_array_of(const struct gb_state *state,
                                            const struct optional_row *row)
{
    return (struct state_array){state, row->member, optional_shape_of(state, row)};
}

static bool optional_allocate(struct gb_state *state, const struct optional_row *row,
                              struct gb_error *err)
{
    const struct gb_hdf_array shape = optional_shape_of(state, row);
    double **member = member_of(state, row);
    gb_alloc_free(*member);
    *member = gb_alloc_array((size_t)(shape.rows + 1) * (size_t)shape.columns,
                             sizeof **member, err);
    return *member != NULL;
}

bool gb_state_optional_allocate(struct gb_state *state, double **member,
                                struct gb_error *err)
{
    const size_t offset = (size_t)((const char *)member - (const char *)state);
    return optional_allocate(state, row_at(offset), err);
}

static void optional_free(struct gb_state *state)
{
    for (int k = 0; k < OPTIONAL_ROWS; k++) {
        gb_alloc_free(*member_of(state, &optional_rows[k]));
        *member_of(state, &optional_rows[k]) = NULL;
    }
}

/* Converts rows begin .. end - 1 of an item, with arcs as angles. */
static void fill_rows(const struct gb_state *state, const struct optional_row *row,
                      const struct gb_record_item *item, int64_t begin, int64_t end,
                      double *to)
{
    const double lengths = state->die_radius > 0.0 ? 1.0 : 2.0;
    for (int64_t i = begin; i < end; i++) {
        const double length = lengths * state->radius[i];
        const double factor = row->power == 0  ? 1.0
                              : row->power > 0 ? length
                                               : 1.0 / length;
        for (int c = 0; c < row->columns; c++) {
            to[row->columns * (i - begin) + c] =
                factor * gb_record_number(item, item->columns * i + c);
        }
    }
}

static const char *item_of(const struct gb_state *state, const struct optional_row *row)
{
    return state->die_radius > 0.0 ? row->bed : row->cell;
}

static int item_columns(const struct gb_state *state, const struct optional_row *row)
{
    return state->die_radius > 0.0 ? BED_COLUMNS : row->columns;
}

/* The item of an array in the record; NULL if there is none. */
static const struct gb_record_item *find_item(const struct gb_state *state,
                                              const struct optional_row *row,
                                              const struct gb_record *record)
{
    const char *name = item_of(state, row);
    return name ? gb_record_find(record, name) : NULL;
}

bool gb_state_optional_check(const struct gb_state *state, const struct gb_record *record,
                             struct gb_error *err)
{
    for (int k = 0; k < OPTIONAL_ROWS; k++) {
        const struct optional_row *row = &optional_rows[k];
        const struct gb_record_item *item = find_item(state, row, record);
        if (item && (item->type != GB_RECORD_DOUBLE || item->rows != state->count ||
                     item->columns != item_columns(state, row))) {
            return gb_error_set(err, GB_ERR_INPUT, "%s: has another shape", item->name);
        }
    }
    return true;
}

bool gb_state_optional_take(struct gb_state *state, const struct gb_record *record,
                            struct gb_error *err)
{
    if (!gb_state_optional_check(state, record, err)) {
        return false;
    }
    for (int k = 0; k < OPTIONAL_ROWS; k++) {
        const struct optional_row *row = &optional_rows[k];
        const struct gb_record_item *item = find_item(state, row, record);
        if (item && !optional_allocate(state, row, err)) {
            return false;
        }
        if (item) {
            fill_rows(state, row, item, 0, state->count, *member_of(state, row));
        }
    }
    return true;
}

bool gb_state_optional_has(const struct gb_record *record, size_t member)
{
    const char *name = row_at(member)->cell;
    return name != NULL && gb_record_find(record, name) != NULL;
}

void gb_state_optional_fill(const struct gb_state *state, const struct gb_record *record,
                            size_t member, int64_t begin, int64_t end, double *to)
{
    const struct optional_row *row = row_at(member);
    const struct gb_record_item *item = gb_record_find(record, row->cell);
    fill_rows(state, row, item, begin, end, to);
}

/* SHA-256 of the optional arrays that exist, in the order of the table. */
static bool optional_digest(const struct gb_state *state, char text[DIGEST_SIZE])
{
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    bool some = false;
    for (int k = 0; k < OPTIONAL_ROWS; k++) {
        const struct state_array array = optional_array_of(state, &optional_rows[k]);
        if (array_exists(&array)) {
            g_checksum_update(sum, (const guchar *)optional_rows[k].name, -1);
            array_sum(&array, sum);
            some = true;
        }
    }
    g_strlcpy(text, g_checksum_get_string(sum), DIGEST_SIZE);
    g_checksum_free(sum);
    return some;
}

/* Writes the optional datasets with a checksum of their own. */
static bool optional_write(const struct gb_state *state, struct gb_hdf *file,
                           struct gb_error *err)
{
    char sum[DIGEST_SIZE];
    bool done = !optional_digest(state, sum) || gb_hdf_put_text(file, sum_name, sum, err);
    if (done && isfinite(state->second_per_time)) {
        done = gb_hdf_put_numbers(file, time_name, GB_HDF_DOUBLE, 1,
                                  &state->second_per_time, err);
    }
    for (int k = 0; k < OPTIONAL_NUMBERS && done; k++) {
        const void *value = (const char *)state + optional_numbers[k].member;
        done = gb_hdf_put_numbers(file, optional_numbers[k].name, GB_HDF_DOUBLE,
                                  optional_numbers[k].count, value, err);
    }
    for (int k = 0; k < OPTIONAL_ROWS && done; k++) {
        const struct state_array array = optional_array_of(state, &optional_rows[k]);
        done = !array_exists(&array) || array_put(&array, file, err);
    }
    return done;
}

static bool optional_check(const struct gb_state *state, const char *path,
                           struct gb_error *err)
{
    for (int k = 0; k < OPTIONAL_ROWS; k++) {
        const struct gb_hdf_array shape = optional_shape_of(state, &optional_rows[k]);
        const double *data = data_of(state, &optional_rows[k]);
        for (int64_t i = 0; data != NULL && i < shape.rows * shape.columns; i++) {
            if (!isfinite(data[i])) {
                return gb_error_set(err, GB_ERR_INPUT, "%s: %s: row %lld is out of range",
                                    path, optional_rows[k].name,
                                    (long long)(i / shape.columns));
            }
        }
    }
    return true;
}

/* Reads optional numbers; a value out of range keeps its default. */
static void optional_read_numbers(struct gb_state *state, struct gb_hdf *file)
{
    for (int k = 0; k < OPTIONAL_NUMBERS; k++) {
        double value[NUMBER_MAX];
        bool good = gb_hdf_get_numbers(file, optional_numbers[k].name, GB_HDF_DOUBLE,
                                       optional_numbers[k].count, value, NULL);
        for (int c = 0; c < optional_numbers[k].count && good; c++) {
            good = value[c] >= optional_numbers[k].low &&
                   value[c] <= optional_numbers[k].high;
        }
        if (good) {
            memcpy((char *)state + optional_numbers[k].member, value,
                   (size_t)optional_numbers[k].count * sizeof *value);
        }
    }
}

/* Reads the optional arrays; the radii and sizes of the state must be set.  Errors:
 * GB_ERR_MEMORY, GB_ERR_INPUT naming path and dataset. */
static bool optional_read(struct gb_state *state, struct gb_hdf *file, const char *path,
                          struct gb_error *err)
{
    char kept[DIGEST_SIZE], sum[DIGEST_SIZE];
    bool done = true, some = false;
    for (int k = 0; k < OPTIONAL_ROWS && done; k++) {
        if (gb_hdf_list_has(file, optional_rows[k].name)) {
            const struct gb_hdf_array shape = optional_shape_of(state, &optional_rows[k]);
            some = true;
            done =
                optional_allocate(state, &optional_rows[k], err) &&
                gb_hdf_get_array(file, &shape, *member_of(state, &optional_rows[k]), err);
        }
    }
    const bool summed = gb_hdf_get_text(file, sum_name, kept, sizeof kept, NULL);
    optional_digest(state, sum);
    if (done && (some || summed) && (!summed || strcmp(kept, sum) != 0)) {
        done = gb_error_set(err, GB_ERR_INPUT,
                            "%s: is damaged: the checksum %s does not match the data",
                            path, sum_name);
    }
    double second = 0.0;
    const bool timed =
        gb_hdf_get_numbers(file, time_name, GB_HDF_DOUBLE, 1, &second, NULL);
    state->second_per_time =
        timed && isfinite(second) && second > 0.0 ? second : (double)NAN;
    optional_read_numbers(state, file);
    return done && optional_check(state, path, err);
}

/* The pointer member of a row. */
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

static struct state_array array_of(const struct gb_state *state,
                                   const struct array_row *row)
{
    return (struct state_array){state, row->offset, shape_of(row, state)};
}

static bool allocate(struct gb_state *state, const struct array_row *row,
                     struct gb_error *err)
{
    const struct gb_hdf_array shape = shape_of(row, state);
    /* one row more, so that an empty array is not NULL */
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
    optional_free(state);
    gb_state_record_destroy(state->source);
    gb_alloc_free(state);
}

/* Larger lengths (d) mean that a file is damaged. */
static const double length_max = 1e9;

static bool positive(double x, double limit)
{
    return isfinite(x) && x > 0.0 && x <= limit;
}

/* Is this the number of a branch, a stage of a die, or a leg from the second on? */
static bool is_branch(int branch)
{
    return branch >= GB_BRANCH_LEAST ||
           (branch < GB_BRANCH_LEG - 1 && branch >= GB_BRANCH_LEG - GB_PATH_LEGS_MAX);
}

static const char *header_fault(const struct gb_state *state)
{
    if (state->dimension != 2 && state->dimension != 3) {
        return "dimension";
    }
    for (int k = 0; k < 3; k++) {
        if (!positive(state->cell[k], length_max)) {
            return "cell_d";
        }
    }
    if (!positive(state->metre_per_length, 1e3)) {
        return "metre_per_length";
    }
    if (!positive(state->pascal_per_stress, 1e30)) {
        return "pascal_per_stress";
    }
    if (state->point.step < 0 || !is_branch(state->point.branch)) {
        return state->point.step < 0 ? "step" : "branch";
    }
    /* NaN marks a value that does not exist; no quantity of a packing is infinite */
    const struct gb_point_column *row;
    for (size_t k = 0; (row = gb_point_columns_at(k)) != NULL; k++) {
        if (row->finite && isinf(gb_point_columns_value(row, &state->point, 0))) {
            return row->state;
        }
    }
    return NULL;
}

static const char *particle_fault(const struct gb_state *state, int64_t i)
{
    for (int k = 0; k < 3; k++) {
        /* at most one cell outside, so that readers can wrap a position in one step */
        const double x = state->position[3 * i + k] / state->cell[k];
        if (!(x >= -1.0 && x <= 2.0)) {
            return "/position";
        }
    }
    if (!positive(state->radius[i], length_max)) {
        return "/radius";
    }
    return state->contacts[i] < 0 ? "/contacts" : NULL;
}

static const char *pair_fault(const struct gb_state *state, int64_t i)
{
    const int32_t a = state->pair[2 * i];
    const int32_t b = state->pair[2 * i + 1];
    if (a < 0 || b < 0 || a >= state->count || b >= state->count || a == b) {
        return "/pair";
    }
    for (int k = 0; k < 3; k++) {
        if (!isfinite(state->pair_force[3 * i + k])) {
            return "/pair_force";
        }
    }
    if (!isfinite(state->pair_normal[i])) {
        return "/pair_normal";
    }
    return state->pair_bridged[i] > 1 ? "/pair_bridged" : NULL;
}

static const char *wall_fault(const struct gb_state *state, int64_t i)
{
    const int32_t particle = state->wall[2 * i], wall = state->wall[2 * i + 1];
    if (particle < 0 || particle >= state->count || wall < 0 || wall >= GB_DIE_WALLS) {
        return "/wall";
    }
    for (int k = 0; k < 3; k++) {
        if (!isfinite(state->wall_force[3 * i + k])) {
            return "/wall_force";
        }
    }
    return NULL;
}

/* Name of the first dataset or attribute with an impossible value, and its row for
 * datasets; NULL if there is none. */
static const char *first_fault(const struct gb_state *state, int64_t *row)
{
    const char *fault = header_fault(state);
    *row = 0;
    for (int64_t i = 0; i < state->count && fault == NULL; i++) {
        fault = particle_fault(state, i);
        *row = i;
    }
    for (int64_t i = 0; i < state->pair_count && fault == NULL; i++) {
        fault = pair_fault(state, i);
        *row = i;
    }
    for (int64_t i = 0; i < state->wall_count && fault == NULL; i++) {
        fault = wall_fault(state, i);
        *row = i;
    }
    return fault;
}

/* SHA-256 of all arrays in the order of the table.  HDF5 has checksums for its headers
 * but not for plain data. */
static void digest(const struct gb_state *state, char text[DIGEST_SIZE])
{
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (int k = 0; k < ARRAY_COUNT; k++) {
        const struct state_array array = array_of(state, &arrays[k]);
        array_sum(&array, sum);
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
        const struct state_array array = array_of(state, &arrays[k]);
        done = array_put(&array, file, err);
    }
    done = done && optional_write(state, file, err) &&
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
    const char *fault = first_fault(state, &row);
    if (fault == NULL) {
        return true;
    }
    if (fault[0] == '/') {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %s: row %lld is out of range", path,
                            fault, (long long)row);
    }
    return gb_error_set(err, GB_ERR_INPUT, "%s: %s: is out of range", path, fault);
}

/* Reads the sizes before memory is allocated.  Every dataset must have as many rows as
 * the first of its kind. */
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
           optional_read(state, file, path, err);
    gb_hdf_destroy(file);
    if (!done) {
        gb_state_destroy(state);
        return false;
    }
    *out = state;
    return true;
}
