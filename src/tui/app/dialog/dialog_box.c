#include "tui/app/dialog/dialog_box.h"

#include <glib.h>

struct gb_paint gb_dialog_box(const struct gb_paint *screen, int rows, int cols,
                              const char *title)
{
    rows = MIN(rows, screen->rect.rows - 2);
    cols = MIN(cols, screen->rect.cols - 2);
    const struct gb_rect rect = {(screen->rect.rows - rows) / 2,
                                 (screen->rect.cols - cols) / 2, rows, cols};
    const struct gb_paint paint = gb_paint_at(screen->term, rect);
    gb_paint_box(&paint, title);
    return paint;
}

struct gb_paint gb_dialog_box_inside(const struct gb_paint *paint)
{
    const struct gb_rect rect = {paint->rect.row + 1, paint->rect.col + 2,
                                 paint->rect.rows - 2, paint->rect.cols - 4};
    return gb_paint_at(paint->term, rect);
}
