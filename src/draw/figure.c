/* Draws an arranged page (figure_page.h) with cairo: map, curves, axes with their names, second
 * axes, inset, panel below, labels, texts; onto an image, or into an SVG or PDF file. */

#include "draw/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"
#include "draw/figure_curve.h"
#include "draw/figure_page.h"
#include "draw/image.h"
#include "draw/text.h"

#define MINUS "−"

/* A number in typographic form: "−0.25"; decimals after the point. */
static void write_number(double value, int decimals, char *text, size_t size)
{
    char plain[36];
    snprintf(plain, sizeof plain, "%.*f", decimals, fabs(value));
    const bool zero = strspn(plain, "0.") == strlen(plain);
    snprintf(text, size, "%s%s", value < 0.0 && !zero ? MINUS : "", plain);
}

double gb_figure_axis_position(const struct gb_figure_axis_scale *scale, double value)
{
    const double share = scale->log
                             ? log(value / scale->low) / log(scale->high / scale->low)
                             : (value - scale->low) / (scale->high - scale->low);
    return scale->from + share * (scale->to - scale->from);
}

static void put_tick(struct gb_figure_axis_scale *scale, double value, const char *label)
{
    if (scale->ticks < GB_FIGURE_AXIS_TICKS) {
        scale->tick[scale->ticks] = value;
        g_strlcpy(scale->label[scale->ticks], label, sizeof scale->label[0]);
        scale->ticks++;
    }
}

static void put_minor(struct gb_figure_axis_scale *scale, double value)
{
    if (scale->minors < GB_FIGURE_AXIS_MINOR) {
        scale->minor[scale->minors++] = value;
    }
}

/* Tick step; *parts: number of minor steps in it. */
static double tick_step(double rough, int *parts)
{
    const double step = gb_number_nearest_step(rough);
    *parts = lround(step / pow(10.0, floor(log10(step) + 1e-9))) == 2 ? 4 : 5;
    return step;
}

/* Power of 1000 that is shown in the label of the axis. */
static int common_power(double largest)
{
    if (largest >= 99999.0 || largest < 0.01) {
        return 3 * (int)floor((log10(largest) + 1e-9) / 3.0);
    }
    return 0;
}

static void fit_linear(struct gb_figure_axis_scale *scale, int wanted,
                       const bool exact[2])
{
    int parts = 5;
    const double step = tick_step((scale->high - scale->low) / wanted, &parts);
    const double part = step / parts;
    if (!exact[0]) {
        scale->low = part * floor(scale->low / part + 1e-6);
    }
    if (!exact[1]) {
        scale->high = part * ceil(scale->high / part - 1e-6);
    }
    scale->power = common_power(fmax(fabs(scale->low), fabs(scale->high)));
    const double unit = pow(10.0, scale->power);
    const int decimals = (int)fmax(0.0, ceil(-log10(step / unit) - 1e-6));
    const double first = ceil(scale->low / part - 1e-6);
    for (double k = first; k * part <= scale->high + 1e-6 * part; k += 1.0) {
        if (fabs(remainder(k, parts)) > 0.5) {
            put_minor(scale, k * part);
            continue;
        }
        char text[40];
        write_number(k * part / unit, decimals, text, sizeof text);
        put_tick(scale, k * part, text);
    }
}

/* Decades as plain numbers where they are short, as powers of ten elsewhere. */
static void decade_label(int decade, bool plain, int digit, char *text, size_t size)
{
    if (plain) {
        write_number(digit * pow(10.0, decade), decade < 0 ? -decade : 0, text, size);
    } else if (digit == 1) {
        snprintf(text, size, "10<sup>%s%d</sup>", decade < 0 ? MINUS : "", abs(decade));
    } else {
        snprintf(text, size, "%d·10<sup>%s%d</sup>", digit, decade < 0 ? MINUS : "",
                 abs(decade));
    }
}

/* Which of 1, 2, ..., 9 are labelled, by the number of decades. */
static bool is_labelled(int digit, double decades)
{
    return digit == 1 || (decades < 2.0 && (digit == 2 || digit == 5)) ||
           (decades < 0.8 && (digit == 3 || digit == 4 || digit == 7));
}

