#include "tui/session/earlier.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"

void gb_earlier_drop(struct gb_earlier *earlier)
{
    gb_alloc_free(earlier->density);
    gb_alloc_free(earlier->pressure_pa);
    gb_alloc_free(earlier->elapsed);
    memset(earlier, 0, sizeof *earlier);
}

double gb_earlier_elapsed(int kind, const struct gb_point *point)
{
    return kind == GB_KIND_DYNAMIC ? 1e9 * point->time_s : (double)point->step;
}

/* The branches of a curve one after the other, NaN between them. */
static void copy_branches(struct gb_earlier *earlier, const struct gb_curve *curve,
                          size_t count)
{
    int branch = 0;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (i > 0 && point->branch != branch && (point->branch > 0 || branch > 0)) {
            earlier->density[n] = NAN;
            earlier->elapsed[n] = NAN;
            earlier->pressure_pa[n++] = NAN;
        }
        branch = point->branch;
        earlier->density[n] = point->density;
        earlier->elapsed[n] = gb_earlier_elapsed(earlier->params.kind, point);
        earlier->pressure_pa[n++] = point->p_pa;
    }
    earlier->count = n;
}

bool gb_earlier_copy(struct gb_earlier *earlier, const struct gb_params *params,
                     const struct gb_curve *curve, size_t count)
{
    memset(earlier, 0, sizeof *earlier);
    earlier->params = *params;
    earlier->density = gb_alloc_array(2 * count, sizeof(double), NULL);
    earlier->pressure_pa = gb_alloc_array(2 * count, sizeof(double), NULL);
    earlier->elapsed = gb_alloc_array(2 * count, sizeof(double), NULL);
    if (earlier->density == NULL || earlier->pressure_pa == NULL ||
        earlier->elapsed == NULL) {
        gb_earlier_drop(earlier);
        return false;
    }
    copy_branches(earlier, curve, count);
    return true;
}

bool gb_earlier_same(const struct gb_params *a, const struct gb_params *b,
                     const struct gb_field *field)
{
    char one[GB_PARAMS_VALUE_MAX];
    char other[GB_PARAMS_VALUE_MAX];
    gb_params_format(a, field, one, sizeof one);
    gb_params_format(b, field, other, sizeof other);
    return strcmp(one, other) == 0;
}

static bool names_only(const struct gb_field *field)
{
    return strcmp(field->key, "title") == 0;
}

int gb_earlier_differences(const struct gb_params *a, const struct gb_params *b)
{
    size_t count = 0;
    int differences = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        differences += !names_only(&field[i]) && !gb_earlier_same(a, b, &field[i]);
    }
    return differences;
}

char *gb_earlier_describe(const struct gb_params *own, const struct gb_params *other,
                          char *text, size_t size)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GString *all = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        if (!names_only(&field[i]) && !gb_earlier_same(own, other, &field[i])) {
            char value[GB_PARAMS_VALUE_MAX];
            gb_params_format(own, &field[i], value, sizeof value);
            const bool none = value[0] == '\0';
            g_string_append_printf(all, "%s%s%s%s%s", all->len > 0 ? ", " : "",
                                   none ? "no " : "", field[i].key, none ? "" : " ",
                                   value);
        }
    }
    g_strlcpy(text, all->len > 0 ? all->str : "same parameters", size);
    g_string_free(all, TRUE);
    return text;
}
