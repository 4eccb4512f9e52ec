#include "tui/panel/panels.h"

#include <stdio.h>

static int limit(int value, int max)
{
    return value < 0 ? 0 : value > max ? max : value;
}

static int scroll_max(const struct gb_panel_events *panel,
                      const struct gb_session *session)
{
    const int64_t kept =
        session->log_count < GB_SESSION_LOG ? session->log_count : GB_SESSION_LOG;
    return kept > panel->page ? (int)kept - panel->page : 0;
}

/* Rows of all lines from the newest down to this one. */
static int total_rows(const struct gb_panel_events *panel, const struct gb_paint *paint,
                      const struct gb_session *session, int max)
{
    int total = 0;
    for (int i = panel->back; total < panel->page; i++) {
        const char *line = gb_session_event_line(session, i);
        if (line == NULL) {
            break;
        }
        total += gb_paint_wrap_rows(paint, max, line);
    }
    return total;
}

/* The newest line at the bottom; a long one is wrapped, into half of the pane at most. */
void gb_panel_events_draw(struct gb_panel_events *panel, const struct gb_paint *paint,
                          const struct gb_session *session, enum gb_paint_focus focus)
{
    char title[GB_CHILD_COMMAND_LINE + 32] = "Events";
    if (session->child.progress[0] != '\0') {
        snprintf(title, sizeof title, "Events: %s, %s", session->child.name,
                 session->child.progress);
    }
    gb_paint_title(paint, title, focus);
    panel->page = paint->rect.rows - 1;
    panel->back = limit(panel->back, scroll_max(panel, session));
    const int max = panel->page > 3 ? 3 : 1;
    const int total = total_rows(panel, paint, session, max);
    int end = 1 + (total < panel->page ? total : panel->page);
    const char *line = NULL;
    for (int i = panel->back; end > 1; i++) {
        line = gb_session_event_line(session, i);
        if (line == NULL) {
            return;
        }
        const int rows = gb_paint_wrap_rows(paint, max, line);
        if (end - rows < 1) {
            return;
        }
        end -= rows;
        gb_paint_wrap(paint, end, rows, GB_STYLE_PLAIN, line);
    }
}

void gb_panel_events_navigate(struct gb_panel_events *panel,
                              const struct gb_session *session, enum gb_action action)
{
    const int max = scroll_max(panel, session);
    switch (action) {
    case GB_ACTION_UP:
        panel->back = limit(panel->back + 1, max);
        break;
    case GB_ACTION_DOWN:
        panel->back = limit(panel->back - 1, max);
        break;
    case GB_ACTION_PAGE_UP:
        panel->back = limit(panel->back + panel->page, max);
        break;
    case GB_ACTION_PAGE_DOWN:
        panel->back = limit(panel->back - panel->page, max);
        break;
    case GB_ACTION_HOME:
        panel->back = max;
        break;
    case GB_ACTION_END:
        panel->back = 0;
        break;
    default:
        break;
    }
}
