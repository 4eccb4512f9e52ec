/* Text around a picture of a packing: title, colour bar, legend of forces, axes of the cell,
 * arrows of pressing, density and pressure, scale bar.  All lengths follow from the height of
 * a line of text.  The file has first the pen, then the arrangement of the page, then one
 * section for each part, and the whole at its end. */
#include "draw/caption.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/units.h"
#include "draw/figure.h"
#include "draw/image.h"
#include "draw/picture_colours.h"
#include "draw/picture_style.h"
#include "draw/scene.h"
#include "draw/text.h"
#include "draw/view.h"

/* Text and lines on an image, in the foreground colour of its background. */
struct pen {
    struct gb_text text;
    cairo_t *cairo;
    double unit;  /* height of a line of text, pixels */
    double least; /* smallest letters, pixels: what does not fit then is cut; 0: any */
    uint8_t foreground[3];
};

/* Until end_pen the image has the byte order of cairo. */
static bool begin_pen(struct pen *pen, struct gb_image *image, double unit,
                      enum gb_background background, struct gb_error *err)
{
    gb_image_swap_red_blue(image);
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        image->rgba, CAIRO_FORMAT_ARGB32, image->width, image->height, 4 * image->width);
    *pen = (struct pen){
        .cairo = cairo_create(surface),
        .unit = unit,
        .least = gb_image_print_pixels(image->per_inch, GB_IMAGE_PRINT_TEXT_LEAST)};
    cairo_surface_destroy(surface);
    gb_scene_foreground(background, pen->foreground);
    return gb_text_init(&pen->text, pen->cairo, err);
}

/* good: all before succeeded; the result is false otherwise, or when cairo failed. */
static bool end_pen(struct pen *pen, struct gb_image *image, bool good,
                    struct gb_error *err)
{
    const cairo_status_t status = cairo_status(pen->cairo);
    cairo_surface_flush(cairo_get_target(pen->cairo));
    gb_text_finish(&pen->text);
    cairo_destroy(pen->cairo);
    gb_image_swap_red_blue(image);
    return good && (status == CAIRO_STATUS_SUCCESS ||
                    gb_error_set(err, GB_ERR_MACHINE, "the caption cannot be drawn: %s",
                                 cairo_status_to_string(status)));
}

static void set_foreground(const struct pen *pen)
{
    cairo_set_source_rgb(pen->cairo, pen->foreground[0] / 255.0,
                         pen->foreground[1] / 255.0, pen->foreground[2] / 255.0);
}

static double width_of(const struct pen *pen, const char *markup, double size)
{
    double wide = 0.0, high = 0.0;
    gb_text_measure(&pen->text, markup, size, 0.0, &wide, &high);
    return wide;
}

/* Markup of a line, with its size reduced to fit or, at the smallest one, its end cut. */
static char *fit(const struct pen *pen, const char *line, double max_width, double *size)
{
    char *markup = g_markup_escape_text(line, -1);
    const double wide = width_of(pen, markup, *size);
    if (!(max_width > 0.0 && wide > max_width)) {
        return markup;
    }
    *size = fmax(*size * max_width / wide, fmin(pen->least, *size));
    for (glong kept = g_utf8_strlen(line, -1);
         kept > 1 && width_of(pen, markup, *size) > max_width * (1.0 + 1e-9); kept--) {
        char *start = g_utf8_substring(line, 0, kept - 1);
        char *cut = g_strconcat(g_strchomp(start), "…", NULL);
        g_free(markup);
        markup = g_markup_escape_text(cut, -1);
        g_free(start);
        g_free(cut);
    }
    return markup;
}

/* One line of plain text at (x, y); align 0, 0.5, 1: x is its left end, middle, right end;
 * y is its middle.  Reduced to fit max_width (> 0), then cut with an ellipsis. */
static void write_line(const struct pen *pen, const char *line, double x, double y,
                       double align, double scale, double max_width)
{
    double size = scale * pen->unit;
    char *markup = fit(pen, line, max_width, &size);
    set_foreground(pen);
    gb_text_write(&pen->text, markup, size, 0.0, (double[2]){x, y},
                  (double[2]){align, 0.5}, 0);
    g_free(markup);
}

