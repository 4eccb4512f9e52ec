#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <glib.h>

#include "base/file.h"
#include "draw/figure/figure.h"
#include "draw/figure/figure_surface.h"
#include "draw/mute_stderr.h"

bool gb_figure_write_png(const struct gb_figure *figure, int width, int height,
                         const struct gb_png_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    struct gb_figure_layout layout;
    struct gb_image *image = NULL;
    const bool good = gb_file_check_target(path, err) &&
                      gb_figure_render(&image, figure, width, height, &layout, err) &&
                      gb_png_write(image, GB_PNG_OPAQUE, texts, text_count, path, err);
    gb_image_destroy(image);
    return good;
}

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned length)
{
    g_byte_array_append(closure, data, length);
    return CAIRO_STATUS_SUCCESS;
}

/* Draws onto a vector surface that collects bytes, and writes these; destroys the surface.
 */
static bool write_vector(cairo_surface_t *surface, GByteArray *bytes,
                         const struct gb_figure *figure, const double size[2],
                         const char *path, struct gb_error *err)
{
    struct gb_figure_layout layout;
    const int saved = gb_mute_stderr_begin();
    bool good = gb_figure_surface_draw(surface, figure, size, 1.0, &layout, err);
    cairo_surface_finish(surface);
    gb_mute_stderr_end(saved);
    const cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (good && status != CAIRO_STATUS_SUCCESS) {
        good = gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be drawn: %s", path,
                            cairo_status_to_string(status));
    }
    good = good && gb_file_replace(path, bytes->data, bytes->len, err);
    g_byte_array_unref(bytes);
    return good;
}

static void page_size(int width, int height, double size[2])
{
    const double unit = gb_figure_surface_pixels_per_point(width, height);
    size[0] = width / unit;
    size[1] = height / unit;
}

bool gb_figure_write_svg(const struct gb_figure *figure, int width, int height,
                         const struct gb_png_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    double size[2];
    (void)texts;
    (void)text_count;
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    GByteArray *bytes = g_byte_array_new();
    page_size(width, height, size);
    cairo_surface_t *surface =
        cairo_svg_surface_create_for_stream(collect, bytes, size[0], size[1]);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PT);
    return write_vector(surface, bytes, figure, size, path, err);
}

bool gb_figure_write_pdf(const struct gb_figure *figure, int width, int height,
                         const struct gb_png_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    double size[2];
    (void)texts;
    (void)text_count;
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    GByteArray *bytes = g_byte_array_new();
    page_size(width, height, size);
    cairo_surface_t *surface =
        cairo_pdf_surface_create_for_stream(collect, bytes, size[0], size[1]);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR,
                                   "greenbody " GB_VERSION);
    /* without a date the same figure gives the same bytes */
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    return write_vector(surface, bytes, figure, size, path, err);
}
