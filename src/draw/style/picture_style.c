#include "draw/style/picture_style.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/style/force_rods.h"
#include "draw/style/picture_colours.h"

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

double gb_picture_style_depth(const struct gb_picture_style *style, const double x[3])
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
        const double depth = gb_picture_style_depth(style, x);
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
        return gb_force_rods_make(style, state, request, err);
    }
    const bool forces = request->show == GB_PICTURE_STYLE_BOTH;
    style->radius_scale = forces ? radius_scale_both : 1.0F;
    return request->particles->particles(style, state, request, err) &&
           (!forces || gb_force_rods_make(style, state, request, err));
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
