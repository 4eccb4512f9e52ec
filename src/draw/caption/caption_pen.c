#include "draw/caption/caption_pen.h"

#include <math.h>

#include "draw/image/print_size.h"

bool gb_caption_pen_begin(struct gb_caption_pen *pen, struct gb_image *image, double unit,
                          enum gb_background background, struct gb_error *err)
{
    gb_image_swap_red_blue(image);
    cairo_surface_t *surface = cairo_image_surface_create_for_data(
        image->rgba, CAIRO_FORMAT_ARGB32, image->width, image->height, 4 * image->width);
    *pen = (struct gb_caption_pen){
        .cairo = cairo_create(surface),
        .unit = unit,
        .least = gb_print_size_pixels(image->per_inch, GB_PRINT_SIZE_LEAST)};
    cairo_surface_destroy(surface);
    gb_scene_foreground(background, pen->foreground);
    return gb_text_init(&pen->text, pen->cairo, err);
}

bool gb_caption_pen_end(struct gb_caption_pen *pen, struct gb_image *image, bool good,
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

void gb_caption_pen_set_foreground(const struct gb_caption_pen *pen)
{
    cairo_set_source_rgb(pen->cairo, pen->foreground[0] / 255.0,
                         pen->foreground[1] / 255.0, pen->foreground[2] / 255.0);
}

static double width_of(const struct gb_caption_pen *pen, const char *markup, double size)
{
    double wide = 0.0, high = 0.0;
    gb_text_measure(&pen->text, markup, size, 0.0, &wide, &high);
    return wide;
}

/* Markup of a line, with its size reduced to fit or, at the smallest one, its end cut. */
static char *fit(const struct gb_caption_pen *pen, const char *line, double max_width,
                 double *size)
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
        char *cut = g_strconcat(g_strchomp(start), "\xe2\x80\xa6", NULL);
        g_free(markup);
        markup = g_markup_escape_text(cut, -1);
        g_free(start);
        g_free(cut);
    }
    return markup;
}

void gb_caption_pen_line(const struct gb_caption_pen *pen, const char *line, double x,
                         double y, double align, double scale, double max_width)
{
    double size = scale * pen->unit;
    char *markup = fit(pen, line, max_width, &size);
    gb_caption_pen_set_foreground(pen);
    gb_text_write(&pen->text, markup, size, 0.0, (double[2]){x, y},
                  (double[2]){align, 0.5}, 0);
    g_free(markup);
}

void gb_caption_pen_line_that_fits(const struct gb_caption_pen *pen,
                                   const char *const *texts, double x, double y,
                                   double align, double scale, double max_width)
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
    gb_caption_pen_line(pen, texts[0], x, y, align, scale, max_width);
}

void gb_caption_pen_line_upwards(const struct gb_caption_pen *pen, const char *line,
                                 double x, double y)
{
    gb_caption_pen_set_foreground(pen);
    gb_text_write(&pen->text, line, 0.95 * pen->unit, 0.0, (double[2]){x, y},
                  (double[2]){0.5, 0.5}, 1);
}
