#include "tui/panel/param_finder.h"

#include <glib.h>
#include <ncurses.h>
#include <stdio.h>
#include <string.h>

#include "scene/field/applies.h"
#include "scene/field/field_words.h"

/* Columns of a wide list; a narrow one leaves the meaning out. */
enum { NAME_COLS = 25, VALUE_COLS = 14, WORDS_ROWS = 2, HEAD_ROWS = 2 };

/* Nearest first; of the same rank as in the field table. */
static void search(struct gb_param_finder *finder)
{
    int rank[GB_PARAM_FINDER_MAX];
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const char *text = gb_prompt_text(&finder->text);
    finder->count = finder->focus = finder->top = 0;
    for (size_t i = 0; i < count && i < GB_PARAM_FINDER_MAX; i++) {
        const int own = gb_field_words_rank(&fields[i], text);
        int at = finder->count;
        if (own == 0) {
            continue;
        }
        for (; at > 0 && rank[at - 1] < own; at--) {
            rank[at] = rank[at - 1];
            finder->found[at] = finder->found[at - 1];
        }
        rank[at] = own;
        finder->found[at] = (int)i;
        finder->count++;
    }
}

void gb_param_finder_init(struct gb_param_finder *finder, const struct gb_params *params)
{
    memset(finder, 0, sizeof *finder);
    finder->params = *params;
    gb_prompt_set(&finder->text, "");
    search(finder);
}

static void go(struct gb_param_finder *finder, int by)
{
    finder->focus = CLAMP(finder->focus + by, 0, MAX(finder->count - 1, 0));
}

bool gb_param_finder_handle(struct gb_param_finder *finder,
                            const struct gb_term_event *event)
{
    switch (event->kind == GB_TERM_KEY ? event->code : 0) {
    case KEY_UP:
        go(finder, -1);
        return true;
    case KEY_DOWN:
    case '\t':
        go(finder, 1);
        return true;
    case KEY_PPAGE:
        go(finder, -finder->page);
        return true;
    case KEY_NPAGE:
        go(finder, finder->page);
        return true;
    default:
        break;
    }
    if (gb_prompt_handle(&finder->text, event)) {
        search(finder);
        return true;
    }
    return false;
}

/* "contact.mu   0.1   friction coefficient of sliding" */
static void draw_row(const struct gb_param_finder *finder, const struct gb_paint *paint,
                     int row, int at)
{
    size_t count = 0;
    const struct gb_field *field = &gb_params_fields(&count)[finder->found[at]];
    const bool used = gb_applies_field(&finder->params, field);
    const enum gb_style style = at == finder->focus ? GB_STYLE_SELECTED
                                : used              ? GB_STYLE_PLAIN
                                                    : GB_STYLE_DIM;
    char name[64], value[GB_PARAMS_VALUE_MAX];
    snprintf(name, sizeof name, "%s.%s", field->group, field->key);
    gb_params_format(&finder->params, field, value, sizeof value);
    gb_paint_cell(paint, row, 0, paint->rect.cols, style, "");
    gb_paint_cell(paint, row, 0, NAME_COLS - 1, style, name);
    gb_paint_cell(paint, row, NAME_COLS, VALUE_COLS - 1, style, value);
    gb_paint_cell(paint, row, NAME_COLS + VALUE_COLS,
                  paint->rect.cols - NAME_COLS - VALUE_COLS, style, field->meaning);
}

/* Meaning and synonyms of the selected parameter. */
static void draw_words(const struct gb_param_finder *finder, const struct gb_paint *paint,
                       int row)
{
    const int selected = gb_param_finder_selected(finder);
    size_t count = 0;
    if (selected < 0) {
        gb_paint_wrap(
            paint, row, WORDS_ROWS, GB_STYLE_WARN,
            "no parameter has this name, symbol or meaning; ? has the glossary");
        return;
    }
    const struct gb_field *field = &gb_params_fields(&count)[selected];
    const char *words = gb_field_words(field);
    char *text = g_strdup_printf(
        "%s%s%s%s", field->meaning, *words != '\0' ? "; also: " : "", words,
        gb_applies_field(&finder->params, field) ? "" : " (no effect on this scene)");
    gb_paint_wrap(paint, row, WORDS_ROWS, GB_STYLE_DIM, text);
    g_free(text);
}

void gb_param_finder_draw(struct gb_param_finder *finder, const struct gb_paint *paint)
{
    const int last = paint->rect.rows - WORDS_ROWS;
    finder->page = MAX(last - HEAD_ROWS, 1);
    finder->top = CLAMP(finder->top, finder->focus - finder->page + 1, finder->focus);
    gb_paint_text(paint, 0, 0, GB_STYLE_DIM, "Name, symbol or meaning:");
    gb_prompt_draw(&finder->text, paint, 0, NAME_COLS, paint->rect.cols - NAME_COLS);
    for (int i = 0; i < finder->page && finder->top + i < finder->count; i++) {
        draw_row(finder, paint, HEAD_ROWS + i, finder->top + i);
    }
    draw_words(finder, paint, last);
}

int gb_param_finder_selected(const struct gb_param_finder *finder)
{
    return finder->count > 0 ? finder->found[finder->focus] : -1;
}