static void fit_log(struct gb_figure_axis_scale *scale, int wanted, const bool exact[2])
{
    double decades = log10(scale->high / scale->low);
    const int first = (int)floor(log10(scale->low) + 1e-9);
    if (!exact[0]) {
        const double unit = decades > 1.5 ? 10.0 : 1.0;
        const double base = pow(10.0, first);
        scale->low = unit > 1.0 && scale->low / base < 3.0
                         ? base
                         : base * floor(scale->low / base + 1e-9);
    }
    if (!exact[1]) {
        const double base = pow(10.0, floor(log10(scale->high) + 1e-9));
        const double digit = ceil(scale->high / base - 1e-9);
        scale->high = base * (decades > 1.5 && digit >= 6.0 ? 10.0 : digit);
    }
    decades = log10(scale->high / scale->low);
    const int last = (int)ceil(log10(scale->high) - 1e-9);
    const bool plain = first >= -3 && last <= 4;
    const int every = (int)fmax(1.0, ceil(decades / wanted));
    for (int decade = first; decade <= last; decade++) {
        for (int digit = 1; digit <= 9; digit++) {
            char text[40] = "";
            const double value = digit * pow(10.0, decade);
            if (value < scale->low * (1.0 - 1e-9) || value > scale->high * (1.0 + 1e-9)) {
                continue;
            }
            if (!is_labelled(digit, decades)) {
                put_minor(scale, value);
                continue;
            }
            if (digit > 1 || decade % every == 0) {
                decade_label(decade, plain, digit, text, sizeof text);
            }
            put_tick(scale, value, text);
        }
    }
}

/* Replaces ends that are not finite, equal or reversed by valid ones. */
static void make_valid(struct gb_figure_axis_scale *scale)
{
    if (!isfinite(scale->low) || !isfinite(scale->high)) {
        scale->low = scale->log ? 0.1 : 0.0;
        scale->high = 1.0;
    }
    if (scale->high < scale->low) {
        const double low = scale->high;
        scale->high = scale->low;
        scale->low = low;
    }
    if (scale->log) {
        scale->high = fmax(scale->high, 1e-290);
        scale->low = fmax(fmax(scale->low, 1e-300), scale->high * 1e-40);
    }
    const double span = scale->high - scale->low;
    const double size = fmax(fabs(scale->high), fabs(scale->low));
    if (span <= 1e-9 * size || size == 0.0) {
        const double pad = size > 0.0 ? 0.1 * size : 1.0;
        scale->low -= pad;
        scale->high += pad;
    }
}

