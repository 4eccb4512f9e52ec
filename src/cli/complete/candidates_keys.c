#include <string.h>

#include "base/units.h"
#include "cli/complete/candidates.h"
#include "greenbody/params.h"
#include "io/material.h"
#include "io/preset_folders.h"

/* Each name of a list "a, b, c" from the table of units. */
static void add_units(const struct gb_candidates *to, const char *number,
                      const char *units)
{
    char **names = g_strsplit(units, ", ", -1);
    for (int i = 0; names[i] != NULL; i++) {
        char *value = g_strconcat(number, names[i], NULL);
        gb_candidates_add(to, value, "unit");
        g_free(value);
    }
    g_strfreev(names);
}

/* "10" or "10n": the number with every unit of its key. */
static void add_number(const struct gb_candidates *to, const struct gb_field *field)
{
    const char *end = to->prefix;
    double value = 0.0;
    if (!gb_units_number(to->prefix, &end, &value) || end == to->prefix) {
        return;
    }
    char *number = g_strndup(to->prefix, (gsize)(end - to->prefix));
    if (field->relative != NULL) {
        add_units(to, number, field->relative);
    }
    if (field->dimension == GB_DIM_FRACTION) {
        add_units(to, number, "%");
    } else if (field->dimension != GB_DIM_NONE) {
        add_units(to, number, gb_units_accepted((enum gb_dimension)field->dimension));
    }
    g_free(number);
}

/* The part of a value behind the last separator is completed. */
static void add_values(const struct gb_candidates *to, const struct gb_field *field)
{
    char accepted[512];
    gb_params_accepted(field, accepted, sizeof accepted);
    for (int i = 0; field->choices != NULL && field->choices[i] != NULL; i++) {
        gb_candidates_add(to, field->choices[i], field->meaning);
    }
    if (field->auto_allowed) {
        gb_candidates_add(to, "auto", accepted);
    }
    if (field->infinite != NULL) {
        gb_candidates_add(to, field->infinite, accepted);
    }
    if (field->choices == NULL && *to->prefix == '\0' && *field->fallback != '\0' &&
        strcmp(field->fallback, "auto") != 0) {
        gb_candidates_add(to, field->fallback, accepted);
    }
    if (field->type == GB_FIELD_SIZES) {
        static const char *const tables[] = {".csv", NULL};
        gb_candidates_paths(to, GB_CANDIDATES_FILE, tables);
    }
    if (field->type == GB_FIELD_PACKING) {
        static const char *const packings[] = {".csv",  ".xyz", ".extxyz", ".dump",
                                               ".data", ".txt", ".vtkhdf", NULL};
        gb_candidates_paths(to, GB_CANDIDATES_FILE, packings);
    }
    add_number(to, field);
}

static void add_materials(const struct gb_candidates *to)
{
    static const char *const files[] = {".ini", NULL};
    char **names = gb_preset_folders_list_materials();
    for (int i = 0; names[i] != NULL; i++) {
        gb_candidates_add(to, names[i], "material");
    }
    g_strfreev(names);
    gb_candidates_paths(to, GB_CANDIDATES_FILE, files);
}

static void complete_value(const struct gb_candidates *to, const char *equals)
{
    char *name = g_strndup(to->prefix, (gsize)(equals - to->prefix));
    char **parts = g_strsplit(name, ".", 2);
    const struct gb_field *field =
        parts[0] != NULL && parts[1] != NULL ? gb_params_find(parts[0], parts[1]) : NULL;
    const char *last = equals + 1;
    for (const char *c = last; *c != '\0'; c++) {
        last = strchr(";,:", *c) != NULL ? c + 1 : last;
    }
    char *before =
        g_strdup_printf("%s%.*s", to->before, (int)(last - to->prefix), to->prefix);
    const struct gb_candidates part = {.prefix = last, .before = before};
    if (field != NULL) {
        add_values(&part, field);
    } else if (strcmp(name, GB_MATERIAL_GROUP) == 0) {
        add_materials(&part);
    }
    g_free(before);
    g_strfreev(parts);
    g_free(name);
}

/* "material=": all keys of the group by a name. */
static void add_whole(const struct gb_candidates *to, const char *group)
{
    if (strcmp(group, GB_MATERIAL_GROUP) == 0) {
        gb_candidates_add(to, GB_MATERIAL_GROUP "=", "all keys of this group by a name");
    }
}

/* Groups for a beginning of a group, keys for a group, and keys by their own names. */
static void complete_name(const struct gb_candidates *to)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const bool in_group = strchr(to->prefix, '.') != NULL;
    const char *last = "";
    for (size_t i = 0; i < count; i++) {
        char *group = g_strconcat(fields[i].group, ".", NULL);
        char *key = g_strconcat(group, fields[i].key, "=", NULL);
        if (in_group) {
            gb_candidates_add(to, key, fields[i].meaning);
        } else if (strcmp(last, fields[i].group) != 0) {
            gb_candidates_add(to, group, "keys of this group");
            add_whole(to, fields[i].group);
        }
        if (!in_group && *to->prefix != '\0' &&
            g_str_has_prefix(fields[i].key, to->prefix)) {
            gb_candidates_add_any(to, key, fields[i].meaning);
        }
        last = fields[i].group;
        g_free(key);
        g_free(group);
    }
}

void gb_candidates_keys(const struct gb_candidates *to)
{
    const char *equals = strchr(to->prefix, '=');
    if (equals != NULL) {
        complete_value(to, equals);
    } else {
        complete_name(to);
    }
}

void gb_candidates_keys_list(const struct gb_candidates *to)
{
    const char *comma = strrchr(to->prefix, ',');
    const char *last = comma != NULL ? comma + 1 : to->prefix;
    char *before =
        g_strdup_printf("%s%.*s", to->before, (int)(last - to->prefix), to->prefix);
    gb_candidates_keys(&(struct gb_candidates){.prefix = last, .before = before});
    g_free(before);
}
