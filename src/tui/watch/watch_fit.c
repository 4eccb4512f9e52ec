#include "tui/watch/watch_views.h"

void gb_watch_fit_draw(struct gb_watch *watch, const struct gb_paint *paint)
{
    struct gb_rect rect = paint->rect;
    rect.col += 1;
    rect.cols -= 2;
    const struct gb_paint inside = gb_paint_at(paint->term, rect);
    int row = 1;
    for (char **line = watch->runset.fit; line != NULL && *line != NULL; line++) {
        const int left = rect.rows - row;
        const int rows = left > 0 ? gb_paint_wrap_rows(&inside, left, *line) : 0;
        gb_paint_wrap(&inside, row, rows, GB_STYLE_PLAIN, *line);
        row += rows;
    }
}
