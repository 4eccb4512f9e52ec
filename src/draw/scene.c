#include "draw/scene.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/vec.h"
#include "draw/die_walls.h"
#include "draw/load_arrows.h"
#include "draw/scene_bounds.h"

/* Share of the background colour in the farthest edges of the box.  Particles and rods do
 * not fade: their colours are values. */
static const float depth_cue = 0.3F;
/* Share of the key light that a shadow removes; the ambient light stays. */
static const float shadow_share = 0.75F;

static double largest_radius(const struct gb_state *state)
{
    double largest = 0.0;
    for (int64_t i = 0; i < state->count; i++) {
        largest = fmax(largest, state->radius[i]);
    }
    return largest;
}

static void set_point(const struct gb_view *view, const double point[3], float out[3])
{
    double eye[3];
    gb_view_eye(view, point, eye);
    for (int k = 0; k < 3; k++) {
        out[k] = (float)eye[k];
    }
}

/* Compacts the visible particles; count becomes their number. */
static void set_spheres(struct gb_scene *scene, const struct gb_state *state,
                        const struct gb_picture_style *style)
{
    size_t shown = 0;
    for (size_t i = 0; i < scene->count; i++) {
        if (style->hidden[i] == GB_PICTURE_STYLE_HIDDEN) {
            continue;
        }
        set_point(&scene->view, &state->position[3 * i], &scene->sphere[4 * shown]);
        scene->sphere[4 * shown + 3] = style->radius_scale * (float)state->radius[i];
        memcpy(&scene->colour[4 * shown], &style->colour[3 * i], 3);
        scene->colour[4 * shown + 3] = 255;
        shown++;
    }
    scene->count = shown;
}

/* Planes in eye coordinates. */
static void set_cuts(struct gb_scene *scene, const struct gb_picture_style *style)
{
    const struct gb_view *view = &scene->view;
    scene->cuts = style->cuts;
    for (int i = 0; i < style->cuts; i++) {
        const double *n = style->cut[i];
        const double eye[3] = {gb_vec_dot(n, view->right), gb_vec_dot(n, view->up),
                               gb_vec_dot(n, view->away)};
        for (int k = 0; k < 3; k++) {
            scene->cut[i][k] = (float)eye[k];
        }
        scene->cut[i][3] =
            (float)(n[3] - gb_vec_dot(n, view->target) + eye[2] * view->distance);
    }
}

static void set_rods(struct gb_scene *scene, const struct gb_picture_style *style)
{
    for (size_t i = 0; i < style->rods; i++) {
        const float *from = &style->rod[7 * i];
        uint8_t *colour = &scene->colour[4 * (scene->count + i)];
        for (size_t end = 0; end < 2; end++) {
            const double point[3] = {from[3 * end], from[3 * end + 1], from[3 * end + 2]};
            set_point(&scene->view, point, &scene->rod[8 * i + 4 * end]);
        }
        scene->rod[8 * i + 3] = from[6];
        memcpy(colour, &style->rod_colour[3 * i], 3);
        colour[3] = 255;
    }
}

void gb_scene_add_edge(struct gb_scene *scene, const double from[3], const double to[3])
{
    float *edge = scene->edge[scene->edge_count++];
    for (int k = 0; k < 3; k++) {
        edge[k] = (float)from[k];
        edge[3 + k] = (float)to[k];
    }
}

/* Corner of the box: bit k stands for edge vector k. */
static void set_corner(const struct gb_state *state, int corner, double point[3])
{
    const struct gb_cell cell = gb_state_cell(state);
    const double fraction[3] = {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
    double matrix[3][3];
    gb_cell_matrix(&cell, matrix);
    gb_mat_apply((const double(*)[3])matrix, fraction, point);
}

/* Edges of the box: corner pairs that differ along one axis; in 2D the four at y = 0. */
static void set_edges(struct gb_scene *scene, const struct gb_state *state)
{
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            const int other = corner | 1 << axis;
            const bool planar = state->dimension == 2 && (other & 2) != 0;
            if (other == corner || planar) {
                continue;
            }
            double end[2][3], eye[2][3];
            set_corner(state, corner, end[0]);
            set_corner(state, other, end[1]);
            gb_view_eye(&scene->view, end[0], eye[0]);
            gb_view_eye(&scene->view, end[1], eye[1]);
            gb_scene_add_edge(scene, eye[0], eye[1]);
        }
    }
}

