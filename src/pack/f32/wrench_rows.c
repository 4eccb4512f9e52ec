#include "pack/f32/wrench_rows.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/list/blocks.h"

/* Particles begin with so many rows for cross pairs in all. */
enum { EXTRA = 64 };

bool gb_wrench_rows_init(struct gb_wrench_rows *rows, int64_t count, struct gb_error *err)
{
    rows->room = count;
    rows->row = gb_alloc_array((size_t)count, sizeof *rows->row, err);
    rows->start = gb_alloc_array(2 * (size_t)count + 1, sizeof *rows->start, err);
    return rows->row && rows->start;
}

void gb_wrench_rows_finish(struct gb_wrench_rows *rows)
{
    gb_alloc_free(rows->row);
    gb_alloc_free(rows->start);
    *rows = (struct gb_wrench_rows){0};
}

/* Entry of particle j in `start`, for near or far pairs. */
static int64_t entry_of(const struct gb_neighbour_list *list,
                        const struct gb_pair_list *pairs, int64_t j)
{
    return 2 * j + (pairs == &list->far);
}

/* Counts the cross pairs of every particle. */
static void count_pairs(const struct gb_neighbour_list *list,
                        const struct gb_pair_list *pairs, int32_t *count)
{
    for (int64_t b = 0; b < gb_blocks_count(list->count); b++) {
        const int64_t begin = gb_blocks_begin(list->count, b);
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t k = pairs->start[begin]; k < pairs->start[end]; k++) {
            count[entry_of(list, pairs, pairs->other[k])] += pairs->other[k] >= end;
        }
    }
}

/* From numbers of rows to one past the last of each. */
static void sum_counts(const struct gb_neighbour_list *list, int32_t *count)
{
    int32_t rows = (int32_t)list->count;
    for (int64_t b = 0; b < gb_blocks_count(list->count); b++) {
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t m = 2 * gb_blocks_begin(list->count, b); m < 2 * end; m++) {
            rows += count[m];
            count[m] = rows;
        }
        rows += GB_WRENCH_ROWS_AT_ONCE; /* other threads' rows are not read */
    }
    count[2 * list->count] = rows;
}

/* From the last pair to the first, which leaves the first row of each in `start`. */
static void assign_rows(const struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                        int32_t *start)
{
    for (int64_t b = gb_blocks_count(list->count) - 1; b >= 0; b--) {
        const int64_t begin = gb_blocks_begin(list->count, b);
        const int64_t end = gb_blocks_end(list->count, b);
        for (int64_t k = pairs->start[end] - 1; k >= pairs->start[begin]; k--) {
            const int32_t j = pairs->other[k];
            pairs->row[k] = j < end ? j : --start[entry_of(list, pairs, j)];
        }
    }
}

bool gb_wrench_rows_update(struct gb_wrench_rows *rows, struct gb_neighbour_list *list,
                           struct gb_error *err)
{
    const size_t count = (size_t)list->count;
    memset(rows->start, 0, (2 * count + 1) * sizeof *rows->start);
    count_pairs(list, &list->near, rows->start);
    count_pairs(list, &list->far, rows->start);
    sum_counts(list, rows->start);
    const int64_t need = rows->start[2 * count];
    if (need > rows->room) {
        const int64_t room = need + (need - list->count) / 16 + EXTRA;
        void *grown =
            gb_alloc_grow(rows->row, count, (size_t)room, sizeof *rows->row, err);
        if (!grown) {
            return false;
        }
        rows->row = grown;
        rows->room = room;
    }
    assign_rows(list, &list->near, rows->start);
    assign_rows(list, &list->far, rows->start);
    return true;
}

void gb_wrench_rows_clear(const struct gb_wrench_rows *rows, int64_t begin, int64_t end)
{
    const int32_t first = rows->start[2 * begin];
    memset(rows->row[first], 0,
           (size_t)(rows->start[2 * end] - first) * sizeof *rows->row);
}