/* The same with the first of the texts (NULL at the end) that fits without a cut. */
static void write_line_that_fits(const struct pen *pen, const char *const *texts,
                                 double x, double y, double align, double scale,
                                 double max_width)
{
    const double size = scale * pen->unit;
    const double least = pen->least > 0.0 ? fmin(pen->least, size) : 0.8 * size;
    while (texts[1] != NULL) {
        char *markup = g_markup_escape_text(texts[0], -1);
        const bool fits = width_of(pen, markup, least) <= max_width;
        g_free(markup);
        if (fits) {
            break;
        }
        texts++;
    }
    write_line(pen, texts[0], x, y, align, scale, max_width);
}

/* One line of markup around (x, y), rotated by 90 degrees anticlockwise. */
static void write_line_upwards(const struct pen *pen, const char *line, double x,
                               double y)
{
    set_foreground(pen);
    gb_text_write(&pen->text, line, 0.95 * pen->unit, 0.0, (double[2]){x, y},
                  (double[2]){0.5, 0.5}, 1);
}

/* Minimum length of the shorter side for text, pixels, and in print inches. */
static const double min_annotated_px = 240.0, min_annotated_inches = 1.1;
/* Margin of a page without text as a share of its shorter side. */
static const double margin = 0.03;
/* Greatest height of a cropped page over its width in print. */
static const double print_height = 1.25;

/* Lengths in lines of text. */
static const double title_above = 2.6;
static const double load_above =
    3.2;                         /* title, and the word of pressing over the packing */
static const double below = 4.4; /* density and scale bar */
static const double text_width = 24.0;    /* density and pressure on one line */
static const double axes_side = 4.4;      /* room of the axes, beside that line */
static const double bar_column = 7.5;     /* colour bar with labels and title */
static const double legend_column = 10.2; /* longest line of the legend of forces */
static const double bar_gap = 2.5, legend_gap = 1.0;
static const double bar_width = 1.1;
static const double bar_height[2] = {12.0, 20.0}; /* shortest with all labels, longest */

/* Lengths in pixels while a page is arranged. */
struct sizes {
    double unit;
    double left, top, bottom; /* around the packing */
    double column;            /* right of it, with the margin of the page */
    double column_height;     /* shortest one without loss */
    double legend_height;
};

static struct sizes bare_sizes(const struct gb_caption_page *page)
{
    const double pad = margin * fmin(page->width, page->height);
    return (struct sizes){.left = pad, .top = pad, .bottom = pad, .column = pad};
}

static struct sizes annotated_sizes(const struct gb_caption_page *page)
{
    const double shorter = fmin(page->width, page->height);
    const double unit = page->per_inch > 0
                            ? gb_image_print_pixels(page->per_inch, GB_IMAGE_PRINT_TEXT)
                            : fmax(shorter / 44.0, 10.0);
    struct sizes sizes = {.unit = unit,
                          .left = fmax(margin * shorter, unit),
                          .top = (page->load ? load_above : title_above) * unit,
                          .bottom = below * unit};
    sizes.legend_height =
        page->rods > 0 ? (page->rods * GB_CAPTION_LEGEND_LINE) * unit : 0.0;
    sizes.column = page->rods > 0 ? (legend_gap + legend_column) * unit
                   : page->bar    ? bar_column * unit
                                  : sizes.left;
    sizes.column_height = sizes.legend_height + (page->bar ? bar_height[0] * unit : 0.0);
    return sizes;
}

