#include "draw/figure/figure_room.h"

#include <glib.h>
#include <math.h>

#include "draw/figure/figure_marks.h"

static const double cell = 2.0;   /* points */
static const double inset = 7.0;  /* of a legend from the frame */
static const double thick = 2.0;  /* half the room a line takes */
static const double around = 4.5; /* half the room a mark takes */

/* A raster under construction: 1 where there is ink. */
struct ink {
    unsigned char *on;
    const struct gb_figure_room *room;
};

static int clamp(double x, int most)
{
    return (int)fmin(fmax(x, 0.0), most);
}

static void fill(struct ink *ink, double left, double top, double right, double bottom)
{
    const struct gb_figure_room *room = ink->room;
    const int x0 = clamp(floor((left - room->left) / cell), room->wide);
    const int x1 = clamp(ceil((right - room->left) / cell), room->wide);
    const int y0 = clamp(floor((top - room->top) / cell), room->high);
    const int y1 = clamp(ceil((bottom - room->top) / cell), room->high);
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            ink->on[y * room->wide + x] = 1;
        }
    }
}

static void stroke(struct ink *ink, const double a[2], const double b[2])
{
    const double far = 4000.0; /* no line of a page is longer */
    const double length = fmin(hypot(b[0] - a[0], b[1] - a[1]), far);
    const int steps = (int)ceil(length / cell) + 1;
    for (int k = 0; k <= steps; k++) {
        const double t = (double)k / steps;
        const double x = a[0] + t * (b[0] - a[0]);
        const double y = a[1] + t * (b[1] - a[1]);
        fill(ink, x - thick, y - thick, x + thick, y + thick);
    }
}

static double error_length(const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve, size_t k)
{
    if (curve->error == NULL || !isfinite(curve->error[k])) {
        return 0.0;
    }
    const double high = gb_figure_axis_place(&layout->y, curve->y[k] + curve->error[k]);
    const double at = gb_figure_axis_place(&layout->y, curve->y[k]);
    return fmin(fabs(at - high), 4000.0);
}

static void ink_curve(struct ink *ink, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    const bool marks = curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH;
    const double half = marks ? around : thick;
    double last[2] = {NAN, NAN};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_marks_place(layout, curve, k, at)) {
            last[0] = NAN;
            continue;
        }
        const double spread = error_length(layout, curve, k);
        fill(ink, at[0] - half, at[1] - half - spread, at[0] + half,
             at[1] + half + spread);
        if (curve->kind == GB_FIGURE_STEPS) {
            fill(ink, isfinite(last[0]) ? last[0] : at[0], fmin(at[1], last[1]) - thick,
                 at[0], layout->frame[3]);
        } else if (isfinite(last[0]) && curve->kind != GB_FIGURE_POINTS) {
            stroke(ink, last, at);
        }
        last[0] = at[0];
        last[1] = at[1];
    }
}

static void sum_up(struct gb_figure_room *room, const unsigned char *on)
{
    const int row = room->wide + 1;
    for (int y = 0; y < room->high; y++) {
        for (int x = 0; x < room->wide; x++) {
            int *sum = &room->taken[(y + 1) * row + x + 1];
            *sum = on[y * room->wide + x] + sum[-1] + sum[-row] - sum[-row - 1];
        }
    }
}

void gb_figure_room_init(struct gb_figure_room *room, const struct gb_figure *figure,
                         const struct gb_figure_layout *layout)
{
    const double *frame = layout->frame;
    room->left = frame[0];
    room->top = frame[1];
    room->wide = (int)fmax((frame[2] - frame[0]) / cell, 1.0);
    room->high = (int)fmax((frame[3] - frame[1]) / cell, 1.0);
    room->taken = g_new0(int, (gsize)(room->wide + 1) * (gsize)(room->high + 1));
    struct ink ink = {g_new0(unsigned char, (gsize)room->wide *(gsize)room->high), room};
    for (size_t i = 0; i < figure->count; i++) {
        ink_curve(&ink, layout, &figure->curve[i]);
    }
    for (size_t i = 0; i < figure->notes; i++) {
        const struct gb_figure_note *note = &figure->note[i];
        const double x = gb_figure_axis_place(&layout->x, note->x);
        const double y = gb_figure_axis_place(&layout->y, note->y);
        fill(&ink, x - 14.0, y - 14.0, x + 14.0, y + 14.0);
    }
    if (layout->inset[2] > layout->inset[0]) {
        fill(&ink, layout->inset[0], layout->inset[1], layout->inset[2],
             layout->inset[3]);
    }
    sum_up(room, ink.on);
    g_free(ink.on);
}

void gb_figure_room_finish(struct gb_figure_room *room)
{
    g_free(room->taken);
    *room = (struct gb_figure_room){0};
}

static int count_taken(const struct gb_figure_room *room, int x0, int y0, int x1, int y1)
{
    const int row = room->wide + 1;
    return room->taken[y1 * row + x1] - room->taken[y0 * row + x1] -
           room->taken[y1 * row + x0] + room->taken[y0 * row + x0];
}

void gb_figure_room_take(struct gb_figure_room *room, const double box[4])
{
    unsigned char *on = g_new0(unsigned char, (gsize)room->wide *(gsize)room->high);
    struct ink ink = {on, room};
    for (int y = 0; y < room->high; y++) {
        for (int x = 0; x < room->wide; x++) {
            on[y * room->wide + x] = count_taken(room, x, y, x + 1, y + 1) > 0;
        }
    }
    fill(&ink, box[0], box[1], box[2], box[3]);
    sum_up(room, on);
    g_free(on);
}

bool gb_figure_room_is_free(const struct gb_figure_room *room, const double box[4])
{
    const int x0 = (int)floor((box[0] - room->left) / cell);
    const int y0 = (int)floor((box[1] - room->top) / cell);
    const int x1 = (int)ceil((box[2] - room->left) / cell);
    const int y1 = (int)ceil((box[3] - room->top) / cell);
    return x0 >= 0 && y0 >= 0 && x1 <= room->wide && y1 <= room->high &&
           count_taken(room, x0, y0, x1, y1) == 0;
}

bool gb_figure_room_find(const struct gb_figure_room *room, double wide, double high,
                         double box[4])
{
    const double most_x = cell * room->wide - wide - inset;
    const double most_y = cell * room->high - high - inset;
    double best = INFINITY;
    for (double y = inset; y <= most_y; y += cell) {
        for (double x = inset; x <= most_x; x += cell) {
            const double at[4] = {room->left + x, room->top + y, room->left + x + wide,
                                  room->top + y + high};
            /* corners first, then edges; the upper ones before the lower */
            const double price = fmin(x - inset, most_x - x) +
                                 fmin(y - inset, most_y - y) +
                                 (y > 0.5 * most_y ? 1.5 : 0.0);
            if (price < best && gb_figure_room_is_free(room, at)) {
                best = price;
                for (int k = 0; k < 4; k++) {
                    box[k] = at[k];
                }
            }
        }
    }
    return isfinite(best);
}
