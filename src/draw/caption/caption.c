#include "draw/caption/caption.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/caption/caption_number.h"
#include "draw/caption/caption_pen.h"
#include "draw/caption/colour_bar.h"
#include "draw/caption/force_legend.h"
#include "draw/caption/orientation.h"
#include "draw/style/round_number.h"

double gb_caption_bar_length(double max_m, char *label, size_t size)
{
    const double length = gb_round_number_below(max_m);
    gb_caption_number_format(length, GB_DIM_LENGTH, 3, label, size);
    return length;
}

/* In perspective the bar is valid in one plane only: the middle of the box. */
static void draw_scale_bar(const struct gb_caption_pen *pen, const struct gb_scene *scene,
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
    gb_caption_pen_set_foreground(pen);
    cairo_rectangle(pen->cairo, x, y - 0.14 * pen->unit, length, 0.28 * pen->unit);
    cairo_fill(pen->cairo);
    gb_caption_pen_line_that_fits(pen, texts, left, y, 0.0, 0.85, end - left);
}

/* Density and pressure, in words or, where these do not fit, in symbols. */
static void draw_point(const struct gb_caption_pen *pen, const struct gb_state *state,
                       double x, double y, double max_width)
{
    char words[160], symbols[96], pressure[48] = "";
    const double density = state->point.density;
    if (isfinite(state->point.p_pa)) {
        gb_caption_number_format(state->point.p_pa, GB_DIM_PRESSURE, 3, pressure,
                                 sizeof pressure);
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
    const double max_width = image->width - 2.0 * left;
    gb_colour_bar_draw(pen, &layout->bar, &style->scale);
    if (style->legend_count > 0) {
        gb_force_legend_draw(pen, &layout->legend, style, gb_view_scale(&scene->view));
    }
    draw_point(pen, state, left, image->height - 2.9 * unit, layout->axes.left - left);
    draw_scale_bar(pen, scene, state, left, image->height - 1.4 * unit,
                   fmin(9.0 * unit, 0.3 * image->width), layout->axes.left);
    gb_orientation_draw_axes(pen, &layout->axes, &scene->view, state->dimension);
    const double taken = gb_orientation_draw_load(
        pen, scene, (const double[2]){image->width - left, 1.5 * unit});
    gb_caption_pen_line(pen, state->preset, left, 1.5 * unit, 0.0, 1.05,
                        max_width - taken);
}

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_picture_style *style,
                     const struct gb_state *state, struct gb_error *err)
{
    struct gb_caption_pen pen;
    if (layout->unit <= 0.0) {
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
        if (fabs(scene->view.away[k]) > 0.99) { /* along the view: in the middle */
            continue;
        }
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
    if (layout->unit <= 0.0) {
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
        gb_caption_number_format(mean_n, GB_DIM_FORCE, 3, force, sizeof force);
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
