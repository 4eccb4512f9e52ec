#include "draw/caption.h"

#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "draw/palette.h"

/* Below this many pixels of the shorter side words cannot be read. */
static const int words_from = 240;

static const char *const face = "DejaVu Sans, Sans";

struct pen {
    cairo_t *cairo;
    PangoLayout *text;
    double unit;
    uint8_t ink[3];
};

void gb_caption_place(int width, int height, bool words, struct gb_caption_layout *layout)
{
    const double shorter = width < height ? width : height;
    const double pad = 0.03 * shorter;
    *layout = (struct gb_caption_layout){
        .scene = {pad, pad, width - 2.0 * pad, height - 2.0 * pad}};
    if (!words || shorter < words_from) {
        return;
    }
    const double unit = fmax(shorter / 44.0, 10.0);
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

double gb_caption_bar_length(double most, char *label, size_t size)
{
    static const double steps[] = {5.0, 2.0, 1.0};
    const double decade = pow(10.0, floor(log10(most) + 1e-9));
    double length = decade;
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        if (steps[k] * decade <= most * (1.0 + 1e-9)) {
            length = steps[k] * decade;
            break;
        }
    }
    gb_units_format_short(length, GB_DIM_LENGTH, 3, label, size);
    return length;
}

static void set_ink(const struct pen *pen)
{
    cairo_set_source_rgb(pen->cairo, pen->ink[0] / 255.0, pen->ink[1] / 255.0,
                         pen->ink[2] / 255.0);
}

/* One line at (x, y); align 0, 0.5, 1: x is its left end, middle, right end; y its
 * middle. Longer than room (> 0), it is cut with an ellipsis. */
static double write_line(const struct pen *pen, const char *line, double x, double y,
                         double align, double scale, double room)
{
    int width = 0;
    int height = 0;
    PangoFontDescription *font = pango_font_description_from_string(face);
    pango_font_description_set_absolute_size(font, scale * pen->unit * PANGO_SCALE);
    pango_layout_set_font_description(pen->text, font);
    pango_font_description_free(font);
    pango_layout_set_text(pen->text, line, -1);
    pango_layout_set_width(pen->text, room > 0.0 ? (int)(room * PANGO_SCALE) : -1);
    pango_layout_set_ellipsize(pen->text, PANGO_ELLIPSIZE_END);
    pango_layout_get_pixel_size(pen->text, &width, &height);
    set_ink(pen);
    cairo_move_to(pen->cairo, x - align * width, y - 0.5 * height);
    pango_cairo_show_layout(pen->cairo, pen->text);
    return width;
}

/* Coordination numbers are whole: a cell of its own for each, 0 at the bottom. */
static void draw_colour_bar(const struct pen *pen, const struct gb_frame *bar)
{
    const double step = bar->height / (GB_PALETTE_CONTACTS + 1);
    for (int k = 0; k <= GB_PALETTE_CONTACTS; k++) {
        uint8_t rgb[3];
        char label[8];
        const double top = bar->top + bar->height - (k + 1) * step;
        gb_palette_contacts(k, rgb);
        cairo_set_source_rgb(pen->cairo, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        cairo_rectangle(pen->cairo, bar->left, top, bar->width, step + 0.5);
        cairo_fill(pen->cairo);
        snprintf(label, sizeof label, "%d", k);
        write_line(pen, label, bar->left + bar->width + 0.5 * pen->unit, top + 0.5 * step,
                   0.0, 0.85, 0.0);
    }
    set_ink(pen);
    cairo_set_line_width(pen->cairo, fmax(0.05 * pen->unit, 1.0));
    cairo_rectangle(pen->cairo, bar->left, bar->top, bar->width, bar->height);
    cairo_stroke(pen->cairo);
    cairo_save(pen->cairo);
    cairo_translate(pen->cairo, bar->left - 0.95 * pen->unit,
                    bar->top + 0.5 * bar->height);
    cairo_rotate(pen->cairo, -0.5 * G_PI);
    write_line(pen, "coordination number", 0.0, 0.0, 0.5, 0.95, 0.0);
    cairo_restore(pen->cairo);
}

/* In perspective a length is true in one plane only: the middle of the box. */
static void draw_scale_bar(const struct pen *pen, const struct gb_scene *scene,
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
    set_ink(pen);
    cairo_rectangle(pen->cairo, x, y - 0.14 * pen->unit, length, 0.28 * pen->unit);
    cairo_fill(pen->cairo);
    write_line(pen, text, x + length + 0.6 * pen->unit, y, 0.0, 0.85, 0.0);
}

static void point_text(const struct gb_state *state, char *text, size_t size)
{
    char pressure[48] = "";
    int length = snprintf(text, size, "density %.3f", state->point.density);
    if (isfinite(state->point.p_pa) && length > 0 && (size_t)length < size) {
        gb_units_format_short(state->point.p_pa, GB_DIM_PRESSURE, 3, pressure,
                              sizeof pressure);
        snprintf(text + length, size - (size_t)length, "     pressure %s", pressure);
    }
}

static void draw_all(const struct pen *pen, const struct gb_image *image,
                     const struct gb_caption_layout *layout, const struct gb_scene *scene,
                     const struct gb_state *state)
{
    char text[160];
    const double unit = layout->unit;
    const double left = 1.4 * unit;
    const double room = image->width - 2.0 * left;
    draw_colour_bar(pen, &layout->bar);
    write_line(pen, state->preset, left, 1.5 * unit, 0.0, 1.05, room);
    point_text(state, text, sizeof text);
    write_line(pen, text, left, image->height - 2.9 * unit, 0.0, 1.0, room);
    draw_scale_bar(pen, scene, state, left, image->height - 1.4 * unit,
                   fmin(9.0 * unit, 0.3 * image->width));
}

/* cairo wants blue first in memory; ours is red first. */
static void swap_red_blue(struct gb_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        uint8_t *pixel = &image->rgba[4 * i];
        const uint8_t red = pixel[0];
        pixel[0] = pixel[2];
        pixel[2] = red;
    }
}

bool gb_caption_draw(struct gb_image *image, const struct gb_caption_layout *layout,
                     const struct gb_scene *scene, const struct gb_state *state,
                     struct gb_error *err)
{
    if (layout->bar.width <= 0.0) {
        return true;
    }
    swap_red_blue(image);
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        image->rgba, CAIRO_FORMAT_ARGB32, image->width, image->height, 4 * image->width);
    struct pen pen = {.cairo = cairo_create(surface), .unit = layout->unit};
    pen.text = pango_cairo_create_layout(pen.cairo);
    gb_scene_ink(scene->ground, pen.ink);
    draw_all(&pen, image, layout, scene, state);
    const cairo_status_t status = cairo_status(pen.cairo);
    g_object_unref(pen.text);
    cairo_destroy(pen.cairo);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    swap_red_blue(image);
    return status == CAIRO_STATUS_SUCCESS ||
           gb_error_set(err, GB_ERR_MACHINE, "the caption cannot be drawn: %s",
                        cairo_status_to_string(status));
}
