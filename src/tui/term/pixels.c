#include "tui/term/pixels.h"

#include <glib.h>
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/built_with.h"
#include "base/file.h"
#include "tui/panel/sphere_shading.h"
#include "tui/term/settings.h"
#include "tui/term/term.h"

/* --- PNG files ---------------------------------------------------------------------- */

enum { CHANNELS = 3, SIDE_MAX = 16384, FILE_PIXELS_MAX = 64 << 20 };

static const png_color white = {255, 255, 255};

/* Opens a PNG file. libpng does not close *stream; the caller does, even after an
 * error. */
static bool begin(png_image *png, FILE **stream, const char *path, struct gb_error *err)
{
    const int fd = gb_file_open(path, err);
    *png = (png_image){.version = PNG_IMAGE_VERSION};
    *stream = fd >= 0 ? fdopen(fd, "rb") : NULL;
    if (*stream == NULL) {
        if (fd >= 0) {
            close(fd);
        }
        return fd >= 0 ? gb_error_set(err, GB_ERR_MEMORY, "out of memory") : false;
    }
    if (!png_image_begin_read_from_stdio(png, *stream)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s: %.64s", path, png->message);
    }
    return (png->width <= SIDE_MAX && png->height <= SIDE_MAX &&
            (uint64_t)png->width * png->height <= FILE_PIXELS_MAX) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: too large for the screen: %u x %u pixels", path,
                        png->width, png->height);
}

static void end(png_image *png, FILE *stream)
{
    png_image_free(png);
    if (stream != NULL) {
        fclose(stream);
    }
}

static uint32_t big_endian(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 |
           bytes[3];
}

/* Reads pixels per inch from the chunk pHYs before the image data, which the simplified
 * functions of libpng ignore. */
static double read_per_inch(FILE *stream)
{
    enum { HEAD = 8, SUM = 4, SIGNATURE = 8, BODY = 9, PER_METRE = 1 };
    uint8_t head[HEAD], body[BODY];
    if (fseek(stream, SIGNATURE, SEEK_SET) != 0) {
        return 0.0;
    }
    while (fread(head, HEAD, 1, stream) == 1 && memcmp(head + 4, "IDAT", 4) != 0) {
        const uint32_t length = big_endian(head);
        if (memcmp(head + 4, "pHYs", 4) == 0) {
            const bool whole = length == BODY && fread(body, BODY, 1, stream) == 1;
            return whole && body[BODY - 1] == PER_METRE ? big_endian(body) * 0.0254 : 0.0;
        }
        if (length > INT32_MAX || fseek(stream, (long)length + SUM, SEEK_CUR) != 0) {
            return 0.0;
        }
    }
    return 0.0;
}

bool gb_pixels_png_measure(struct gb_png_pixels *out, const char *path,
                           struct gb_error *err)
{
    png_image png;
    FILE *stream = NULL;
    const bool good = begin(&png, &stream, path, err);
    *out = (struct gb_png_pixels){0};
    if (good) {
        out->wide = (int)png.width;
        out->high = (int)png.height;
        out->per_inch = read_per_inch(stream);
    }
    end(&png, stream);
    return good;
}

/* Reads the rows of pixels; false with err. */
static bool read_rows(struct gb_png_pixels *out, png_image *png, const char *path,
                      struct gb_error *err)
{
    png->format = PNG_FORMAT_RGB;
    out->wide = (int)png->width;
    out->high = (int)png->height;
    out->rgb = gb_alloc_array((size_t)png->width * png->height, CHANNELS, err);
    return out->rgb != NULL &&
           (png_image_finish_read(png, &white, out->rgb, 0, NULL) ||
            gb_error_set(err, GB_ERR_INPUT, "%.300s: %.64s", path, png->message));
}

bool gb_pixels_png_read(struct gb_png_pixels *out, const char *path, struct gb_error *err)
{
    png_image png;
    FILE *stream = NULL;
    *out = (struct gb_png_pixels){0};
    const bool good = begin(&png, &stream, path, err) && read_rows(out, &png, path, err);
    end(&png, stream);
    if (!good) {
        gb_pixels_png_finish(out);
    }
    return good;
}

void gb_pixels_png_finish(struct gb_png_pixels *pixels)
{
    gb_alloc_free(pixels->rgb);
    memset(pixels, 0, sizeof *pixels);
}

/* --- image protocols ---------------------------------------------------------------- */

static const char *wipe(int images)
{
    return images == GB_IMAGES_KITTY ? "\033_Ga=d\033\\" : "";
}

#if GB_WITH_CHAFA

#include <chafa.h>

