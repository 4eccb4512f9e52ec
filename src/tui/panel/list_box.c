#include "tui/panel/list_box.h"

#include <glib.h>
#include <ncurses.h>
#include <string.h>

enum { FAR = 1 << 20 }; /* more than any list */

void gb_list_box_finish(struct gb_list_box *list)
{
    g_free(list->item);
    memset(list, 0, sizeof *list);
}

/* --- rows ------------------------------------------------------------------------- */

void gb_list_box_set_count(struct gb_list_box *list, int count)
{
    list->count = count;
    list->focus = CLAMP(list->focus, 0, MAX(count - 1, 0));
}

bool gb_list_box_matches(char **words, const char *text)
{
    char *folded = g_utf8_casefold(text, -1);
    bool found = true;
    for (int i = 0; words[i] != NULL && found; i++) {
        found = strstr(folded, words[i]) != NULL;
    }
    g_free(folded);
    return found;
}

/* Insertion sort: items of equal rank keep their order. */
void gb_list_box_search(struct gb_list_box *list, int total,
                        int (*rank)(void *data, int item, char **words), void *data)
{
    int *scores = g_new(int, (gsize)total + 1);
    char *folded = g_utf8_casefold(gb_prompt_text(&list->filter), -1);
    char **words = g_strsplit(folded, " ", -1);
    list->item = g_renew(int, list->item, (gsize)total + 1);
    list->count = list->focus = list->top = 0;
    for (int i = 0; i < total; i++) {
        const int own = rank(data, i, words);
        int at = own > 0 ? list->count++ : -1;
        for (; at > 0 && scores[at - 1] < own; at--) {
            scores[at] = scores[at - 1];
            list->item[at] = list->item[at - 1];
        }
        if (at >= 0) {
            scores[at] = own;
            list->item[at] = i;
        }
    }
    g_strfreev(words);
    g_free(folded);
    g_free(scores);
}

static int item_of(const struct gb_list_box *list, int row)
{
    return list->item != NULL ? list->item[row] : row;
}

int gb_list_box_focused(const struct gb_list_box *list)
{
    return list->focus < list->count ? item_of(list, list->focus) : -1;
}

/* --- keys ------------------------------------------------------------------------- */

void gb_list_box_go(struct gb_list_box *list, int by)
{
    if (list->unfocused) {
        list->top = MAX(list->top + by, 0); /* drawing limits it */
    } else {
        list->focus = CLAMP(list->focus + by, 0, MAX(list->count - 1, 0));
    }
}

bool gb_list_box_navigate(struct gb_list_box *list, enum gb_action action)
{
    switch (action) {
    case GB_ACTION_UP:
        gb_list_box_go(list, -1);
        return true;
    case GB_ACTION_DOWN:
        gb_list_box_go(list, 1);
        return true;
    case GB_ACTION_PAGE_UP:
        gb_list_box_go(list, -list->page);
        return true;
    case GB_ACTION_PAGE_DOWN:
        gb_list_box_go(list, list->page);
        return true;
    case GB_ACTION_HOME:
        gb_list_box_go(list, -FAR);
        return true;
    case GB_ACTION_END:
        gb_list_box_go(list, FAR);
        return true;
    default:
        return false;
    }
}

/* Action of a key.  Home and End belong to the filter. */
static enum gb_action action_of(int code)
{
    switch (code) {
    case KEY_UP:
        return GB_ACTION_UP;
    case KEY_DOWN:
        return GB_ACTION_DOWN;
    case KEY_PPAGE:
        return GB_ACTION_PAGE_UP;
    case KEY_NPAGE:
        return GB_ACTION_PAGE_DOWN;
    default:
        return GB_ACTION_NONE;
    }
}

enum gb_list_box_event gb_list_box_handle(struct gb_list_box *list,
                                          const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_KEY &&
        gb_list_box_navigate(list, action_of(event->code))) {
        return GB_LIST_BOX_MOVED;
    }
    return gb_prompt_handle(&list->filter, event) ? GB_LIST_BOX_TYPED : GB_LIST_BOX_OTHER;
}

