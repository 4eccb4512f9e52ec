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

/* Whether slice or cut hides a position. */
static bool is_hidden(const struct gb_state *state,
                      const struct gb_picture_style_request *request,
                      const double *position)
{
    const struct gb_cell cell = gb_state_cell(state);
    double fraction[3];
    gb_cell_fraction(&cell, position, fraction);
    if (request->slice_axis >= 0) {
        const int k = request->slice_axis;
        const double distance =
            fabs(fraction[k] - request->slice_at) * gb_cell_spacing(&cell, k);
        return distance > 0.5 * request->slice_width;
    }
    if (request->cut_axis >= 0 && fraction[request->cut_axis] > request->cut_at) {
        return true;
    }
    return request->cut_corner && fraction[0] > 0.5 && fraction[1] < 0.5 &&
           fraction[2] > 0.5;
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
    bool good = style->colour != NULL && style->hidden != NULL;
    for (size_t i = 0; i < style->count && good; i++) {
        style->hidden[i] = is_hidden(state, request, &state->position[3 * i]);
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
