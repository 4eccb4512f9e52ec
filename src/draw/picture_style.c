/* Style of a picture: which particles are visible (slice, cuts), how they are coloured, and
 * the normal forces as rods, whose thickness is proportional to the force. */
#include "draw/picture_style.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/units.h"
#include "base/vec.h"
#include "draw/picture_colours.h"
#include "pack/cell/cell.h"
#include "pack/die/die.h"

/* Radius of the thickest and the thinnest rods, d. */
static const double max_radius = 0.17;
static const double min_radius = 0.006;

/* Quantile of the forces that, rounded up, has the thickest rod; larger forces are as thick:
 * a few large ones would make all others thin. */
static const double max_force_quantile = 0.99;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double gb_picture_style_rod_radius(double ratio)
{
    return fmax(max_radius * fmin(ratio, 1.0), min_radius);
}

/* The walls of a state's die; a funnel that it does not have is not touched. */
static struct gb_die walls_of(const struct gb_state *state)
{
    const double size = hypot(state->funnel_slope, 1.0);
    return (struct gb_die){.radius = state->die_radius,
                           .funnel = state->funnel_height > 0.0,
                           .height = state->funnel_height,
                           .outlet = state->funnel_outlet,
                           .sine = state->funnel_slope / size,
                           .cosine = 1.0 / size,
                           .punch = isfinite(state->punch_height),
                           .punch_position = state->punch_height,
                           .bore = !isfinite(state->die_top) ? GB_DIE_BORE_ENDLESS
                                   : state->die_top > 0.0    ? GB_DIE_BORE_OPEN
                                                             : GB_DIE_BORE_GONE,
                           .top = state->die_top};
}

/* Normal force of a contact with a wall, E d^2, and the way from the wall to the particle's
 * centre; 0 where the state does not tell the place of the wall. */
static double wall_normal(const struct gb_state *state, const struct gb_die *die,
                          int64_t line, double unit[3])
{
    const int32_t particle = state->wall[2 * line];
    const double *at = state->position + 3 * (int64_t)particle;
    const double x[3] = {at[0] - 0.5 * state->cell[0], at[1] - 0.5 * state->cell[1],
                         at[2]};
    const double overlap =
        gb_die_overlap(die, (enum gb_die_wall)state->wall[2 * line + 1], x,
                       state->radius[particle], unit);
    return isfinite(overlap) ? gb_vec_dot(state->wall_force + 3 * line, unit) : 0.0;
}

/* Quantile of the forces for the thickest rods and the largest force, N. */
static bool find_largest(const struct gb_state *state, const struct gb_die *die,
                         double newton, double *quantile, double *largest,
                         struct gb_error *err)
{
    const size_t pairs = (size_t)state->pair_count;
    const size_t count = pairs + (size_t)state->wall_count;
    double *force = gb_alloc_array(count + 1, sizeof *force, err);
    if (force == NULL) {
        return false;
    }
    for (size_t k = 0; k < pairs; k++) {
        force[k] = fabs(state->pair_normal[k]);
    }
    for (size_t k = pairs; k < count; k++) {
        double unit[3];
        force[k] = fabs(wall_normal(state, die, (int64_t)(k - pairs), unit));
    }
    qsort(force, count, sizeof *force, compare);
    *quantile = *largest = 0.0;
    if (count > 0) {
        *quantile =
            newton * force[(size_t)ceil(max_force_quantile * (double)(count - 1))];
        *largest = newton * force[count - 1];
    }
    gb_alloc_free(force);
    return true;
}

static void put_rod(struct gb_picture_style *style, const double *from,
                    const double span[3], double fraction, double radius,
                    const uint8_t rgb[3])
{
    float *rod = &style->rod[7 * style->rods];
    for (int k = 0; k < 3; k++) {
        rod[k] = (float)from[k];
        rod[3 + k] = (float)(from[k] + fraction * span[k]);
    }
    rod[6] = (float)radius;
    memcpy(&style->rod_colour[3 * style->rods], rgb, 3);
    style->rods++;
}

