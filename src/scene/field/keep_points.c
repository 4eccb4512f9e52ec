#include "scene/field/keep_points.h"

#include <glib.h>
#include <string.h>

#include "base/units.h"
#include "scene/tolerances.h"

static const int64_t every_most = 1000000;
static const double pressure_least = 1.0, pressure_most = 1e12;

static bool refuse(const char *entry, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT,
        "output.snapshots_at = %.60s: must be up to %d pressures, "
        "densities or numbers of points, separated by ';', as in 100 MPa; "
        "density = 0.5; every 20",
        entry, GB_KEEP_POINTS_MAX);
}

static bool parse_every(const char *text, int64_t *every)
{
    char *rest = NULL;
    if (!g_str_has_prefix(text, "every") || !g_ascii_isspace(text[5])) {
        return false;
    }
    *every = g_ascii_strtoll(text + 5, &rest, 10);
    return *rest == '\0' && *every >= 1 && *every <= every_most;
}

static bool parse_point(const char *text, struct gb_keep_point *point)
{
    const char *value = text;
    point->by_density = g_str_has_prefix(text, "density");
    if (point->by_density) {
        value += strlen("density");
        value += strspn(value, " \t");
        if (*value++ != '=') {
            return false;
        }
    }
    return gb_units_parse(value, point->by_density ? GB_DIM_NONE : GB_DIM_PRESSURE,
                          &point->value, NULL) &&
           (point->by_density
                ? point->value > 0.0 && point->value < 1.0
                : point->value >= pressure_least && point->value <= pressure_most);
}

static bool parse_entry(const char *text, struct gb_keep_points *points)
{
    if (points->every == 0 && parse_every(text, &points->every)) {
        return true;
    }
    return points->count < GB_KEEP_POINTS_MAX &&
           parse_point(text, &points->point[points->count]) && ++points->count > 0;
}

bool gb_keep_points_parse(const char *text, struct gb_keep_points *points,
                          struct gb_error *err)
{
    *points = (struct gb_keep_points){0};
    char **entries = g_strsplit(text, ";", -1);
    bool good = true;
    for (size_t i = 0; good && entries[i] != NULL; i++) {
        char *entry = g_strstrip(entries[i]);
        /* the end of the list after a final ';', or an empty text */
        const bool nothing = entry[0] == '\0' && entries[i + 1] == NULL;
        good = nothing || parse_entry(entry, points) || refuse(entry, err);
    }
    g_strfreev(entries);
    return good;
}

bool gb_keep_points_reached(const struct gb_keep_point *point,
                            const struct gb_params *params, double before, double now)
{
    const double of_leg = params->path[0] != '\0' ? GB_PATH_END_SHARE : 0.0;
    const double share = point->by_density ? GB_PATH_STRAIN_TOLERANCE : of_leg;
    const double enough = point->value * (1.0 - share);
    return before < enough && now >= enough;
}
