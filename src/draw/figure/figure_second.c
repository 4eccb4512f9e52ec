#include "draw/figure/figure_second.h"

#include <glib.h>
#include <math.h>

#include "draw/figure/figure_names.h"

/* Lengths in points. */
static const double rule_width = 0.6;
static const double tick_length = 4.0;
static const double minor_tick_length = 2.2;

/* The scale of a second axis along that of the first. */
static void fit_scale(const struct gb_figure_axis_scale *first, double factor,
                      struct gb_figure_axis_scale *scale)
{
    const int wanted = MAX(first->ticks, 3);
    gb_figure_axis_fit(scale, first->log ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR,
                       factor * first->low, factor * first->high, wanted,
                       (const bool[2]){true, true});
    scale->from = first->from;
    scale->to = first->to;
}

static double widest_label(const struct gb_figure_page *page,
                           const struct gb_figure_axis_scale *scale)
{
    double max = 0.0;
    for (int k = 0; k < scale->ticks; k++) {
        double wide = 0.0;
        double high = 0.0;
        gb_text_measure(&page->text, scale->label[k], page->tick_size, 0.0, &wide, &high);
        max = fmax(max, wide);
    }
    return max;
}

double gb_figure_second_height(const struct gb_figure *figure)
{
    return figure->top.label != NULL
               ? 2.0 * gb_figure_page_label_size + 1.5 * gb_figure_page_tick_size
               : 0.0;
}

double gb_figure_second_width(const struct gb_figure_page *page)
{
    struct gb_figure_axis_scale scale;
    if (page->figure->right.label == NULL) {
        return 0.0;
    }
    fit_scale(&page->layout.y, page->figure->right.factor, &scale);
    return widest_label(page, &scale) + 2.0 * gb_figure_page_label_size +
           gb_figure_page_gap;
}

enum side { TOP, RIGHT };

static void draw_ticks(const struct gb_figure_page *page,
                       const struct gb_figure_axis_scale *scale, enum side side,
                       const double *values, int count, double length)
{
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    for (int k = 0; k < count; k++) {
        const double at = gb_figure_axis_position(scale, values[k]);
        cairo_move_to(cairo, side == TOP ? at : f[2], side == TOP ? f[1] : at);
        cairo_line_to(cairo, side == TOP ? at : f[2] - length,
                      side == TOP ? f[1] + length : at);
    }
    cairo_stroke(cairo);
}

static void draw_labels(const struct gb_figure_page *page,
                        const struct gb_figure_axis_scale *scale, enum side side)
{
    const double *f = page->layout.frame;
    for (int k = 0; k < scale->ticks; k++) {
        const double along = gb_figure_axis_position(scale, scale->tick[k]);
        const double at[2] = {side == TOP ? along : f[2] + gb_figure_page_gap,
                              side == TOP ? f[1] - gb_figure_page_gap : along};
        const double align[2] = {side == TOP ? 0.5 : 0.0, side == TOP ? 1.0 : 0.5};
        gb_text_write(&page->text, scale->label[k], page->tick_size, 0.0, at, align, 0);
    }
}

static void draw_name(const struct gb_figure_page *page,
                      const struct gb_figure_second_axis *axis,
                      const struct gb_figure_axis_scale *scale, enum side side)
{
    const double *f = page->layout.frame;
    char *name = gb_figure_names_of(axis->label, scale);
    if (side == TOP) {
        gb_figure_names_draw(page, name, GB_FIGURE_NAMES_ALONG_X, 0.5 * (f[0] + f[2]),
                             f[1] - gb_figure_page_gap - 1.5 * gb_figure_page_tick_size,
                             1.0);
    } else {
        gb_figure_names_draw(page, name, GB_FIGURE_NAMES_ALONG_Y, 0.5 * (f[1] + f[3]),
                             f[2] + gb_figure_second_width(page) + 4.0, 1.0);
    }
    g_free(name);
}

static void draw_axis(const struct gb_figure_page *page,
                      const struct gb_figure_second_axis *axis,
                      const struct gb_figure_axis_scale *first, enum side side)
{
    struct gb_figure_axis_scale scale;
    if (axis->label == NULL) {
        return;
    }
    fit_scale(first, axis->factor, &scale);
    cairo_set_source_rgb(page->text.cairo, 0.1, 0.1, 0.12);
    cairo_set_line_width(page->text.cairo, rule_width);
    draw_ticks(page, &scale, side, scale.tick, scale.ticks, tick_length);
    draw_ticks(page, &scale, side, scale.minor, scale.minors, minor_tick_length);
    draw_labels(page, &scale, side);
    draw_name(page, axis, &scale, side);
}

void gb_figure_second_draw(const struct gb_figure_page *page)
{
    draw_axis(page, &page->figure->top, &page->layout.x, TOP);
    draw_axis(page, &page->figure->right, &page->layout.y, RIGHT);
}
