/* Geometry of a picture, from a state and a style: spheres, rods, edges of the box, the walls
 * of a die as translucent surfaces, arrows of pressing; and the camera that shows them all. */
#include "draw/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/vec.h"
#include "pack/cell/cell.h"

static void extend(struct gb_view *view, int axis, double low, double high)
{
    view->low[axis] = fmin(view->low[axis], low);
    view->high[axis] = fmax(view->high[axis], high);
}

/* The outline of a sphere. */
static void add_ball(struct gb_view *view, const float *at, double radius)
{
    for (int k = 0; k < 2; k++) {
        const double x = at[k];
        const double z = at[2];
        const double d = z * z - radius * radius;
        if (view->orthographic) {
            extend(view, k, x - radius, x + radius);
        } else if (d > 0.0 && z > 0.0) {
            const double s = radius * sqrt(x * x + d);
            extend(view, k, (x * z - s) / d, (x * z + s) / d);
        }
    }
}

static void include_depth(struct gb_view *view, double depth)
{
    view->near = depth > 0.0 || view->orthographic ? fmin(view->near, depth) : view->near;
    view->far = fmax(view->far, depth);
}

/* Extends the bounds by a point in eye coordinates; by the arrows of the frame. */
static void include_point(struct gb_scene *scene, const double eye[3])
{
    const float at[3] = {(float)eye[0], (float)eye[1], (float)eye[2]};
    add_ball(&scene->view, at, 0.0);
    include_depth(&scene->view, eye[2]);
}

void gb_scene_include_arrows(struct gb_scene *scene)
{
    for (int i = 0; i < 2 * scene->frame_arrows; i++) {
        const float *end = &scene->frame_arrow[i / 2][3 * (i % 2)];
        add_ball(&scene->view, end, 0.0);
    }
}

/* Sets the bounds of the scene's camera to what is drawn: outlines of the spheres and rods,
 * edges of the box, walls of the die.  Unchanged for an empty scene. */
static void tighten_bounds(struct gb_scene *scene)
{
    struct gb_view tight = scene->view;
    tight.low[0] = tight.low[1] = INFINITY;
    tight.high[0] = tight.high[1] = -INFINITY;
    for (size_t i = 0; i < scene->count; i++) {
        add_ball(&tight, &scene->sphere[4 * i], scene->sphere[4 * i + 3]);
    }
    for (size_t i = 0; i < 2 * scene->rods; i++) {
        add_ball(&tight, &scene->rod[4 * i], scene->rod[8 * (i / 2) + 3]);
    }
    for (int i = 0; i < 2 * scene->edge_count; i++) {
        add_ball(&tight, &scene->edge[i / 2][3 * (i % 2)], 0.0);
    }
    for (size_t i = 0; i < 3 * scene->walls; i++) {
        const float *at = &scene->wall[GB_SCENE_WALL_NUMBERS / 3 * i];
        add_ball(&tight, at, 0.0);
        include_depth(&tight, at[2]);
    }
    if (tight.high[0] > tight.low[0] && tight.high[1] > tight.low[1]) {
        scene->view = tight;
    }
}

/* Bore and punch above the powder, radii of the die: the bore ends below the punch's top. */
static const double bore_above = 0.12, punch_height = 0.3;
/* Play between punch and bore, radii: two surfaces in one place would flicker. */
static const double punch_radius = 0.985;
/* Drawn radius of the bore over its own: its chords, and contacts, would reach through. */
static const double bore_radius = 1.006;
/* Opacity of surfaces seen at right angles; the shader adds to it at grazing angles. */
static const float bore_opacity = 0.07F, plane_opacity = 0.16F, punch_opacity = 0.3F;

enum { CORNERS = 3, NUMBERS = GB_SCENE_WALL_NUMBERS / CORNERS, SURFACES = 6 };

/* A surface of revolution between two circles. */
struct surface {
    double radius[2], height[2];
    float opacity;
};

/* The surfaces of a die while they are collected. */
struct walls {
    struct gb_scene *scene;
    double axis[2];
    struct surface surface[SURFACES];
    int count;
};

/* Top of the punch that is drawn on a bed of a height, d. */
static double punch_top(double radius, double height)
{
    return height + punch_height * radius;
}

static void add(struct walls *walls, double r0, double z0, double r1, double z1,
                float opacity)
{
    walls->surface[walls->count++] = (struct surface){{r0, r1}, {z0, z1}, opacity};
}

static void point_on(const struct walls *walls, double radius, double angle,
                     double height, double eye[3])
{
    const double point[3] = {walls->axis[0] + radius * cos(angle),
                             walls->axis[1] + radius * sin(angle), height};
    gb_view_eye(&walls->scene->view, point, eye);
}

static void add_edge(struct gb_scene *scene, const double from[3], const double to[3])
{
    float *edge = scene->edge[scene->edge_count++];
    for (int k = 0; k < 3; k++) {
        edge[k] = (float)from[k];
        edge[3 + k] = (float)to[k];
    }
}

