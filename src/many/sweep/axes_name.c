#include <string.h>

#include "many/sweep/axes.h"

/* Characters of a value in the name of a directory, and those before a checksum. */
enum { VALUE_MAX = 60, VALUE_KEPT = 40 };

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

static void add_to_name(GString *name, const struct gb_axis *axis, const char *value)
{
    const gsize before = name->len;
    for (const char *c = value; *c != '\0'; c++) {
        if (g_ascii_isalnum(*c) || *c == '.' || *c == '-' || *c == '+') {
            g_string_append_c(name, *c);
        } else if (gb_axes_is_free_text(axis)) { /* not the blanks in "10 nm" */
            g_string_append_printf(name, "~%02X", (unsigned)(unsigned char)*c);
        }
    }
    if (name->len - before > VALUE_MAX) {
        char *sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, value, -1);
        g_string_truncate(name, before + VALUE_KEPT);
        g_string_append_printf(name, "~~%.16s", sum);
        g_free(sum);
    }
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
        add_to_name(name, &axes->axis[i], gb_axes_value(axes, point, i));
    }
    return g_string_free(name, FALSE);
}
