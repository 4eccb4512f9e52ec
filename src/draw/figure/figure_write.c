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
    const int saved = gb_mute_stderr_begin();
    const bool good = gb_figure_surface_draw(surface, figure, size, scale, &layout, err);
    cairo_surface_finish(surface);
    gb_mute_stderr_end(saved);
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
    const double unit = gb_figure_surface_pixels_per_point(figure, width, height);
    const double size[2] = {width / unit,
                            gb_figure_surface_height(figure, width, height) / unit};
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
                         const struct gb_png_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    (void)texts;
    (void)text_count;
    return write_vector(&svg, figure, width, height, path, err);
}

bool gb_figure_write_pdf(const struct gb_figure *figure, int width, int height,
                         const struct gb_png_text *texts, int text_count,
                         const char *path, struct gb_error *err)
{
    (void)texts;
    (void)text_count;
    return write_vector(&pdf, figure, width, height, path, err);
}
