#include "draw/figure/figure_names.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#include "draw/figure/figure_marks.h"
#include "draw/figure/figure_room.h"

static const double size = 8.6;    /* of the letters, points */
static const double pitch = 12.6;  /* of the lines of a legend */
static const double sample = 24.0; /* length of a line's sample */
static const double pad = 5.0;

enum { MOST_DIRECT = 6, ANCHORS = 48, SIDES = 8 };

/* A curve without a point to be seen has no name either. */
static bool is_named(const struct gb_figure_curve *curve)
{
    if (curve->label == NULL || curve->label[0] == '\0') {
        return false;
    }
    for (size_t k = 0; k < curve->count; k++) {
        if (isfinite(curve->x[k]) && isfinite(curve->y[k])) {
            return true;
        }
    }
    return false;
}

static bool is_line(const struct gb_figure_curve *curve)
{
    return curve->kind == GB_FIGURE_LINE || curve->kind == GB_FIGURE_BOTH;
}

/* Distance of a point from a rectangle. */
static double apart(const double box[4], const double at[2])
{
    const double dx = fmax(fmax(box[0] - at[0], at[0] - box[2]), 0.0);
    const double dy = fmax(fmax(box[1] - at[1], at[1] - box[3]), 0.0);
    return hypot(dx, dy);
}

/* Distance of a rectangle from the line of a curve, sampled along its segments. */
static double distance(const double box[4], const struct gb_figure_layout *layout,
                       const struct gb_figure_curve *curve)
{
    double nearest = INFINITY;
    double last[2];
    bool have = false;
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_marks_place(layout, curve, k, at)) {
            have = false;
            continue;
        }
        const double length = have ? hypot(at[0] - last[0], at[1] - last[1]) : 0.0;
        const int parts = (int)fmin(ceil(length / 6.0) + 1.0, 200.0);
        for (int j = have ? 0 : parts; j <= parts; j++) {
            const double t = (double)j / parts;
            const double p[2] = {have ? last[0] + t * (at[0] - last[0]) : at[0],
                                 have ? last[1] + t * (at[1] - last[1]) : at[1]};
            nearest = fmin(nearest, apart(box, p));
        }
        last[0] = at[0];
        last[1] = at[1];
        have = true;
    }
    return nearest;
}

/* Nobody may take the name for another curve's. */
static bool is_clear(const struct gb_figure *figure,
                     const struct gb_figure_layout *layout, size_t own,
                     const double box[4])
{
    const double mine = distance(box, layout, &figure->curve[own]);
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *other = &figure->curve[i];
        if (i != own && other->kind != GB_FIGURE_FAINT &&
            distance(box, layout, other) < 2.0 * mine + 6.0) {
            return false;
        }
    }
    return true;
}

/* Point of the line at a share of the frame's width from its right end. */
static bool anchor(const struct gb_figure_layout *layout,
                   const struct gb_figure_curve *curve, int number, double at[2])
{
    const double share = 1.0 - (double)number / ANCHORS;
    const size_t k = (size_t)lround(share * (double)(curve->count - 1));
    return gb_figure_marks_place(layout, curve, k, at);
}

/* Names keep off the ticks. */
static bool is_inside(const struct gb_figure_layout *layout, const double box[4])
{
    const double *f = layout->frame;
    return box[0] > f[0] + pad && box[1] > f[1] + pad && box[2] < f[2] - pad &&
           box[3] < f[3] - pad;
}

static bool place_beside(const struct gb_figure *figure,
                         const struct gb_figure_layout *layout,
                         const struct gb_figure_room *room, size_t own, double wide,
                         double high, double box[4])
{
    /* which corner or edge of the name looks at the line: right of it first */
    static const double sides[SIDES][2] = {{0.0, 0.5}, {0.0, 0.0}, {1.0, 1.0},
                                           {0.0, 1.0}, {1.0, 0.0}, {1.0, 0.5},
                                           {0.5, 1.0}, {0.5, 0.0}};
    for (int number = 0; number <= ANCHORS; number++) {
        double at[2];
        if (!anchor(layout, &figure->curve[own], number, at)) {
            continue;
        }
        for (int side = 0; side < SIDES; side++) {
            const double gap_x = 7.0 * (1.0 - 2.0 * sides[side][0]);
            const double gap_y = 5.0 * (1.0 - 2.0 * sides[side][1]);
            box[0] = at[0] + gap_x - sides[side][0] * wide;
            box[1] = at[1] + gap_y - sides[side][1] * high;
            box[2] = box[0] + wide;
            box[3] = box[1] + high;
            if (is_inside(layout, box) && gb_figure_room_is_free(room, box) &&
                is_clear(figure, layout, own, box)) {
                return true;
            }
        }
    }
    return false;
}