static void add_ring(const struct walls *walls, double radius, double height)
{
    for (int k = 0; k < GB_SCENE_RING; k++) {
        double end[2][3];
        for (int j = 0; j < 2; j++) {
            point_on(walls, radius, 2.0 * M_PI * (k + j) / GB_SCENE_RING, height, end[j]);
        }
        add_edge(walls->scene, end[0], end[1]);
    }
}

/* The two lines where the viewer's rays touch a cylinder or, nearly, a cone. */
static void add_outline(const struct walls *walls, const struct surface *surface)
{
    const struct gb_view *view = &walls->scene->view;
    const double flat = hypot(view->away[0], view->away[1]);
    const double radius = 0.5 * (surface->radius[0] + surface->radius[1]);
    const double reach = view->orthographic ? INFINITY : view->distance * flat;
    if (!(flat > 1e-6 && radius < reach)) {
        return;
    }
    const double towards = atan2(-view->away[1], -view->away[0]);
    for (int side = -1; side <= 1; side += 2) {
        const double angle = towards + side * acos(radius / reach);
        double end[2][3];
        for (int j = 0; j < 2; j++) {
            point_on(walls, surface->radius[j], angle, surface->height[j], end[j]);
        }
        add_edge(walls->scene, end[0], end[1]);
    }
}

/* Normal of a surface at an angle, in eye coordinates. */
static void find_normal(const struct walls *walls, const struct surface *surface,
                        double angle, double normal[3])
{
    const struct gb_view *view = &walls->scene->view;
    const double across = surface->radius[1] - surface->radius[0];
    const double up = surface->height[1] - surface->height[0];
    const double size = hypot(across, up);
    const double n[3] = {up / size * cos(angle), up / size * sin(angle), -across / size};
    normal[0] = gb_vec_dot(n, view->right);
    normal[1] = gb_vec_dot(n, view->up);
    normal[2] = gb_vec_dot(n, view->away);
}

/* Two triangles of a surface between two angles. */
static float *put_strip(const struct walls *walls, const struct surface *surface, int k,
                        float *out)
{
    static const int corner[6] = {0, 1, 2, 2, 1, 3};
    for (int c = 0; c < 6; c++) {
        const int end = corner[c] & 1;
        const double angle = 2.0 * M_PI * (k + (corner[c] >> 1)) / GB_SCENE_RING;
        double eye[3], normal[3];
        point_on(walls, surface->radius[end], angle, surface->height[end], eye);
        find_normal(walls, surface, angle, normal);
        for (int j = 0; j < 3; j++) {
            out[j] = (float)eye[j];
            out[3 + j] = (float)normal[j];
        }
        out[6] = surface->opacity;
        out += NUMBERS;
    }
    return out;
}

static float depth_of(const float *wall)
{
    return wall[2] + wall[NUMBERS + 2] + wall[2 * NUMBERS + 2];
}

/* Far ones first; at equal depth in the order of their coordinates. */
static int compare_depth(const void *a, const void *b)
{
    const float x = depth_of(a);
    const float y = depth_of(b);
    return x != y ? (x < y) - (x > y)
                  : memcmp(a, b, GB_SCENE_WALL_NUMBERS * sizeof(float));
}

static bool build(const struct walls *walls, struct gb_error *err)
{
    struct gb_scene *scene = walls->scene;
    const size_t count = (size_t)walls->count * 2 * GB_SCENE_RING;
    const size_t size = GB_SCENE_WALL_NUMBERS * sizeof *scene->wall;
    scene->wall = gb_alloc_array(count + 1, size, err);
    if (scene->wall == NULL) {
        return false;
    }
    float *out = scene->wall;
    for (int s = 0; s < walls->count; s++) {
        for (int k = 0; k < GB_SCENE_RING; k++) {
            out = put_strip(walls, &walls->surface[s], k, out);
        }
    }
    scene->walls = count;
    qsort(scene->wall, count, size, compare_depth);
    return true;
}

/* From the outlet in to the bore's wall, and the cone up to above the powder. */
static void add_funnel(struct walls *walls, const struct gb_state *state)
{
    const double outlet = state->funnel_outlet;
    const double height = state->funnel_height;
    const double end = fmax(state->cell[2], height + 0.2 * state->die_radius);
    const double wide = outlet + (end - height) * state->funnel_slope;
    add(walls, outlet, height, bore_radius * state->die_radius, height, plane_opacity);
    add(walls, outlet, height, wide, end, bore_opacity);
    add_ring(walls, outlet, height);
    add_ring(walls, wide, end);
    add_outline(walls, &walls->surface[walls->count - 1]);
}

static void add_punch(struct walls *walls, const struct gb_state *state)
{
    const double radius = punch_radius * state->die_radius;
    const double face = state->punch_height;
    const double top = punch_top(state->die_radius, face);
    add(walls, 0.0, face, radius, face, punch_opacity);
    add(walls, radius, face, radius, top, punch_opacity);
    add(walls, 0.0, top, radius, top, punch_opacity);
    add_ring(walls, radius, face);
    add_ring(walls, radius, top);
    add_outline(walls, &walls->surface[walls->count - 2]);
}

