#include "draw/caption.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "draw/caption_pen.h"
#include "draw/colour_bar.h"
#include "draw/image/print_size.h"

/* Minimum length of the shorter side for readable text, pixels. */
static const int min_annotated_px = 240;

/* A quantity with its unit; the prefix micro as a Greek letter. */
static void format_short(double value, enum gb_dimension dimension, int digits,
                         char *text, size_t size)
{
    char plain[48];
    gb_units_format_short(value, dimension, digits, plain, sizeof plain);
    const char *micro = strstr(plain, " u");
    if (micro != NULL) {
        snprintf(text, size, "%.*s \xce\xbc%s", (int)(micro - plain), plain, micro + 2);
    } else {
        snprintf(text, size, "%s", plain);
    }
}

void gb_caption_arrange(int width, int height, int per_inch, bool annotated,
                        struct gb_caption_layout *layout)
{
    const double shorter = width < height ? width : height;
    const double pad = 0.03 * shorter;
    *layout = (struct gb_caption_layout){
        .scene = {pad, pad, width - 2.0 * pad, height - 2.0 * pad}};
    if (!annotated || shorter < min_annotated_px) {
        return;
    }
    const double unit = per_inch > 0 ? gb_print_size_pixels(per_inch, GB_PRINT_SIZE_TEXT)
                                     : fmax(shorter / 44.0, 10.0);
    const double column = 7.5 * unit; /* of the colour bar and its title */
    layout->unit = unit;
    layout->scene.top = 2.6 * unit;
    layout->scene.height = height - 2.6 * unit - 4.4 * unit;
    layout->scene.width = width - pad - column;
    layout->bar.width = 1.1 * unit;
    layout->bar.height = fmin(0.62 * height, height - 12.0 * unit);
    layout->bar.left = width - 5.0 * unit;
    layout->bar.top = 0.5 * (height - layout->bar.height) - 0.5 * unit;
}

double gb_caption_bar_length(double max_m, char *label, size_t size)
{
    static const double steps[] = {5.0, 2.0, 1.0};
    const double decade = pow(10.0, floor(log10(max_m) + 1e-9));
    double length = decade;
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade <= max_m * (1.0 + 1e-9)) {
            length = steps[k] * decade;
            break;
        }
    }
    format_short(length, GB_DIM_LENGTH, 3, label, size);
    return length;
}

/* Classes of forces and the force of the thickest rod, in the upper right corner. */
static void draw_legend(const struct gb_caption_pen *pen,
                        const struct gb_picture_style *style, double right)
{
    const double unit = pen->unit;
    double y = 1.5 * unit;
    for (int k = 0; k < style->legend_count; k++) {
        const uint8_t *rgb = style->legend[k].rgb;
        double wide = 0.0;
        double high = 0.0;
        gb_text_measure(&pen->text, style->legend[k].name, 0.95 * unit, 0.0, &wide,
                        &high);
        gb_caption_pen_line(pen, style->legend[k].name, right, y, 1.0, 0.95, 0.0);
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        cairo_set_line_width(pen->cairo, 0.45 * unit);
        cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_ROUND);
        cairo_move_to(pen->cairo, right - wide - 2.2 * unit, y);
        cairo_line_to(pen->cairo, right - wide - 0.8 * unit, y);
        cairo_stroke(pen->cairo);
        cairo_set_line_cap(pen->cairo, CAIRO_LINE_CAP_BUTT);
        y += 1.45 * unit;
    }
    if (style->legend_count > 0) {
        char force[48];
        char line[80];
        format_short(style->max_force_n, GB_DIM_FORCE, 2, force, sizeof force);
        snprintf(line, sizeof line, "thickest rod: %s", force);
        gb_caption_pen_line(pen, line, right, y, 1.0, 0.85, 0.0);
    }
}

/* In perspective the bar is valid in one plane only: the middle of the box. */
static void draw_scale_bar(const struct gb_caption_pen *pen, const struct gb_scene *scene,
                           const struct gb_state *state, double x, double y, double most)
{
    char label[64];
    char text[96];
    const double pixel_per_metre = gb_view_scale(&scene->view) / state->metre_per_length;
    const double length =
        gb_caption_bar_length(most / pixel_per_metre, label, sizeof label) *
        pixel_per_metre;
    snprintf(text, sizeof text, "%s%s", label,
             scene->view.orthographic ? "" : " at mid-depth");
    gb_caption_pen_set_foreground(pen);
    cairo_rectangle(pen->cairo, x, y - 0.14 * pen->unit, length, 0.28 * pen->unit);
    cairo_fill(pen->cairo);
    gb_caption_pen_line(pen, text, x + length + 0.6 * pen->unit, y, 0.0, 0.85, 0.0);
}

