#include "draw/caption/load_label.h"

#include <math.h>

/* Lengths in lines of text: from the shaft to the word, and the word to what is below. */
static const double beside = 0.5, clearance = 0.15;

/* Shorter than this share of its length an arrow is drawn as its end. */
static const double shortest = 0.3;

bool gb_load_label_end_on(const float arrow[6])
{
    const double size = hypot(arrow[3] - arrow[0], arrow[4] - arrow[1]);
    return !(size > shortest * hypot(size, arrow[5] - arrow[2]));
}

int gb_load_label_arrow(const float *arrow, int count)
{
    int steepest = -1;
    double most = -1.0;
    for (int i = 0; i < count; i++, arrow += 6) {
        const double rise = fabs(arrow[4] - arrow[1]);
        const double slope = rise / hypot(arrow[3] - arrow[0], rise);
        if (!gb_load_label_end_on(arrow) && slope > most) {
            steepest = i;
            most = slope;
        }
    }
    return steepest;
}

static void find_pixel(const struct gb_view *view, const float *point, double up,
                       double pixel[2])
{
    gb_view_pixel(view, (const double[3]){point[0], point[1] + up, point[2]}, pixel);
}

/* Uppermost row of a segment between two columns; INFINITY beside them. */
static double top_of_segment(const double from[2], const double to[2], double left,
                             double right)
{
    const double *const low = from[0] <= to[0] ? from : to;
    const double *const high = low == from ? to : from;
    const double width = high[0] - low[0];
    const double first = fmax(left, low[0]);
    const double last = fmin(right, high[0]);
    if (first > last) {
        return INFINITY;
    }
    if (width < 1e-9) {
        return fmin(low[1], high[1]);
    }
    const double slope = (high[1] - low[1]) / width;
    return fmin(low[1] + (first - low[0]) * slope, low[1] + (last - low[0]) * slope);
}

/* Uppermost row between two columns of the box or die, and of the particles. */
static double top_of_scene(const struct gb_scene *scene, double left, double right)
{
    double top = INFINITY;
    for (int k = 0; k < scene->edge_count; k++) {
        double end[2][2];
        find_pixel(&scene->view, scene->edge[k], 0.0, end[0]);
        find_pixel(&scene->view, scene->edge[k] + 3, 0.0, end[1]);
        top = fmin(top, top_of_segment(end[0], end[1], left, right));
    }
    for (size_t k = 0; k < scene->count; k++) {
        const float *sphere = &scene->sphere[4 * k];
        double middle[2], above[2];
        find_pixel(&scene->view, sphere, 0.0, middle);
        find_pixel(&scene->view, sphere, sphere[3], above);
        const double radius = middle[1] - above[1];
        if (middle[0] + radius > left && middle[0] - radius < right) {
            top = fmin(top, above[1]);
        }
    }
    return top;
}

void gb_load_label_find(const struct gb_scene *scene, int arrow, double unit, double page,
                        double top, struct gb_frame *frame)
{
    double tail[2], tip[2], best = -INFINITY;
    find_pixel(&scene->view, scene->arrow[arrow], 0.0, tail);
    find_pixel(&scene->view, scene->arrow[arrow] + 3, 0.0, tip);
    const double x = 0.6 * tail[0] + 0.4 * tip[0];
    const double y = 0.6 * tail[1] + 0.4 * tip[1];
    *frame = (struct gb_frame){0.0, 0.0, GB_LOAD_LABEL_WIDTH * unit,
                               GB_LOAD_LABEL_LINE * unit};
    for (int side = 0; side < 2; side++) {
        const double left =
            side == 0 ? x + beside * unit : x - beside * unit - frame->width;
        const double right = left + frame->width;
        const double free = top_of_scene(scene, left, right) - clearance * unit;
        const double low = fmax(fmin(free, y + 0.5 * frame->height), top + frame->height);
        const bool fits = left >= 0.0 && right <= page;
        if (low - (fits ? 0.0 : page) > best + (side == 0 ? 0.0 : unit)) {
            best = low - (fits ? 0.0 : page);
            frame->left = left;
            frame->top = low - frame->height;
        }
    }
}