static bool place_direct(struct gb_figure_names *names, const struct gb_figure *figure,
                         const struct gb_figure_layout *layout,
                         const struct gb_text *text, struct gb_figure_room *room)
{
    size_t lines = 0;
    for (size_t i = 0; i < figure->count; i++) {
        lines += is_named(&figure->curve[i]) && is_line(&figure->curve[i]);
    }
    if (lines < 1 || lines > MOST_DIRECT) {
        return false;
    }
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        double wide = 0.0;
        double high = 0.0;
        if (!is_named(curve) || !is_line(curve)) {
            continue;
        }
        gb_text_measure(text, curve->label, size, 0.0, &wide, &high);
        if (!place_beside(figure, layout, room, i, wide, high, names->at[i])) {
            return false;
        }
        gb_figure_room_take(room, names->at[i]);
    }
    return true;
}

static bool in_legend(const struct gb_figure_names *names, const struct gb_figure *figure,
                      size_t i)
{
    return is_named(&figure->curve[i]) && names->at[i][2] <= 0.0;
}

static void legend_size(const struct gb_figure_names *names,
                        const struct gb_figure *figure, const struct gb_text *text,
                        double *wide, double *high)
{
    *wide = 0.0;
    *high = 0.0;
    for (size_t i = 0; i < figure->count; i++) {
        double w = 0.0;
        double h = 0.0;
        if (in_legend(names, figure, i)) {
            gb_text_measure(text, figure->curve[i].label, size, 0.0, &w, &h);
            *wide = fmax(*wide, w + sample + 3.0 * pad);
            *high += pitch;
        }
    }
    *high += *high > 0.0 ? pad : 0.0;
}

void gb_figure_names_place(struct gb_figure_names *names, const struct gb_figure *figure,
                           const struct gb_figure_layout *layout,
                           const struct gb_text *text)
{
    struct gb_figure_room room;
    double wide = 0.0;
    double high = 0.0;
    *names =
        (struct gb_figure_names){.at = g_malloc0_n(figure->count + 1, sizeof *names->at)};
    gb_figure_room_init(&room, figure, layout);
    if (!place_direct(names, figure, layout, text, &room)) {
        memset(names->at, 0, figure->count * sizeof *names->at);
        gb_figure_room_finish(&room);
        gb_figure_room_init(&room, figure, layout);
    }
    legend_size(names, figure, text, &wide, &high);
    if (high > 0.0 && !gb_figure_room_find(&room, wide, high, names->legend)) {
        names->outside = true;
        names->legend[2] = wide;
        names->legend[3] = high;
    }
    gb_figure_room_finish(&room);
}

static void draw_legend(const struct gb_figure_names *names,
                        const struct gb_figure *figure, const struct gb_text *text)
{
    static const double align[2] = {0.0, 0.5};
    double y = names->legend[1] + 0.5 * (pitch + pad);
    for (size_t i = 0; i < figure->count; i++) {
        if (!in_legend(names, figure, i)) {
            continue;
        }
        const double x = names->legend[0] + pad;
        gb_figure_marks_sample(text->cairo, &figure->curve[i], x, y, sample);
        cairo_set_source_rgb(text->cairo, 0.1, 0.1, 0.12);
        gb_text_write(text, figure->curve[i].label, size, 0.0,
                      (double[2]){x + sample + pad, y}, align, 0);
        y += pitch;
    }
}

void gb_figure_names_draw(const struct gb_figure_names *names,
                          const struct gb_figure *figure, const struct gb_text *text)
{
    static const double align[2] = {0.0, 0.0};
    for (size_t i = 0; i < figure->count; i++) {
        double rgb[3];
        if (names->at[i][2] <= 0.0) {
            continue;
        }
        gb_figure_marks_colour(figure->curve[i].style, rgb);
        /* darker than the line: letters are thin */
        cairo_set_source_rgb(text->cairo, 0.72 * rgb[0], 0.72 * rgb[1], 0.72 * rgb[2]);
        gb_text_write(text, figure->curve[i].label, size, 0.0, names->at[i], align, 0);
    }
    if (names->legend[2] > 0.0) {
        draw_legend(names, figure, text);
    }
}

void gb_figure_names_finish(struct gb_figure_names *names)
{
    g_free(names->at);
    *names = (struct gb_figure_names){0};
}
