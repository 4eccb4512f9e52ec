#include "study/law/law_points.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"

/* A whole text that is one number, or one length. */
static bool read_number(const char *text, struct gb_law_points_number *number)
{
    number->length = !gb_units_parse(text, GB_DIM_NONE, &number->value, NULL);
    return !number->length || gb_units_parse(text, GB_DIM_LENGTH, &number->value, NULL);
}

/* Splits "name=rest"; rest is NULL when there is no name. */
static const char *read_name(const char *text, char name[16])
{
    const char *equals = strchr(text, '=');
    const size_t length = equals ? (size_t)(equals - text) : 0;
    if (length == 0 || length >= 16) {
        return NULL;
    }
    memcpy(name, text, length);
    name[length] = '\0';
    g_strstrip(name);
    return equals + 1;
}

static bool refuse(const char *option, const char *text, const char *accepted,
                   struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s %.80s: accepted %s", option, text,
                        accepted);
}

bool gb_law_points_at(struct gb_law_points_at *at, const char *text, struct gb_error *err)
{
    *at = (struct gb_law_points_at){0};
    char **parts = g_strsplit(text, ",", GB_LAW_POINTS_FIXED + 1);
    bool good = parts[0] != NULL;
    for (int i = 0; parts[i] && good; i++) {
        struct gb_law_points_value *item = &at->item[at->count];
        good = at->count < GB_LAW_POINTS_FIXED;
        if (good) {
            const char *number = read_name(parts[i], item->name);
            good = number && read_number(number, &item->number);
            at->count++;
        }
    }
    g_strfreev(parts);
    return good || refuse("--at", text,
                          "name=number, as in h=0.01, h_min=0.02,h=0.015 or h=20nm", err);
}

bool gb_law_points_refuse_range(const char *text, struct gb_error *err)
{
    return refuse("--range", text,
                  "name=from:to:count, from below to, count 1 to 10000000, as in "
                  "h=0:0.1:101",
                  err);
}

bool gb_law_points_range(struct gb_law_points_range *range, const char *text,
                         struct gb_error *err)
{
    const char *rest = read_name(text, range->name);
    char **parts = g_strsplit(rest ? rest : "", ":", 4);
    double count = 0.0;
    const bool good = g_strv_length(parts) == 3 && read_number(parts[0], &range->from) &&
                      read_number(parts[1], &range->to) &&
                      gb_units_parse(parts[2], GB_DIM_NONE, &count, NULL) &&
                      count == floor(count) && count >= 1.0 && count <= GB_LAW_POINTS_MAX;
    g_strfreev(parts);
    range->count = good ? (int64_t)count : 0;
    return good || gb_law_points_refuse_range(text, err);
}

double gb_law_points_between(double from, double to, int64_t count, int64_t index)
{
    if (index + 1 == count && index > 0) {
        return to;
    }
    const double share = count > 1 ? (double)index / (double)(count - 1) : 0.0;
    return from + (to - from) * share;
}

bool gb_law_points_path(struct gb_law_points_path *path, const char *text,
                        struct gb_error *err)
{
    const char *rest = read_name(text, path->name);
    if (!rest) {
        path->name[0] = '\0';
        rest = text;
    }
    char **parts = g_strsplit(rest, ",", GB_LAW_POINTS_CORNERS + 1);
    const guint length = g_strv_length(parts);
    bool good = length >= 2 && length <= GB_LAW_POINTS_CORNERS;
    for (guint i = 0; i < length && good; i++) {
        good = read_number(parts[i], &path->corner[i]);
    }
    g_strfreev(parts);
    path->count = (int)length;
    return good || refuse("--path", text,
                          "two or more overlaps, as in 0,0.02,-0.01 or 0,20nm,5nm", err);
}
