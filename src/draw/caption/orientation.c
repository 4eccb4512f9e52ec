#include "draw/caption/orientation.h"

#include <math.h>

#include "draw/caption/load_label.h"

/* Lengths in lines of text. */
static const double axis_length = 1.9, symbol_gap = 0.5;
static const double head_length = 0.8, axis_head = 0.5; /* of arrows, of axes */
static const double axis_width = 0.1, arrow_width = 0.2;
static const double end_radius = 0.28; /* circle of an axis along the view */

/* Shorter than this share of its length an axis is drawn as its end. */
static const double shortest = 0.3;

static const char word[] = "pressing";

/* A shaft and a filled head at its end. */
static void draw_arrow(const struct gb_caption_pen *pen, const double from[2],
                       const double to[2], double width, double head)
{
    const double size = hypot(to[0] - from[0], to[1] - from[1]);
    const double u[2] = {(to[0] - from[0]) / size, (to[1] - from[1]) / size};
    const double long_head = fmin(head, 0.7 * size);
    const double base[2] = {to[0] - long_head * u[0], to[1] - long_head * u[1]};
    const double half = 0.38 * head;
    gb_caption_pen_set_foreground(pen);
    cairo_set_line_width(pen->cairo, width);
    cairo_move_to(pen->cairo, from[0], from[1]);
    cairo_line_to(pen->cairo, base[0] + 0.1 * head * u[0], base[1] + 0.1 * head * u[1]);
    cairo_stroke(pen->cairo);
    cairo_move_to(pen->cairo, to[0], to[1]);
    cairo_line_to(pen->cairo, base[0] - half * u[1], base[1] + half * u[0]);
    cairo_line_to(pen->cairo, base[0] + half * u[1], base[1] - half * u[0]);
    cairo_close_path(pen->cairo);
    cairo_fill(pen->cairo);
}

enum end { TOWARDS_VIEWER, AWAY_FROM_VIEWER };

static void draw_end(const struct gb_caption_pen *pen, const double at[2], enum end end)
{
    const double r = end_radius * pen->unit;
    gb_caption_pen_set_foreground(pen);
    cairo_set_line_width(pen->cairo, axis_width * pen->unit);
    cairo_new_sub_path(pen->cairo);
    cairo_arc(pen->cairo, at[0], at[1], r, 0.0, 2.0 * M_PI);
    cairo_stroke(pen->cairo);
    if (end == TOWARDS_VIEWER) {
        cairo_arc(pen->cairo, at[0], at[1], 0.35 * r, 0.0, 2.0 * M_PI);
        cairo_fill(pen->cairo);
        return;
    }
    for (int side = -1; side <= 1; side += 2) {
        cairo_move_to(pen->cairo, at[0] - 0.7 * r, at[1] - 0.7 * side * r);
        cairo_line_to(pen->cairo, at[0] + 0.7 * r, at[1] + 0.7 * side * r);
        cairo_stroke(pen->cairo);
    }
}

/* An axis as drawn: end of its shaft and middle of its symbol, from the origin, lines of text. */
struct shaft {
    double end[2], symbol[2];
    bool along_view;
    enum end towards;
};

static void find_shaft(const struct gb_view *view, int axis, struct shaft *shaft)
{
    const double u[2] = {view->right[axis], -view->up[axis]};
    const double size = hypot(u[0], u[1]);
    *shaft = (struct shaft){.along_view = size < shortest,
                            .towards = view->away[axis] < 0.0 ? TOWARDS_VIEWER
                                                              : AWAY_FROM_VIEWER,
                            .symbol = {-0.75, 0.6}};
    for (int k = 0; k < 2 && !shaft->along_view; k++) {
        shaft->end[k] = axis_length * u[k];
        shaft->symbol[k] = shaft->end[k] + symbol_gap * u[k] / size;
    }
}

