#include <glib.h>
#include <math.h>

#include "tui/panel/panels.h"
#include "tui/watch/watch_views.h"

enum { STATE_COL = 2, ERROR_COL = 22 };

void gb_watch_runs_draw(struct gb_watch *watch, const struct gb_paint *paint)
{
    const int page = paint->rect.rows - 1;
    const int last = (int)watch->runset.runs - page;
    watch->top = MAX(MIN(watch->top, last), 0);
    for (int i = 0; i < page && watch->top + i < (int)watch->runset.runs; i++) {
        const struct gb_runset_view_run *run = &watch->runset.run[watch->top + i];
        enum gb_style style = GB_STYLE_PLAIN;
        const char *word = gb_panel_state_word(run->state, run->error, &style);
        gb_paint_text(paint, 1 + i, STATE_COL, style, word);
        gb_paint_format(paint, 1 + i, STATE_COL + 12, GB_STYLE_PLAIN, "%4.0f %%",
                        floor(100.0 * run->progress));
        const int col = gb_paint_text(paint, 1 + i, ERROR_COL, GB_STYLE_PLAIN, run->name);
        gb_paint_text(paint, 1 + i, col + 2, GB_STYLE_WARN, run->error);
    }
}
