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

/* A number with a unit, or one without that takes the unit behind the number of `like`. */
static bool parse_end(const char *text, const char *like, enum gb_dimension dimension,
                      double *value_si)
{
    const char *end = NULL;
    double number = 0.0;
    if (gb_units_parse(text, dimension, value_si, NULL)) {
        return true;
    }
    if (!gb_units_number(text, &end, &number) || *end != '\0' ||
        !gb_units_number(like, &end, &number)) {
        return false;
    }
    char *with_unit = g_strconcat(text, end, NULL);
    const bool good = gb_units_parse(with_unit, dimension, value_si, NULL);
    g_free(with_unit);
    return good;
}

static bool parse_ends(const char *text, enum gb_dimension dimension, double range_si[2])
{
    char **ends = g_strsplit(text, ":", 3);
    const bool good = g_strv_length(ends) == 2 &&
                      parse_end(ends[0], ends[1], dimension, &range_si[0]) &&
                      gb_units_parse(ends[1], dimension, &range_si[1], NULL) &&
                      range_si[0] < range_si[1];
    g_strfreev(ends);
    return good;
}

bool gb_picture_style_parse_range(struct gb_picture_style_request *request,
                                  const char *text, struct gb_error *err)
{
    static const struct {
        enum gb_dimension dimension;
        const char *example;
    } examples[] = {{GB_DIM_PRESSURE, "0:200MPa"}, {GB_DIM_LENGTH, "0:20nm"}};
    const enum gb_dimension dimension = request->particles->dimension;
    const bool particles = request->show != GB_PICTURE_STYLE_FORCES;
    const bool forces = request->show != GB_PICTURE_STYLE_PARTICLES;
    const char *example = "2:10";
    double range_si[2];
    if (forces && parse_ends(text, GB_DIM_FORCE, range_si) && range_si[0] == 0.0) {
        request->max_force_n = range_si[1];
        return true;
    }
    if (particles && parse_ends(text, dimension, request->range_si)) {
        request->ranged = true;
        return true;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(examples); k++) {
        example = examples[k].dimension == dimension ? examples[k].example : example;
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--range %.80s: accepted LOW:HIGH, as in %s%s%s", text,
                        particles ? example : "", particles && forces ? ", or " : "",
                        forces ? "0:50nN for the thickest rod" : "");
}

char *gb_picture_style_parse_colormaps(void)
{
    GString *names = g_string_new(NULL);
    for (const struct gb_palette_map *map = gb_palette_maps(); map->name; map++) {
        g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", map->name);
    }
    return g_string_free(names, FALSE);
}

bool gb_picture_style_parse_colormap(struct gb_picture_style_request *request,
                                     const char *text, struct gb_error *err)
{
    request->map = gb_palette_find(text);
    if (request->map != NULL) {
        return true;
    }
    char *names = gb_picture_style_parse_colormaps();
    gb_error_set(err, GB_ERR_INPUT, "--colormap %.80s: accepted %s", text, names);
    g_free(names);
    return false;
}