/* Origin for which shafts and symbols are in the middle of the frame. */
static void find_origin(const struct gb_caption_pen *pen, const struct gb_frame *frame,
                        const struct shaft shaft[3], double origin[2])
{
    for (int k = 0; k < 2; k++) {
        double low = 0.0, high = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            low = fmin(low, fmin(shaft[axis].end[k], shaft[axis].symbol[k] - symbol_gap));
            high =
                fmax(high, fmax(shaft[axis].end[k], shaft[axis].symbol[k] + symbol_gap));
        }
        const double middle =
            k == 0 ? frame->left + 0.5 * frame->width : frame->top + 0.5 * frame->height;
        origin[k] = middle - 0.5 * (low + high) * pen->unit;
    }
}

void gb_orientation_draw_axes(const struct gb_caption_pen *pen,
                              const struct gb_frame *frame, const struct gb_view *view,
                              int dimension)
{
    static const char *const names[3] = {"<i>x</i>", "<i>y</i>", "<i>z</i>"};
    struct shaft shaft[3] = {0};
    double origin[2];
    for (int axis = 0; axis < 3; axis++) {
        if (axis != 1 || dimension == 3) {
            find_shaft(view, axis, &shaft[axis]);
        }
    }
    find_origin(pen, frame, shaft, origin);
    for (int axis = 0; axis < 3; axis++) {
        double at[2][2];
        if (axis == 1 && dimension == 2) {
            continue;
        }
        for (int k = 0; k < 2; k++) {
            at[0][k] = origin[k] + pen->unit * shaft[axis].end[k];
            at[1][k] = origin[k] + pen->unit * shaft[axis].symbol[k];
        }
        if (shaft[axis].along_view) {
            draw_end(pen, origin, shaft[axis].towards);
        } else {
            draw_arrow(pen, origin, at[0], axis_width * pen->unit, axis_head * pen->unit);
        }
        gb_text_write(&pen->text, names[axis], 0.95 * pen->unit, 0.0, at[1],
                      (double[2]){0.5, 0.5}, 0);
    }
}

static void find_pixel(const struct gb_view *view, const float *point, double pixel[2])
{
    gb_view_pixel(view, (const double[3]){point[0], point[1], point[2]}, pixel);
}

static void write_word(const struct gb_caption_pen *pen, const struct gb_scene *scene,
                       double top)
{
    const double page = cairo_image_surface_get_width(cairo_get_target(pen->cairo));
    const int arrow = gb_load_label_arrow(scene->arrow[0], scene->arrows);
    struct gb_frame frame;
    if (arrow >= 0) {
        gb_load_label_find(scene, arrow, pen->unit, page, top, &frame);
        gb_caption_pen_line(pen, word, frame.left, frame.top + 0.5 * frame.height, 0.0,
                            GB_LOAD_LABEL_LINE, 0.0);
    }
}

double gb_orientation_draw_load(const struct gb_caption_pen *pen,
                                const struct gb_scene *scene, const double corner[2])
{
    double taken = 0.0;
    for (int i = 0; i < scene->arrows; i++) {
        const float *arrow = scene->arrow[i];
        double from[2], to[2];
        find_pixel(&scene->view, arrow, from);
        find_pixel(&scene->view, arrow + 3, to);
        if (!gb_load_label_end_on(arrow)) {
            draw_arrow(pen, from, to, arrow_width * pen->unit, head_length * pen->unit);
            continue;
        }
        const double end[2] = {corner[0] - (GB_LOAD_LABEL_WIDTH + 0.3) * pen->unit,
                               corner[1]};
        draw_end(pen, end, arrow[5] < arrow[2] ? TOWARDS_VIEWER : AWAY_FROM_VIEWER);
        gb_caption_pen_line(pen, word, corner[0], corner[1], 1.0, GB_LOAD_LABEL_LINE,
                            0.0);
        taken = (GB_LOAD_LABEL_WIDTH + 1.6) * pen->unit;
    }
    write_word(pen, scene, corner[1] + 0.65 * pen->unit);
    return taken;
}
