#include "io/lab/lab_private.h"

#include <math.h>
#include <string.h>

/* A fall of the pressure below this share of the highest one so far is more than noise. */
static const double fall_share = 0.95;

/* Where a row of a fall lies between the loading curve at its pressure (0) and the density
 * at the highest pressure (1), above this it is unloaded: springback is a small part of
 * compaction.  Points of compacts in any order lie on the curve. */
static const double unloaded_share = 0.5;

/* Rows of loading of one series: pressures ascend. */
struct loading {
    size_t *row;
    size_t count;
};

/* Density of loading at a pressure below its highest. */
static double density_at(const struct gb_lab_reading *reading,
                         const struct loading *loading, double pressure)
{
    size_t low = 0;
    size_t high = loading->count - 1;
    const double *p = reading->pressure;
    const double *rho = reading->density;
    if (p[loading->row[0]] >= pressure) {
        return rho[loading->row[0]];
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (p[loading->row[middle]] < pressure) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const size_t a = loading->row[low];
    const size_t b = loading->row[high];
    return p[b] > p[a] ? rho[a] + (rho[b] - rho[a]) * (pressure - p[a]) / (p[b] - p[a])
                       : rho[b];
}

/* A stretch of rows below the highest pressure: their indices among `rows`. */
struct fall {
    const size_t *rows;
    size_t from, to;
};

static bool is_unloading(const struct gb_lab_reading *reading,
                         const struct loading *loading, const struct fall *fall)
{
    const double most = reading->density[loading->row[loading->count - 1]];
    size_t unloaded = 0;
    for (size_t i = fall->from; i < fall->to; i++) {
        const size_t row = fall->rows[i];
        const double curve = density_at(reading, loading, reading->pressure[row]);
        unloaded += reading->density[row] > curve + unloaded_share * (most - curve);
    }
    return 2 * unloaded > fall->to - fall->from;
}

static void say_order(struct gb_lab_reading *reading)
{
    static const char text[] = ", rows not in the order of pressure taken as loading";
    if (strstr(reading->said->str, text) == NULL) {
        g_string_append(reading->said, text);
    }
}

/* Decides on a fall; the loading continues behind it. */
static void judge(struct gb_lab_reading *reading, const struct loading *loading,
                  const struct fall *fall, bool *kept)
{
    double least = INFINITY;
    for (size_t i = fall->from; i < fall->to; i++) {
        least = fmin(least, reading->pressure[fall->rows[i]]);
    }
    const double most = reading->pressure[loading->row[loading->count - 1]];
    if (least >= fall_share * most) {
        return;
    }
    if (!is_unloading(reading, loading, fall)) {
        say_order(reading);
        return;
    }
    for (size_t i = fall->from; i < fall->to; i++) {
        kept[fall->rows[i]] = false;
        gb_lab_rows_leave_out(reading, "of unloading", reading->line[fall->rows[i]]);
    }
}

/* The rows of one series, in the order of the file. */
static void drop_of_series(struct gb_lab_reading *reading, const size_t *rows,
                           size_t count, bool *kept)
{
    struct loading loading = {g_new(size_t, count), 0};
    struct fall fall = {rows, 0, 0};
    for (size_t i = 0; i < count; i = fall.to) {
        const double most =
            loading.count > 0 ? reading->pressure[loading.row[loading.count - 1]] : 0.0;
        fall.from = i;
        fall.to = i;
        while (fall.to < count && reading->pressure[rows[fall.to]] < most) {
            fall.to++;
        }
        if (fall.to > fall.from) {
            judge(reading, &loading, &fall, kept);
        } else {
            loading.row[loading.count++] = rows[i];
            fall.to = i + 1;
        }
    }
    g_free(loading.row);
}

void gb_lab_branch_drop(struct gb_lab_reading *reading)
{
    if (reading->column[GB_LAB_ROLE_BRANCH].index != GB_LAB_NONE) {
        return;
    }
    bool *kept = g_new0(bool, reading->count);
    bool *seen = g_new0(bool, reading->count);
    size_t *rows = g_new(size_t, reading->count);
    memset(kept, true, reading->count * sizeof *kept);
    for (size_t i = 0; i < reading->count; i++) {
        size_t count = 0;
        for (size_t k = i; k < reading->count && !seen[i]; k++) {
            if (strcmp(reading->word[k], reading->word[i]) == 0) {
                rows[count++] = k;
            }
        }
        for (size_t k = 0; k < count; k++) {
            seen[rows[k]] = true;
        }
        drop_of_series(reading, rows, count, kept);
    }
    gb_lab_rows_keep(reading, kept);
    g_free(kept);
    g_free(seen);
    g_free(rows);
}
