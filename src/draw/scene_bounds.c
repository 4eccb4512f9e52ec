#include "draw/scene_bounds.h"

#include <math.h>

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

void gb_scene_bounds_include(struct gb_scene *scene, const double eye[3])
{
    const float at[3] = {(float)eye[0], (float)eye[1], (float)eye[2]};
    add_ball(&scene->view, at, 0.0);
    include_depth(&scene->view, eye[2]);
}

void gb_scene_bounds_include_arrows(struct gb_scene *scene)
{
    for (int i = 0; i < 2 * scene->frame_arrows; i++) {
        const float *end = &scene->frame_arrow[i / 2][3 * (i % 2)];
        add_ball(&scene->view, end, 0.0);
    }
}

void gb_scene_bounds_tighten(struct gb_scene *scene)
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