/* The page, and the room of the packing on it. */
static void set_page(const struct gb_caption_page *page, const struct sizes *sizes,
                     struct gb_caption_layout *layout)
{
    const bool print = page->per_inch > 0 && page->crop != GB_CAPTION_NO_CROP;
    const double max_height = print ? print_height * page->width : page->height;
    const double aspect = page->aspect > 0.0 ? page->aspect : 1.0;
    const double around = sizes->left + sizes->column;
    const double height = fmax(max_height - sizes->top - sizes->bottom, 1.0);
    const double width = fmax(fmin(page->width - around, height / aspect), 1.0);
    layout->width = page->width;
    layout->height = page->height;
    layout->scene = (struct gb_frame){sizes->left, sizes->top, width, height};
    if (page->crop == GB_CAPTION_NO_CROP) {
        layout->scene.left += 0.5 * fmax(page->width - around - width, 0.0);
        return;
    }
    layout->scene.height = fmin(height, fmax(width * aspect, sizes->column_height));
    layout->height = (int)ceil(layout->scene.height + sizes->top + sizes->bottom);
    if (page->crop == GB_CAPTION_CROP_BOTH && page->per_inch == 0) {
        const double least =
            fmin((double)page->width, (text_width + axes_side) * sizes->unit);
        layout->width = (int)ceil(fmax(width + around, least));
    }
    layout->scene.left += 0.5 * fmax(layout->width - around - width, 0.0);
}

/* The colour bar and, below it, the legend of forces, in the middle of the packing's height. */
static void set_column(const struct gb_caption_page *page, const struct sizes *sizes,
                       struct gb_caption_layout *layout)
{
    const double unit = sizes->unit;
    const double right = layout->scene.left + layout->scene.width;
    const double room = layout->scene.height - sizes->legend_height;
    const double height =
        page->bar ? fmax(fmin(room - 2.0 * unit, bar_height[1] * unit), unit) : 0.0;
    const double gap = page->bar && page->rods > 0 ? 2.0 * unit : 0.0;
    const double free_height = layout->scene.height - sizes->legend_height - height - gap;
    const double top = layout->scene.top + 0.5 * fmax(free_height, 0.0);
    layout->bar =
        (struct gb_frame){right + bar_gap * unit, top, bar_width * unit, height};
    layout->legend = (struct gb_frame){right + legend_gap * unit, top + height + gap,
                                       legend_column * unit, sizes->legend_height};
}

void gb_caption_arrange(const struct gb_caption_page *page,
                        struct gb_caption_layout *layout)
{
    const double least =
        page->per_inch > 0 ? min_annotated_inches * page->per_inch : min_annotated_px;
    const bool annotated = page->annotated && fmin(page->width, page->height) >= least;
    const struct sizes sizes = annotated ? annotated_sizes(page) : bare_sizes(page);
    *layout = (struct gb_caption_layout){.unit = sizes.unit};
    set_page(page, &sizes, layout);
    if (annotated) {
        const double side = axes_side * sizes.unit;
        set_column(page, &sizes, layout);
        layout->axes =
            (struct gb_frame){layout->width - side, layout->height - side, side, side};
    }
}

/* Width of the word beside an arrow of pressing, lines of text. */
#define LOAD_WIDTH 4.4
#define LOAD_LINE  0.85 /* size of its letters */

/* Lengths in lines of text: from the shaft to the word, and the word to what is below. */
static const double beside = 0.5, clearance = 0.15;

/* Shorter than this share of its length an arrow or axis is drawn as its end. */
static const double shortest = 0.3;

/* Whether an arrow is drawn as its end. */
static bool is_end_on(const float arrow[6])
{
    const double size = hypot(arrow[3] - arrow[0], arrow[4] - arrow[1]);
    return !(size > shortest * hypot(size, arrow[5] - arrow[2]));
}

int gb_caption_load_arrow(const float *arrow, int count)
{
    int steepest = -1;
    double most = -1.0;
    for (int i = 0; i < count; i++, arrow += 6) {
        const double rise = fabs(arrow[4] - arrow[1]);
        const double slope = rise / hypot(arrow[3] - arrow[0], rise);
        if (!is_end_on(arrow) && slope > most) {
            steepest = i;
            most = slope;
        }
    }
    return steepest;
}

static void find_pixel_above(const struct gb_view *view, const float *point, double up,
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
        find_pixel_above(&scene->view, scene->edge[k], 0.0, end[0]);
        find_pixel_above(&scene->view, scene->edge[k] + 3, 0.0, end[1]);
        top = fmin(top, top_of_segment(end[0], end[1], left, right));
    }
    for (size_t k = 0; k < scene->count; k++) {
        const float *sphere = &scene->sphere[4 * k];
        double middle[2], above[2];
        find_pixel_above(&scene->view, sphere, 0.0, middle);
        find_pixel_above(&scene->view, sphere, sphere[3], above);
        const double radius = middle[1] - above[1];
        if (middle[0] + radius > left && middle[0] - radius < right) {
            top = fmin(top, above[1]);
        }
    }
    return top;
}

