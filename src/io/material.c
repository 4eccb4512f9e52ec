#include "io/material.h"

#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/file.h"
#include "io/preset.h"
#include "io/preset_folders.h"

enum { BYTES_MAX = 1 << 20 };

/* Keys without which a file is no material. */
static const char *const needed[] = {"name", "young",      "poisson", "density",
                                     "d0",   "n_d0_cubed", "epsilon"};

static bool is_file(const char *path)
{
    return g_file_test(path, G_FILE_TEST_EXISTS) &&
           !g_file_test(path, G_FILE_TEST_IS_DIR);
}

static void *no_such(const char *name, char **known, struct gb_error *err)
{
    char *list = g_strjoinv(", ", known);
    gb_error_set(err, GB_ERR_INPUT,
                 "material=%.60s: no such material; must be one of %.300s, or a file",
                 name, known[0] != NULL ? list : "none");
    g_free(list);
    return NULL;
}

/* Finds a material whose name differs only in case. */
static char *find_any_case(const char *name, struct gb_error *err)
{
    char **known = gb_preset_folders_list_materials();
    char *path = NULL;
    for (int i = 0; known[i] != NULL && path == NULL; i++) {
        if (g_ascii_strcasecmp(known[i], name) == 0) {
            path = gb_preset_folders_find_material(known[i]);
        }
    }
    path = path != NULL ? path : no_such(name, known, err);
    g_strfreev(known);
    return path;
}

char *gb_material_path(const char *name_or_path, struct gb_error *err)
{
    const bool path = strchr(name_or_path, '/') != NULL ||
                      (g_str_has_suffix(name_or_path, ".ini") && is_file(name_or_path));
    char *found = path ? NULL : gb_preset_folders_find_material(name_or_path);
    if (path) { /* opening it reports the error */
        return g_strdup(name_or_path);
    }
    return found != NULL ? found : find_any_case(name_or_path, err);
}

static bool check(const struct gb_preset *file, struct gb_error *err)
{
    const char *path = gb_preset_path(file);
    const char *other = gb_preset_other_group(file, GB_MATERIAL_GROUP);
    if (other != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: [%.40s]: a material has the group [material] only",
                            path, other);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(needed); i++) {
        if (!gb_preset_has(file, GB_MATERIAL_GROUP, needed[i])) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: no material.%s: a material needs name, young, "
                                "poisson, density, d0, n_d0_cubed and epsilon",
                                path, needed[i]);
        }
    }
    return true;
}

static void copy_group(struct gb_params *to, const struct gb_params *from)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(fields[i].group, GB_MATERIAL_GROUP) == 0) {
            memcpy((char *)to + fields[i].offset, (const char *)from + fields[i].offset,
                   fields[i].size);
        }
    }
}

/* Finds a name as a word of a title, in any case; NULL: not found. */
static const char *find_word(const char *title, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = title; *at != '\0' && length > 0; at++) {
        const bool begins = at == title || !g_ascii_isalnum(at[-1]);
        if (begins && g_ascii_strncasecmp(at, name, length) == 0 &&
            !g_ascii_isalnum(at[length])) {
            return at;
        }
    }
    return NULL;
}

/* Replaces the name of the previous material in the title. */
static void rename_title(struct gb_params *params, const char *before)
{
    const char *word = find_word(params->title, before);
    if (word != NULL) {
        char *title =
            g_strdup_printf("%.*s%s%s", (int)(word - params->title), params->title,
                            params->material, word + strlen(before));
        if (strlen(title) < sizeof params->title) {
            g_strlcpy(params->title, title, sizeof params->title);
        }
        g_free(title);
    }
}

bool gb_material_apply(struct gb_params *params, const char *name_or_path,
                       struct gb_error *err)
{
    char *path = gb_material_path(name_or_path, err);
    struct gb_preset *file = NULL;
    const bool good =
        path != NULL && gb_preset_load(&file, path, err) && check(file, err);
    if (good) {
        char *before = g_strdup(params->material);
        copy_group(params, gb_preset_params(file));
        rename_title(params, before);
        g_free(before);
    }
    gb_preset_destroy(file);
    g_free(path);
    return good;
}

bool gb_material_assign(struct gb_params *params, const char *assignment,
                        struct gb_error *err)
{
    char **part = g_strsplit(assignment, "=", 2);
    const bool whole = part[0] != NULL && part[1] != NULL &&
                       strcmp(g_strstrip(part[0]), GB_MATERIAL_GROUP) == 0;
    const bool good = whole ? gb_material_apply(params, g_strstrip(part[1]), err)
                            : gb_params_assign(params, assignment, err);
    g_strfreev(part);
    return good;
}

char *gb_material_guessed(const char *path)
{
    char *text = NULL;
    GString *keys = g_string_new(NULL);
    bool guessed = false;
    size_t length = 0;
    (void)gb_file_read(path, BYTES_MAX, &text, &length, NULL);
    char **line = g_strsplit(text != NULL ? text : "", "\n", -1);
    for (int i = 0; line[i] != NULL; i++) {
        const char *equals = strchr(line[i], '=');
        if (line[i][0] == '#') {
            guessed = guessed || strstr(line[i], "(guessed)") != NULL;
            continue;
        }
        if (guessed && equals != NULL) {
            char *key = g_strndup(line[i], (gsize)(equals - line[i]));
            g_string_append_printf(keys, "%s%s", keys->len > 0 ? ", " : "",
                                   g_strstrip(key));
            g_free(key);
        }
        guessed = false;
    }
    g_strfreev(line);
    gb_alloc_free(text);
    return g_string_free(keys, FALSE);
}
