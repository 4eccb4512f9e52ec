#include "draw/figure/figure_draw.h"

#include <glib.h>

#include "draw/figure/figure_curve.h"
#include "draw/figure/figure_map.h"
#include "draw/figure/figure_names.h"
#include "draw/figure/figure_second.h"

/* Lengths in points. */
static const double rule_width = 0.6; /* frame and ticks */
static const double tick_length = 4.0;
static const double minor_tick_length = 2.2;

static const double ink[3] = {0.1, 0.1, 0.12};
static const double caption_ink[3] = {0.32, 0.33, 0.36};

static void set_ink(cairo_t *cairo, const double rgb[3])
{
    cairo_set_source_rgb(cairo, rgb[0], rgb[1], rgb[2]);
}

static void add_rule(cairo_t *cairo, double x0, double y0, double x1, double y1)
{
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
}

enum direction { ALONG_X, ALONG_Y };

/* Ticks inside the frame, on both sides unless a second axis has one. */
static void draw_ticks(const struct gb_figure_page *page, enum direction direction,
                       const double *values, int count, double length)
{
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    const struct gb_figure *figure = page->figure;
    for (int k = 0; k < count; k++) {
        const double at = gb_figure_axis_position(
            direction == ALONG_X ? &page->layout.x : &page->layout.y, values[k]);
        if (direction == ALONG_X) {
            add_rule(cairo, at, f[3], at, f[3] - length);
            add_rule(cairo, at, f[1], at, f[1] + (figure->top.label ? 0.0 : length));
        } else {
            add_rule(cairo, f[0], at, f[0] + length, at);
            add_rule(cairo, f[2], at, f[2] - (figure->right.label ? 0.0 : length), at);
        }
    }
    cairo_stroke(cairo);
}

static void draw_tick_labels(const struct gb_figure_page *page)
{
    const struct gb_figure_layout *layout = &page->layout;
    const bool labelled = page->figure->below_count == 0; /* x ticks: else below */
    for (int k = 0; k < layout->x.ticks && labelled; k++) {
        const double at[2] = {gb_figure_axis_position(&layout->x, layout->x.tick[k]),
                              layout->frame[3] + gb_figure_page_gap};
        gb_text_write(&page->text, layout->x.label[k], page->tick_size, 0.0, at,
                      (double[2]){0.5, 0.0}, 0);
    }
    for (int k = 0; k < layout->y.ticks; k++) {
        const double at[2] = {layout->frame[0] - gb_figure_page_gap,
                              gb_figure_axis_position(&layout->y, layout->y.tick[k])};
        gb_text_write(&page->text, layout->y.label[k], page->tick_size, 0.0, at,
                      (double[2]){1.0, 0.5}, 0);
    }
}

static void draw_rules(const struct gb_figure_page *page)
{
    cairo_t *cairo = page->text.cairo;
    const struct gb_figure_layout *layout = &page->layout;
    const double *f = layout->frame;
    set_ink(cairo, ink);
    cairo_set_line_width(cairo, rule_width);
    cairo_rectangle(cairo, f[0], f[1], f[2] - f[0], f[3] - f[1]);
    cairo_stroke(cairo);
    draw_ticks(page, ALONG_X, layout->x.tick, layout->x.ticks, tick_length);
    draw_ticks(page, ALONG_Y, layout->y.tick, layout->y.ticks, tick_length);
    draw_ticks(page, ALONG_X, layout->x.minor, layout->x.minors, minor_tick_length);
    draw_ticks(page, ALONG_Y, layout->y.minor, layout->y.minors, minor_tick_length);
    draw_tick_labels(page);
}

static void draw_axes(const struct gb_figure_page *page)
{
    const struct gb_figure_layout *layout = &page->layout;
    const double *f = layout->frame;
    draw_rules(page);
    char *x_name = gb_figure_names_of(page->figure->x.label, &layout->x);
    char *y_name = gb_figure_names_of(page->figure->y.label, &layout->y);
    if (page->figure->below_count == 0) {
        gb_figure_names_draw(page, x_name, GB_FIGURE_NAMES_ALONG_X, 0.5 * (f[0] + f[2]),
                             f[3] + gb_figure_page_gap + 1.5 * gb_figure_page_tick_size,
                             0.0);
    }
    gb_figure_names_draw(page, y_name, GB_FIGURE_NAMES_ALONG_Y, 0.5 * (f[1] + f[3]), 8.0,
                         0.0);
    g_free(x_name);
    g_free(y_name);
}

static void draw_texts(const struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    set_ink(page->text.cairo, ink);
    if (figure->title != NULL && figure->title[0] != '\0') {
        char *bold = g_strdup_printf("<b>%s</b>", figure->title);
        gb_text_write(&page->text, bold, gb_figure_page_title_size,
                      gb_figure_page_text_width(page), (double[2]){12.0, 7.0},
                      (double[2]){0.0, 0.0}, 0);
        g_free(bold);
    }
    if (figure->caption != NULL && figure->caption[0] != '\0') {
        set_ink(page->text.cairo, caption_ink);
        gb_text_write(&page->text, figure->caption, gb_figure_page_caption_size,
                      gb_figure_page_text_width(page),
                      (double[2]){12.0, page->height - 6.0}, (double[2]){0.0, 1.0}, 0);
    }
}

/* From back to front: faint curves, histograms, lines with bands, arrows, points. */
static void draw_curves(const struct gb_figure_page *page)
{
    static const enum gb_figure_kind order[] = {GB_FIGURE_FAINT,  GB_FIGURE_STEPS,
                                                GB_FIGURE_LINE,   GB_FIGURE_BOTH,
                                                GB_FIGURE_ARROWS, GB_FIGURE_POINTS};
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    cairo_save(cairo);
    cairo_rectangle(cairo, f[0], f[1], f[2] - f[0], f[3] - f[1]);
    cairo_clip(cairo);
    for (size_t layer = 0; layer < G_N_ELEMENTS(order); layer++) {
        for (size_t i = 0; i < page->figure->count; i++) {
            if (page->figure->curve[i].kind == order[layer]) {
                gb_figure_curve_draw(cairo, &page->layout, &page->figure->curve[i]);
            }
        }
    }
    cairo_restore(cairo);
}

static void draw_inset(const struct gb_figure_page *page)
{
    cairo_t *cairo = page->text.cairo;
    struct gb_figure part;
    struct gb_figure_page inset;
    if (!(page->layout.inset[2] > page->layout.inset[0])) {
        return;
    }
    gb_figure_page_inset(page, &part, &inset);
    const double *f = inset.layout.frame;
    cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
    cairo_rectangle(cairo, f[0], f[1], f[2] - f[0], f[3] - f[1]);
    cairo_fill(cairo);
    draw_curves(&inset);
    draw_rules(&inset);
}

static void draw_below(const struct gb_figure_page *page)
{
    struct gb_figure part;
    struct gb_figure_page below;
    if (page->figure->below_count == 0) {
        return;
    }
    gb_figure_page_below(page, &part, &below);
    draw_curves(&below);
    draw_axes(&below);
}

void gb_figure_draw_page(const struct gb_figure_page *page)
{
    gb_figure_map_draw(page);
    draw_curves(page);
    draw_axes(page);
    gb_figure_second_draw(page);
    draw_inset(page);
    draw_below(page);
    gb_figure_labels_annotate(page->figure, &page->layout, &page->text);
    gb_figure_labels_draw(&page->labels, page->figure, &page->text);
    draw_texts(page);
}
