#include "scene/path/path.h"

#include <string.h>

#include "greenbody/params.h"

static const char *const names[GB_PATH_COMPONENTS] = {"x", "y", "z", "xy", "xz", "yz"};
static const char *const long_names[3] = {"xx", "yy", "zz"};

bool gb_path_has_component(int dimension, int component)
{
    return dimension == 3 || component == 0 || component == 2 || component == 4;
}

const char *gb_path_component_name(int component)
{
    return names[component];
}

int gb_path_component_find(const char *name, size_t length)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        const char *second = k < 3 ? long_names[k] : names[k];
        if ((strlen(names[k]) == length && strncmp(names[k], name, length) == 0) ||
            (strlen(second) == length && strncmp(second, name, length) == 0)) {
            return k;
        }
    }
    return -1;
}

static bool fixed(const struct gb_leg_component *component)
{
    return component->control == GB_LEG_STRAIN && component->value == 0.0;
}

/* Are all axes strained equally? */
static bool is_isotropic(const struct gb_leg *leg)
{
    return leg->leading < 3 && leg->component[0].control == GB_LEG_STRAIN &&
           leg->component[0].value == leg->component[2].value &&
           leg->component[2].control == GB_LEG_STRAIN;
}

int gb_path_strained(const struct gb_path *path)
{
    int component = -1;
    for (int l = 0; l < path->count; l++) {
        const struct gb_leg *leg = &path->leg[l];
        if (leg->leading >= 3 ||
            (component < 3 && leg->leading >= 0 && !is_isotropic(leg))) {
            component = leg->leading;
        }
    }
    return component >= 0 ? component : 2;
}

bool gb_path_sheared(const struct gb_path *path)
{
    for (int l = 0; l < path->count; l++) {
        for (int k = 3; k < GB_PATH_COMPONENTS; k++) {
            if (!fixed(&path->leg[l].component[k])) {
                return true;
            }
        }
    }
    return false;
}

int gb_path_geometry(const struct gb_path *path, int dimension)
{
    const struct gb_leg_component *component = path->leg[0].component;
    const bool by_strain = component[0].control == GB_LEG_STRAIN &&
                           component[1].control == GB_LEG_STRAIN &&
                           component[2].control == GB_LEG_STRAIN;
    const bool x = !fixed(&component[0]);
    const bool y = dimension == 3 && !fixed(&component[1]);
    if (!by_strain || x || fixed(&component[2])) {
        return GB_GEOMETRY_ISOTROPIC;
    }
    return y ? GB_GEOMETRY_BIAXIAL : GB_GEOMETRY_UNIAXIAL;
}