void gb_figure_axis_fit(struct gb_figure_axis_scale *scale, enum gb_figure_axis_kind kind,
                        double low, double high, int wanted, const bool exact[2])
{
    *scale = (struct gb_figure_axis_scale){
        .log = kind == GB_FIGURE_AXIS_LOG, .low = low, .high = high};
    make_valid(scale);
    if (scale->log) {
        fit_log(scale, wanted, exact);
    } else {
        fit_linear(scale, wanted, exact);
    }
}

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
                              layout->frame[3] + GB_FIGURE_PAGE_GAP};
        gb_text_write(&page->text, layout->x.label[k], page->tick_size, 0.0, at,
                      (double[2]){0.5, 0.0}, 0);
    }
    for (int k = 0; k < layout->y.ticks; k++) {
        const double at[2] = {layout->frame[0] - GB_FIGURE_PAGE_GAP,
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

/* Of names of two panels, half of it. */
static const double panel_gap = 2.0;

/* Whether it is the panel below another one. */
static bool is_below(const struct gb_figure_page *page)
{
    const double *below = page->layout.below;
    return below[3] > below[1] && page->layout.frame[1] >= below[1];
}

/* Room of a name along y: above those along x, and beside its own panel alone. */
static void find_room(const struct gb_figure_page *page, double room[2])
{
    const double *frame = page->layout.frame;
    room[0] = is_below(page) ? frame[1] - panel_gap : GB_FIGURE_PAGE_NAME_MARGIN;
    room[1] = page->figure->below_count > 0
                  ? frame[3]
                  : frame[3] + GB_FIGURE_PAGE_GAP + 1.5 * GB_FIGURE_PAGE_TICK;
}

/* Draws a name along an axis around its middle, moved to lie within the page, reduced where
 * it is longer, and shortened in its middle where that is not enough.  `across`: the
 * coordinate across the axis of the text's edge: 0 its upper, 1 its lower one. */
static void draw_name(const struct gb_figure_page *page, const char *name,
                      enum direction direction, double middle, double across, double edge)
{
    const bool along_x = direction == ALONG_X;
    double room[2] = {GB_FIGURE_PAGE_NAME_MARGIN,
                      page->width - GB_FIGURE_PAGE_NAME_MARGIN};
    double wide = 0.0, high = 0.0;
    if (!along_x) {
        find_room(page, room);
    }
    const double most = room[1] - room[0];
    gb_text_measure(&page->text, name, GB_FIGURE_PAGE_LABEL, 0.0, &wide, &high);
    const double half = 0.5 * fmin(wide, most);
    const double along = fmin(fmax(middle, room[0] + half), room[1] - half);
    const double at[2] = {along_x ? along : across, along_x ? across : along};
    gb_text_write_line(&page->text, name, GB_FIGURE_PAGE_LABEL, GB_FIGURE_PAGE_LEAST,
                       most, at, (double[2]){0.5, edge}, along_x ? 0 : 1);
}

static void draw_axes(const struct gb_figure_page *page)
{
    const struct gb_figure_layout *layout = &page->layout;
    const double *f = layout->frame;
    draw_rules(page);
    char *x_name = gb_figure_page_name(page->figure->x.label, &layout->x);
    char *y_name = gb_figure_page_name(page->figure->y.label, &layout->y);
    if (page->figure->below_count == 0) {
        draw_name(page, x_name, ALONG_X, 0.5 * (f[0] + f[2]),
                  f[3] + GB_FIGURE_PAGE_GAP + 1.5 * GB_FIGURE_PAGE_TICK, 0.0);
    }
    draw_name(page, y_name, ALONG_Y, 0.5 * (f[1] + f[3]), 8.0, 0.0);
    g_free(x_name);
    g_free(y_name);
}

enum side { TOP, RIGHT };

static void draw_second_ticks(const struct gb_figure_page *page,
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

static void draw_second_labels(const struct gb_figure_page *page,
                               const struct gb_figure_axis_scale *scale, enum side side)
{
    const double *f = page->layout.frame;
    for (int k = 0; k < scale->ticks; k++) {
        const double along = gb_figure_axis_position(scale, scale->tick[k]);
        const double at[2] = {side == TOP ? along : f[2] + GB_FIGURE_PAGE_GAP,
                              side == TOP ? f[1] - GB_FIGURE_PAGE_GAP : along};
        const double align[2] = {side == TOP ? 0.5 : 0.0, side == TOP ? 1.0 : 0.5};
        gb_text_write(&page->text, scale->label[k], page->tick_size, 0.0, at, align, 0);
    }
}

static void draw_second_name(const struct gb_figure_page *page,
                             const struct gb_figure_second_axis *axis,
                             const struct gb_figure_axis_scale *scale, enum side side)
{
    const double *f = page->layout.frame;
    char *name = gb_figure_page_name(axis->label, scale);
    if (side == TOP) {
        draw_name(page, name, ALONG_X, 0.5 * (f[0] + f[2]),
                  f[1] - GB_FIGURE_PAGE_GAP - 1.5 * GB_FIGURE_PAGE_TICK, 1.0);
    } else {
        draw_name(page, name, ALONG_Y, 0.5 * (f[1] + f[3]),
                  f[2] + gb_figure_page_second_width(page) + 4.0, 1.0);
    }
    g_free(name);
}

static void draw_second_axis(const struct gb_figure_page *page,
                             const struct gb_figure_second_axis *axis,
                             const struct gb_figure_axis_scale *first, enum side side)
{
    struct gb_figure_axis_scale scale;
    if (axis->label == NULL) {
        return;
    }
    gb_figure_page_fit_second(first, axis->factor, &scale);
    set_ink(page->text.cairo, ink);
    cairo_set_line_width(page->text.cairo, rule_width);
    draw_second_ticks(page, &scale, side, scale.tick, scale.ticks, tick_length);
    draw_second_ticks(page, &scale, side, scale.minor, scale.minors, minor_tick_length);
    draw_second_labels(page, &scale, side);
    draw_second_name(page, axis, &scale, side);
}

/* Axes on the top and on the right, whose values are those of the lower and of the left
 * axis times a factor. */
static void draw_second(const struct gb_figure_page *page)
{
    draw_second_axis(page, &page->figure->top, &page->layout.x, TOP);
    draw_second_axis(page, &page->figure->right, &page->layout.y, RIGHT);
}

static const double bar_gap = 12.0;
static const double bar_width = 12.0;

enum { BAR_STEPS = 128, BAR_TICKS = 6 };

static void set_map_colour(cairo_t *cairo, const struct gb_figure_map *map, double value)
{
    uint8_t rgb[3];
    gb_image_viridis((value - map->low) / (map->high - map->low), rgb);
    cairo_set_source_rgb(cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/* Cells overlap by a little: no seams between them in any format. */
static void draw_cells(const struct gb_figure_page *page)
{
    const struct gb_figure_map *map = page->figure->map;
    cairo_t *cairo = page->text.cairo;
    for (int i = 0; i < map->columns; i++) {
        for (int k = 0; k < map->rows; k++) {
            const double value = map->value[i * map->rows + k];
            const double left = gb_figure_axis_position(&page->layout.x, map->x[i]);
            const double right = gb_figure_axis_position(&page->layout.x, map->x[i + 1]);
            const double low = gb_figure_axis_position(&page->layout.y, map->y[k]);
            const double high = gb_figure_axis_position(&page->layout.y, map->y[k + 1]);
            if (isfinite(value)) {
                set_map_colour(cairo, map, value);
                cairo_rectangle(cairo, left, high, right - left + 0.3, low - high + 0.3);
                cairo_fill(cairo);
            }
        }
    }
}

static void draw_colour_bar(const struct gb_figure_page *page)
{
    const struct gb_figure_map *map = page->figure->map;
    cairo_t *cairo = page->text.cairo;
    const double *f = page->layout.frame;
    const double left = f[2] + bar_gap, height = (f[3] - f[1]) / BAR_STEPS;
    struct gb_figure_axis_scale scale;
    gb_figure_axis_fit(&scale, GB_FIGURE_AXIS_LINEAR, map->low, map->high, BAR_TICKS,
                       (const bool[2]){true, true});
    scale.from = f[3];
    scale.to = f[1];
    for (int k = 0; k < BAR_STEPS; k++) {
        set_map_colour(cairo, map,
                       map->low + (map->high - map->low) * (k + 0.5) / BAR_STEPS);
        cairo_rectangle(cairo, left, f[3] - (k + 1) * height, bar_width, height + 0.3);
        cairo_fill(cairo);
    }
    set_ink(cairo, ink);
    cairo_set_line_width(cairo, rule_width);
    cairo_rectangle(cairo, left, f[1], bar_width, f[3] - f[1]);
    cairo_stroke(cairo);
    for (int k = 0; k < scale.ticks; k++) {
        const double at[2] = {left + bar_width + GB_FIGURE_PAGE_GAP,
                              gb_figure_axis_position(&scale, scale.tick[k])};
        gb_text_write(&page->text, scale.label[k], GB_FIGURE_PAGE_TICK, 0.0, at,
                      (double[2]){0.0, 0.5}, 0);
    }
    draw_name(page, map->label, ALONG_Y, 0.5 * (f[1] + f[3]), page->width - 5.0, 1.0);
}

static void draw_map(const struct gb_figure_page *page)
{
    if (page->figure->map != NULL) {
        draw_cells(page);
        draw_colour_bar(page);
    }
}

static void draw_texts(const struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    set_ink(page->text.cairo, ink);
    if (figure->title != NULL && figure->title[0] != '\0') {
        char *bold = g_strdup_printf("<b>%s</b>", figure->title);
        gb_text_write(&page->text, bold, GB_FIGURE_PAGE_TITLE,
                      gb_figure_page_text_width(page), (double[2]){12.0, 7.0},
                      (double[2]){0.0, 0.0}, 0);
        g_free(bold);
    }
    if (figure->caption != NULL && figure->caption[0] != '\0') {
        set_ink(page->text.cairo, caption_ink);
        gb_text_write(&page->text, figure->caption, GB_FIGURE_PAGE_CAPTION,
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

/* Draws an arranged page: curves, axes, inset, labels and texts. */
static void draw_page(const struct gb_figure_page *page)
{
    draw_map(page);
    draw_curves(page);
    draw_axes(page);
    draw_second(page);
    draw_inset(page);
    draw_below(page);
    gb_figure_page_annotate(page->figure, &page->layout, &page->text);
    gb_figure_page_draw_labels(&page->labels, page->figure, &page->text);
    draw_texts(page);
}

/* Minimum size of a page in points; a page has the shape of the image. */
static const double min_width = 420.0;
static const double min_height = 300.0;

/* Pixels per point for an image of this size: both sides of the page have their minimum. */
/* Labels of a page are larger than they shall be in print. */
static double pixels_per_point(const struct gb_figure *figure, int width, int height)
{
    if (figure->per_inch > 0) {
        return gb_image_print_pixels(figure->per_inch,
                                     GB_IMAGE_PRINT_TEXT / GB_FIGURE_PAGE_LABELS_SIZE);
    }
    return fmin(width / min_width, height / min_height);
}

/* The least height with which a page is high enough: a legend may find room in a higher
 * frame. */
static double grow(struct gb_figure_page *page)
{
    const double most = 2.0 * page->width;
    for (;;) {
        gb_figure_page_arrange(page);
        const double missing = gb_figure_page_wanted_height(page) - page->height;
        gb_figure_page_finish_labels(&page->labels);
        if (missing <= 0.1 || page->height >= most) {
            return page->height;
        }
        page->height += fmax(0.25 * missing, 2.0);
        page->legend_height = 0.0;
        memset(&page->layout, 0, sizeof page->layout);
    }
}

/* Height of an image that is `width` pixels wide: in print that of its page, which grows where
 * legend, caption or names would leave too little of it; otherwise `height`. */
static int height_of(const struct gb_figure *figure, int width, int height)
{
    const double unit = pixels_per_point(figure, width, height);
    struct gb_figure_page page = {.figure = figure,
                                  .width = width / unit,
                                  .height = height / unit,
                                  .tick_size = GB_FIGURE_PAGE_TICK};
    struct gb_error err = {0};
    if (figure->per_inch == 0) {
        return height;
    }
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
    cairo_t *cairo = cairo_create(surface);
    const int saved = gb_text_mute_begin();
    const bool good = gb_text_init(&page.text, cairo, &err); /* told when it is drawn */
    const double grown = good ? ceil(grow(&page) * unit - 1e-6) : height;
    gb_text_mute_end(saved);
    gb_text_finish(&page.text);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
    return (int)fmin(grown, GB_IMAGE_MAX);
}

/* Draws a figure onto a surface of which a point is `unit` long; size in points. */
static bool draw_on(cairo_surface_t *surface, const struct gb_figure *figure,
                    const double size[2], double unit, struct gb_figure_layout *layout,
                    struct gb_error *err)
{
    cairo_t *cairo = cairo_create(surface);
    struct gb_figure_page page = {.figure = figure,
                                  .width = size[0],
                                  .height = size[1],
                                  .tick_size = GB_FIGURE_PAGE_TICK};
    bool good = gb_text_init(&page.text, cairo, err);
    if (good) {
        cairo_scale(cairo, unit, unit);
        cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
        cairo_paint(cairo);
        gb_figure_page_arrange(&page);
        draw_page(&page);
        page.layout.unit = unit;
        memcpy(page.layout.legend, page.labels.legend, sizeof page.layout.legend);
        page.layout.direct = page.labels.at[0][2] > 0.0;
        *layout = page.layout;
    }
    const cairo_status_t status = cairo_status(cairo);
    gb_figure_page_finish_labels(&page.labels);
    gb_text_finish(&page.text);
    cairo_destroy(cairo);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        good = gb_error_set(
            err, status == CAIRO_STATUS_NO_MEMORY ? GB_ERR_MEMORY : GB_ERR_MACHINE,
            "the figure cannot be drawn: %s", cairo_status_to_string(status));
    }
    return good;
}

const uint8_t gb_figure_colours[GB_FIGURE_COLOURS][3] = {
    {0, 160, 215}, {215, 135, 0}, {0, 135, 95}, {175, 0, 135}, {215, 0, 0}, {0, 95, 255}};

const uint8_t gb_figure_colours_black[3] = {26, 26, 31};

static void scale_to_pixels(struct gb_figure_layout *layout)
{
    for (int k = 0; k < 4; k++) {
        layout->frame[k] *= layout->unit;
        layout->legend[k] *= layout->unit;
        layout->inset[k] *= layout->unit;
        layout->below[k] *= layout->unit;
    }
    layout->x.from *= layout->unit;
    layout->x.to *= layout->unit;
    layout->y.from *= layout->unit;
    layout->y.to *= layout->unit;
}

bool gb_figure_render(struct gb_image **out, const struct gb_figure *figure, int width,
                      int height, struct gb_figure_layout *layout, struct gb_error *err)
{
    height = height_of(figure, width, height);
    if (!gb_image_create(out, width, height, err)) {
        return false;
    }
    (*out)->per_inch = figure->per_inch;
    const double unit = pixels_per_point(figure, width, height);
    const double size[2] = {width / unit, height / unit};
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        (*out)->rgba, CAIRO_FORMAT_ARGB32, width, height, 4 * width);
    const int saved = gb_text_mute_begin();
    const bool good = draw_on(surface, figure, size, unit, layout, err);
    gb_text_mute_end(saved);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (!good) {
        gb_image_destroy(*out);
        *out = NULL;
        return false;
    }
    scale_to_pixels(layout);
    gb_image_swap_red_blue(*out);
    return true;
}

bool gb_figure_write_png(const struct gb_figure *figure, int width, int height,
                         const struct gb_image_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    struct gb_figure_layout layout;
    struct gb_image *image = NULL;
    const bool good =
        gb_file_check_target(path, err) &&
        gb_figure_render(&image, figure, width, height, &layout, err) &&
        gb_image_write(image, GB_IMAGE_OPAQUE, texts, text_count, path, err);
    gb_image_destroy(image);
    return good;
}

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned length)
{
    g_byte_array_append(closure, data, length);
    return CAIRO_STATUS_SUCCESS;
}

/* Kinds of vector files: the functions of their surfaces. */
struct vector_kind {
    cairo_surface_t *(*create)(cairo_write_func_t write, void *closure, double width,
                               double height);
    void (*prepare)(cairo_surface_t *surface);
};

static void use_points(cairo_surface_t *surface)
{
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
}

/* Without a date the same figure gives the same bytes. */
static void set_metadata(cairo_surface_t *surface)
{
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR,
                                   "greenbody " GB_VERSION);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
}

static const struct vector_kind svg = {cairo_svg_surface_create_for_stream, use_points};
static const struct vector_kind pdf = {cairo_pdf_surface_create_for_stream, set_metadata};

/* Draws onto the surface, and destroys it. */
static bool draw(cairo_surface_t *surface, const struct gb_figure *figure,
                 const double size[2], double scale, const char *path,
                 struct gb_error *err)
{
    struct gb_figure_layout layout;
    const int saved = gb_text_mute_begin();
    const bool good = draw_on(surface, figure, size, scale, &layout, err);
    cairo_surface_finish(surface);
    gb_text_mute_end(saved);
    const cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        return gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be drawn: %s", path,
                            cairo_status_to_string(status));
    }
    return good;
}

/* width, height: pixels of the same figure as PNG. */
static bool write_vector(const struct vector_kind *kind, const struct gb_figure *figure,
                         int width, int height, const char *path, struct gb_error *err)
{
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    const double unit = pixels_per_point(figure, width, height);
    const double size[2] = {width / unit, height_of(figure, width, height) / unit};
    const double scale = figure->per_inch > 0 ? unit * 72.0 / figure->per_inch : 1.0;
    GByteArray *bytes = g_byte_array_new();
    cairo_surface_t *surface =
        kind->create(collect, bytes, scale * size[0], scale * size[1]);
    kind->prepare(surface);
    const bool good = draw(surface, figure, size, scale, path, err) &&
                      gb_file_replace(path, bytes->data, bytes->len, err);
    g_byte_array_unref(bytes);
    return good;
}

bool gb_figure_write_svg(const struct gb_figure *figure, int width, int height,
                         const struct gb_image_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    (void)texts;
    (void)text_count;
    return write_vector(&svg, figure, width, height, path, err);
}

bool gb_figure_write_pdf(const struct gb_figure *figure, int width, int height,
                         const struct gb_image_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    (void)texts;
    (void)text_count;
    return write_vector(&pdf, figure, width, height, path, err);
}
