#include "draw/hidden.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"

/* A coarse buffer of depths.  A cell that a sphere covers entirely gets the largest
 * depth of the sphere's front in it, which is that of a corner: in x/z, y/z and 1/z a
 * sphere in front of the viewer is an ellipsoid, so the front bulges towards the
 * viewer.  What is farther away than all cells it touches is hidden. */
struct screen {
    const struct gb_camera *camera;
    int cell;          /* side of a cell, samples */
    int width, height; /* cells */
    float *depth;
};

/* Cells across the radius of a mean sphere; maximum number of cells. */
static const float cells_per_radius = 4.0F;
static const double cells_most = 3e6;
/* Factor on the radius of a sphere that hides others: rounding may miss samples at its
 * outline. */
static const float firm = 0.995F;

/* Most cell corners across a sphere; larger spheres hide nothing. */
enum { NODES_MAX = 64 };

struct ball {
    float x, y, z, r;
};

static struct ball in_view(const struct gb_camera *camera, const float *at, float radius)
{
    const float *m = camera->rotation;
    return (struct ball){
        m[0] * at[0] + m[3] * at[1] + m[6] * at[2] + camera->translation[0],
        m[1] * at[0] + m[4] * at[1] + m[7] * at[2] + camera->translation[1],
        m[2] * at[0] + m[5] * at[1] + m[8] * at[2] + camera->translation[2],
        radius,
    };
}

/* Samples from..to that a ball touches along an axis: 0 is x, 1 is y. */
static void reach(const struct gb_camera *camera, const struct ball *ball, int axis,
                  float span[2])
{
    const float a = axis == 0 ? ball->x : -ball->y;
    float low = a - ball->r;
    float high = a + ball->r;
    if (camera->projection[3] == 0.0F) {
        const float d = ball->z * ball->z - ball->r * ball->r;
        const float s = ball->r * sqrtf(a * a + d);
        low = (a * ball->z - s) / d;
        high = (a * ball->z + s) / d;
    }
    span[0] = camera->projection[axis] + camera->projection[2] * low;
    span[1] = camera->projection[axis] + camera->projection[2] * high;
}

/* Depth at which the ray through a sample enters a ball; infinite beside it. */
static float enter(const struct gb_camera *camera, const struct ball *ball, float x,
                   float y)
{
    const float u = (x - camera->projection[0]) / camera->projection[2];
    const float v = -(y - camera->projection[1]) / camera->projection[2];
    const bool flat = camera->projection[3] != 0.0F;
    const float a = flat ? 1.0F : u * u + v * v + 1.0F;
    const float t = flat ? ball->z : (u * ball->x + v * ball->y + ball->z) / a;
    const float mx = ball->x - (flat ? u : t * u);
    const float my = ball->y - (flat ? v : t * v);
    const float mz = flat ? 0.0F : ball->z - t;
    const float h = ball->r * ball->r - mx * mx - my * my - mz * mz;
    return h > 0.0F ? t - sqrtf(h / a) : INFINITY;
}

/* First and last cell of a span of samples; false when it leaves the screen. */
static bool cells_of(const struct screen *screen, const float span[2], int count,
                     int *first, int *last)
{
    const float scale = 1.0F / (float)screen->cell;
    if (!(span[0] >= 0.0F && span[1] < (float)(count * screen->cell))) {
        return false;
    }
    *first = (int)(span[0] * scale);
    *last = (int)(span[1] * scale);
    return true;
}

static float larger(const float a[2])
{
    return a[0] > a[1] ? a[0] : a[1];
}

/* One row of cells.  node: depths at the corners of its upper and lower side. */
static void lower_row(struct screen *screen, int row, int first, int count,
                      const float (*node)[2])
{
    float *depth = &screen->depth[(size_t)row * (size_t)screen->width + (size_t)first];
    for (int k = 0; k + 1 < count; k++) {
        const float most = fmaxf(larger(node[k]), larger(node[k + 1]));
        depth[k] = most < depth[k] ? most : depth[k];
    }
}

static void cover(struct screen *screen, struct ball ball)
{
    float x[2];
    float y[2];
    float node[NODES_MAX][2];
    int left;
    int right;
    int top;
    int bottom;
    ball.r *= firm;
    reach(screen->camera, &ball, 0, x);
    reach(screen->camera, &ball, 1, y);
    if (!cells_of(screen, x, screen->width, &left, &right) ||
        !cells_of(screen, y, screen->height, &top, &bottom) ||
        right - left + 2 > NODES_MAX || right - left < 2) {
        return;
    }
    const int count = right - left + 2;
    for (int row = top; row <= bottom + 1; row++) {
        for (int k = 0; k < count; k++) {
            node[k][0] = node[k][1];
            node[k][1] = enter(screen->camera, &ball, (float)((left + k) * screen->cell),
                               (float)(row * screen->cell));
        }
        if (row > top) {
            lower_row(screen, row - 1, left, count, (const float(*)[2])node);
        }
    }
}

