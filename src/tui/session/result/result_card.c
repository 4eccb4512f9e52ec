#include "tui/session/result/result_card.h"

#include <stdarg.h>
#include <string.h>

static void clear_line(void *data)
{
    g_free(((struct gb_result_line *)data)->text);
}

static void clear_value(void *data)
{
    g_free(((struct gb_result_value *)data)->text);
}

void gb_result_card_init(struct gb_result_card *card, const struct gb_result_kind *kind,
                         const char *path)
{
    *card = (struct gb_result_card){
        .kind = kind,
        .lines = g_array_new(FALSE, TRUE, sizeof(struct gb_result_line)),
        .values = g_array_new(FALSE, TRUE, sizeof(struct gb_result_value)),
        .path = g_strdup(path),
    };
    g_array_set_clear_func(card->lines, clear_line);
    g_array_set_clear_func(card->values, clear_value);
}

void gb_result_card_finish(struct gb_result_card *card)
{
    if (card->kind != NULL) {
        g_array_unref(card->lines);
        g_array_unref(card->values);
    }
    g_free(card->path);
    g_free(card->page);
    g_free(card->picture);
    memset(card, 0, sizeof *card);
}

void gb_result_card_add(struct gb_result_card *card, enum gb_result_role role,
                        const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const struct gb_result_line line = {role, g_strdup_vprintf(format, list)};
    va_end(list);
    g_array_append_val(card->lines, line);
}

void gb_result_card_offer(struct gb_result_card *card, const struct gb_field *field,
                          const struct gb_params *params)
{
    char text[GB_PARAMS_VALUE_MAX];
    gb_params_format(params, field, text, sizeof text);
    const struct gb_result_value value = {field, g_strdup(text)};
    g_array_append_val(card->values, value);
}

char *gb_result_card_text(const struct gb_result_card *card)
{
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < card->lines->len; i++) {
        g_string_append(text, g_array_index(card->lines, struct gb_result_line, i).text);
        g_string_append_c(text, '\n');
    }
    g_string_append(text, card->path != NULL ? card->path : "");
    return g_strchomp(g_string_free(text, FALSE));
}

bool gb_result_card_use(const struct gb_result_card *card, struct gb_params *params,
                        char **told, struct gb_error *err)
{
    struct gb_params changed = *params;
    GString *text = g_string_new(NULL);
    bool good = true;
    for (guint i = 0; i < card->values->len && good; i++) {
        const struct gb_result_value *value =
            &g_array_index(card->values, struct gb_result_value, i);
        good = gb_params_set(&changed, value->field, value->text, err);
        g_string_append_printf(text, "%s%s.%s = %s", i > 0 ? ", " : "",
                               value->field->group, value->field->key, value->text);
    }
    *told = g_string_free(text, !good);
    if (good) {
        *params = changed;
    }
    return good;
}
