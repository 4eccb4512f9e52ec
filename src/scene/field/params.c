#include "greenbody/params.h"

#include <string.h>

#include <glib.h>

#include "scene/field/field.h"
#include "scene/field/nearest_key.h"
#include "scene/field/params_table.h"

const struct gb_field *gb_params_fields(size_t *count)
{
    return gb_params_table(count);
}

const struct gb_field *gb_params_find(const char *group, const char *key)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_table(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(fields[i].group, group) == 0 && strcmp(fields[i].key, key) == 0) {
            return &fields[i];
        }
    }
    return NULL;
}

void gb_params_init(struct gb_params *params)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_table(&count);
    memset(params, 0, sizeof *params);
    for (size_t i = 0; i < count; i++) {
        struct gb_error err;
        if (!gb_field_read(&fields[i], params, fields[i].fallback, &err)) {
            g_assert_not_reached(); /* wrong row; see test_params */
        }
    }
}

bool gb_params_set(struct gb_params *params, const struct gb_field *field,
                   const char *text, struct gb_error *err)
{
    return gb_field_read(field, params, text, err);
}

char *gb_params_format(const struct gb_params *params, const struct gb_field *field,
                       char *buffer, size_t size)
{
    return gb_field_write(field, params, buffer, size);
}

char *gb_params_accepted(const struct gb_field *field, char *buffer, size_t size)
{
    return gb_field_accepted(field, buffer, size);
}

/* The message lists the keys of the group, or the groups when the group is unknown. */
static bool unknown_key(const char *group, const char *key, struct gb_error *err)
{
    char *name = g_strconcat(group, ".", key, NULL);
    char meant[128];
    GString *keys = g_string_new(NULL), *groups = g_string_new(NULL);
    const char *last = "";
    size_t count = 0;
    const struct gb_field *fields = gb_params_table(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(fields[i].group, group) == 0) {
            g_string_append_printf(keys, "%s%s", keys->len ? ", " : "", fields[i].key);
        }
        if (strcmp(fields[i].group, last) != 0) {
            last = fields[i].group;
            g_string_append_printf(groups, "%s%s", groups->len ? ", " : "", last);
        }
    }
    gb_error_set(err, GB_ERR_INPUT, "%.40s.%.40s: no such %s; %smust be one of %s", group,
                 key, keys->len ? "key" : "group",
                 gb_nearest_key(name, meant, sizeof meant),
                 keys->len ? keys->str : groups->str);
    g_free(name);
    g_string_free(keys, TRUE);
    g_string_free(groups, TRUE);
    return false;
}

/* The only field with this key.  If several have it, err lists them. */
static const struct gb_field *find_short(const char *name, struct gb_error *err)
{
    GString *found = g_string_new(NULL);
    const struct gb_field *field = NULL;
    size_t count = 0, matches = 0;
    const struct gb_field *fields = gb_params_table(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(fields[i].key, name) == 0) {
            field = &fields[i];
            g_string_append_printf(found, "%s%s.%s", matches++ ? ", " : "",
                                   fields[i].group, name);
        }
    }
    if (matches == 0) {
        char meant[128];
        gb_error_set(err, GB_ERR_INPUT,
                     "%.80s: no such key; %sexpected group.key, as contact.mu", name,
                     gb_nearest_key(name, meant, sizeof meant));
    } else if (matches > 1) {
        gb_error_set(err, GB_ERR_INPUT, "%.80s: must be one of %s", name, found->str);
    }
    g_string_free(found, TRUE);
    return matches == 1 ? field : NULL;
}

const struct gb_field *gb_params_find_name(const char *name, struct gb_error *err)
{
    char **part = g_strsplit(name, ".", 2);
    const struct gb_field *field =
        part[0] && part[1] ? gb_params_find(part[0], part[1]) : find_short(name, err);
    if (!field && part[0] && part[1]) {
        unknown_key(part[0], part[1], err);
    }
    g_strfreev(part);
    return field;
}

bool gb_params_assign(struct gb_params *params, const char *assignment,
                      struct gb_error *err)
{
    char *name = g_strdup(assignment);
    char *equals = strchr(name, '=');
    bool assigned = false;
    if (equals) {
        *equals = '\0';
        const struct gb_field *field = gb_params_find_name(g_strstrip(name), err);
        assigned = field && gb_params_set(params, field, equals + 1, err);
    } else {
        gb_error_set(err, GB_ERR_INPUT,
                     "%.80s: missing \"=value\"; must be group.key=value", assignment);
    }
    g_free(name);
    return assigned;
}
