#include <string.h>

#include "figures/report/report.h"
#include "figures/report/report_references.h"
#include "figures/report/report_table.h"
#include "scene/field/applies.h"
#include "scene/field/field_symbol.h"
#include "scene/normal_law.h"

/* Keys that say nothing about the model. */
static bool is_housekeeping(const struct gb_field *field)
{
    return strcmp(field->group, "output") == 0 || strcmp(field->key, "title") == 0 ||
           strcmp(field->key, "threads") == 0 || strcmp(field->key, "seed") == 0;
}

/* Values of a key in the groups that use it, each once. */
static GPtrArray *values_of(const struct gb_runset *set, const struct gb_field *field)
{
    GPtrArray *values = g_ptr_array_new_with_free_func(g_free);
    char *buffer = g_malloc(GB_PARAMS_VALUE_MAX);
    for (size_t g = 0; g < set->groups; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (!gb_applies_field(params, field)) {
            continue;
        }
        gb_params_format(params, field, buffer, GB_PARAMS_VALUE_MAX);
        if (*buffer != '\0' &&
            !g_ptr_array_find_with_equal_func(values, buffer, g_str_equal, NULL)) {
            g_ptr_array_add(values, g_strdup(buffer));
        }
    }
    g_free(buffer);
    return values;
}

/* "9.7 nm" -> "9.7" and "nm"; the unit stays with a list or a word. */
static const char *split_unit(const struct gb_field *field, char *value)
{
    char *blank = strchr(value, ' ');
    const bool number =
        field->type == GB_FIELD_NUMBER || field->type == GB_FIELD_RELATIVE;
    if (!number || blank == NULL) {
        return number && g_ascii_isdigit(value[0]) ? "1" : "";
    }
    *blank = '\0';
    return blank + 1;
}

/* Values of one unit share it; others keep theirs. */
static void put_values(struct gb_report_table *table, const struct gb_field *field,
                       GPtrArray *values)
{
    char *unit = NULL;
    GString *numbers = g_string_new(NULL);
    bool one_unit = true;
    for (guint k = 0; k < values->len; k++) {
        char *value = g_strdup(g_ptr_array_index(values, k));
        const char *own = split_unit(field, value);
        one_unit = one_unit && (unit == NULL || strcmp(unit, own) == 0);
        unit = unit != NULL ? unit : g_strdup(own);
        g_string_append_printf(numbers, "%s%s", k > 0 ? "; " : "", value);
        g_free(value);
    }
    if (!one_unit) {
        g_string_truncate(numbers, 0);
        for (guint k = 0; k < values->len; k++) {
            g_string_append_printf(numbers, "%s%s", k > 0 ? "; " : "",
                                   (const char *)g_ptr_array_index(values, k));
        }
    }
    gb_report_table_put(table, "%s", numbers->str);
    gb_report_table_put(table, "%s", one_unit && unit != NULL ? unit : "");
    g_string_free(numbers, TRUE);
    g_free(unit);
}

static void put_key(struct gb_report *report, struct gb_report_table *table,
                    const struct gb_field *field)
{
    GPtrArray *values = values_of(report->set, field);
    if (values->len > 0) {
        const char *symbol = gb_field_symbol(field);
        gb_report_table_put(table, "%s.%s", field->group, field->key);
        gb_report_table_put(table, "%s", symbol != NULL ? symbol : "");
        put_values(table, field, values);
        gb_report_table_put(table, "%s", field->meaning);
        gb_report_table_put(table, "%s", field->source);
        gb_report_references_cite(report, field->source);
    }
    g_ptr_array_unref(values);
}

bool gb_report_keys(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"key",     "symbol", "value", "unit",
                                        "meaning", "source", NULL};
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    struct gb_report_table table;
    gb_report_table_begin(&table, heads);
    table.markup = 1;
    for (size_t k = 0; k < count; k++) {
        if (!is_housekeeping(&fields[k])) {
            put_key(report, &table, &fields[k]);
        }
    }
    for (size_t g = 0; g < report->set->groups; g++) {
        gb_report_references_cite_name(
            report, gb_normal_law_of(&gb_runset_first(report->set, g)->params)->name,
            NULL);
    }
    return gb_report_table_end(
        report, &table, "keys",
        "Keys that these scenes use; lengths in d are multiples of "
        "the particle diameter, stresses in E of Young's modulus, "
        "times in T of the reduced time.",
        err);
}
