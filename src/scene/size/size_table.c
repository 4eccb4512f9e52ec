#include "scene/size/size_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/table.h"
#include "base/units.h"
#include "scene/derived.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"

static const char by_number[] = "number:", by_volume[] = "volume:";
static const char share_number[] = "share_number", share_volume[] = "share_volume";

bool gb_size_table_is_path(const char *text)
{
    return *text != '\0' && !g_str_has_prefix(text, by_number) &&
           !g_str_has_prefix(text, by_volume);
}

static bool check_row(const struct gb_sizetable *table, int i, struct gb_error *err)
{
    const struct gb_sizetable_row *row = &table->row[i];
    char given[64], before[64];
    gb_units_format(row->diameter_m, GB_DIM_LENGTH, given, sizeof given);
    if (!isfinite(row->diameter_m) || !(row->diameter_m > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "diameter %s: must be above 0", given);
    }
    if (i > 0 && !(row->diameter_m > row[-1].diameter_m)) {
        gb_units_format(row[-1].diameter_m, GB_DIM_LENGTH, before, sizeof before);
        return gb_error_set(err, GB_ERR_INPUT,
                            "diameter %s: must be above %s, the one before it", given,
                            before);
    }
    return (row->fraction >= 0.0 && row->fraction <= 1.0 + GB_SIZE_FRACTIONS_TOLERANCE) ||
           gb_error_set(err, GB_ERR_INPUT, "share %g: must be between 0 and 1",
                        row->fraction);
}

bool gb_size_table_check(const struct gb_sizetable *table, int *row, struct gb_error *err)
{
    int nowhere = 0;
    row = row ? row : &nowhere;
    *row = -1;
    if (table->count < 0 || table->count > GB_SIZES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%d rows: must be at most %d",
                            table->count, GB_SIZES_MAX);
    }
    double sum = 0.0;
    for (int i = 0; i < table->count; i++) {
        if (!check_row(table, i, err)) {
            *row = i;
            return false;
        }
        sum += table->row[i].fraction;
    }
    return table->count == 0 || fabs(sum - 1.0) <= GB_SIZE_FRACTIONS_TOLERANCE ||
           gb_error_set(err, GB_ERR_INPUT, "the shares sum to %.6g: must be 1 within %g",
                        sum, GB_SIZE_FRACTIONS_TOLERANCE);
}

/* "1.5 um 0.25": the share is the last word. */
static bool read_pair(char *text, struct gb_sizetable_row *row)
{
    char *last = g_strrstr(g_strstrip(text), " ");
    if (last == NULL) {
        return false;
    }
    *last = '\0';
    return gb_units_parse(text, GB_DIM_LENGTH, &row->diameter_m, NULL) &&
           gb_units_parse(last + 1, GB_DIM_NONE, &row->fraction, NULL);
}

static bool read_line(struct gb_sizetable *table, const char *text, struct gb_error *err)
{
    table->by_volume = g_str_has_prefix(text, by_volume);
    char **part = g_strsplit(text + strlen(by_number), ";", GB_SIZES_MAX + 2);
    bool good = true;
    for (int i = 0; part[i] && good; i++) {
        if (*g_strstrip(part[i]) == '\0') {
            continue; /* after the last ';' */
        }
        char *given = g_strdup(part[i]);
        if (table->count == GB_SIZES_MAX) {
            good =
                gb_error_set(err, GB_ERR_INPUT, "must be at most %d sizes", GB_SIZES_MAX);
        } else if (!read_pair(part[i], &table->row[table->count++])) {
            good = gb_error_set(err, GB_ERR_INPUT,
                                "%.60s: must be a diameter and a share, as in 1.5 um "
                                "0.25",
                                given);
        }
        g_free(given);
    }
    g_strfreev(part);
    if (good && table->count == 0) {
        good = gb_error_set(err, GB_ERR_INPUT, "%s must be followed by sizes", text);
    }
    int row = -1;
    struct gb_error why = {0};
    if (good && !gb_size_table_check(table, &row, &why)) {
        good = row < 0 ? gb_error_set(err, why.code, "%s", why.text)
                       : gb_error_set(err, why.code, "size %d: %s", row + 1, why.text);
    }
    return good;
}

/* What the columns of a file are. */
struct columns {
    const char *unit;       /* behind "diameter_"; NULL: the cells carry units */
    const double *diameter; /* NULL: words */
    const double *share;
};

static bool find_columns(const struct gb_table *csv, struct gb_sizetable *table,
                         struct columns *columns, struct gb_error *err)
{
    static const char prefix[] = "diameter_";
    const char *diameter = NULL, *share = NULL, *name;
    for (size_t k = 0; (name = gb_table_name(csv, k)) != NULL; k++) {
        const bool is_size =
            strcmp(name, "diameter") == 0 || g_str_has_prefix(name, prefix);
        const bool is_share =
            strcmp(name, share_number) == 0 || strcmp(name, share_volume) == 0;
        if ((is_size && diameter) || (is_share && share)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%s: columns %s and %.40s: must be one of them",
                                gb_table_path(csv), is_size ? diameter : share, name);
        }
        diameter = is_size ? name : diameter;
        share = is_share ? name : share;
    }
    if (!diameter || !share) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: no column of %s; must be %s",
                            gb_table_path(csv), diameter ? "shares" : "diameters",
                            diameter ? "share_number or share_volume"
                                     : "diameter, or diameter_um and the like");
    }
    *columns = (struct columns){.share = gb_table_column(csv, share, err)};
    if (g_str_has_prefix(diameter, prefix)) {
        columns->unit = diameter + strlen(prefix);
        columns->diameter = gb_table_column(csv, diameter, err);
    }
    table->by_volume = strcmp(share, share_volume) == 0;
    return true;
}

