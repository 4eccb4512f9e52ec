#include <glib.h>
#include <limits.h>
#include <stdio.h>

#include "tui/plot/plot.h"
#include "tui/term/text_fit.h"

/* A candidate position of the legend. */
struct box {
    int rows, columns; /* of entries */
    int width;         /* of an entry */
    int row, col;
    int taken; /* occupied cells below it */
};

static int box_cols(const struct box *box)
{
    return box->columns * box->width + (box->columns - 1) * 2;
}

/* Occupied cells below a box; the count ends at `enough`. */
static int taken(const struct gb_plot *plot, const struct box *box, int enough)
{
    const int cols = box_cols(box);
    int sum = 0;
    for (int r = box->row; r < box->row + box->rows; r++) {
        for (int c = box->col; c < box->col + cols && sum < enough; c++) {
            sum += plot->cell[r * plot->cols + c].ch != ' ';
        }
    }
    return sum;
}

/* Moves the box to a position that covers fewer cells, if this one does. */
static void try_position(const struct gb_plot *plot, struct box *box, int row, int col)
{
    struct box there = *box;
    there.row = row;
    there.col = col;
    there.taken = taken(plot, &there, box->taken);
    if (there.taken < box->taken) {
        *box = there;
    }
}

/* First the corners top left and bottom right, mostly free of curves, then all
 * positions. */
static void find_position(const struct gb_plot *plot, struct box *box)
{
    const int bottom = plot->top + plot->field_rows - 1 - box->rows;
    const int right = plot->left + plot->field_cols - box_cols(box);
    box->taken = INT_MAX;
    try_position(plot, box, plot->top + 1, plot->left + 1);
    try_position(plot, box, bottom, right);
    for (int row = plot->top + 1; row <= bottom; row++) {
        for (int col = plot->left + 1; col <= right && box->taken > 0; col++) {
            try_position(plot, box, row, col);
        }
    }
}

/* A box for the entries that covers nothing, in one to three columns; false: none. */
static bool find_free(const struct gb_plot *plot, struct box *box, int entries)
{
    for (box->columns = 1; box->columns <= 3; box->columns++) {
        box->rows = (entries + box->columns - 1) / box->columns;
        if (box->rows > plot->field_rows - 2 || box_cols(box) > plot->field_cols - 1) {
            continue;
        }
        find_position(plot, box);
        if (box->taken == 0) {
            return true;
        }
    }
    return false;
}

/* Columns of entries in the foot. */
static int foot_columns(const struct gb_plot *plot, int width)
{
    return MAX(1, (plot->cols + 2) / (width + 2));
}

/* Position of the entries: the foot if there is one, or a free area, or the box that
 * covers least.  Returns how many fit. */
static int arrange(const struct gb_plot *plot, struct box *box, int count)
{
    if (plot->foot > 0) {
        box->rows = plot->foot;
        box->row = plot->rows - plot->foot;
        box->columns = foot_columns(plot, box->width);
        return MIN(count, box->rows * box->columns);
    }
    if (!find_free(plot, box, count)) {
        box->columns = 1;
        box->rows = MIN(count, plot->field_rows - 2);
        find_position(plot, box);
    }
    return MIN(count, box->rows * box->columns);
}

static void write_entry(struct gb_plot *plot, int row, int col, int width,
                        const struct gb_plot_entry *entry)
{
    char *name = gb_text_fit(entry->name, width - 2);
    gb_plot_put(plot, row, col,
                entry->marker ? gb_plot_mark_char(plot, entry->marker) : ' ', entry->ink);
    gb_plot_put(plot, row, col + 1, ' ', GB_PLOT_INK_NONE);
    gb_plot_text(plot, row, col + 2, entry->ink, name);
    g_free(name);
}

static int entry_width(const struct gb_plot *plot, const struct gb_plot_entry *entry,
                       int count)
{
    int width = 0;
    for (int i = 0; i < count; i++) {
        width = MAX(width, 2 + (int)g_utf8_strlen(entry[i].name, -1));
    }
    return MIN(width, plot->field_cols - 2);
}

int gb_plot_legend_foot(const struct gb_plot *plot, const struct gb_plot_entry *entry,
                        int count)
{
    const int columns = foot_columns(plot, entry_width(plot, entry, count));
    return MIN((count + columns - 1) / columns, plot->rows / 3);
}

bool gb_plot_legend(struct gb_plot *plot, const struct gb_plot_entry *entry, int count)
{
    struct box box = {.width = entry_width(plot, entry, count)};
    if (count <= 0 || plot->field_rows < 5 || box.width < 4) {
        return count <= 0;
    }
    const int shown = arrange(plot, &box, count);
    for (int i = 0; i < shown; i++) {
        struct gb_plot_entry more = {.ink = GB_PLOT_INK_DIM};
        snprintf(more.name, sizeof more.name, "and %d more", count - shown + 1);
        const bool whole = i + 1 < shown || shown == count;
        write_entry(plot, box.row + i % box.rows,
                    box.col + i / box.rows * (box.width + 2), box.width,
                    whole ? &entry[i] : &more);
    }
    return shown == count && box.taken == 0;
}