void gb_caption_load_word(const struct gb_scene *scene, int arrow, double unit,
                          double page, double top, struct gb_frame *frame)
{
    double tail[2], tip[2], best = -INFINITY;
    find_pixel_above(&scene->view, scene->arrow[arrow], 0.0, tail);
    find_pixel_above(&scene->view, scene->arrow[arrow] + 3, 0.0, tip);
    const double x = 0.6 * tail[0] + 0.4 * tip[0];
    const double y = 0.6 * tail[1] + 0.4 * tip[1];
    *frame = (struct gb_frame){0.0, 0.0, LOAD_WIDTH * unit, LOAD_LINE * unit};
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

/* Lengths in lines of text. */
static const double axis_length = 1.9, symbol_gap = 0.5;
static const double head_length = 0.8, axis_head = 0.5; /* of arrows, of axes */
static const double axis_width = 0.1, arrow_width = 0.2;
static const double end_radius = 0.28; /* circle of an axis along the view */

static const char word[] = "pressing";

/* A shaft and a filled head at its end. */
static void draw_shaft(const struct pen *pen, const double from[2], const double to[2],
                       double width, double head)
{
    const double size = hypot(to[0] - from[0], to[1] - from[1]);
    const double u[2] = {(to[0] - from[0]) / size, (to[1] - from[1]) / size};
    const double long_head = fmin(head, 0.7 * size);
    const double base[2] = {to[0] - long_head * u[0], to[1] - long_head * u[1]};
    const double half = 0.38 * head;
    set_foreground(pen);
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

static void draw_end(const struct pen *pen, const double at[2], enum end end)
{
    const double r = end_radius * pen->unit;
    set_foreground(pen);
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
static void find_origin(const struct pen *pen, const struct gb_frame *frame,
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

/* The axes of the cell as the camera sees them, in a frame: x, y, z, of discs x and z.  An
 * axis along the view is a circle with a dot (towards the viewer) or a cross. */
static void draw_axes(const struct pen *pen, const struct gb_frame *frame,
                      const struct gb_view *view, int dimension)
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
            draw_shaft(pen, origin, at[0], axis_width * pen->unit, axis_head * pen->unit);
        }
        gb_text_write(&pen->text, names[axis], 0.95 * pen->unit, 0.0, at[1],
                      (double[2]){0.5, 0.5}, 0);
    }
}

static void write_word(const struct pen *pen, const struct gb_scene *scene, double top)
{
    const double page = cairo_image_surface_get_width(cairo_get_target(pen->cairo));
    const int arrow = gb_caption_load_arrow(scene->arrow[0], scene->arrows);
    struct gb_frame frame;
    if (arrow >= 0) {
        gb_caption_load_word(scene, arrow, pen->unit, page, top, &frame);
        write_line(pen, word, frame.left, frame.top + 0.5 * frame.height, 0.0, LOAD_LINE,
                   0.0);
    }
}

/* Arrows of pressing, with their word beside the steepest one, clear of the packing.  An
 * arrow along the view is a circle with a dot or a cross, before the word that ends at `corner`.  Returns the width that this
 * takes there, pixels, or 0. */
static double draw_load(const struct pen *pen, const struct gb_scene *scene,
                        const double corner[2])
{
    double taken = 0.0;
    for (int i = 0; i < scene->arrows; i++) {
        const float *arrow = scene->arrow[i];
        double from[2], to[2];
        find_pixel_above(&scene->view, arrow, 0.0, from);
        find_pixel_above(&scene->view, arrow + 3, 0.0, to);
        if (!is_end_on(arrow)) {
            draw_shaft(pen, from, to, arrow_width * pen->unit, head_length * pen->unit);
            continue;
        }
        const double end[2] = {corner[0] - (LOAD_WIDTH + 0.3) * pen->unit, corner[1]};
        draw_end(pen, end, arrow[5] < arrow[2] ? TOWARDS_VIEWER : AWAY_FROM_VIEWER);
        write_line(pen, word, corner[0], corner[1], 1.0, LOAD_LINE, 0.0);
        taken = (LOAD_WIDTH + 1.6) * pen->unit;
    }
    write_word(pen, scene, corner[1] + 0.65 * pen->unit);
    return taken;
}

static void frame_bar(const struct pen *pen, const struct gb_frame *bar,
                      const char *title)
{
    set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_stroke(pen->cairo);
    write_line_upwards(pen, title, bar->left - 0.95 * pen->unit,
                       bar->top + 0.5 * bar->height);
}

static void set_colour(const struct pen *pen, const uint8_t rgb[3])
{
    cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/* Whole numbers: one cell each, the lowest at the bottom; every n-th has a label where they
 * are low. */
static void draw_cells(const struct pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    const int first = (int)scale->low;
    const int last = (int)scale->high;
    const double step = bar->height / (last - first + 1);
    const int every = (int)fmax(ceil(0.95 * pen->unit / step), 1.0);
    for (int k = first; k <= last; k++) {
        uint8_t rgb[3];
        char label[16];
        const double top = bar->top + bar->height - (k - first + 1) * step;
        gb_picture_colours_at(scale, k, rgb);
        set_colour(pen, rgb);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width, step + 0.5);
        cairo_fill(pen->cairo);
        if ((last - k) % every != 0) {
            continue;
        }
        snprintf(label, sizeof label, "%s%d",
                 k == last && scale->above    ? "≥"
                 : k == first && scale->below ? "≤"
                                              : "",
                 k);
        write_line(pen, label, bar->left + bar->width + 0.5 * pen->unit, top + 0.5 * step,
                   0.0, 0.85, 0.0);
    }
}

enum bar_end { AT_LOW_END, AT_HIGH_END };

/* Triangle at an end of the bar: values exist beyond it. */
static void draw_bar_end(const struct pen *pen, const struct gb_frame *bar,
                         const struct gb_picture_style_scale *scale, enum bar_end end)
{
    const bool above = end == AT_HIGH_END;
    const double base = above ? bar->top : bar->top + bar->height;
    const double tip = base + (above ? -1.0 : 1.0) * 0.8 * pen->unit;
    uint8_t rgb[3];
    gb_image_map_colour(scale->map, above ? 1.0 : 0.0, rgb);
    set_colour(pen, rgb);
    cairo_move_to(pen->cairo, bar->left, base);
    cairo_line_to(pen->cairo, bar->left + 0.5 * bar->width, tip);
    cairo_line_to(pen->cairo, bar->left + bar->width, base);
    cairo_close_path(pen->cairo);
    cairo_fill_preserve(pen->cairo);
    set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_stroke(pen->cairo);
}

static void draw_tick(const struct pen *pen, const struct gb_frame *bar, double y,
                      const char *label)
{
    set_foreground(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_move_to(pen->cairo, bar->left + bar->width, y);
    cairo_line_to(pen->cairo, bar->left + bar->width + 0.3 * pen->unit, y);
    cairo_stroke(pen->cairo);
    gb_text_write(&pen->text, label, 0.85 * pen->unit, 0.0,
                  (double[2]){bar->left + bar->width + 0.5 * pen->unit, y},
                  (double[2]){0.0, 0.5}, 0);
}

/* The ends, and the ticks between them that leave room for those. */
static void draw_ticks(const struct pen *pen, const struct gb_frame *bar,
                       const struct gb_picture_style_scale *scale)
{
    static const bool exact[2] = {true, true};
    const double room = 1.1 * pen->unit;
    const int wanted = (int)fmin(fmax(bar->height / (2.0 * pen->unit), 2.0), 6.0);
    struct gb_figure_axis_scale axis;
    gb_figure_axis_fit(&axis, scale->log ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR,
                       scale->low, scale->high, wanted, exact);
    axis.from = bar->top + bar->height;
    axis.to = bar->top;
    for (int k = 0; k < axis.ticks; k++) {
        char plain[48]; /* no space for a power of ten */
        const double y = gb_figure_axis_position(&axis, axis.tick[k]);
        if (y > axis.from - room || y < axis.to + room) {
            continue;
        }
        snprintf(plain, sizeof plain, "%.4g", axis.tick[k]);
        draw_tick(pen, bar, y, axis.power == 0 ? axis.label[k] : plain);
    }
    for (int end = 0; end < 2; end++) {
        char label[48];
        const double value = end == 0 ? scale->low : scale->high;
        const double magnitude = fabs(value);
        snprintf(label, sizeof label, "%s%.4g", value < 0.0 ? "−" : "", magnitude);
        draw_tick(pen, bar, end == 0 ? axis.from : axis.to, label);
    }
}

/* One colour, one tick. */
static void draw_one_value(const struct pen *pen, const struct gb_frame *bar,
                           const struct gb_picture_style_scale *scale)
{
    uint8_t rgb[3];
    char label[48];
    gb_image_map_colour(scale->map, 0.5, rgb);
    set_colour(pen, rgb);
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_fill(pen->cairo);
    snprintf(label, sizeof label, "%.4g", scale->low);
    draw_tick(pen, bar, bar->top + 0.5 * bar->height, label);
}

static void draw_gradient(const struct pen *pen, const struct gb_frame *bar,
                          const struct gb_picture_style_scale *scale)
{
    const int steps = 256;
    for (int k = 0; k < steps; k++) {
        uint8_t rgb[3];
        gb_image_map_colour(scale->map, (k + 0.5) / steps, rgb);
        const double top = bar->top + bar->height * (1.0 - (k + 1.0) / steps);
        set_colour(pen, rgb);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width,
                        bar->height / steps + 0.6);
        cairo_fill(pen->cairo);
    }
    if (scale->below) {
        draw_bar_end(pen, bar, scale, AT_LOW_END);
    }
    if (scale->above) {
        draw_bar_end(pen, bar, scale, AT_HIGH_END);
    }
    draw_ticks(pen, bar, scale);
}

/* Colour bar with its labels and title beside a packing; none for a scale without title. */
static void draw_colour_bar(const struct pen *pen, const struct gb_frame *bar,
                            const struct gb_picture_style_scale *scale)
{
    if (scale->title == NULL) {
        return;
    }
    if (scale->whole) {
        draw_cells(pen, bar, scale);
    } else if (!(scale->high > scale->low)) {
        draw_one_value(pen, bar, scale);
    } else {
        draw_gradient(pen, bar, scale);
    }
    frame_bar(pen, bar, scale->title);
}

/* Colours of the classes of forces and, below them, rods of round forces as thick as those of
 * the picture (in perspective: of its mid-depth). */

enum { RODS = 3 };

/* Each further rod has at most this share of the force before. */
static const double next_share = 0.5;
/* Thickest rod of the legend, heights of a line. */
static const double max_thickness = 1.2;

int gb_caption_legend_lines(const struct gb_picture_style *style)
{
    return style->legend_count > 0 ? style->legend_count + 1 + RODS : 0;
}

static void draw_rod(const struct pen *pen, double x, double y, double width)
{
    cairo_set_line_width(pen->cairo, width);
    cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_ROUND);
    cairo_move_to(pen->cairo, x + 0.3 * pen->unit, y);
    cairo_line_to(pen->cairo, x + 1.6 * pen->unit, y);
    cairo_stroke(pen->cairo);
    cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_BUTT);
}