/* End of the bore; 0: drawn off. */
static double bore_end(const struct gb_state *state)
{
    const double above = state->cell[2] + bore_above * state->die_radius;
    return state->funnel_height > 0.0 ? state->funnel_height
           : isfinite(state->die_top) ? fmax(fmin(state->die_top, above), 0.0)
                                      : above;
}

/* The punch above the box of all frames of a sequence, whether it is there or not. */
static void include_extent(const struct walls *walls, double radius, double height)
{
    const double top = punch_top(radius, height);
    for (int k = 0; k < GB_SCENE_RING; k++) {
        double eye[3];
        point_on(walls, radius, 2.0 * M_PI * k / GB_SCENE_RING, top, eye);
        include_point(walls->scene, eye);
    }
}

/* Bore, floor, funnel and upper punch of a die: translucent surfaces and their edges.  The
 * bore ends a little above the powder where it has no end there.  With a viewpoint of an
 * extent the view includes the punch above that box.  Errors: GB_ERR_MEMORY. */
static bool set_walls(struct gb_scene *scene, const struct gb_state *state,
                      const struct gb_viewpoint *viewpoint, struct gb_error *err)
{
    struct walls walls = {.scene = scene,
                          .axis = {0.5 * state->cell[0], 0.5 * state->cell[1]}};
    const double radius = state->die_radius;
    const double wide = bore_radius * radius;
    const double end = bore_end(state);
    add(&walls, 0.0, 0.0, wide, 0.0, plane_opacity);
    add_ring(&walls, wide, 0.0);
    if (end > 0.0) {
        add(&walls, wide, 0.0, wide, end, bore_opacity);
        add_ring(&walls, wide, end);
        add_outline(&walls, &walls.surface[walls.count - 1]);
    }
    if (state->funnel_height > 0.0) {
        add_funnel(&walls, state);
    }
    if (isfinite(state->punch_height)) {
        add_punch(&walls, state);
    }
    if (viewpoint->extent[0] > 0.0) {
        include_extent(&walls, radius, viewpoint->extent[2]);
    }
    return build(&walls, err);
}

/* Length of an arrow and its distance from the face, means of the edges in the picture. */
static const double length = 0.2, gap = 0.035;

/* From a point of a face, out of it along an axis: the tip, and the tail beyond. */
static void point_at(const struct gb_scene *scene, const double face[3], int axis,
                     double size, float arrow[6])
{
    for (int end = 0; end < 2; end++) {
        double point[3], eye[3];
        memcpy(point, face, sizeof point);
        point[axis] += size * (end == 0 ? gap + length : gap);
        gb_view_eye(&scene->view, point, eye);
        for (int k = 0; k < 3; k++) {
            arrow[3 * end + k] = (float)eye[k];
        }
    }
}

/* Middle of the upper face of an axis; in a die the top of its punch. */
static void find_face(const struct gb_state *state, const double box[3], int axis,
                      double face[3])
{
    double fraction[3] = {0.5, state->dimension == 2 ? 0.0 : 0.5, 0.5};
    double matrix[3][3];
    struct gb_cell cell = gb_state_cell(state);
    memcpy(cell.edge, box, sizeof cell.edge);
    fraction[axis] = 1.0;
    gb_cell_matrix(&cell, matrix);
    gb_mat_apply((const double(*)[3])matrix, fraction, face);
    if (state->die_radius > 0.0) {
        face[2] = punch_top(state->die_radius, box[2]);
    }
}

/* Whether an axis is pressed alone, or with one other of three. */
static bool is_pressed(const struct gb_state *state, int axis)
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        count += state->pressed[k] > 0.0 && (k != 1 || state->dimension == 3);
    }
    return state->pressed[axis] > 0.0 && count < state->dimension &&
           (axis != 1 || state->dimension == 3);
}

/* Arrows of pressing of a scene, inwards over the faces of its axes that are pressed; none
 * where all are, and none in a die without its punch.  Those of the frame (scene.h) lie at the
 * box of the viewpoint's extent where it has one. */
static void set_arrows(struct gb_scene *scene, const struct gb_state *state,
                       const struct gb_viewpoint *viewpoint)
{
    const bool fixed = viewpoint->extent[0] > 0.0;
    const bool shown = !(state->die_radius > 0.0) || isfinite(state->punch_height);
    const double *box = fixed ? viewpoint->extent : state->cell;
    const double size = sqrt(box[0] * box[2]);
    scene->arrows = scene->frame_arrows = 0;
    for (int axis = 0; axis < 3; axis++) {
        double face[3];
        if (!is_pressed(state, axis)) {
            continue;
        }
        if (shown) {
            find_face(state, state->cell, axis, face);
            point_at(scene, face, axis, size, scene->arrow[scene->arrows++]);
        }
        if (shown || fixed) {
            find_face(state, box, axis, face);
            point_at(scene, face, axis, size, scene->frame_arrow[scene->frame_arrows++]);
        }
    }
}

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
            add_edge(scene, eye[0], eye[1]);
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
        return set_walls(scene, state, viewpoint, err);
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
        set_arrows(*out, state, viewpoint);
        if (!(viewpoint->extent[0] > 0.0)) {
            tighten_bounds(*out);
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