/* Rod of a contact; two halves where it crosses a periodic wall. */
static void put_contact(struct gb_picture_style *style, const struct gb_state *state,
                        const struct gb_cell *cell, int64_t pair, double radius,
                        const uint8_t rgb[3])
{
    const int32_t *ends = &state->pair[2 * pair];
    const double *a = &state->position[3 * ends[0]];
    const double *b = &state->position[3 * ends[1]];
    const double direct[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    double span[3] = {direct[0], direct[1], direct[2]};
    gb_cell_nearest(cell, span);
    const bool inside = fabs(span[0] - direct[0]) + fabs(span[1] - direct[1]) +
                            fabs(span[2] - direct[2]) <
                        1e-9;
    if (inside) {
        put_rod(style, a, span, 1.0, radius, rgb);
        return;
    }
    const double back[3] = {-span[0], -span[1], -span[2]};
    put_rod(style, a, span, 0.5, radius, rgb);
    put_rod(style, b, back, 0.5, radius, rgb);
}

/* Rods from centres to walls. */
static void put_walls(struct gb_picture_style *style, const struct gb_state *state,
                      const struct gb_die *die,
                      const struct gb_picture_colours_row *colours, double newton)
{
    for (int64_t k = 0; k < state->wall_count; k++) {
        const int32_t particle = state->wall[2 * k];
        double unit[3];
        const double normal = wall_normal(state, die, k, unit);
        if (style->hidden[particle] != 0 || normal == 0.0) {
            continue;
        }
        const double ratio = fabs(normal) * newton / style->max_force_n;
        gb_vec_scale(unit, -state->radius[particle]);
        put_rod(style, state->position + 3 * (int64_t)particle, unit, 1.0,
                gb_picture_style_rod_radius(ratio),
                style->legend[colours->wall_class(normal)].rgb);
    }
}

/* Normal forces as rods between particle centres, and from these to the walls of a die:
 * thickness proportional to the force, colour by its class.  Fills rods and legend of a style
 * with known hidden particles. */
static bool make_rods(struct gb_picture_style *style, const struct gb_state *state,
                      const struct gb_picture_style_request *request,
                      struct gb_error *err)
{
    const struct gb_picture_colours_row *colours = request->forces;
    const size_t max_rods = 2 * (size_t)state->pair_count + (size_t)state->wall_count + 1;
    const struct gb_die die = walls_of(state);
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    const struct gb_cell cell = gb_state_cell(state);
    double quantile = 0.0;
    double largest = 0.0;
    style->rod = gb_alloc_array(max_rods, 7 * sizeof *style->rod, err);
    style->rod_colour = gb_alloc_array(max_rods, 3, err);
    if (style->rod == NULL || style->rod_colour == NULL ||
        !find_largest(state, &die, newton, &quantile, &largest, err)) {
        return false;
    }
    memcpy(style->legend, colours->legend, sizeof style->legend);
    style->legend_count = 2;
    style->max_force_n = request->max_force_n > 0.0 ? request->max_force_n
                         : quantile > 0.0           ? gb_number_round_above(quantile)
                                                    : newton;
    style->forces_above = largest > style->max_force_n;
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t *ends = &state->pair[2 * k];
        if (style->hidden[ends[0]] != 0 || style->hidden[ends[1]] != 0) {
            continue;
        }
        const double ratio = fabs(state->pair_normal[k]) * newton / style->max_force_n;
        put_contact(style, state, &cell, k, gb_picture_style_rod_radius(ratio),
                    style->legend[colours->force_class(state, k)].rgb);
    }
    put_walls(style, state, &die, colours, newton);
    return true;
}

/* Drawn radius over particle radius: between small particles forces are visible, and with
 * forces alone the particles are dots. */
static const float radius_scale_both = 0.38F;
static const float radius_scale_forces = 0.1F;

void gb_picture_style_init(struct gb_picture_style_request *request)
{
    *request = (struct gb_picture_style_request){
        .particles = gb_picture_colours_find("coordination"),
        .forces = gb_picture_colours_find("sign"),
        .slice_axis = -1,
        .cut_axis = -1};
}

static bool is_outside_slice(const struct gb_state *state,
                             const struct gb_picture_style_request *request,
                             const double *position)
{
    const struct gb_cell cell = gb_state_cell(state);
    const int k = request->slice_axis;
    double fraction[3];
    gb_cell_fraction(&cell, position, fraction);
    const double distance =
        fabs(fraction[k] - request->slice_at) * gb_cell_spacing(&cell, k);
    return distance > 0.5 * request->slice_width;
}

/* Half-space beyond (side 1) or before (-1) a fraction of an edge. */
static void add_cut(struct gb_picture_style *style, const struct gb_cell *cell, int axis,
                    double at, double side)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double *cut = style->cut[style->cuts++];
    const double spacing = gb_cell_spacing(cell, axis);
    double zero[3];
    gb_cell_fraction(cell, origin, zero);
    for (int k = 0; k < 3; k++) {
        double unit[3] = {0.0, 0.0, 0.0};
        double fraction[3];
        unit[k] = 1.0;
        gb_cell_fraction(cell, unit, fraction);
        cut[k] = side * spacing * (fraction[axis] - zero[axis]);
    }
    cut[3] = side * spacing * (at - zero[axis]);
}