static void draw_line(const struct pen *pen, const struct gb_frame *frame,
                      const char *text, double y)
{
    write_line(pen, text, frame->left + 2.5 * pen->unit, y, 0.0, 0.9,
               frame->width - 2.5 * pen->unit);
}

/* Largest force of the legend, N: its rod fits a line. */
static double largest(const struct pen *pen, const struct gb_picture_style *style,
                      double scale)
{
    const double thickest = 2.0 * scale * gb_picture_style_rod_radius(1.0);
    const double limit = max_thickness * pen->unit;
    return thickest <= limit
               ? style->max_force_n
               : gb_number_round_below(style->max_force_n * limit / thickest);
}

/* A quantity with its unit; the prefix micro as a Greek letter. */
static void format_number(double value, enum gb_dimension dimension, int digits,
                          char *text, size_t size)
{
    char plain[48];
    gb_units_format_short(value, dimension, digits, plain, sizeof plain);
    const char *micro = strstr(plain, " u");
    if (micro != NULL) {
        snprintf(text, size, "%.*s μ%s", (int)(micro - plain), plain, micro + 2);
    } else {
        snprintf(text, size, "%s", plain);
    }
}

/* scale: pixels per d */
static void draw_force_legend(const struct pen *pen, const struct gb_frame *frame,
                              const struct gb_picture_style *style, double scale)
{
    const double step = GB_CAPTION_LEGEND_LINE * pen->unit;
    double y = frame->top + 0.5 * step;
    for (int k = 0; k < style->legend_count; k++, y += step) {
        const uint8_t *rgb = style->legend[k].rgb;
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        draw_rod(pen, frame->left, y, 0.45 * pen->unit);
        draw_line(pen, frame, style->legend[k].name, y);
    }
    write_line(pen, "normal force", frame->left, y, 0.0, 0.9, frame->width);
    double force_n = largest(pen, style, scale);
    for (int k = 0; k < RODS; k++) {
        char force[48], line[64];
        const double ratio = force_n / style->max_force_n;
        const bool above = ratio >= 1.0 && style->forces_above;
        y += step;
        format_number(force_n, GB_DIM_FORCE, 2, force, sizeof force);
        snprintf(line, sizeof line, "%s%s", above ? "≥ " : "", force);
        set_foreground(pen);
        draw_rod(pen, frame->left, y, 2.0 * scale * gb_picture_style_rod_radius(ratio));
        draw_line(pen, frame, line, y);
        force_n = gb_number_round_below(next_share * force_n);
    }
}