/* One row; the unit of the header is put behind the number, so that "1.3" under
 * diameter_um is the same double as "1.3 um". */
static bool take_row(const struct gb_table *csv, const struct columns *columns, size_t i,
                     struct gb_sizetable_row *row, struct gb_error *err)
{
    char text[128], number[64];
    if (columns->diameter) {
        gb_units_format(columns->diameter[i], GB_DIM_NONE, number, sizeof number);
        snprintf(text, sizeof text, "%s %.40s", number, columns->unit);
    } else {
        g_strlcpy(text, gb_table_word(csv, i), sizeof text);
    }
    row->fraction = columns->share[i];
    return gb_units_parse(text, GB_DIM_LENGTH, &row->diameter_m, err);
}

static bool take_rows(const struct gb_table *csv, struct gb_sizetable *table,
                      struct gb_error *err)
{
    struct columns columns = {0};
    const char *path = gb_table_path(csv);
    const size_t rows = gb_table_rows(csv);
    if (!find_columns(csv, table, &columns, err)) {
        return false;
    }
    if (rows < 1 || rows > GB_SIZES_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: %zu rows: must be between 1 and %d",
                            path, rows, GB_SIZES_MAX);
    }
    struct gb_error why = {0};
    for (size_t i = 0; i < rows; i++) {
        if (!take_row(csv, &columns, i, &table->row[i], &why)) {
            return gb_error_set(err, why.code, "%s:%d: %s", path, gb_table_line(csv, i),
                                why.text);
        }
    }
    table->count = (int)rows;
    int row = -1;
    if (gb_size_table_check(table, &row, &why)) {
        return true;
    }
    const size_t at = row < 0 ? rows - 1 : (size_t)row;
    return gb_error_set(err, why.code, "%s:%d: %s", path, gb_table_line(csv, at),
                        why.text);
}

static bool read_csv(struct gb_sizetable *table, const char *path, struct gb_error *err)
{
    struct gb_table *csv = NULL;
    if (!gb_table_read(&csv, path, "diameter", err)) {
        return false;
    }
    const bool good = take_rows(csv, table, err);
    gb_table_destroy(csv);
    return good;
}

bool gb_size_table_read(struct gb_sizetable *table, const char *text,
                        struct gb_error *err)
{
    struct gb_sizetable read = {0};
    if (gb_size_table_is_path(text) ? !read_csv(&read, text, err)
                                    : *text != '\0' && !read_line(&read, text, err)) {
        return false;
    }
    *table = read;
    return true;
}

char *gb_size_table_write(const struct gb_sizetable *table, char *buffer, size_t size)
{
    const int count = CLAMP(table->count, 0, GB_SIZES_MAX);
    g_strlcpy(buffer, count == 0 ? "" : table->by_volume ? by_volume : by_number, size);
    for (int i = 0; i < count; i++) {
        char diameter[64], share[64];
        gb_units_format(table->row[i].diameter_m, GB_DIM_LENGTH, diameter,
                        sizeof diameter);
        gb_units_format(table->row[i].fraction, GB_DIM_NONE, share, sizeof share);
        const size_t used = strlen(buffer);
        snprintf(buffer + used, size - used, "%s %s %s", i > 0 ? ";" : "", diameter,
                 share);
    }
    return buffer;
}

/* A cut on the wrong side of the median would leave almost no particles. */
static bool check_lognormal(const struct gb_params *params, struct gb_error *err)
{
    const double median = gb_derived_median_m(params);
    const bool low = params->diameter_min_m >= median,
               high = params->diameter_max_m <= median;
    if (!low && !high) {
        return true;
    }
    char cut[64], middle[64];
    gb_units_format(low ? params->diameter_min_m : params->diameter_max_m, GB_DIM_LENGTH,
                    cut, sizeof cut);
    gb_units_format(median, GB_DIM_LENGTH, middle, sizeof middle);
    return gb_error_set(err, GB_ERR_INPUT, "particles.%s = %s: must be %s the median, %s",
                        low ? "least" : "largest", cut, low ? "below" : "above", middle);
}

bool gb_size_table_check_params(const struct gb_params *params, struct gb_error *err)
{
    if (params->distribution == GB_DISTRIBUTION_TABLE && params->sizes.count == 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "particles.table: must not be empty with "
                            "particles.distribution = table");
    }
    return params->distribution != GB_DISTRIBUTION_LOGNORMAL ||
           check_lognormal(params, err);
}
