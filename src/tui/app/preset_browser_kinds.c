#include "tui/app/preset_browser_kinds.h"

#include <glib.h>
#include <stdio.h>

#include "base/units.h"
#include "io/material.h"
#include "io/preset_folders.h"

/* --- presets ---------------------------------------------------------------------- */

static bool load_preset(struct gb_preset **out, const char *name,
                        const struct gb_params *current, struct gb_error *err)
{
    (void)current;
    return gb_preset_load(out, name, err);
}

static const char *title_of_scene(const struct gb_params *params)
{
    return params->title;
}

static void write_scene(struct gb_preset *preset, const char *path, char *text,
                        size_t size)
{
    const struct gb_params *params = gb_preset_params(preset);
    (void)path;
    char diameter[32];
    char until[48];
    char geometry[32];
    gb_units_format_short(params->diameter_m, GB_DIM_LENGTH, 4, diameter,
                          sizeof diameter);
    gb_params_format(params, gb_params_find("loading", "until"), until, sizeof until);
    gb_params_format(params, gb_params_find("loading", "geometry"), geometry,
                     sizeof geometry);
    snprintf(text, size, "%dD, %lld particles of %s, %s, until %s", params->dimension,
             (long long)params->count, diameter, geometry, until);
}

const struct gb_preset_browser_kind gb_preset_browser_kinds_presets = {
    .list = gb_preset_folders_list,
    .find = gb_preset_folders_find,
    .load = load_preset,
    .title = title_of_scene,
    .describe = write_scene,
    .empty = "no presets found",
};

/* --- materials -------------------------------------------------------------------- */

static bool load_material(struct gb_preset **out, const char *name,
                          const struct gb_params *current, struct gb_error *err)
{
    if (!gb_preset_create(out, err)) {
        return false;
    }
    *gb_preset_params(*out) = *current;
    if (!gb_material_apply(gb_preset_params(*out), name, err)) {
        gb_preset_destroy(*out);
        *out = NULL;
        return false;
    }
    return true;
}

static const char *name_of_material(const struct gb_params *params)
{
    return params->material;
}

static void write_guessed(struct gb_preset *preset, const char *path, char *text,
                          size_t size)
{
    char *keys = gb_material_guessed(path);
    (void)preset;
    g_snprintf(text, size, "%s%s", *keys != '\0' ? "Guessed: " : "", keys);
    g_free(keys);
}

const struct gb_preset_browser_kind gb_preset_browser_kinds_materials = {
    .list = gb_preset_folders_list_materials,
    .find = gb_preset_folders_find_material,
    .load = load_material,
    .title = name_of_material,
    .describe = write_guessed,
    .empty = "no materials found",
};
