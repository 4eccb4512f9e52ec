#include <stdio.h>

#include "base/listing.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "io/material.h"
#include "io/preset_folders.h"

enum { CELL = 320 };

static void write_unit(const struct gb_field *field, char *out, size_t size)
{
    const char *units = gb_units_accepted((enum gb_dimension)field->dimension);
    if (field->type == GB_FIELD_RELATIVE) {
        snprintf(out, size, "%s, or %s", field->relative, units);
    } else if (field->dimension == GB_DIM_NONE) {
        g_strlcpy(out, "-", size);
    } else {
        g_strlcpy(out, units, size);
    }
}

static struct gb_listing *list_keys(void)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "`%s`", "key");
    gb_listing_columns(listing, "%s", "default,range,unit,meaning,source");
    for (size_t i = 0; i < count; i++) {
        char text[CELL];
        char *key = g_strdup_printf("%s.%s", field[i].group, field[i].key);
        gb_listing_text(listing, key);
        gb_listing_text(listing, *field[i].fallback ? field[i].fallback : "-");
        gb_listing_text(listing, gb_params_accepted(&field[i], text, sizeof text));
        write_unit(&field[i], text, sizeof text);
        gb_listing_text(listing, text);
        gb_listing_text(listing, field[i].meaning);
        gb_listing_text(listing, field[i].source);
        g_free(key);
    }
    return listing;
}

/* Adds the values of a material, the guessed ones, and its file; or why it cannot be
 * read. */
static void add_material(struct gb_listing *listing, const char *name)
{
    static const char *const keys[] = {"young", "poisson", "density",
                                       "d0",    "epsilon", "yield"};
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    const bool good = gb_material_apply(&params, name, &err);
    char *path = good ? gb_material_path(name, NULL) : g_strdup(err.text);
    char *guessed = good ? gb_material_guessed(path) : g_strdup("");
    gb_listing_text(listing, name);
    for (size_t k = 0; k < G_N_ELEMENTS(keys); k++) {
        char text[GB_PARAMS_VALUE_MAX] = "-";
        if (good) {
            gb_params_format(&params, gb_params_find(GB_MATERIAL_GROUP, keys[k]), text,
                             sizeof text);
        }
        gb_listing_text(listing, text);
    }
    gb_listing_text(listing, *guessed != '\0' ? guessed : "-");
    gb_listing_text(listing, path);
    g_free(guessed);
    g_free(path);
}

static struct gb_listing *list_materials(void)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "`%s`", "material");
    gb_listing_columns(listing, "%s",
                       "young,poisson,density,d0,epsilon,yield,guessed,file");
    char **names = gb_preset_folders_list_materials();
    for (int i = 0; names[i] != NULL; i++) {
        add_material(listing, names[i]);
    }
    g_strfreev(names);
    return listing;
}

int gb_cmd_params(int argc, char **argv)
{
    gboolean markdown = FALSE, materials = FALSE;
    const GOptionEntry entries[] = {
        {"materials", 0, 0, G_OPTION_ARG_NONE, &materials,
         "the materials that material=NAME takes, with their files, instead of the keys",
         NULL},
        {"markdown", 0, 0, G_OPTION_ARG_NONE, &markdown, "a Markdown table", NULL},
        {0},
    };
    static const struct gb_options_page page = {
        .usage = "",
        .summary =
            "Every preset key: default, range, unit, meaning, source.\n"
            "Keys are written under [group] in a preset, or as group.key=value on the\n"
            "command line; material=NAME sets all keys of [material].",
    };
    char **words = NULL;
    int status = 0;
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        return status;
    }
    struct gb_error err = {0};
    if (words[0]) {
        gb_error_set(&err, GB_ERR_INPUT, "%.80s: params takes no words", words[0]);
        g_strfreev(words);
        return gb_options_fail(&err);
    }
    g_strfreev(words);
    const bool good =
        gb_options_print(gb_listing_end(materials ? list_materials() : list_keys(),
                                        markdown ? GB_LISTING_MARKDOWN : GB_LISTING_TEXT),
                         &err);
    return good ? 0 : gb_options_fail(&err);
}
