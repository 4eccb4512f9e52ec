#include "draw/style/picture_style_parse.h"

#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "draw/style/picture_colours.h"

static const char *const shows[] = {"particles", "forces", "both"};

/* Default thickness of a slice, d. */
static const double default_slice = 2.0;

bool gb_picture_style_parse_colour(struct gb_picture_style_request *request,
                                   const char *text, struct gb_error *err)
{
    const struct gb_picture_colours_row *row = gb_picture_colours_find(text);
    if (row == NULL) {
        char *particles = gb_picture_colours_names(GB_PICTURE_COLOURS_PARTICLES);
        char *forces = gb_picture_colours_names(GB_PICTURE_COLOURS_FORCES);
        gb_error_set(err, GB_ERR_INPUT, "--color %.80s: accepted %s; for forces %s", text,
                     particles, forces);
        g_free(forces);
        g_free(particles);
        return false;
    }
    if (row->kind == GB_PICTURE_COLOURS_FORCES) {
        request->forces = row;
    } else {
        request->particles = row;
    }
    return true;
}

bool gb_picture_style_parse_show(struct gb_picture_style_request *request,
                                 const char *text, struct gb_error *err)
{
    for (size_t k = 0; k < G_N_ELEMENTS(shows); k++) {
        if (strcmp(text, shows[k]) == 0) {
            request->show = (enum gb_picture_style_show)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--show %.80s: accepted particles, forces or both", text);
}

/* "z=0.5"; *end: first character after the number. */
static bool parse_plane(const char *text, int *axis, double *at, const char **end)
{
    if (text[0] < 'x' || text[0] > 'z' || text[1] != '=' ||
        !gb_units_number(text + 2, end, at)) {
        return false;
    }
    *axis = text[0] - 'x';
    return *at >= 0.0 && *at <= 1.0;
}

bool gb_picture_style_parse_slice(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err)
{
    const char *end = text;
    int axis = 0;
    double at = 0.0;
    double width = default_slice;
    bool good = parse_plane(text, &axis, &at, &end);
    if (good && *end == ':') {
        good = gb_units_number(end + 1, &end, &width) && width > 0.0;
        good = good && (strcmp(end, " d") == 0 || strcmp(end, "d") == 0 || *end == '\0');
        end = "";
    }
    if (!good || *end != '\0') {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--slice %.80s: accepted an axis, a fraction of its edge and a "
            "thickness in diameters, as in y=0.5 or z=0.25:3d",
            text);
    }
    request->slice_axis = axis;
    request->slice_at = at;
    request->slice_width = width;
    return true;
}

bool gb_picture_style_parse_cut(struct gb_picture_style_request *request,
                                const char *text, struct gb_error *err)
{
    const char *end = text;
    int axis = 0;
    double at = 0.0;
    if (strcmp(text, "corner") == 0) {
        request->cut_corner = true;
        return true;
    }
    if (!parse_plane(text, &axis, &at, &end) || *end != '\0') {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--cut %.80s: accepted corner, or an axis and a fraction of its "
            "edge, as in y=0.5",
            text);
    }
    request->cut_axis = axis;
    request->cut_at = at;
    return true;
}
