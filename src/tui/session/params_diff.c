#include "tui/session/params_diff.h"

#include <glib.h>
#include <string.h>

#include "tui/term/text_fit.h"

bool gb_params_diff_same(const struct gb_params *a, const struct gb_params *b,
                         const struct gb_field *field)
{
    char one[GB_PARAMS_VALUE_MAX];
    char other[GB_PARAMS_VALUE_MAX];
    gb_params_format(a, field, one, sizeof one);
    gb_params_format(b, field, other, sizeof other);
    return strcmp(one, other) == 0;
}

static bool is_title(const struct gb_field *field)
{
    return strcmp(field->key, "title") == 0;
}

int gb_params_diff_count(const struct gb_params *a, const struct gb_params *b)
{
    size_t count = 0;
    int differences = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        differences += !is_title(&field[i]) && !gb_params_diff_same(a, b, &field[i]);
    }
    return differences;
}

char *gb_params_diff_describe(const struct gb_params *own, const struct gb_params *other,
                              char *text, size_t size)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!is_title(&field[i]) && !gb_params_diff_same(own, other, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            const bool none = value[0] == '\0';
            g_string_append_printf(all, "%s%s%s%s%s", all->len > 0 ? ", " : "",
                                   none ? "no " : "", field[i].key, none ? "" : " ",
                                   value);
        }
    }
    gb_text_fit_copy(text, size, all->len > 0 ? all->str : "same parameters");
    g_string_free(all, TRUE);
    return text;
}
