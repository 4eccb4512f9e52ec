#include "tui/plot/die_outline.h"

#include <math.h>

#include "tui/plot/sphere_shading.h"

enum { AROUND = 48 };

static void tilt(const struct gb_die_outline_camera *camera, double right, double behind,
                 double up, double seen[3])
{
    const double sine = sin(camera->elevation), cosine = cos(camera->elevation);
    seen[0] = right;
    seen[1] = behind * cosine - up * sine;
    seen[2] = behind * sine + up * cosine;
}

double gb_die_outline_see(const struct gb_die_outline_camera *camera,
                          const double point[3], double seen[3])
{
    const double x = point[0] - camera->centre[0], y = point[1] - camera->centre[1];
    const double sine = sin(camera->azimuth), cosine = cos(camera->azimuth);
    const double behind = y * cosine - x * sine;
    tilt(camera, x * cosine + y * sine, behind, point[2] - camera->centre[2], seen);
    return behind;
}

void gb_die_outline_round(const struct gb_die_outline_camera *camera,
                          const double point[3], double seen[3])
{
    tilt(camera, point[0] - camera->centre[0], point[1] - camera->centre[1],
         point[2] - camera->centre[2], seen);
}

/* What the dots of a line say of its direction, for screens with a character a cell. */
static float sign_of(double across, double down)
{
    if (fabs(across) < 0.4 * fabs(down)) {
        return GB_SPHERE_SHADING_UPRIGHT;
    }
    if (fabs(down) < 0.4 * fabs(across)) {
        return GB_SPHERE_SHADING_LEVEL;
    }
    return across * down < 0.0 ? GB_SPHERE_SHADING_RISING : GB_SPHERE_SHADING_FALLING;
}

struct pen {
    const struct gb_die_outline_camera *camera;
    float *shade;
};

static void line(const struct pen *pen, const double from[3], const double to[3])
{
    const struct gb_die_outline_camera *camera = pen->camera;
    const double col = camera->left + from[0] * camera->scale;
    const double row = camera->top - from[2] * camera->scale;
    const double across = (to[0] - from[0]) * camera->scale;
    const double down = -(to[2] - from[2]) * camera->scale;
    const int steps = (int)fmin(2.0 * fmax(fabs(across), fabs(down)) + 1.0, 8192.0);
    const float sign = sign_of(across, down);
    for (int k = 0; k <= steps; k++) {
        const double r = floor(row + down * k / steps);
        const double c = floor(col + across * k / steps);
        if (r >= 0.0 && r < camera->rows && c >= 0.0 && c < camera->cols) {
            pen->shade[(int)r * camera->cols + (int)c] = sign;
        }
    }
}

/* A point of the silhouette: side 1 right, -1 left. */
static void at(const struct pen *pen, double side, double radius, double height,
               double seen[3])
{
    const double point[3] = {pen->camera->centre[0] + side * radius,
                             pen->camera->centre[1], height};
    gb_die_outline_round(pen->camera, point, seen);
}

static void silhouette(const struct pen *pen, double radius, double height,
                       double to_radius, double to_height)
{
    for (double side = -1.0; side <= 1.0; side += 2.0) {
        double from[3], to[3];
        at(pen, side, radius, height, from);
        at(pen, side, to_radius, to_height, to);
        line(pen, from, to);
    }
}

static void circle(const struct pen *pen, double radius, double height)
{
    for (int k = 0; k < AROUND; k++) {
        double seen[2][3];
        for (int end = 0; end < 2; end++) {
            const double a = 2.0 * M_PI * (k + end) / AROUND;
            const double point[3] = {pen->camera->centre[0] + radius * cos(a),
                                     pen->camera->centre[1] + radius * sin(a), height};
            gb_die_outline_round(pen->camera, point, seen[end]);
        }
        line(pen, seen[0], seen[1]);
    }
}

/* Planes are circles, open ends are not drawn across. */
void gb_die_outline_draw(const struct gb_die_outline_camera *camera,
                         const struct gb_view_sample *sample, float *shade)
{
    const struct gb_view_die *die = &sample->die;
    const struct pen pen = {camera, shade};
    const double end = sample->window[2];
    circle(&pen, die->radius, 0.0);
    if (!die->gone && die->top > 0.0) {
        silhouette(&pen, die->radius, 0.0, die->radius, die->top);
    }
    if (die->funnel) {
        silhouette(&pen, die->radius, die->top, die->outlet, die->top);
        silhouette(&pen, die->outlet, die->top,
                   die->outlet + fmax(end - die->top, 0.0) * die->funnel_slope,
                   fmax(end, die->top));
    }
    if (die->punch) {
        circle(&pen, die->radius, die->punch_height);
    }
}
