#include "tui/panel/param_finder.h"

#include <glib.h>

#include "scene/field/field.h"
#include "scene/field/field_words.h"

/* Columns of a wide list; a narrow one leaves the meaning out. */
enum { NAME_COLS = 25, VALUE_COLS = 14, WORDS_ROWS = 2, HEAD_ROWS = 2 };

/* Nearest first; of the same rank as in the field table. */
static int rank_field(void *data, int item, char **words)
{
    struct gb_param_finder *finder = data;
    size_t count = 0;
    (void)words;
    return gb_field_words_rank(&gb_params_fields(&count)[item],
                               gb_prompt_text(&finder->list.filter));
}

static void search(struct gb_param_finder *finder)
{
    size_t count = 0;
    (void)gb_params_fields(&count);
    gb_list_box_search(&finder->list, (int)count, rank_field, finder);
}

void gb_param_finder_init(struct gb_param_finder *finder, const struct gb_params *params)
{
    gb_param_finder_finish(finder);
    finder->params = *params;
    search(finder);
}

void gb_param_finder_finish(struct gb_param_finder *finder)
{
    gb_list_box_finish(&finder->list);
}

bool gb_param_finder_handle(struct gb_param_finder *finder,
                            const struct gb_term_event *event)
{
    if (event->kind == GB_TERM_KEY && event->code == '\t') {
        gb_list_box_go(&finder->list, 1);
        return true;
    }
    const enum gb_list_box_event news = gb_list_box_handle(&finder->list, event);
    if (news == GB_LIST_BOX_TYPED) {
        search(finder);
    }
    return news != GB_LIST_BOX_OTHER;
}

/* "contact.mu   0.1   friction coefficient of sliding" */
static void write_field(void *data, int item, struct gb_list_box_line *line)
{
    const struct gb_param_finder *finder = data;
    size_t count = 0;
    const struct gb_field *field = &gb_params_fields(&count)[item];
    char value[GB_PARAMS_VALUE_MAX];
    gb_params_format(&finder->params, field, value, sizeof value);
    line->style =
        gb_field_applies(field, &finder->params) ? GB_STYLE_PLAIN : GB_STYLE_DIM;
    line->cell[0] = g_strdup_printf("%s.%s", field->group, field->key);
    line->cell[1] = g_strdup(value);
    line->cell[2] = g_strdup(field->meaning);
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
    const char *words = field->words != NULL ? field->words : "";
    char *text = g_strdup_printf(
        "%s%s%s%s", field->meaning, *words != '\0' ? "; also: " : "", words,
        gb_field_applies(field, &finder->params) ? "" : " (no effect on this scene)");
    gb_paint_wrap(paint, row, WORDS_ROWS, GB_STYLE_DIM, text);
    g_free(text);
}

void gb_param_finder_draw(struct gb_param_finder *finder, const struct gb_paint *paint)
{
    static const struct gb_list_box_look look = {
        .columns = 3,
        .column = {{.cols = NAME_COLS}, {.cols = VALUE_COLS}, {.cols = 0}},
        .write = write_field};
    struct gb_rect rows = paint->rect;
    rows.row += HEAD_ROWS;
    rows.rows -= HEAD_ROWS + WORDS_ROWS;
    const struct gb_paint inside = gb_paint_at(paint->term, rows);
    gb_list_box_draw_filter(&finder->list, paint, 0, 0, "Name, symbol or meaning:");
    gb_list_box_draw(&finder->list, &inside, &look, finder);
    draw_words(finder, paint, paint->rect.rows - WORDS_ROWS);
}

int gb_param_finder_selected(const struct gb_param_finder *finder)
{
    return gb_list_box_focused(&finder->list);
}
