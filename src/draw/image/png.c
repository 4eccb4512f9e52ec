#include "draw/image/png.h"

#include <errno.h>
#include <glib.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/read_file.h"

enum { TEXTS_MAX = 16, LEVEL = 5 /* of zlib: half the time of 6 for 2 % more bytes */ };

/* State that survives the longjmp of libpng. */
struct writer {
    png_structp png;
    png_infop info;
    FILE *stream; /* grows in memory */
    uint8_t *row;
    char reason[120];
};

static void on_error(png_structp png, png_const_charp text)
{
    struct writer *writer = png_get_error_ptr(png);
    g_strlcpy(writer->reason, text, sizeof writer->reason);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void on_data(png_structp png, png_bytep data, size_t size)
{
    struct writer *writer = png_get_io_ptr(png);
    if (fwrite(data, 1, size, writer->stream) != size) {
        png_error(png, "out of memory");
    }
}

static void on_flush(png_structp png)
{
    (void)png;
}

static void put_header(struct writer *writer, const struct gb_image *image,
                       enum gb_png_alpha alpha, const struct gb_png_text *texts,
                       int text_count)
{
    png_text text[TEXTS_MAX];
    memset(text, 0, sizeof text);
    for (int k = 0; k < text_count; k++) {
        text[k].compression = g_str_is_ascii(texts[k].value) ? PNG_TEXT_COMPRESSION_NONE
                                                             : PNG_ITXT_COMPRESSION_NONE;
        text[k].key = (png_charp)(uintptr_t)texts[k].key;
        text[k].text = (png_charp)(uintptr_t)texts[k].value;
    }
    png_set_IHDR(
        writer->png, writer->info, (png_uint_32)image->width, (png_uint_32)image->height,
        8, alpha == GB_PNG_OPAQUE ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
        PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(writer->png, writer->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(writer->png, writer->info, text, text_count);
    if (image->per_inch > 0) {
        const double per_metre = image->per_inch / 0.0254;
        const png_uint_32 whole = (png_uint_32)(per_metre + 0.5);
        png_set_pHYs(writer->png, writer->info, whole, whole, PNG_RESOLUTION_METER);
    }
    png_set_compression_level(writer->png, LEVEL);
    png_write_info(writer->png, writer->info);
}

/* PNG stores colours that are not multiplied by alpha. */
static void pack_row(const uint8_t *from, int width, enum gb_png_alpha channel,
                     uint8_t *to)
{
    const bool opaque = channel == GB_PNG_OPAQUE;
    for (int x = 0; x < width; x++, from += 4) {
        const unsigned alpha = from[3];
        for (int k = 0; k < 3; k++) {
            const unsigned whole = alpha == 0 ? 0 : (255U * from[k] + alpha / 2) / alpha;
            *to++ = opaque ? from[k] : (uint8_t)MIN(whole, 255U);
        }
        if (!opaque) {
            *to++ = (uint8_t)alpha;
        }
    }
}

static bool encode(struct writer *writer, const struct gb_image *image,
                   enum gb_png_alpha alpha, const struct gb_png_text *texts,
                   int text_count)
{
    if (setjmp(png_jmpbuf(writer->png)) != 0) {
        return false;
    }
    png_set_write_fn(writer->png, writer, on_data, on_flush);
    put_header(writer, image, alpha, texts, text_count);
    for (int y = 0; y < image->height; y++) {
        pack_row(&image->rgba[4 * (size_t)y * (size_t)image->width], image->width, alpha,
                 writer->row);
        png_write_row(writer->png, writer->row);
    }
    png_write_end(writer->png, writer->info);
    return true;
}

bool gb_png_encode(const struct gb_image *image, enum gb_png_alpha alpha,
                   const struct gb_png_text *texts, int text_count, char **memory,
                   size_t *size, struct gb_error *err)
{
    struct writer writer = {.png = NULL};
    *memory = NULL;
    writer.row = gb_alloc_array((size_t)image->width, 4, err);
    if (writer.row == NULL) {
        return false;
    }
    writer.stream = open_memstream(memory, size);
    writer.png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, on_error, on_warning);
    writer.info = writer.png != NULL ? png_create_info_struct(writer.png) : NULL;
    bool done = writer.stream != NULL && writer.info != NULL &&
                encode(&writer, image, alpha, texts, MIN(text_count, TEXTS_MAX));
    if (writer.png != NULL) {
        png_destroy_write_struct(&writer.png, &writer.info);
    }
    if (writer.stream != NULL && fclose(writer.stream) != 0) {
        done = false;
    }
    gb_alloc_free(writer.row);
    if (!done) {
        free(*memory);
        *memory = NULL;
    }
    return done || gb_error_set(err, GB_ERR_MEMORY, "libpng cannot write the picture: %s",
                                writer.reason[0] != '\0' ? writer.reason : "no memory");
}

bool gb_png_write(const struct gb_image *image, enum gb_png_alpha alpha,
                  const struct gb_png_text *texts, int text_count, const char *path,
                  struct gb_error *err)
{
    char *memory = NULL;
    size_t size = 0;
    const bool done =
        gb_file_check_target(path, err) &&
        gb_png_encode(image, alpha, texts, text_count, &memory, &size, err) &&
        gb_file_replace(path, memory, size, err);
    free(memory);
    return done;
}

static bool no_chunk(const char *path, const char *key, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: has no text chunk %s; accepted a PNG written by "
                        "greenbody from a run",
                        path, key);
}

/* A preset has some kilobytes; libpng allocates the claimed size of a chunk before it
 * reads it. */
static const png_alloc_size_t max_text_size = 4 << 20;

/* State that survives the longjmp of libpng. */
struct reader {
    png_structp png;
    png_infop info;
    FILE *file;
    char *value;
};

static bool find_text(struct reader *reader, const char *key)
{
    png_textp text = NULL;
    int count = 0;
    if (setjmp(png_jmpbuf(reader->png)) != 0) {
        return false;
    }
    png_init_io(reader->png, reader->file);
    png_set_chunk_malloc_max(reader->png, max_text_size);
    png_set_benign_errors(reader->png,
                          0); /* else exceeding the limit is a warning only */
    png_read_info(reader->png, reader->info);
    png_get_text(reader->png, reader->info, &text, &count);
    for (int k = 0; k < count && reader->value == NULL; k++) {
        if (strcmp(text[k].key, key) == 0) {
            reader->value = g_strdup(text[k].text);
        }
    }
    return reader->value != NULL;
}

static FILE *open_picture(const char *path, struct gb_error *err)
{
    const int file = gb_read_file_open(path, err);
    FILE *stream = file >= 0 ? fdopen(file, "rb") : NULL;
    if (file >= 0 && stream == NULL) {
        gb_error_set(err, GB_ERR_MEMORY, "%.300s: %s", path, g_strerror(errno));
        close(file);
    }
    return stream;
}

bool gb_png_read_text(const char *path, const char *key, char **value,
                      struct gb_error *err)
{
    struct writer silent = {.png = NULL}; /* for on_error */
    struct reader reader = {.file = open_picture(path, err)};
    *value = NULL;
    if (reader.file == NULL) {
        return false;
    }
    reader.png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &silent, on_error, on_warning);
    reader.info = reader.png != NULL ? png_create_info_struct(reader.png) : NULL;
    const bool good = reader.info != NULL && find_text(&reader, key);
    if (reader.png != NULL) {
        png_destroy_read_struct(&reader.png, &reader.info, NULL);
    }
    fclose(reader.file);
    *value = reader.value;
    return good || no_chunk(path, key, err);
}
