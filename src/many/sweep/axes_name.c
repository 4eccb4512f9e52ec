#include <string.h>

#include "io/rundir.h"
#include "many/sweep/axes.h"

/* Is the key alone enough to tell this axis from the others? */
static bool is_key_unique(const struct gb_axes *axes, size_t axis)
{
    for (size_t i = 0; i < axes->count; i++) {
        if (i != axis &&
            strcmp(axes->axis[i].field->key, axes->axis[axis].field->key) == 0) {
            return false;
        }
    }
    return true;
}

char *gb_axes_name(const struct gb_axes *axes, size_t point)
{
    GString *name = g_string_new(axes->count == 0 ? "scene" : NULL);
    for (size_t i = 0; i < axes->count; i++) {
        const struct gb_field *field = axes->axis[i].field;
        g_string_append(name, i > 0 ? "_" : "");
        if (!is_key_unique(axes, i)) {
            g_string_append_printf(name, "%s.", field->group);
        }
        g_string_append_printf(name, "%s-",
                               axes->axis[i].material ? field->group : field->key);
        gb_rundir_name_value(name, gb_axes_value(axes, point, i),
                             gb_axes_is_free_text(&axes->axis[i]));
    }
    return g_string_free(name, FALSE);
}
