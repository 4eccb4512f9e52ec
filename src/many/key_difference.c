#include "many/key_difference.h"

#include <string.h>

static bool is_listed(const struct gb_field *field, const char *const *list)
{
    for (size_t i = 0; list[i] != NULL; i++) {
        const size_t length = strlen(field->group);
        if (strncmp(list[i], field->group, length) == 0 && list[i][length] == '.' &&
            (list[i][length + 1] == '\0' ||
             strcmp(list[i] + length + 1, field->key) == 0)) {
            return true;
        }
    }
    return false;
}

/* What is drawn by lot, and what changes no result. */
bool gb_key_difference_bookkeeping(const struct gb_field *field)
{
    return field->no_result || field->type == GB_FIELD_SEED;
}

/* As a preset would write them: equal texts are equal values. */
bool gb_key_difference_equal(const struct gb_field *field, const struct gb_params *a,
                             const struct gb_params *b)
{
    char first[GB_PARAMS_VALUE_MAX], second[GB_PARAMS_VALUE_MAX];
    return strcmp(gb_params_format(a, field, first, sizeof first),
                  gb_params_format(b, field, second, sizeof second)) == 0;
}

const struct gb_field *gb_key_difference_find(const struct gb_params *a,
                                              const struct gb_params *b,
                                              const char *const *accepted)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (!gb_key_difference_bookkeeping(&fields[i]) &&
            !is_listed(&fields[i], accepted) &&
            !gb_key_difference_equal(&fields[i], a, b)) {
            return &fields[i];
        }
    }
    return NULL;
}
