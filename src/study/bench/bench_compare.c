#include "study/bench/bench_compare.h"

#include <math.h>
#include <string.h>

#include "base/table.h"

/* Row of the table with a name; its number of rows: none. */
static size_t find(const struct gb_table *table, const char *name)
{
    size_t row = 0;
    while (row < gb_table_rows(table) && strcmp(gb_table_word(table, row), name) != 0) {
        row++;
    }
    return row;
}

static struct gb_bench_change judge(const struct gb_bench_row *row, double before,
                                    double spread)
{
    struct gb_bench_change change = {before, row->value / before, GB_BENCH_UNKNOWN};
    if (row->goal != GB_BENCH_FACT && isfinite(change.ratio) && change.ratio > 0.0) {
        const double noise =
            fmax(GB_BENCH_CHANGE_LEAST, row->spread / row->value + fabs(spread / before));
        const double grown =
            log(change.ratio) * (row->goal == GB_BENCH_MORE ? 1.0 : -1.0);
        change.verdict = fabs(grown) <= log1p(noise) ? GB_BENCH_WITHIN
                         : grown > 0.0               ? GB_BENCH_BETTER
                                                     : GB_BENCH_WORSE;
    }
    return change;
}

bool gb_bench_compare(const char *path, const struct gb_bench_row *row, size_t rows,
                      struct gb_bench_change *change, struct gb_error *err)
{
    struct gb_table *table = NULL;
    if (!gb_table_read(&table, path, "figure", err)) {
        return false;
    }
    const double *value = gb_table_column(table, "value", err);
    const double *spread = value ? gb_table_column(table, "spread", err) : NULL;
    bool good = spread != NULL;
    for (size_t i = 0; i < rows && good; i++) {
        const size_t at = find(table, row[i].name);
        const bool there = at < gb_table_rows(table);
        change[i] = judge(&row[i], there ? value[at] : (double)NAN,
                          there ? spread[at] : (double)NAN);
    }
    if (good && !(change[0].ratio == 1.0)) {
        good = gb_error_set(err, GB_ERR_INPUT,
                            "%s: %s %g, here %g: accepted a run of the same scene", path,
                            row[0].name, change[0].before, row[0].value);
    }
    gb_table_destroy(table);
    return good;
}
