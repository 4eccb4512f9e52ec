#include "pack/f32/cross_rows.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/list/blocks.h"

bool gb_cross_rows_init(struct gb_cross_rows *rows, int64_t count, int width,
                        struct gb_error *err)
{
    const size_t blocks = (size_t)gb_blocks_count(count);
    rows->width = width;
    rows->start = gb_alloc_array(blocks + 1, sizeof *rows->start, err);
    rows->source = gb_alloc_array(blocks, sizeof *rows->source, err);
    rows->in_start = gb_alloc_array((size_t)count + 1, sizeof *rows->in_start, err);
    return rows->start && rows->source && rows->in_start;
}

static void free_rows(struct gb_cross_rows *rows)
{
    gb_alloc_free(rows->in_row);
    gb_alloc_free(rows->row);
    rows->in_row = NULL;
    rows->row = NULL;
    rows->capacity = 0;
}

void gb_cross_rows_finish(struct gb_cross_rows *rows)
{
    gb_alloc_free(rows->start);
    gb_alloc_free(rows->source);
    gb_alloc_free(rows->in_start);
    free_rows(rows);
}

/* Counts the rows: of every block, and for every particle. */
static void count_rows(struct gb_cross_rows *rows, const struct gb_pair_list *list,
                       int64_t count)
{
    int64_t total = 0;
    memset(rows->in_start, 0, ((size_t)count + 1) * sizeof *rows->in_start);
    for (int64_t b = 0; b < gb_blocks_count(count); b++) {
        const int64_t begin = gb_blocks_begin(count, b), end = gb_blocks_end(count, b);
        rows->start[b] = total;
        rows->source[b] = b;
        for (int64_t k = list->start[begin]; k < list->start[end]; k++) {
            const int32_t j = list->other[k];
            const bool crosses = j >= end;
            rows->in_start[j + 1] += crosses;
            total += crosses;
        }
    }
    rows->start[gb_blocks_count(count)] = total;
    for (int64_t j = 0; j < count; j++) {
        rows->in_start[j + 1] += rows->in_start[j];
    }
}

/* Assigns the rows to the particles that collect them; leaves in_start as it was. */
static void assign_rows(struct gb_cross_rows *rows, const struct gb_pair_list *list,
                        int64_t count)
{
    const int64_t size = gb_blocks_size(count);
    int32_t row = 0, *in = rows->in_start;
    for (int64_t b = 0; b < gb_blocks_count(count); b++) {
        const int64_t begin = gb_blocks_begin(count, b), end = gb_blocks_end(count, b);
        for (int64_t k = list->start[begin]; k < list->start[end]; k++) {
            if (list->other[k] >= end) {
                int64_t *source = &rows->source[list->other[k] / size];
                *source = b < *source ? b : *source;
                rows->in_row[in[list->other[k]]++] = row++;
            }
        }
    }
    for (int64_t j = count; j > 0; j--) {
        in[j] = in[j - 1];
    }
    in[0] = 0;
}

bool gb_cross_rows_update(struct gb_cross_rows *rows, const struct gb_pair_list *list,
                          int64_t count, struct gb_error *err)
{
    count_rows(rows, list, count);
    const int64_t total = rows->start[gb_blocks_count(count)];
    if (total >= rows->capacity) {
        const size_t room = (size_t)(total + total / 16 + 64);
        free_rows(rows);
        rows->in_row =
            gb_alloc_array(room + GB_CROSS_ROWS_SLACK, sizeof *rows->in_row, err);
        rows->row = gb_alloc_array(room * (size_t)rows->width, sizeof *rows->row, err);
        if (!rows->in_row || !rows->row) {
            free_rows(rows);
            return false;
        }
        rows->capacity = (int64_t)room;
    }
    assign_rows(rows, list, count);
    return true;
}
