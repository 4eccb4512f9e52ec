/* The cameras of the viewer and of the light. */
#include <math.h>

#include "draw/gl/gl_pass.h"

void gb_gl_cameras_set_eye(struct gb_gl_pass *pass)
{
    const struct gb_view *view = &pass->scene->view;
    struct gb_camera *camera = &pass->eye;
    *camera = (struct gb_camera){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int k = 0; k < 2; k++) {
        const int origin = k == 0 ? pass->x : pass->y;
        camera->projection[k] =
            (float)(GB_GL_SAMPLES * (view->centre[k] - origin) + pass->margin);
    }
    camera->projection[2] = (float)(GB_GL_SAMPLES * view->focal);
    camera->projection[3] = view->orthographic ? 1.0F : 0.0F;
    camera->depth_range[0] = (float)view->near;
    camera->depth_range[1] = (float)view->far;
}

/* Axes of the view from the light: rows of its rotation matrix. */
static void light_axes(const float light[3], float axis[3][3])
{
    const float size = sqrtf(gb_gl_pass_dot(light, light));
    for (int k = 0; k < 3; k++) {
        axis[2][k] = -light[k] / size;
    }
    const float flat = hypotf(axis[2][0], axis[2][2]);
    axis[0][0] = axis[2][2] / flat;
    axis[0][1] = 0.0F;
    axis[0][2] = -axis[2][0] / flat;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        axis[1][k] = axis[2][i] * axis[0][j] - axis[2][j] * axis[0][i];
    }
}

/* Bounds of the scene in light coordinates. */
struct room {
    float axis[3][3], low[3], high[3];
};

static void widen(struct room *room, const float *point, float radius)
{
    for (int k = 0; k < 3; k++) {
        const float x = gb_gl_pass_dot(point, room->axis[k]);
        room->low[k] = fminf(room->low[k], x - radius);
        room->high[k] = fmaxf(room->high[k], x + radius);
    }
}

/* Parallel light over the whole scene. */
void gb_gl_cameras_set_light(struct gb_gl_pass *pass)
{
    const struct gb_scene *scene = pass->scene;
    struct gb_camera *camera = &pass->light;
    struct room room = {.low = {INFINITY, INFINITY, INFINITY},
                        .high = {-INFINITY, -INFINITY, -INFINITY}};
    light_axes(scene->light, room.axis);
    for (size_t i = 0; i < scene->count; i++) {
        widen(&room, &scene->sphere[4 * i], scene->sphere[4 * i + 3]);
    }
    for (size_t i = 0; i < 2 * scene->rods; i++) {
        widen(&room, &scene->rod[4 * i], scene->rod[8 * (i / 2) + 3]);
    }
    for (size_t i = 0; i < 3 * scene->facets; i++) {
        widen(&room, &scene->facet[3 * i], 0.0F);
    }
    if (!(room.low[0] <= room.high[0])) {
        for (int k = 0; k < 3; k++) {
            room.low[k] = -1.0F;
            room.high[k] = 1.0F;
        }
    }
    const float(*axis)[3] = (const float(*)[3])room.axis;
    const float *low = room.low;
    const float *high = room.high;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            camera->rotation[3 * j + k] = axis[k][j];
        }
        camera->translation[k] = k < 2 ? -0.5F * (low[k] + high[k]) : -low[k];
    }
    camera->projection[0] = camera->projection[1] = 0.5F * GB_GL_SHADOW;
    camera->projection[2] =
        0.96F * GB_GL_SHADOW / fmaxf(high[0] - low[0], high[1] - low[1]);
    camera->projection[3] = 1.0F;
    camera->depth_range[0] = 0.0F;
    camera->depth_range[1] = high[2] - low[2];
}
