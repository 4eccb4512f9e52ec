/* PNG files: single images, animations (APNG), and their text chunks. */
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
#include "draw/image/image.h"

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

/* Encodes an image into memory, which belongs to the caller (free). */
static bool encode_image(const struct gb_image *image, enum gb_png_alpha alpha,
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
        encode_image(image, alpha, texts, text_count, &memory, &size, err) &&
        gb_file_replace(path, memory, size, err);
    free(memory);
    return done;
}

static bool no_chunk(const char *path, const char *key, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: has no text chunk %s; expected a PNG written by "
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
    const int file = gb_file_open(path, err);
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

/* PNG specification, third edition: acTL before the first IDAT, fcTL before each frame,
 * and fdAT, which is IDAT after a number; fcTL and fdAT are numbered together. */
struct gb_png_animation {
    int count, added;
    enum gb_png_alpha alpha;
    const struct gb_png_text *texts;
    int text_count;
    struct gb_image *before;
    uint32_t number;
    FILE *stream;
    char *memory;
    size_t size;
    png_structp png;
};

struct area {
    int x, y, width, height;
};

static void apng_on_error(png_structp png, png_const_charp text)
{
    (void)text;
    png_longjmp(png, 1);
}

static void apng_on_data(png_structp png, png_bytep data, size_t size)
{
    if (fwrite(data, 1, size, png_get_io_ptr(png)) != size) {
        png_error(png, "out of memory");
    }
}

static bool no_memory(struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MEMORY, "no memory for the frames of a picture");
}

bool gb_png_animation_create(struct gb_png_animation **out, int count,
                             enum gb_png_alpha alpha, const struct gb_png_text *texts,
                             int text_count, struct gb_error *err)
{
    *out = NULL;
    struct gb_png_animation *apng = gb_alloc_array(1, sizeof *apng, err);
    if (apng == NULL) {
        return false;
    }
    apng->count = count;
    apng->alpha = alpha;
    apng->texts = texts;
    apng->text_count = text_count;
    apng->stream = open_memstream(&apng->memory, &apng->size);
    apng->png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, apng_on_error, on_warning);
    if (apng->stream == NULL || apng->png == NULL) {
        gb_png_animation_destroy(apng);
        return no_memory(err);
    }
    png_set_write_fn(apng->png, apng->stream, apng_on_data, on_flush);
    *out = apng;
    return true;
}

void gb_png_animation_destroy(struct gb_png_animation *apng)
{
    if (apng == NULL) {
        return;
    }
    if (apng->png != NULL) {
        png_destroy_write_struct(&apng->png, NULL);
    }
    if (apng->stream != NULL) {
        fclose(apng->stream);
    }
    free(apng->memory);
    gb_image_destroy(apng->before);
    gb_alloc_free(apng);
}

static void put_number(uint8_t *to, uint32_t value)
{
    for (int k = 0; k < 4; k++) {
        to[k] = (uint8_t)(value >> (24 - 8 * k));
    }
}

static uint32_t get_number(const uint8_t *from)
{
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 |
           from[3];
}

static bool put_chunk(struct gb_png_animation *apng, const char *name,
                      const uint8_t *data, size_t size, struct gb_error *err)
{
    if (setjmp(png_jmpbuf(apng->png)) != 0) {
        return no_memory(err);
    }
    png_write_chunk(apng->png, (png_const_bytep)name, data, size);
    return true;
}

static bool put_control(struct gb_png_animation *apng, const struct area *area,
                        int milliseconds, struct gb_error *err)
{
    uint8_t data[26] = {0}; /* the last two: no disposal, no blending */
    put_number(data, apng->number++);
    put_number(data + 4, (uint32_t)area->width);
    put_number(data + 8, (uint32_t)area->height);
    put_number(data + 12, (uint32_t)area->x);
    put_number(data + 16, (uint32_t)area->y);
    data[20] = (uint8_t)(milliseconds >> 8);
    data[21] = (uint8_t)milliseconds;
    data[22] = 1000 >> 8;
    data[23] = 1000 & 255;
    return put_chunk(apng, "fcTL", data, sizeof data, err);
}

static bool put_data(struct gb_png_animation *apng, const uint8_t *data, size_t size,
                     struct gb_error *err)
{
    if (apng->added == 0) {
        return put_chunk(apng, "IDAT", data, size, err);
    }
    uint8_t *numbered = gb_alloc_array(size + 4, 1, err);
    if (numbered == NULL) {
        return false;
    }
    put_number(numbered, apng->number++);
    memcpy(numbered + 4, data, size);
    const bool done = put_chunk(apng, "fdAT", numbered, size + 4, err);
    gb_alloc_free(numbered);
    return done;
}

