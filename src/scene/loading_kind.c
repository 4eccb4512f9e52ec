#include "scene/loading_kind.h"

#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "scene/die_scene.h"
#include "scene/dynamic_scene.h"
#include "scene/quasistatic_scene.h"

#define NORMAL(law) (1u << GB_NORMAL_##law)

const struct gb_loading_kind gb_loading_kind_table[GB_LOADING_KINDS] = {
    [GB_KIND_QUASISTATIC] =
        {
            .name = "quasistatic",
            .doc = "a periodic cell is strained in steps and relaxed after each; "
                   "P1 III",
            .normals = NORMAL(ROD) | NORMAL(HERTZ),
            .columns = GB_COLUMNS_COMMON,
            .periodic_cell = true,
            .plane = true,
            .single_precision = true,
            .changes = true,
            .unloading_branches = true,
            .paths = true,
            .check = gb_quasistatic_scene_check,
            .freeze = gb_quasistatic_scene_freeze,
            .note = gb_quasistatic_scene_note,
        },
    [GB_KIND_DYNAMIC] =
        {
            .name = "dynamic",
            .doc = "a periodic cell is compressed at a given rate, particles obey "
                   "Newton's equations; P2 (1)",
            .normals = NORMAL(ROD),
            .columns = GB_COLUMNS_ENERGY,
            .periodic_cell = true,
            .plane = true,
            .viscous_contacts = true,
            .follows_time = true,
            .given_rate = true,
            .check = gb_dynamic_scene_check,
            .freeze = gb_dynamic_scene_freeze,
            .note = gb_dynamic_scene_note,
        },
    [GB_KIND_DIE] =
        {
            .name = "die",
            .doc = "powder is poured into a die and pressed by a punch; P3 5",
            .normals = NORMAL(HERTZ) | NORMAL(STORAKERS),
            .columns = GB_COLUMNS_DIE,
            .follows_time = true,
            .check = gb_die_scene_check,
            .freeze = gb_die_scene_freeze,
            .note = gb_die_scene_note,
        },
};

#undef NORMAL

const struct gb_loading_kind *gb_loading_kind_at(int kind)
{
    return &gb_loading_kind_table[kind];
}

const struct gb_loading_kind *gb_loading_kind_of(const struct gb_params *params)
{
    return gb_loading_kind_at(params->kind);
}

bool gb_loading_kind_follows_path(const struct gb_params *params)
{
    return gb_loading_kind_of(params)->paths && params->path[0] != '\0';
}

static void append_name(char *buffer, size_t size, const char *name)
{
    const size_t used = strlen(buffer);
    snprintf(buffer + used, size - used, "%s%s", used > 0 ? " or " : "", name);
}

char *gb_loading_kind_names(bool (*has)(const struct gb_loading_kind *kind), char *buffer,
                            size_t size)
{
    buffer[0] = '\0';
    for (int k = 0; k < GB_LOADING_KINDS; k++) {
        if (has(&gb_loading_kind_table[k])) {
            append_name(buffer, size, gb_loading_kind_table[k].name);
        }
    }
    return buffer;
}

bool gb_loading_kind_check_normal(const struct gb_params *params, struct gb_error *err)
{
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    const char *const *names = gb_params_find("contact", "normal")->choices;
    char accepted[80] = "";
    if (kind->normals >> params->normal & 1u) {
        return true;
    }
    for (int law = 0; names[law] != NULL; law++) {
        if (kind->normals >> law & 1u) {
            append_name(accepted, sizeof accepted, names[law]);
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "contact.normal = %s: must be %s with scene.kind = %s",
                        names[params->normal], accepted, kind->name);
}

static bool has_cell(const struct gb_loading_kind *kind)
{
    return kind->periodic_cell;
}

bool gb_loading_kind_check_cell(const struct gb_params *params, const char *what,
                                struct gb_error *err)
{
    char names[80];
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    return kind->periodic_cell ||
           gb_error_set(err, GB_ERR_INPUT,
                        "scene.kind = %s: %s needs a periodic cell, scene.kind = %s",
                        kind->name, what,
                        gb_loading_kind_names(has_cell, names, sizeof names));
}