static bool is_behind(const struct screen *screen, const float x[2], const float y[2],
                      float nearest)
{
    int left;
    int right;
    int top;
    int bottom;
    if (!cells_of(screen, x, screen->width, &left, &right) ||
        !cells_of(screen, y, screen->height, &top, &bottom)) {
        return false;
    }
    for (int row = top; row <= bottom; row++) {
        const float *depth = &screen->depth[(size_t)row * (size_t)screen->width];
        for (int k = left; k <= right; k++) {
            if (!(depth[k] < nearest)) {
                return false;
            }
        }
    }
    return true;
}

static bool sphere_is_behind(const struct screen *screen, const float *sphere)
{
    const struct ball ball = in_view(screen->camera, sphere, sphere[3]);
    float x[2];
    float y[2];
    reach(screen->camera, &ball, 0, x);
    reach(screen->camera, &ball, 1, y);
    return is_behind(screen, x, y, ball.z - ball.r);
}

static bool rod_is_behind(const struct screen *screen, const float *rod)
{
    const struct ball ends[2] = {in_view(screen->camera, rod, rod[3]),
                                 in_view(screen->camera, rod + 4, rod[3])};
    float span[2][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (int end = 0; end < 2; end++) {
        for (int axis = 0; axis < 2; axis++) {
            float one[2];
            reach(screen->camera, &ends[end], axis, one);
            span[axis][0] = fminf(span[axis][0], one[0]);
            span[axis][1] = fmaxf(span[axis][1], one[1]);
        }
    }
    return is_behind(screen, span[0], span[1], fminf(ends[0].z, ends[1].z) - rod[3]);
}

/* Side of a cell: cells_per_radius across the radius of a mean sphere in the centre. */
static int choose_cell(const struct gb_scene *scene, const struct gb_camera *camera,
                       int width, int height)
{
    double sum = 0.0;
    for (size_t i = 0; i < scene->count; i++) {
        const float *at = &scene->sphere[4 * i];
        const struct ball ball = in_view(camera, at, at[3]);
        sum += (double)(ball.r / (camera->projection[3] != 0.0F ? 1.0F : ball.z));
    }
    const double radius = (double)camera->projection[2] * sum / (double)scene->count;
    const double fine = radius / (double)cells_per_radius;
    const double coarse = sqrt((double)width * (double)height / cells_most);
    return (int)ceil(fmin(fmax(fmax(fine, coarse), 1.0), 64.0));
}

/* Whether a sphere may have lost its front. */
static bool is_cut(const struct gb_scene *scene, const float *sphere)
{
    bool cut = scene->cuts > 0;
    for (int k = 0; k < scene->cuts; k++) {
        const float *n = scene->cut[k];
        cut = cut &&
              n[0] * sphere[0] + n[1] * sphere[1] + n[2] * sphere[2] - n[3] > -sphere[3];
    }
    return cut;
}

static void find(struct screen *screen, const struct gb_scene *scene, uint8_t *hidden)
{
    const size_t cells = (size_t)screen->width * (size_t)screen->height;
    for (size_t i = 0; i < cells; i++) {
        screen->depth[i] = INFINITY;
    }
    for (size_t i = 0; i < scene->count; i++) {
        const float *at = &scene->sphere[4 * i];
        if (!is_cut(scene, at)) {
            cover(screen, in_view(screen->camera, at, at[3]));
        }
    }
    for (size_t i = 0; i < scene->count; i++) {
        hidden[i] = sphere_is_behind(screen, &scene->sphere[4 * i]);
    }
    for (size_t i = 0; i < scene->rods; i++) {
        hidden[scene->count + i] = rod_is_behind(screen, &scene->rod[8 * i]);
    }
}

bool gb_hidden_find(const struct gb_scene *scene, const struct gb_camera *camera,
                    int width, int height, uint8_t *hidden, struct gb_error *err)
{
    struct screen screen = {.camera = camera};
    memset(hidden, 0, scene->count + scene->rods);
    if (scene->count == 0) {
        return true;
    }
    screen.cell = choose_cell(scene, camera, width, height);
    screen.width = width / screen.cell;
    screen.height = height / screen.cell;
    screen.depth =
        gb_alloc_array((size_t)(screen.width + 1) * (size_t)(screen.height + 1),
                       sizeof *screen.depth, err);
    if (screen.depth == NULL) {
        return false;
    }
    find(&screen, scene, hidden);
    gb_alloc_free(screen.depth);
    return true;
}
