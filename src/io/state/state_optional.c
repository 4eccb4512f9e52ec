#include "io/state/state_optional.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "hdf/hdf.h"
#include "io/state/state_array.h"

enum { DIGEST_SIZE = 65, BED_COLUMNS = 4 };

/* An array, and the items of a record that have it. */
struct optional_row {
    const char *name; /* of the dataset */
    const char *unit;
    int columns;
    bool of_pairs;
    size_t member;
    const char *cell, *bed; /* items: of a periodic cell, of a die; NULL: none */
    int power; /* of what turns their arcs into angles: diameter of a cell's, radius of a die's */
};

static const struct optional_row rows[] = {
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
enum { ROWS = sizeof rows / sizeof rows[0] };

static const char time_name[] = "second_per_time", sum_name[] = "sha256_optional";

/* Numbers that a state may lack, with the ends of their ranges. */
static const struct {
    const char *name;
    int count;
    size_t member;
    double low, high;
} numbers[] = {
    {"attraction_strength", 1, offsetof(struct gb_state, attraction_strength), 0.0, 1e9},
    {"attraction_shift_d", 1, offsetof(struct gb_state, attraction_shift), 0.0, 1e9},
    {"attraction_cutoff_d", 1, offsetof(struct gb_state, attraction_cutoff), 0.0, 1e9},
    {"pressed_axes", 3, offsetof(struct gb_state, pressed), 0.0, 1.0},
    {"punch_height_d", 1, offsetof(struct gb_state, punch_height), 0.0, 1e9},
    {"funnel_height_d", 1, offsetof(struct gb_state, funnel_height), 0.0, 1e9},
    {"funnel_outlet_d", 1, offsetof(struct gb_state, funnel_outlet), 0.0, 1e9},
    {"funnel_slope", 1, offsetof(struct gb_state, funnel_slope), 0.0, 1e3},
};
enum { NUMBERS = sizeof numbers / sizeof numbers[0], NUMBER_MAX = 3 };

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
    while (rows[k].member != member) {
        k++;
    }
    return &rows[k];
}

static struct gb_hdf_array shape_of(const struct gb_state *state,
                                    const struct optional_row *row)
{
    return (struct gb_hdf_array){.name = row->name,
                                 .type = GB_HDF_DOUBLE,
                                 .rows = row->of_pairs ? state->pair_count : state->count,
                                 .columns = row->columns,
                                 .unit = row->unit};
}

static struct gb_state_array array_of(const struct gb_state *state,
                                      const struct optional_row *row)
{
    return (struct gb_state_array){state, row->member, shape_of(state, row)};
}

static bool allocate(struct gb_state *state, const struct optional_row *row,
                     struct gb_error *err)
{
    const struct gb_hdf_array shape = shape_of(state, row);
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
    return allocate(state, row_at(offset), err);
}

void gb_state_optional_free(struct gb_state *state)
{
    for (int k = 0; k < ROWS; k++) {
        gb_alloc_free(*member_of(state, &rows[k]));
        *member_of(state, &rows[k]) = NULL;
    }
}

/* Rows begin .. end - 1: three numbers of each row of the item, arcs as angles. */
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

/* The item of an array that the record has; NULL without one. */
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
    for (int k = 0; k < ROWS; k++) {
        const struct optional_row *row = &rows[k];
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
    for (int k = 0; k < ROWS; k++) {
        const struct optional_row *row = &rows[k];
        const struct gb_record_item *item = find_item(state, row, record);
        if (item && !allocate(state, row, err)) {
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

/* SHA-256 of the arrays that are there, in the order of the table. */
static bool digest(const struct gb_state *state, char text[DIGEST_SIZE])
{
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    bool some = false;
    for (int k = 0; k < ROWS; k++) {
        const struct gb_state_array array = array_of(state, &rows[k]);
        if (gb_state_array_exists(&array)) {
            g_checksum_update(sum, (const guchar *)rows[k].name, -1);
            gb_state_array_sum(&array, sum);
            some = true;
        }
    }
    g_strlcpy(text, g_checksum_get_string(sum), DIGEST_SIZE);
    g_checksum_free(sum);
    return some;
}

bool gb_state_optional_write(const struct gb_state *state, struct gb_hdf *file,
                             struct gb_error *err)
{
    char sum[DIGEST_SIZE];
    bool done = !digest(state, sum) || gb_hdf_put_text(file, sum_name, sum, err);
    if (done && isfinite(state->second_per_time)) {
        done = gb_hdf_put_numbers(file, time_name, GB_HDF_DOUBLE, 1,
                                  &state->second_per_time, err);
    }
    for (int k = 0; k < NUMBERS && done; k++) {
        const void *value = (const char *)state + numbers[k].member;
        done = gb_hdf_put_numbers(file, numbers[k].name, GB_HDF_DOUBLE, numbers[k].count,
                                  value, err);
    }
    for (int k = 0; k < ROWS && done; k++) {
        const struct gb_state_array array = array_of(state, &rows[k]);
        done = !gb_state_array_exists(&array) || gb_state_array_put(&array, file, err);
    }
    return done;
}

static bool check(const struct gb_state *state, const char *path, struct gb_error *err)
{
    for (int k = 0; k < ROWS; k++) {
        const struct gb_hdf_array shape = shape_of(state, &rows[k]);
        const double *data = data_of(state, &rows[k]);
        for (int64_t i = 0; data != NULL && i < shape.rows * shape.columns; i++) {
            if (!isfinite(data[i])) {
                return gb_error_set(err, GB_ERR_INPUT, "%s: %s: row %lld is out of range",
                                    path, rows[k].name, (long long)(i / shape.columns));
            }
        }
    }
    return true;
}

/* What is out of range stays as gb_state_create has it. */
static void read_numbers(struct gb_state *state, struct gb_hdf *file)
{
    for (int k = 0; k < NUMBERS; k++) {
        double value[NUMBER_MAX];
        bool good = gb_hdf_get_numbers(file, numbers[k].name, GB_HDF_DOUBLE,
                                       numbers[k].count, value, NULL);
        for (int c = 0; c < numbers[k].count && good; c++) {
            good = value[c] >= numbers[k].low && value[c] <= numbers[k].high;
        }
        if (good) {
            memcpy((char *)state + numbers[k].member, value,
                   (size_t)numbers[k].count * sizeof *value);
        }
    }
}

bool gb_state_optional_read(struct gb_state *state, struct gb_hdf *file, const char *path,
                            struct gb_error *err)
{
    char kept[DIGEST_SIZE], sum[DIGEST_SIZE];
    bool done = true, some = false;
    for (int k = 0; k < ROWS && done; k++) {
        if (gb_hdf_list_has(file, rows[k].name)) {
            const struct gb_hdf_array shape = shape_of(state, &rows[k]);
            some = true;
            done = allocate(state, &rows[k], err) &&
                   gb_hdf_get_array(file, &shape, *member_of(state, &rows[k]), err);
        }
    }
    const bool summed = gb_hdf_get_text(file, sum_name, kept, sizeof kept, NULL);
    digest(state, sum);
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
    read_numbers(state, file);
    return done && check(state, path, err);
}
