#include "tui/term/png_pixels.h"

#include <png.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/read_file.h"

enum { CHANNELS = 3, SIDE_MAX = 16384, PIXELS_MAX = 64 << 20 };

static const png_color white = {255, 255, 255};

/* libpng closes nothing: *stream is for the caller, also after an error. */
static bool begin(png_image *png, FILE **stream, const char *path, struct gb_error *err)
{
    const int fd = gb_read_file_open(path, err);
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
            (uint64_t)png->width * png->height <= PIXELS_MAX) ||
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

/* Pixels per inch of the chunk pHYs, which stands before the image data; libpng's simplified
 * functions leave it out. */
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

bool gb_png_pixels_measure(struct gb_png_pixels *out, const char *path,
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

/* False with err. */
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

bool gb_png_pixels_read(struct gb_png_pixels *out, const char *path, struct gb_error *err)
{
    png_image png;
    FILE *stream = NULL;
    *out = (struct gb_png_pixels){0};
    const bool good = begin(&png, &stream, path, err) && read_rows(out, &png, path, err);
    end(&png, stream);
    if (!good) {
        gb_png_pixels_finish(out);
    }
    return good;
}

void gb_png_pixels_finish(struct gb_png_pixels *pixels)
{
    gb_alloc_free(pixels->rgb);
    memset(pixels, 0, sizeof *pixels);
}
