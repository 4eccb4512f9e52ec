#include "draw/figure/figure_occupancy.h"

#include <glib.h>
#include <math.h>

#include "draw/figure/figure_curve.h"

static const double cell = 2.0;   /* points */
static const double inset = 7.0;  /* of a legend from the frame */
static const double thick = 2.0;  /* half the width kept free around a line */
static const double around = 4.5; /* the same around a marker */

/* 1 where curves or texts are. */
struct raster {
    unsigned char *on;
    const struct gb_figure_occupancy *occupancy;
};

static int clamp(double x, int most)
{
    return (int)fmin(fmax(x, 0.0), most);
}

static void fill(struct raster *raster, double left, double top, double right,
                 double bottom)
{
    const struct gb_figure_occupancy *occupancy = raster->occupancy;
    const int x0 = clamp(floor((left - occupancy->left) / cell), occupancy->wide);
    const int x1 = clamp(ceil((right - occupancy->left) / cell), occupancy->wide);
    const int y0 = clamp(floor((top - occupancy->top) / cell), occupancy->high);
    const int y1 = clamp(ceil((bottom - occupancy->top) / cell), occupancy->high);
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            raster->on[y * occupancy->wide + x] = 1;
        }
    }
}

static void stroke(struct raster *raster, const double a[2], const double b[2])
{
    const double far = 4000.0; /* no line of a page is longer */
    const double length = fmin(hypot(b[0] - a[0], b[1] - a[1]), far);
    const int steps = (int)ceil(length / cell) + 1;
    for (int k = 0; k <= steps; k++) {
        const double t = (double)k / steps;
        const double x = a[0] + t * (b[0] - a[0]);
        const double y = a[1] + t * (b[1] - a[1]);
        fill(raster, x - thick, y - thick, x + thick, y + thick);
    }
}

static double error_length(const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve, size_t k)
{
    if (curve->error == NULL || !isfinite(curve->error[k])) {
        return 0.0;
    }
    const double high =
        gb_figure_axis_position(&layout->y, curve->y[k] + curve->error[k]);
    const double at = gb_figure_axis_position(&layout->y, curve->y[k]);
    return fmin(fabs(at - high), 4000.0);
}

static void add_curve(struct raster *raster, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    const bool marks = curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH;
    const double half = marks ? around : thick;
    double last[2] = {NAN, NAN};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            last[0] = NAN;
            continue;
        }
        const double spread = error_length(layout, curve, k);
        fill(raster, at[0] - half, at[1] - half - spread, at[0] + half,
             at[1] + half + spread);
        if (curve->kind == GB_FIGURE_STEPS) {
            fill(raster, isfinite(last[0]) ? last[0] : at[0],
                 fmin(at[1], last[1]) - thick, at[0], layout->frame[3]);
        } else if (isfinite(last[0]) && curve->kind != GB_FIGURE_POINTS) {
            stroke(raster, last, at);
        }
        last[0] = at[0];
        last[1] = at[1];
    }
}

static void sum_up(struct gb_figure_occupancy *occupancy, const unsigned char *on)
{
    const int row = occupancy->wide + 1;
    for (int y = 0; y < occupancy->high; y++) {
        for (int x = 0; x < occupancy->wide; x++) {
            int *sum = &occupancy->occupied[(y + 1) * row + x + 1];
            *sum = on[y * occupancy->wide + x] + sum[-1] + sum[-row] - sum[-row - 1];
        }
    }
}