/* Signature and header of the file, and acTL. */
static bool put_head(struct gb_png_animation *apng, const uint8_t *png, size_t size,
                     struct gb_error *err)
{
    uint8_t data[8] = {0}; /* repeats: 0 is unlimited */
    put_number(data, (uint32_t)apng->count);
    return (fwrite(png, 1, size, apng->stream) == size || no_memory(err)) &&
           put_chunk(apng, "acTL", data, sizeof data, err);
}

/* The chunks of a PNG as those of one frame. */
static bool put_frame(struct gb_png_animation *apng, const uint8_t *png, size_t size,
                      const struct area *area, int milliseconds, struct gb_error *err)
{
    bool started = false;
    bool done = true;
    size_t at = 8; /* behind the signature */
    while (done && at + 12 <= size) {
        const size_t length = get_number(png + at);
        if (memcmp(png + at + 4, "IDAT", 4) == 0) {
            done = (started || ((apng->added > 0 || put_head(apng, png, at, err)) &&
                                put_control(apng, area, milliseconds, err))) &&
                   put_data(apng, png + at + 8, length, err);
            started = true;
        }
        at += length + 12;
    }
    return done;
}

/* Rectangle that differs; one pixel for equal images. */
static struct area changed(const struct gb_image *before, const struct gb_image *image)
{
    int left = image->width;
    int right = -1;
    int top = image->height;
    int bottom = -1;
    for (int y = 0; y < image->height; y++) {
        const size_t row = 4 * (size_t)y * (size_t)image->width;
        for (int x = 0; x < image->width; x++) {
            const size_t at = row + 4 * (size_t)x;
            if (memcmp(&image->rgba[at], &before->rgba[at], 4) != 0) {
                left = x < left ? x : left;
                right = x > right ? x : right;
                top = y < top ? y : top;
                bottom = y;
            }
        }
    }
    return right < 0 ? (struct area){0, 0, 1, 1}
                     : (struct area){left, top, right - left + 1, bottom - top + 1};
}

static bool cut_out(struct gb_image **out, const struct gb_image *image,
                    const struct area *area, struct gb_error *err)
{
    struct gb_image *part = gb_alloc_array(1, sizeof *part, err);
    *out = part;
    if (part == NULL) {
        return false;
    }
    part->width = area->width;
    part->height = area->height;
    part->rgba = gb_alloc_array((size_t)area->width * (size_t)area->height, 4, err);
    for (int y = 0; y < area->height && part->rgba != NULL; y++) {
        const size_t from =
            (size_t)(area->y + y) * (size_t)image->width + (size_t)area->x;
        memcpy(&part->rgba[4 * (size_t)y * (size_t)area->width], &image->rgba[4 * from],
               4 * (size_t)area->width);
    }
    return part->rgba != NULL;
}

/* Keeps the frame for the comparison with the next. */
static bool keep_frame(struct gb_png_animation *apng, const struct gb_image *image,
                       struct gb_error *err)
{
    if (apng->before == NULL &&
        !gb_image_create(&apng->before, image->width, image->height, err)) {
        return false;
    }
    memcpy(apng->before->rgba, image->rgba,
           4 * (size_t)image->width * (size_t)image->height);
    return true;
}

bool gb_png_animation_add(struct gb_png_animation *apng, const struct gb_image *image,
                          int milliseconds, struct gb_error *err)
{
    struct area area = {0, 0, image->width, image->height};
    struct gb_image *part = NULL;
    char *memory = NULL;
    size_t size = 0;
    if (apng->before != NULL) {
        area = changed(apng->before, image);
    }
    const bool done =
        cut_out(&part, image, &area, err) &&
        encode_image(part, apng->alpha, apng->texts,
                     apng->added == 0 ? apng->text_count : 0, &memory, &size, err) &&
        put_frame(apng, (const uint8_t *)memory, size, &area, milliseconds, err) &&
        keep_frame(apng, image, err);
    free(memory);
    gb_image_destroy(part);
    apng->added += done;
    return done;
}

bool gb_png_animation_write(struct gb_png_animation *apng, const char *path,
                            struct gb_error *err)
{
    return put_chunk(apng, "IEND", NULL, 0, err) &&
           (fflush(apng->stream) == 0 || no_memory(err)) &&
           gb_file_replace(path, apng->memory, apng->size, err);
}