/* --- drawing ---------------------------------------------------------------------- */

/* First column of the cells, and width of a column of the list. */
static int column_start(const struct gb_list_box_look *look, int cols, int column,
                        int *width)
{
    int fixed = 0, col = 0;
    for (int k = 0; k < look->columns; k++) {
        fixed += look->column[k].cols;
    }
    for (int k = 0;; k++) {
        *width = look->column[k].cols > 0 ? look->column[k].cols : MAX(cols - fixed, 1);
        if (k == column) {
            return col;
        }
        col += *width;
    }
}

/* Columns end with a blank, except the last one and tight ones. */
static void draw_cell(const struct gb_paint *paint, const struct gb_list_box_look *look,
                      int row, int column, enum gb_style style, const char *text)
{
    int width = 0;
    const int col = column_start(look, paint->rect.cols, column, &width);
    width -= column + 1 < look->columns && !look->column[column].tight;
    if (look->column[column].right) {
        gb_paint_text(paint, row, col + width - gb_paint_width(text), style, text);
    } else {
        gb_paint_cell(paint, row, col, width, style, text);
    }
}

static void draw_row(const struct gb_paint *paint, const struct gb_list_box_look *look,
                     int row, bool focused, const struct gb_list_box_line *line)
{
    const enum gb_style style = focused ? GB_STYLE_SELECTED : line->style;
    gb_paint_cell(paint, row, 0, paint->rect.cols, style, "");
    if (line->whole != NULL) {
        gb_paint_text(paint, row, 0, style, line->whole);
        return;
    }
    for (int k = 0; k < look->columns; k++) {
        if (line->cell[k] != NULL) {
            draw_cell(paint, look, row, k,
                      line->ink[k] >= 0 ? (enum gb_style)line->ink[k] : style,
                      line->cell[k]);
        }
    }
}

/* Keeps the focus visible and fills the page. */
static void keep_in_view(struct gb_list_box *list, int page)
{
    list->page = MAX(page, 1);
    if (!list->unfocused) {
        list->top = CLAMP(list->top, list->focus - list->page + 1, list->focus);
    }
    list->top = CLAMP(list->top, 0, MAX(list->count - list->page, 0));
}

void gb_list_box_draw(struct gb_list_box *list, const struct gb_paint *paint,
                      const struct gb_list_box_look *look, void *data)
{
    const int head = look->titled ? 1 : 0;
    gb_list_box_set_count(list, list->count);
    keep_in_view(list, paint->rect.rows - head);
    for (int k = 0; look->titled && k < look->columns; k++) {
        if (look->column[k].title != NULL) {
            draw_cell(paint, look, 0, k, look->head, look->column[k].title);
        }
    }
    for (int i = 0; i < list->page && list->top + i < list->count; i++) {
        const int row = list->top + i;
        struct gb_list_box_line line = {.style = GB_STYLE_PLAIN};
        memset(line.ink, -1, sizeof line.ink);
        look->write(data, item_of(list, row), &line);
        draw_row(paint, look, head + i, !list->unfocused && row == list->focus, &line);
        for (int k = 0; k < GB_LIST_BOX_COLUMNS; k++) {
            g_free(line.cell[k]);
        }
        g_free(line.whole);
    }
    if (list->count == 0 && look->empty != NULL) {
        gb_paint_text(paint, head, 0, look->empty_style, look->empty);
    }
}

void gb_list_box_draw_filter(const struct gb_list_box *list, const struct gb_paint *paint,
                             int row, int col, const char *label)
{
    const int from = gb_paint_text(paint, row, col, GB_STYLE_DIM, label) + 1;
    gb_prompt_draw(&list->filter, paint, row, from, paint->rect.cols - from - 1);
}

struct gb_rect gb_list_box_cell(const struct gb_list_box *list,
                                const struct gb_paint *paint,
                                const struct gb_list_box_look *look, int column)
{
    struct gb_rect rect = {(look->titled ? 1 : 0) + list->focus - list->top, 0, 1, 0};
    rect.col = column_start(look, paint->rect.cols, column, &rect.cols);
    return rect;
}