bool gb_scene_begin(struct gb_scene **out, const double cell[3], double margin,
                    const size_t parts[3], const struct gb_viewpoint *viewpoint,
                    const struct gb_frame *frame, enum gb_background background,
                    struct gb_error *err)
{
    *out = NULL;
    struct gb_scene *scene = gb_alloc_array(1, sizeof *scene, err);
    if (scene == NULL) {
        return false;
    }
    scene->count = parts[0];
    scene->rods = parts[1];
    scene->facets = parts[2];
    scene->sphere = gb_alloc_array(parts[0] + 1, 4 * sizeof *scene->sphere, err);
    scene->rod = gb_alloc_array(parts[1] + 1, 8 * sizeof *scene->rod, err);
    scene->facet = gb_alloc_array(parts[2] + 1, 9 * sizeof *scene->facet, err);
    scene->colour = gb_alloc_array(parts[0] + parts[1] + parts[2] + 1, 4, err);
    if (scene->sphere == NULL || scene->rod == NULL || scene->facet == NULL ||
        scene->colour == NULL) {
        gb_scene_destroy(scene);
        return false;
    }
    gb_view_init(&scene->view, viewpoint, cell, margin, frame);
    /* over the viewer's left shoulder */
    scene->light[0] = -0.45F;
    scene->light[1] = 0.70F;
    scene->light[2] = -0.55F;
    scene->diameter = 1.0F;
    scene->background = background;
    scene->depth_cue = background != GB_BACKGROUND_TRANSPARENT ? depth_cue : 0.0F;
    scene->shadow_share = shadow_share;
    *out = scene;
    return true;
}

/* Discs lie in the plane y = 0 and are seen along y. */
static bool begin(struct gb_scene **out, const struct gb_state *state, size_t rods,
                  const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                  enum gb_background background, struct gb_error *err)
{
    const bool planar = state->dimension == 2;
    const struct gb_viewpoint along_y = {
        .azimuth_deg = -90.0,
        .orthographic = true,
        .extent = {viewpoint->extent[0], 0.0, viewpoint->extent[2]},
        .lowest = {viewpoint->lowest[0], 0.0, viewpoint->lowest[2]}};
    const size_t parts[3] = {(size_t)state->count, rods, 0};
    double cell[3];
    memcpy(cell, state->cell, sizeof cell);
    cell[1] = planar ? 0.0 : cell[1];
    if (!gb_scene_begin(out, cell, largest_radius(state), parts,
                        planar ? &along_y : viewpoint, frame, background, err)) {
        return false;
    }
    if (planar) {
        (*out)->depth_cue = 0.0F;
        (*out)->shadow_share = 0.0F;
    }
    return true;
}

/* The die, or the edges of the periodic cell. */
static bool set_box(struct gb_scene *scene, const struct gb_state *state,
                    const struct gb_viewpoint *viewpoint, struct gb_error *err)
{
    if (state->die_radius > 0.0) {
        return gb_die_walls_set(scene, state, viewpoint, err);
    }
    set_edges(scene, state);
    return true;
}

bool gb_scene_create(struct gb_scene **out, const struct gb_state *state,
                     const struct gb_picture_style *style,
                     const struct gb_viewpoint *viewpoint, const struct gb_frame *frame,
                     enum gb_background background, struct gb_error *err)
{
    struct gb_picture_style *usual = NULL;
    struct gb_picture_style_request request;
    gb_picture_style_init(&request);
    *out = NULL;
    if (style == NULL && !gb_picture_style_create(&usual, state, &request, err)) {
        return false;
    }
    const struct gb_picture_style *used = style != NULL ? style : usual;
    const bool good = begin(out, state, used->rods, viewpoint, frame, background, err) &&
                      set_box(*out, state, viewpoint, err);
    if (good) {
        set_spheres(*out, state, used);
        set_rods(*out, used);
        set_cuts(*out, used);
        gb_load_arrows_set(*out, state, viewpoint);
        if (!(viewpoint->extent[0] > 0.0)) {
            gb_scene_bounds_tighten(*out);
        }
        gb_view_set_frame(&(*out)->view, frame);
    } else {
        gb_scene_destroy(*out);
        *out = NULL;
    }
    gb_picture_style_destroy(usual);
    return good;
}

void gb_scene_destroy(struct gb_scene *scene)
{
    if (scene == NULL) {
        return;
    }
    gb_alloc_free(scene->sphere);
    gb_alloc_free(scene->rod);
    gb_alloc_free(scene->facet);
    gb_alloc_free(scene->wall);
    gb_alloc_free(scene->colour);
    gb_alloc_free(scene);
}

void gb_scene_background(enum gb_background background, uint8_t rgb[3])
{
    static const uint8_t white[3] = {255, 255, 255};
    static const uint8_t dark[3] = {24, 27, 31};
    memcpy(rgb, background == GB_BACKGROUND_DARK ? dark : white, 3);
}

void gb_scene_foreground(enum gb_background background, uint8_t rgb[3])
{
    static const uint8_t light[3] = {225, 228, 232};
    static const uint8_t black[3] = {38, 42, 48};
    memcpy(rgb, background == GB_BACKGROUND_DARK ? light : black, 3);
}
