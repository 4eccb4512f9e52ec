#include <string.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/parameters_private.h"
#include "base/alloc.h"
#include "base/units.h"
#include "io/material.h"
#include "io/preset_folders.h"
#include "io/rundir.h"
#include "scene/seed.h"

static struct gb_params *params_of(const struct gb_parameters *parameters)
{
    return gb_preset_params(parameters->preset);
}

/* Takes ownership of the preset.  NULL: reading failed and err is set. */
static bool take(struct gb_parameters **out, struct gb_preset *preset,
                 struct gb_error *err)
{
    struct gb_parameters *parameters = NULL;
    if (preset != NULL) {
        parameters = gb_alloc_array(1, sizeof *parameters, err);
    }
    if (parameters == NULL) {
        gb_preset_destroy(preset);
        return false;
    }
    parameters->preset = preset;
    *out = parameters;
    return true;
}

bool gb_parameters_create(struct gb_parameters **out, const char *preset,
                          struct gb_error *err)
{
    struct gb_preset *read = NULL;
    if (!gb_arguments_given(out, "out", err)) {
        return false;
    }
    (void)(preset ? gb_preset_load(&read, preset, err) : gb_preset_create(&read, err));
    return take(out, read, err);
}

bool gb_parameters_wrap(struct gb_parameters **out, const struct gb_params *params,
                        struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (gb_preset_create(&preset, err)) {
        *gb_preset_params(preset) = *params;
    }
    return take(out, preset, err);
}

bool gb_parameters_copy(struct gb_parameters **out,
                        const struct gb_parameters *parameters, struct gb_error *err)
{
    return gb_arguments_given(out, "out", err) &&
           gb_arguments_given(parameters, "parameters", err) &&
           gb_parameters_wrap(out, params_of(parameters), err);
}

void gb_parameters_destroy(struct gb_parameters *parameters)
{
    if (parameters) {
        gb_preset_destroy(parameters->preset);
        gb_alloc_free(parameters);
    }
}

bool gb_parameters_set(struct gb_parameters *parameters, const char *assignment,
                       struct gb_error *err)
{
    return gb_arguments_given(parameters, "parameters", err) &&
           gb_arguments_given(assignment, "assignment", err) &&
           gb_material_assign(params_of(parameters), assignment, err);
}

bool gb_parameters_get(const struct gb_parameters *parameters, const char *key,
                       char *buffer, size_t size, struct gb_error *err)
{
    char value[GB_PARAMETERS_VALUE];
    if (!gb_arguments_given(parameters, "parameters", err) ||
        !gb_arguments_given(key, "key", err) ||
        !gb_arguments_given(buffer, "buffer", err)) {
        return false;
    }
    const struct gb_field *field = gb_params_find_name(key, err);
    if (!field) {
        return false;
    }
    gb_params_format(params_of(parameters), field, value, sizeof value);
    return gb_arguments_fit(size, strlen(value) + 1, "size", err) &&
           g_strlcpy(buffer, value, size) < size;
}

bool gb_parameters_label(const struct gb_parameters *parameters, const char *key,
                         char *buffer, size_t size, struct gb_error *err)
{
    char value[GB_PARAMETERS_VALUE];
    if (!gb_arguments_given(buffer, "buffer", err) ||
        !gb_parameters_get(parameters, key, value, sizeof value, err)) {
        return false;
    }
    const struct gb_field *field = gb_params_find_name(key, err);
    const bool word = field->type == GB_FIELD_TEXT || field->type == GB_FIELD_PRESSURES ||
                      field->type == GB_FIELD_SIZES || field->type == GB_FIELD_PACKING;
    GString *label = g_string_new(NULL);
    gb_rundir_name_value(label, value, word && !field->choices);
    const bool good = gb_arguments_fit(size, label->len + 1, "size", err);
    if (good) {
        memcpy(buffer, label->str, label->len + 1);
    }
    g_string_free(label, TRUE);
    return good;
}

bool gb_parameters_check(const struct gb_parameters *parameters, struct gb_error *err)
{
    return gb_arguments_given(parameters, "parameters", err) &&
           gb_params_check(params_of(parameters), err);
}

bool gb_parameters_check_cells(const struct gb_parameters *parameters, size_t cells,
                               struct gb_error *err)
{
    return gb_arguments_given(parameters, "parameters", err) &&
           gb_seed_check_cells(params_of(parameters), cells, err);
}

bool gb_parameters_save(struct gb_parameters *parameters, const char *path,
                        struct gb_error *err)
{
    return gb_arguments_given(parameters, "parameters", err) &&
           gb_arguments_given(path, "path", err) &&
           gb_preset_save(parameters->preset, path, GB_PRESET_CHANGED_KEYS, err);
}

/* --- the table of keys ------------------------------------------------------------ */

static const char *type_of(const struct gb_field *field)
{
    static const char *const names[] = {
        [GB_FIELD_NUMBER] = "number",   [GB_FIELD_RELATIVE] = "number",
        [GB_FIELD_INTEGER] = "integer", [GB_FIELD_SEED] = "integer",
        [GB_FIELD_CHOICE] = "choice",   [GB_FIELD_TEXT] = "text",
        [GB_FIELD_UNTIL] = "text",      [GB_FIELD_PRESSURES] = "list",
        [GB_FIELD_SIZES] = "list",      [GB_FIELD_PACKING] = "text"};
    return names[field->type];
}

static void write_unit(const struct gb_field *field, char *buffer, size_t size)
{
    const char *units = field->dimension == GB_DIM_NONE
                            ? ""
                            : gb_units_accepted((enum gb_dimension)field->dimension);
    if (field->type == GB_FIELD_RELATIVE) {
        g_snprintf(buffer, size, "%s, %s", field->relative, units);
    } else {
        g_strlcpy(buffer, units, size);
    }
}

static void write_choices(const struct gb_field *field, char *buffer, size_t size)
{
    buffer[0] = '\0';
    for (size_t k = 0; field->choices && field->choices[k]; k++) {
        g_strlcat(buffer, k ? ";" : "", size);
        g_strlcat(buffer, field->choices[k], size);
    }
}

bool gb_parameters_text(size_t index, enum gb_parameters_text what, char *buffer,
                        size_t size)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    if (index >= count || !buffer || size == 0) {
        return false;
    }
    const struct gb_field *field = &fields[index];
    switch (what) {
    case GB_PARAMETERS_KEY:
        g_snprintf(buffer, size, "%s.%s", field->group, field->key);
        return true;
    case GB_PARAMETERS_TYPE:
        g_strlcpy(buffer, type_of(field), size);
        return true;
    case GB_PARAMETERS_UNIT:
        write_unit(field, buffer, size);
        return true;
    case GB_PARAMETERS_DEFAULT:
        g_strlcpy(buffer, field->fallback, size);
        return true;
    case GB_PARAMETERS_RANGE:
        gb_params_accepted(field, buffer, size);
        return true;
    case GB_PARAMETERS_CHOICES:
        write_choices(field, buffer, size);
        return true;
    case GB_PARAMETERS_DOC:
        g_strlcpy(buffer, field->meaning, size);
        return true;
    case GB_PARAMETERS_SOURCE:
        g_strlcpy(buffer, field->source, size);
        return true;
    }
    return false;
}

size_t gb_parameters_presets(char *buffer, size_t size)
{
    char **names = gb_preset_folders_list();
    char *lines = g_strjoinv("\n", names);
    const size_t needed = strlen(lines) + 1;
    if (buffer && size > 0) {
        g_strlcpy(buffer, lines, size);
    }
    g_free(lines);
    g_strfreev(names);
    return needed;
}