double gb_caption_bar_length(double max_m, char *label, size_t size)
{
    const double length = gb_number_round_below(max_m);
    format_number(length, GB_DIM_LENGTH, 3, label, size);
    return length;
}

/* In perspective the bar is valid in one plane only: the middle of the box. */
static void draw_scale_bar(const struct pen *pen, const struct gb_scene *scene,
                           const struct gb_state *state, double x, double y, double most,
                           double end)
{
    char label[64];
    char words[96], shorter[96];
    const double pixel_per_metre = gb_view_scale(&scene->view) / state->metre_per_length;
    const double length =
        gb_caption_bar_length(most / pixel_per_metre, label, sizeof label) *
        pixel_per_metre;
    const double left = x + length + 0.6 * pen->unit;
    snprintf(words, sizeof words, "%s%s", label,
             scene->view.orthographic ? "" : " at mid-depth");
    snprintf(shorter, sizeof shorter, "%s%s", label,
             scene->view.orthographic ? "" : ", middle");
    const char *const texts[] = {words, shorter, label, NULL};
    set_foreground(pen);
    cairo_rectangle(pen->cairo, x, y - 0.14 * pen->unit, length, 0.28 * pen->unit);
    cairo_fill(pen->cairo);
    write_line_that_fits(pen, texts, left, y, 0.0, 0.85, end - left);
}