/* The shades of term.c as red, green, blue. */
static const uint8_t ramp[][3] = {{0, 0, 95},      {0, 95, 95},    {0, 95, 135},
                                  {0, 135, 175},   {0, 175, 215},  {95, 175, 215},
                                  {135, 215, 255}, {215, 255, 255}};
static const uint8_t background[3] = {12, 12, 16}, outline[3] = {150, 150, 150};

enum { RAMP = sizeof ramp / sizeof ramp[0], LEVELS = 28, PIXELS_MAX = 1600 * 1200 };

bool gb_pixels_available(void)
{
    return true;
}

static ChafaTermInfo *describe_terminal(void)
{
    char **env = g_get_environ();
    ChafaTermDb *db = chafa_term_db_get_default();
    ChafaTermInfo *info = chafa_term_db_detect(db, env);
    g_strfreev(env);
    return info;
}

int gb_pixels_detect(void)
{
    ChafaTermInfo *info = describe_terminal();
    const bool kitty =
        chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1);
    const bool sixel = chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_SIXELS);
    chafa_term_info_unref(info);
    return kitty ? GB_IMAGES_KITTY : sixel ? GB_IMAGES_SIXEL : GB_IMAGES_NONE;
}

static void put_pixel(uint8_t *pixel, float shade)
{
    if (shade < 0.0F) {
        memcpy(pixel, background, sizeof background);
        return;
    }
    if (shade > 1.0F) {
        memcpy(pixel, outline, sizeof outline);
        return;
    }
    /* in levels: runs of equal colour compress well */
    const float level = floorf(CLAMP(shade, 0.0F, 1.0F) * (float)LEVELS) / (float)LEVELS;
    const float at = level * (float)(RAMP - 1);
    const int low = MIN((int)at, RAMP - 2);
    const float part = at - (float)low;
    for (int k = 0; k < 3; k++) {
        pixel[k] = (uint8_t)((1.0F - part) * (float)ramp[low][k] +
                             part * (float)ramp[low + 1][k] + 0.5F);
    }
}

static char *print(int images, const uint8_t *rgb, int high, int wide, int rows, int cols,
                   struct gb_pixels_cell cell)
{
#if GB_CHAFA_POOL
    /* one thread, because the engine needs the cores */
    chafa_set_n_threads(1);
#endif
    ChafaTermInfo *info = describe_terminal();
    ChafaTermInfo *all = chafa_term_db_get_fallback_info(chafa_term_db_get_default());
    ChafaCanvasConfig *config = chafa_canvas_config_new();
    chafa_term_info_supplement(info, all);
    chafa_canvas_config_set_geometry(config, cols, rows);
    chafa_canvas_config_set_cell_geometry(config, cell.width, cell.height);
    chafa_canvas_config_set_canvas_mode(config, CHAFA_CANVAS_MODE_TRUECOLOR);
    chafa_canvas_config_set_dither_mode(config, CHAFA_DITHER_MODE_NONE);
    chafa_canvas_config_set_pixel_mode(config, images == GB_IMAGES_KITTY
                                                   ? CHAFA_PIXEL_MODE_KITTY
                                                   : CHAFA_PIXEL_MODE_SIXELS);
    ChafaCanvas *canvas = chafa_canvas_new(config);
    chafa_canvas_draw_all_pixels(canvas, CHAFA_PIXEL_RGB8, rgb, wide, high, wide * 3);
    GString *text = chafa_canvas_print(canvas, info);
    chafa_canvas_unref(canvas);
    chafa_canvas_config_unref(config);
    chafa_term_info_unref(all);
    chafa_term_info_unref(info);
    return g_string_free(text, FALSE);
}

static char *encode(int images, const struct gb_view_sample *sample,
                    const struct gb_packing_look *look, int rows, int cols,
                    struct gb_pixels_cell cell)
{
    const int wide = cols * cell.width, high = rows * cell.height;
    const size_t count = (size_t)wide * (size_t)high;
    if (count == 0 || count > PIXELS_MAX) {
        return NULL;
    }
    float *shade = gb_alloc_array(count, sizeof *shade, NULL);
    uint8_t *rgb = gb_alloc_array(count, 3, NULL);
    char *text = NULL;
    if (shade != NULL && rgb != NULL) {
        gb_sphere_shading_render(sample, look, high, wide, shade);
        for (size_t i = 0; i < count; i++) {
            put_pixel(rgb + 3 * i, shade[i]);
        }
        text = print(images, rgb, high, wide, rows, cols, cell);
    }
    gb_alloc_free(shade);
    gb_alloc_free(rgb);
    return text;
}

static char *encode_picture(int images, const struct gb_png_pixels *picture, int rows,
                            int cols, struct gb_pixels_cell cell)
{
    return print(images, picture->rgb, picture->high, picture->wide, rows, cols, cell);
}