/* Density and pressure, in words or, where these do not fit, in symbols. */
static void draw_point(const struct gb_caption_pen *pen, const struct gb_state *state,
                       double x, double y, double max_width)
{
    char words[160], symbols[96], pressure[48] = "";
    const double density = state->point.density;
    if (isfinite(state->point.p_pa)) {
        format_short(state->point.p_pa, GB_DIM_PRESSURE, 3, pressure, sizeof pressure);
        snprintf(words, sizeof words, "relative density %.3f     pressure %s", density,
                 pressure);
        snprintf(symbols, sizeof symbols, "\xcf\x81 %.3f   p %s", density, pressure);
    } else {
        snprintf(words, sizeof words, "relative density %.3f", density);
        snprintf(symbols, sizeof symbols, "\xcf\x81 %.3f", density);
    }
    const char *const texts[] = {words, symbols, NULL};
    gb_caption_pen_line_that_fits(pen, texts, x, y, 0.0, 1.0, max_width);
}

static void draw_all(const struct gb_caption_pen *pen, const struct gb_image *image,
                     const struct gb_caption_layout *layout, const struct gb_scene *scene,
                     const struct gb_picture_style *style, const struct gb_state *state)
{
    const double unit = layout->unit;
    const double left = 1.4 * unit;
    const double max_width =
        image->width - 2.0 * left - (style->legend_count > 0 ? 12.0 * unit : 0.0);
    gb_colour_bar_draw(pen, &layout->bar, &style->scale);
    draw_legend(pen, style, image->width - left);
    gb_caption_pen_line(pen, state->preset, left, 1.5 * unit, 0.0, 1.05, max_width);
    draw_point(pen, state, left, image->height - 2.9 * unit, image->width - 2.0 * left);
    draw_scale_bar(pen, scene, state, left, image->height - 1.4 * unit,
                   fmin(9.0 * unit, 0.3 * image->width));
}

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *style,
                     const struct gb_state *state, struct gb_error *err)
{
    struct gb_caption_pen pen;
    if (layout->bar.width <= 0.0) {
        return true;
    }
    const bool good =
        gb_caption_pen_begin(&pen, image, layout->unit, scene->background, err);
    if (good) {
        draw_all(&pen, image, layout, scene, style, state);
    }
    return gb_caption_pen_end(&pen, image, good, err);
}

/* x, y, z at the ends of the axes of the rose that face the viewer. */
static void label_axes(const struct gb_caption_pen *pen, const struct gb_scene *scene,
                       double reach)
{
    static const char *const names[3] = {"<i>x</i>", "<i>y</i>", "<i>z</i>"};
    for (int k = 0; k < 3; k++) {
        double point[3] = {reach, reach, reach};
        double eye[3];
        double pixel[2];
        const double side = scene->view.away[k] > 0.3 ? -1.0 : 1.0;
        point[k] += 1.08 * side * reach;
        gb_view_eye(&scene->view, point, eye);
        gb_view_pixel(&scene->view, eye, pixel);
        gb_caption_pen_set_foreground(pen);
        gb_text_write(&pen->text, names[k], 1.05 * pen->unit, 0.0, pixel,
                      (double[2]){0.5, 0.5}, 0);
    }
}

bool gb_caption_draw_rose(struct gb_image *image, const struct gb_caption_layout *layout,
                          const struct gb_scene *scene, double reach, double mean_n,
                          struct gb_error *err)
{
    struct gb_caption_pen pen;
    char force[48];
    char line[96], mean[64];
    if (layout->bar.width <= 0.0) {
        return true;
    }
    const struct gb_picture_style_scale scale = {
        .title = "<i>f</i> / \xe2\x9f\xa8<i>f</i>\xe2\x9f\xa9", .high = reach};
    const bool good =
        gb_caption_pen_begin(&pen, image, layout->unit, scene->background, err);
    if (good) {
        const double unit = layout->unit;
        const double max_width = image->width - 2.8 * unit;
        gb_colour_bar_draw(&pen, &layout->bar, &scale);
        label_axes(&pen, scene, reach);
        static const char *const titles[] = {"mean normal force by direction",
                                             "mean normal force", "forces", NULL};
        gb_caption_pen_line_that_fits(&pen, titles, 1.4 * unit, 1.5 * unit, 0.0, 1.05,
                                      max_width);
        format_short(mean_n, GB_DIM_FORCE, 3, force, sizeof force);
        snprintf(line, sizeof line,
                 "\xe2\x9f\xa8"
                 "f\xe2\x9f\xa9 = %s; reference ring: f / \xe2\x9f\xa8"
                 "f\xe2\x9f\xa9 = 1",
                 force);
        snprintf(mean, sizeof mean,
                 "\xe2\x9f\xa8"
                 "f\xe2\x9f\xa9 = %s",
                 force);
        const char *const texts[] = {line, mean, NULL};
        gb_caption_pen_line_that_fits(&pen, texts, 1.4 * unit, image->height - 2.9 * unit,
                                      0.0, 1.0, max_width);
    }
    return gb_caption_pen_end(&pen, image, good, err);
}