/* Density and pressure, in words or, where these do not fit, in symbols. */
static void draw_point(const struct pen *pen, const struct gb_state *state, double x,
                       double y, double max_width)
{
    char words[160], symbols[96], pressure[48] = "";
    const double density = state->point.density;
    if (isfinite(state->point.p_pa)) {
        format_number(state->point.p_pa, GB_DIM_PRESSURE, 3, pressure, sizeof pressure);
        snprintf(words, sizeof words, "relative density %.3f     pressure %s", density,
                 pressure);
        snprintf(symbols, sizeof symbols, "ρ %.3f   p %s", density, pressure);
    } else {
        snprintf(words, sizeof words, "relative density %.3f", density);
        snprintf(symbols, sizeof symbols, "ρ %.3f", density);
    }
    const char *const texts[] = {words, symbols, NULL};
    write_line_that_fits(pen, texts, x, y, 0.0, 1.0, max_width);
}

static void draw_all(const struct pen *pen, const struct gb_image *image,
                     const struct gb_caption_layout *layout, const struct gb_scene *scene,
                     const struct gb_picture_style *style, const struct gb_state *state)
{
    const double unit = layout->unit;
    const double left = 1.4 * unit;
    const double max_width = image->width - 2.0 * left;
    draw_colour_bar(pen, &layout->bar, &style->scale);
    if (style->legend_count > 0) {
        draw_force_legend(pen, &layout->legend, style, gb_view_scale(&scene->view));
    }
    draw_point(pen, state, left, image->height - 2.9 * unit, layout->axes.left - left);
    draw_scale_bar(pen, scene, state, left, image->height - 1.4 * unit,
                   fmin(9.0 * unit, 0.3 * image->width), layout->axes.left);
    draw_axes(pen, &layout->axes, &scene->view, state->dimension);
    const double taken =
        draw_load(pen, scene, (const double[2]){image->width - left, 1.5 * unit});
    write_line(pen, state->preset, left, 1.5 * unit, 0.0, 1.05, max_width - taken);
}

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *style,
                     const struct gb_state *state, struct gb_error *err)
{
    struct pen pen;
    if (layout->unit <= 0.0) {
        return true;
    }
    const bool good = begin_pen(&pen, image, layout->unit, scene->background, err);
    if (good) {
        draw_all(&pen, image, layout, scene, style, state);
    }
    return end_pen(&pen, image, good, err);
}

