#include "draw/image/apng.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"

/* PNG specification, third edition: acTL before the first IDAT, fcTL before each frame,
 * and fdAT, which is IDAT after a number; fcTL and fdAT are numbered together. */
struct gb_apng {
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

static void on_error(png_structp png, png_const_charp text)
{
    (void)text;
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void on_data(png_structp png, png_bytep data, size_t size)
{
    if (fwrite(data, 1, size, png_get_io_ptr(png)) != size) {
        png_error(png, "out of memory");
    }
}

static void on_flush(png_structp png)
{
    (void)png;
}

static bool no_memory(struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MEMORY, "no memory for the frames of a picture");
}

bool gb_apng_create(struct gb_apng **out, int count, enum gb_png_alpha alpha,
                    const struct gb_png_text *texts, int text_count, struct gb_error *err)
{
    *out = NULL;
    struct gb_apng *apng = gb_alloc_array(1, sizeof *apng, err);
    if (apng == NULL) {
        return false;
    }
    apng->count = count;
    apng->alpha = alpha;
    apng->texts = texts;
    apng->text_count = text_count;
    apng->stream = open_memstream(&apng->memory, &apng->size);
    apng->png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning);
    if (apng->stream == NULL || apng->png == NULL) {
        gb_apng_destroy(apng);
        return no_memory(err);
    }
    png_set_write_fn(apng->png, apng->stream, on_data, on_flush);
    *out = apng;
    return true;
}

void gb_apng_destroy(struct gb_apng *apng)
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

static bool put_chunk(struct gb_apng *apng, const char *name, const uint8_t *data,
                      size_t size, struct gb_error *err)
{
    if (setjmp(png_jmpbuf(apng->png)) != 0) {
        return no_memory(err);
    }
    png_write_chunk(apng->png, (png_const_bytep)name, data, size);
    return true;
}

static bool put_control(struct gb_apng *apng, const struct area *area, int milliseconds,
                        struct gb_error *err)
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

static bool put_data(struct gb_apng *apng, const uint8_t *data, size_t size,
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
static bool put_head(struct gb_apng *apng, const uint8_t *png, size_t size,
                     struct gb_error *err)
{
    uint8_t data[8] = {0}; /* repeats: 0 is unlimited */
    put_number(data, (uint32_t)apng->count);
    return (fwrite(png, 1, size, apng->stream) == size || no_memory(err)) &&
           put_chunk(apng, "acTL", data, sizeof data, err);
}

/* The chunks of a PNG as those of one frame. */
static bool put_frame(struct gb_apng *apng, const uint8_t *png, size_t size,
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
static bool keep_frame(struct gb_apng *apng, const struct gb_image *image,
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

bool gb_apng_add(struct gb_apng *apng, const struct gb_image *image, int milliseconds,
                 struct gb_error *err)
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
        gb_png_encode(part, apng->alpha, apng->texts,
                      apng->added == 0 ? apng->text_count : 0, &memory, &size, err) &&
        put_frame(apng, (const uint8_t *)memory, size, &area, milliseconds, err) &&
        keep_frame(apng, image, err);
    free(memory);
    gb_image_destroy(part);
    apng->added += done;
    return done;
}

bool gb_apng_write(struct gb_apng *apng, const char *path, struct gb_error *err)
{
    return put_chunk(apng, "IEND", NULL, 0, err) &&
           (fflush(apng->stream) == 0 || no_memory(err)) &&
           gb_file_replace(path, apng->memory, apng->size, err);
}