void gb_figure_occupancy_init(struct gb_figure_occupancy *occupancy,
                              const struct gb_figure *figure,
                              const struct gb_figure_layout *layout)
{
    const double *frame = layout->frame;
    occupancy->left = frame[0];
    occupancy->top = frame[1];
    occupancy->wide = (int)fmax((frame[2] - frame[0]) / cell, 1.0);
    occupancy->high = (int)fmax((frame[3] - frame[1]) / cell, 1.0);
    occupancy->occupied =
        g_new0(int, (gsize)(occupancy->wide + 1) * (gsize)(occupancy->high + 1));
    struct raster raster = {
        g_new0(unsigned char, (gsize)occupancy->wide *(gsize)occupancy->high), occupancy};
    for (size_t i = 0; i < figure->count; i++) {
        add_curve(&raster, layout, &figure->curve[i]);
    }
    for (size_t i = 0; i < figure->annotations; i++) {
        const struct gb_figure_annotation *note = &figure->annotation[i];
        const double x = gb_figure_axis_position(&layout->x, note->x);
        const double y = gb_figure_axis_position(&layout->y, note->y);
        fill(&raster, x - 14.0, y - 14.0, x + 14.0, y + 14.0);
    }
    if (layout->inset[2] > layout->inset[0]) {
        fill(&raster, layout->inset[0], layout->inset[1], layout->inset[2],
             layout->inset[3]);
    }
    sum_up(occupancy, raster.on);
    g_free(raster.on);
}

void gb_figure_occupancy_finish(struct gb_figure_occupancy *occupancy)
{
    g_free(occupancy->occupied);
    *occupancy = (struct gb_figure_occupancy){0};
}

static int count_occupied(const struct gb_figure_occupancy *occupancy, int x0, int y0,
                          int x1, int y1)
{
    const int row = occupancy->wide + 1;
    return occupancy->occupied[y1 * row + x1] - occupancy->occupied[y0 * row + x1] -
           occupancy->occupied[y1 * row + x0] + occupancy->occupied[y0 * row + x0];
}

void gb_figure_occupancy_add(struct gb_figure_occupancy *occupancy, const double box[4])
{
    unsigned char *on =
        g_new0(unsigned char, (gsize)occupancy->wide *(gsize)occupancy->high);
    struct raster raster = {on, occupancy};
    for (int y = 0; y < occupancy->high; y++) {
        for (int x = 0; x < occupancy->wide; x++) {
            on[y * occupancy->wide + x] =
                count_occupied(occupancy, x, y, x + 1, y + 1) > 0;
        }
    }
    fill(&raster, box[0], box[1], box[2], box[3]);
    sum_up(occupancy, on);
    g_free(on);
}

bool gb_figure_occupancy_is_free(const struct gb_figure_occupancy *occupancy,
                                 const double box[4])
{
    const int x0 = (int)floor((box[0] - occupancy->left) / cell);
    const int y0 = (int)floor((box[1] - occupancy->top) / cell);
    const int x1 = (int)ceil((box[2] - occupancy->left) / cell);
    const int y1 = (int)ceil((box[3] - occupancy->top) / cell);
    return x0 >= 0 && y0 >= 0 && x1 <= occupancy->wide && y1 <= occupancy->high &&
           count_occupied(occupancy, x0, y0, x1, y1) == 0;
}

bool gb_figure_occupancy_find(const struct gb_figure_occupancy *occupancy, double wide,
                              double high, double box[4])
{
    const double max_x = cell * occupancy->wide - wide - inset;
    const double max_y = cell * occupancy->high - high - inset;
    double best = INFINITY;
    for (double y = inset; y <= max_y; y += cell) {
        for (double x = inset; x <= max_x; x += cell) {
            const double at[4] = {occupancy->left + x, occupancy->top + y,
                                  occupancy->left + x + wide, occupancy->top + y + high};
            /* corners first, then edges; the upper ones before the lower */
            const double cost = fmin(x - inset, max_x - x) + fmin(y - inset, max_y - y) +
                                (y > 0.5 * max_y ? 1.5 : 0.0);
            if (cost < best && gb_figure_occupancy_is_free(occupancy, at)) {
                best = cost;
                for (int k = 0; k < 4; k++) {
                    box[k] = at[k];
                }
            }
        }
    }
    return isfinite(best);
}