#else

bool gb_pixels_available(void)
{
    return false;
}

int gb_pixels_detect(void)
{
    return GB_IMAGES_NONE;
}

static char *encode(int images, const struct gb_view_sample *sample,
                    const struct gb_packing_look *look, int rows, int cols,
                    struct gb_pixels_cell cell)
{
    (void)images;
    (void)sample;
    (void)look;
    (void)rows;
    (void)cols;
    (void)cell;
    return NULL;
}

static char *encode_picture(int images, const struct gb_png_pixels *picture, int rows,
                            int cols, struct gb_pixels_cell cell)
{
    (void)images;
    (void)picture;
    (void)rows;
    (void)cols;
    (void)cell;
    return NULL;
}

#endif

/* --- the image on the screen -------------------------------------------------------- */

static const double spacing_s = 1.0;

void gb_pixels_image_init(struct gb_term_image *image, int images)
{
    *image = (struct gb_term_image){.images = images, .last_s = -spacing_s};
}

static bool is_empty(const struct gb_term_picture *wanted)
{
    return wanted->sample == NULL && wanted->picture == NULL;
}

bool gb_pixels_image_before(struct gb_term_image *image, struct gb_term *term,
                            const struct gb_term_picture *wanted)
{
    if (!image->shown || (!is_empty(wanted) && wanted->picture == image->picture)) {
        return false;
    }
    gb_term_send(term, 0, 0, wipe(image->images));
    image->shown = image->waiting = false;
    return true;
}

static bool same_rect(const struct gb_rect *a, const struct gb_rect *b)
{
    return a->row == b->row && a->col == b->col && a->rows == b->rows &&
           a->cols == b->cols;
}

static bool same_look(const struct gb_packing_look *a, const struct gb_packing_look *b)
{
    return a->colour == b->colour && a->azimuth_deg == b->azimuth_deg &&
           a->elevation_deg == b->elevation_deg;
}

bool gb_pixels_image_due(const struct gb_term_image *image, double now_s)
{
    return image->waiting && now_s >= image->last_s + spacing_s;
}

/* The largest rectangle with the shape of the picture, centred in the cells. */
static struct gb_rect fit_shape(const struct gb_png_pixels *picture,
                                const struct gb_rect *cells, struct gb_pixels_cell cell)
{
    struct gb_rect fitted = *cells;
    const double shape = (double)picture->wide / (double)picture->high;
    const double cols_per_row = shape * (double)cell.height / (double)cell.width;
    fitted.cols = CLAMP((int)(cols_per_row * (double)cells->rows), 1, cells->cols);
    fitted.rows = CLAMP((int)((double)fitted.cols / cols_per_row + 0.5), 1, cells->rows);
    fitted.row += (cells->rows - fitted.rows) / 2;
    fitted.col += (cells->cols - fitted.cols) / 2;
    return fitted;
}

static void show(struct gb_term_image *image, struct gb_term *term,
                 const struct gb_term_picture *wanted)
{
    struct gb_pixels_cell cell;
    struct gb_rect cells = *wanted->cells;
    char *text = NULL;
    gb_term_cell(term, &cell.width, &cell.height);
    if (wanted->picture != NULL) {
        cells = fit_shape(wanted->picture, &cells, cell);
        text =
            encode_picture(image->images, wanted->picture, cells.rows, cells.cols, cell);
    } else {
        text = encode(image->images, wanted->sample, wanted->look, cells.rows, cells.cols,
                      cell);
    }
    if (text != NULL) {
        gb_term_send(term, cells.row, cells.col, wipe(image->images));
        gb_term_send(term, cells.row, cells.col, text);
    }
    g_free(text);
}

void gb_pixels_image_after(struct gb_term_image *image, struct gb_term *term,
                           const struct gb_term_picture *wanted, double now_s)
{
    const struct gb_rect *cells = wanted->cells;
    const bool wiped = image->repaints != gb_term_repaints(term);
    image->repaints = gb_term_repaints(term);
    if (is_empty(wanted) || cells->rows < 1 || cells->cols < 1) {
        return;
    }
    const double density = wanted->sample != NULL ? wanted->sample->density : 0.0;
    const bool other = !image->shown || wiped || !same_rect(cells, &image->rect) ||
                       (wanted->sample != NULL && !same_look(wanted->look, &image->look));
    image->waiting = density != image->density;
    if (!other && !gb_pixels_image_due(image, now_s)) {
        return;
    }
    show(image, term, wanted);
    image->shown = true;
    image->waiting = false;
    image->rect = *cells;
    image->density = density;
    image->picture = wanted->picture;
    image->look = *wanted->look;
    image->last_s = now_s;
}
