#include "draw/die_walls.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "draw/scene_bounds.h"

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

double gb_die_walls_punch_top(double radius, double height)
{
    return height + punch_height * radius;
}

static void add(struct walls *walls, double r0, double z0, double r1, double z1,
                float opacity)
{
    walls->surface[walls->count++] = (struct surface){{r0, r1}, {z0, z1}, opacity};
}

static void point_at(const struct walls *walls, double radius, double angle,
                     double height, double eye[3])
{
    const double point[3] = {walls->axis[0] + radius * cos(angle),
                             walls->axis[1] + radius * sin(angle), height};
    gb_view_eye(&walls->scene->view, point, eye);
}

static void add_ring(const struct walls *walls, double radius, double height)
{
    for (int k = 0; k < GB_SCENE_RING; k++) {
        double end[2][3];
        for (int j = 0; j < 2; j++) {
            point_at(walls, radius, 2.0 * M_PI * (k + j) / GB_SCENE_RING, height, end[j]);
        }
        gb_scene_add_edge(walls->scene, end[0], end[1]);
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
            point_at(walls, surface->radius[j], angle, surface->height[j], end[j]);
        }
        gb_scene_add_edge(walls->scene, end[0], end[1]);
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
        point_at(walls, surface->radius[end], angle, surface->height[end], eye);
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
    const double top = gb_die_walls_punch_top(state->die_radius, face);
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
    const double top = gb_die_walls_punch_top(radius, height);
    for (int k = 0; k < GB_SCENE_RING; k++) {
        double eye[3];
        point_at(walls, radius, 2.0 * M_PI * k / GB_SCENE_RING, top, eye);
        gb_scene_bounds_include(walls->scene, eye);
    }
}

bool gb_die_walls_set(struct gb_scene *scene, const struct gb_state *state,
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