static void set_cuts(struct gb_picture_style *style, const struct gb_state *state,
                     const struct gb_picture_style_request *request)
{
    const struct gb_cell cell = gb_state_cell(state);
    if (request->cut_axis >= 0) {
        add_cut(style, &cell, request->cut_axis, request->cut_at, 1.0);
    } else if (request->cut_corner) {
        for (int k = 0; k < 3; k++) {
            add_cut(style, &cell, k, 0.5, k == 1 ? -1.0 : 1.0);
        }
    }
}

/* How far a point lies within what is cut away, d; negative outside. */
static double depth_in_cut(const struct gb_picture_style *style, const double x[3])
{
    double depth = style->cuts > 0 ? INFINITY : -INFINITY;
    for (int k = 0; k < style->cuts; k++) {
        const double *n = style->cut[k];
        depth = fmin(depth, n[0] * x[0] + n[1] * x[1] + n[2] * x[2] - n[3]);
    }
    return depth;
}

static void set_hidden(struct gb_picture_style *style, const struct gb_state *state,
                       const struct gb_picture_style_request *request)
{
    for (size_t i = 0; i < style->count; i++) {
        const double *x = &state->position[3 * i];
        const double depth = depth_in_cut(style, x);
        const bool outside =
            request->slice_axis >= 0 && is_outside_slice(state, request, x);
        style->hidden[i] = outside || depth >= state->radius[i] ? GB_PICTURE_STYLE_HIDDEN
                           : depth > 0.0                        ? GB_PICTURE_STYLE_CUT
                                                                : GB_PICTURE_STYLE_SHOWN;
    }
}

/* Forces alone: particles are grey dots. */
static void make_dots(struct gb_picture_style *style)
{
    static const uint8_t grey[3] = {150, 152, 156};
    style->radius_scale = radius_scale_forces;
    style->scale.title = NULL;
    for (size_t i = 0; i < style->count; i++) {
        memcpy(&style->colour[3 * i], grey, 3);
    }
}

static bool fill(struct gb_picture_style *style, const struct gb_state *state,
                 const struct gb_picture_style_request *request, struct gb_error *err)
{
    if (request->show == GB_PICTURE_STYLE_FORCES) {
        make_dots(style);
        return make_rods(style, state, request, err);
    }
    const bool forces = request->show == GB_PICTURE_STYLE_BOTH;
    style->radius_scale = forces ? radius_scale_both : 1.0F;
    return request->particles->particles(style, state, request, err) &&
           (!forces || make_rods(style, state, request, err));
}

bool gb_picture_style_create(struct gb_picture_style **out, const struct gb_state *state,
                             const struct gb_picture_style_request *request,
                             struct gb_error *err)
{
    *out = NULL;
    struct gb_picture_style *style = gb_alloc_array(1, sizeof *style, err);
    if (style == NULL) {
        return false;
    }
    style->count = (size_t)state->count;
    style->colour = gb_alloc_array(style->count, 3, err);
    style->hidden = gb_alloc_array(style->count, 1, err);
    const bool good = style->colour != NULL && style->hidden != NULL;
    if (good) {
        set_cuts(style, state, request);
        set_hidden(style, state, request);
    }
    if (!good || !fill(style, state, request, err)) {
        gb_picture_style_destroy(style);
        return false;
    }
    *out = style;
    return true;
}

void gb_picture_style_destroy(struct gb_picture_style *style)
{
    if (style == NULL) {
        return;
    }
    gb_alloc_free(style->colour);
    gb_alloc_free(style->hidden);
    gb_alloc_free(style->rod);
    gb_alloc_free(style->rod_colour);
    gb_alloc_free(style);
}

/* The options of the command line. */

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
        gb_error_set(err, GB_ERR_INPUT, "--color %.80s: expected %s; for forces %s", text,
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
                        "--show %.80s: expected particles, forces or both", text);
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
            "--slice %.80s: expected an axis, a fraction of its edge and a "
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
            "--cut %.80s: expected corner, or an axis and a fraction of its "
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
                        "--range %.80s: expected LOW:HIGH, as in %s%s%s", text,
                        particles ? example : "", particles && forces ? ", or " : "",
                        forces ? "0:50nN for the thickest rod" : "");
}

char *gb_picture_style_parse_colormaps(void)
{
    GString *names = g_string_new(NULL);
    for (const struct gb_image_map *map = gb_image_maps(); map->name; map++) {
        g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", map->name);
    }
    return g_string_free(names, FALSE);
}

bool gb_picture_style_parse_colormap(struct gb_picture_style_request *request,
                                     const char *text, struct gb_error *err)
{
    request->map = gb_image_find(text);
    if (request->map != NULL) {
        return true;
    }
    char *names = gb_picture_style_parse_colormaps();
    gb_error_set(err, GB_ERR_INPUT, "--colormap %.80s: expected %s", text, names);
    g_free(names);
    return false;
}