/* x, y, z at the ends of the axes of the rose that face the viewer. */
static void label_axes(const struct pen *pen, const struct gb_scene *scene, double reach)
{
    static const char *const names[3] = {"<i>x</i>", "<i>y</i>", "<i>z</i>"};
    for (int k = 0; k < 3; k++) {
        double point[3] = {reach, reach, reach};
        double eye[3];
        double pixel[2];
        const double side = scene->view.away[k] > 0.3 ? -1.0 : 1.0;
        if (fabs(scene->view.away[k]) > 0.99) { /* along the view: in the middle */
            continue;
        }
        point[k] += 1.08 * side * reach;
        gb_view_eye(&scene->view, point, eye);
        gb_view_pixel(&scene->view, eye, pixel);
        set_foreground(pen);
        gb_text_write(&pen->text, names[k], 1.05 * pen->unit, 0.0, pixel,
                      (double[2]){0.5, 0.5}, 0);
    }
}

bool gb_caption_draw_rose(struct gb_image *image, const struct gb_caption_layout *layout,
                          const struct gb_scene *scene, double reach, double mean_n,
                          struct gb_error *err)
{
    struct pen pen;
    char force[48];
    char line[96], mean[64];
    if (layout->unit <= 0.0) {
        return true;
    }
    const struct gb_picture_style_scale scale = {.title = "<i>f</i> / ⟨<i>f</i>⟩",
                                                 .high = reach};
    const bool good = begin_pen(&pen, image, layout->unit, scene->background, err);
    if (good) {
        const double unit = layout->unit;
        const double max_width = image->width - 2.8 * unit;
        draw_colour_bar(&pen, &layout->bar, &scale);
        label_axes(&pen, scene, reach);
        static const char *const titles[] = {"mean normal force by direction",
                                             "mean normal force", "forces", NULL};
        write_line_that_fits(&pen, titles, 1.4 * unit, 1.5 * unit, 0.0, 1.05, max_width);
        format_number(mean_n, GB_DIM_FORCE, 3, force, sizeof force);
        snprintf(line, sizeof line, "⟨f⟩ = %s; reference ring: f / ⟨f⟩ = 1", force);
        snprintf(mean, sizeof mean, "⟨f⟩ = %s", force);
        const char *const texts[] = {line, mean, NULL};
        write_line_that_fits(&pen, texts, 1.4 * unit, image->height - 2.9 * unit, 0.0,
                             1.0, max_width);
    }
    return end_pen(&pen, image, good, err);
}
