#include "draw/picture_style_parse.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

static const char *const colours[] = {"coordination", "pressure", "bridges", "size",
                                      "displacement", "sign",     "bridged"};
static const char *const shows[] = {"particles", "forces", "both"};

enum { COLOURS = sizeof colours / sizeof colours[0] };

/* Thickness of a slice that names none, d. */
static const double usual_slice = 2.0;

bool gb_picture_style_parse_colour(struct gb_picture_style_request *request,
                                   const char *text, struct gb_error *err)
{
    for (int k = 0; k < COLOURS; k++) {
        if (strcmp(text, colours[k]) == 0) {
            if (k == GB_PICTURE_STYLE_SIGN || k == GB_PICTURE_STYLE_BRIDGED) {
                request->force = (enum gb_picture_style_colour)k;
            } else {
                request->colour = (enum gb_picture_style_colour)k;
            }
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--color %.80s: accepted coordination, pressure, bridges, size, "
                        "displacement; for forces sign, bridged",
                        text);
}

bool gb_picture_style_parse_show(struct gb_picture_style_request *request,
                                 const char *text, struct gb_error *err)
{
    for (int k = 0; k < 3; k++) {
        if (strcmp(text, shows[k]) == 0) {
            request->show = (enum gb_picture_style_show)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--show %.80s: accepted particles, forces or both", text);
}

/* "z=0.5"; *end behind the number. */
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
    double width = usual_slice;
    bool good = parse_plane(text, &axis, &at, &end);
    if (good && *end == ':') {
        good = gb_units_number(end + 1, &end, &width) && width > 0.0;
        good = good && (strcmp(end, " d") == 0 || strcmp(end, "d") == 0 || *end == '\0');
        end = "";
    }
    if (!good || *end != '\0') {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--slice %.80s: accepted an axis, a share of its edge and a "
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
        return gb_error_set(err, GB_ERR_INPUT,
                            "--cut %.80s: accepted corner, or an axis and a share of its "
                            "edge, as in y=0.5",
                            text);
    }
    request->cut_axis = axis;
    request->cut_at = at;
    return true;
}
