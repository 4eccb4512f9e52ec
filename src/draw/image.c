/* Images: pixels in memory, the sizes that users give (pixels, or a width in print), scales of
 * colours, and PNG files: single images, animations (APNG), and their text chunks. */

#include "draw/image.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/units.h"

static bool side_fits(int side)
{
    return side >= GB_IMAGE_MIN && side <= GB_IMAGE_MAX;
}

bool gb_image_create(struct gb_image **out, int width, int height, struct gb_error *err)
{
    *out = NULL;
    if (!side_fits(width) || !side_fits(height)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "an image of %d x %d pixels: expected %d to %d a side", width,
                            height, GB_IMAGE_MIN, GB_IMAGE_MAX);
    }
    struct gb_image *image = gb_alloc_array(1, sizeof *image, err);
    if (image == NULL) {
        return false;
    }
    image->width = width;
    image->height = height;
    image->rgba = gb_alloc_array((size_t)width * (size_t)height, 4, err);
    if (image->rgba == NULL) {
        gb_image_destroy(image);
        return false;
    }
    *out = image;
    return true;
}

void gb_image_destroy(struct gb_image *image)
{
    if (image == NULL) {
        return;
    }
    gb_alloc_free(image->rgba);
    gb_alloc_free(image);
}

void gb_image_swap_red_blue(struct gb_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        uint8_t *pixel = &image->rgba[4 * i];
        const uint8_t red = pixel[0];
        pixel[0] = pixel[2];
        pixel[2] = red;
    }
}

/* Up to five digits; moves *text past them. */
static bool read_side(const char **text, int *side)
{
    int value = 0;
    int digits = 0;
    while (**text >= '0' && **text <= '9' && digits < 6) {
        value = 10 * value + (**text - '0');
        (*text)++;
        digits++;
    }
    *side = value;
    return digits > 0 && digits < 6 && side_fits(value);
}

bool gb_image_parse_size(const char *text, int *width, int *height, struct gb_error *err)
{
    const char *at = text;
    int w = 0;
    int h = 0;
    if (!read_side(&at, &w) || *at++ != 'x' || !read_side(&at, &h) || *at != '\0') {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--size %s: expected WIDTHxHEIGHT in pixels, %d to %d a side",
                            text, GB_IMAGE_MIN, GB_IMAGE_MAX);
    }
    *width = w;
    *height = h;
    return true;
}

/* Inches of the units that widths are given in. */
static const struct {
    const char *name;
    double inches;
} units[] = {{"cm", 1.0 / 2.54}, {"mm", 1.0 / 25.4}, {"in", 1.0}};

const struct gb_image_journal gb_image_journals[] = {
    {"elsevier", 90.0, 140.0, 190.0, "Elsevier, Artwork sizing"},
    {"aps", 86.0, 140.0, 178.0, "APS, Style and Notation Guide; REVTeX page"},
    {"aip", 85.0, 0.0, 170.0, "AIP Publishing, Preparing your manuscript: graphics"},
    {"springer", 84.0, 0.0, 174.0, "Springer, Artwork guidelines, large journals"},
    {"wiley", 80.0, 0.0, 180.0, "Wiley, Guidelines for figure preparation"},
    {"nature", 89.0, 120.0, 183.0, "Nature, Final submission"},
    {"acs", 82.5, 0.0, 177.8, "ACS, Preparing graphics"},
    {"rsc", 83.0, 0.0, 171.0, "RSC, Prepare your article: graphics"},
    {.name = NULL},
};

/* Inches of a column of a journal; NaN: not a name of one, or the journal has none. */
static double column_inches(const char *text)
{
    for (const struct gb_image_journal *row = gb_image_journals; row->name != NULL;
         row++) {
        const size_t length = strlen(row->name);
        if (strncmp(text, row->name, length) == 0) {
            const char *columns = text + length;
            const double mm = *columns == '\0'               ? row->single_mm
                              : strcmp(columns, "-1.5") == 0 ? row->middle_mm
                              : strcmp(columns, "-2") == 0   ? row->double_mm
                                                             : 0.0;
            return mm > 0.0 ? mm / 25.4 : (double)NAN;
        }
    }
    return NAN;
}

static double inches_of(const char *text)
{
    const char *end = NULL;
    double value = 0.0;
    if (gb_units_number(text, &end, &value)) {
        end += strspn(end, " ");
        for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
            if (strcmp(end, units[i].name) == 0) {
                return value * units[i].inches;
            }
        }
    }
    return column_inches(text);
}

bool gb_image_parse_print(const char *width, int per_inch, struct gb_image_print *size,
                          struct gb_error *err)
{
    const double inches = inches_of(width);
    if (!(inches >= 0.999 && inches <= 20.0)) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--width %.80s: must be between 2.54 and 50 cm, as in 8cm, 80mm, 3.3in, or a "
            "column of a journal that plot --help lists, as elsevier, elsevier-1.5, "
            "elsevier-2",
            width);
    }
    if (per_inch < 100 || per_inch > 1200) {
        return gb_error_set(err, GB_ERR_INPUT, "--dpi %d: must be between 100 and 1200",
                            per_inch);
    }
    const double pixels = round(inches * per_inch);
    if (pixels > GB_IMAGE_MAX) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--width %.80s --dpi %d: %g pixels; expected %d", width,
                            per_inch, pixels, GB_IMAGE_MAX);
    }
    *size = (struct gb_image_print){(int)pixels, (int)round(0.75 * pixels), per_inch};
    return true;
}

enum { LAST = GB_IMAGE_MAP_ANCHORS - 1 };

static const struct gb_image_map maps[] = {
    {"viridis",
     "dark blue, green, yellow",
     false,
     0.06,
     {{68, 1, 84},
      {72, 26, 108},
      {71, 47, 125},
      {65, 68, 135},
      {57, 86, 140},
      {49, 104, 142},
      {42, 120, 142},
      {35, 136, 142},
      {31, 152, 139},
      {34, 168, 132},
      {53, 183, 121},
      {84, 197, 104},
      {122, 209, 81},
      {165, 219, 54},
      {210, 226, 27},
      {234, 229, 26},
      {253, 231, 37}}},
    {"fire",
     "violet, red, light yellow",
     false,
     0.0,
     {{60, 31, 79},
      {85, 32, 92},
      {112, 32, 100},
      {138, 30, 104},
      {163, 30, 105},
      {186, 35, 103},
      {205, 46, 99},
      {221, 62, 94},
      {234, 80, 89},
      {244, 100, 86},
      {250, 121, 85},
      {254, 142, 87},
      {255, 162, 95},
      {255, 182, 108},
      {255, 201, 126},
      {254, 220, 150},
      {255, 237, 179}}},
    {"blue-yellow",
     "blue, grey, yellow, for all kinds of colour vision",
     false,
     0.0,
     {{1, 51, 110},
      {33, 60, 113},
      {52, 70, 116},
      {68, 80, 119},
      {82, 90, 122},
      {96, 101, 125},
      {109, 112, 127},
      {122, 123, 130},
      {135, 134, 132},
      {150, 144, 133},
      {164, 154, 134},
      {179, 164, 135},
      {193, 174, 135},
      {208, 185, 136},
      {222, 196, 136},
      {237, 206, 136},
      {251, 217, 136}}},
    {"grey",
     "dark to light grey",
     false,
     0.0,
     {{53, 53, 53},
      {63, 63, 63},
      {74, 74, 74},
      {84, 84, 84},
      {95, 95, 95},
      {107, 107, 107},
      {118, 118, 118},
      {130, 130, 130},
      {142, 142, 142},
      {154, 154, 154},
      {166, 166, 166},
      {179, 179, 179},
      {191, 191, 191},
      {204, 204, 204},
      {217, 217, 217},
      {230, 230, 230},
      {243, 243, 243}}},
    {"diverging",
     "blue, light grey, brown; around 0 where the values have both signs",
     true,
     0.0,
     {{19, 83, 166},
      {65, 100, 175},
      {95, 118, 184},
      {121, 137, 193},
      {145, 156, 202},
      {169, 176, 211},
      {192, 196, 220},
      {215, 217, 229},
      {238, 238, 238},
      {230, 214, 209},
      {222, 190, 181},
      {212, 167, 154},
      {201, 144, 128},
      {189, 122, 102},
      {177, 99, 77},
      {163, 77, 53},
      {148, 53, 30}}},
    {0},
};

const struct gb_image_map *gb_image_maps(void)
{
    return maps;
}

const struct gb_image_map *gb_image_find(const char *name)
{
    for (const struct gb_image_map *map = maps; map->name != NULL; map++) {
        if (strcmp(map->name, name) == 0) {
            return map;
        }
    }
    return NULL;
}

static void interpolate(const struct gb_image_map *map, double x, uint8_t rgb[3])
{
    const double at = fmin(fmax(x, 0.0), 1.0) * LAST;
    const int k = at >= LAST ? LAST - 1 : (int)at;
    const double t = at - k;
    for (int c = 0; c < 3; c++) {
        const int low = map->anchor[k][c];
        rgb[c] = (uint8_t)lrint(low + t * (map->anchor[k + 1][c] - low));
    }
}

void gb_image_map_colour(const struct gb_image_map *map, double x, uint8_t rgb[3])
{
    const struct gb_image_map *used = map != NULL ? map : &maps[0];
    interpolate(used, used->start + (1.0 - used->start) * fmin(fmax(x, 0.0), 1.0), rgb);
}

void gb_image_viridis(double x, uint8_t rgb[3])
{
    interpolate(&maps[0], x, rgb);
}

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
                       enum gb_image_alpha alpha, const struct gb_image_text *texts,
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
        8, alpha == GB_IMAGE_OPAQUE ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
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
static void pack_row(const uint8_t *from, int width, enum gb_image_alpha channel,
                     uint8_t *to)
{
    const bool opaque = channel == GB_IMAGE_OPAQUE;
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
                   enum gb_image_alpha alpha, const struct gb_image_text *texts,
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
static bool encode_image(const struct gb_image *image, enum gb_image_alpha alpha,
                         const struct gb_image_text *texts, int text_count, char **memory,
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

bool gb_image_write(const struct gb_image *image, enum gb_image_alpha alpha,
                    const struct gb_image_text *texts, int text_count, const char *path,
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

bool gb_image_read_text(const char *path, const char *key, char **value,
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
struct gb_image_animation {
    int count, added;
    enum gb_image_alpha alpha;
    const struct gb_image_text *texts;
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

bool gb_image_animation_create(struct gb_image_animation **out, int count,
                               enum gb_image_alpha alpha,
                               const struct gb_image_text *texts, int text_count,
                               struct gb_error *err)
{
    *out = NULL;
    struct gb_image_animation *apng = gb_alloc_array(1, sizeof *apng, err);
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
        gb_image_animation_destroy(apng);
        return no_memory(err);
    }
    png_set_write_fn(apng->png, apng->stream, apng_on_data, on_flush);
    *out = apng;
    return true;
}

void gb_image_animation_destroy(struct gb_image_animation *apng)
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

static bool put_chunk(struct gb_image_animation *apng, const char *name,
                      const uint8_t *data, size_t size, struct gb_error *err)
{
    if (setjmp(png_jmpbuf(apng->png)) != 0) {
        return no_memory(err);
    }
    png_write_chunk(apng->png, (png_const_bytep)name, data, size);
    return true;
}

static bool put_control(struct gb_image_animation *apng, const struct area *area,
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

static bool put_data(struct gb_image_animation *apng, const uint8_t *data, size_t size,
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
static bool put_head(struct gb_image_animation *apng, const uint8_t *png, size_t size,
                     struct gb_error *err)
{
    uint8_t data[8] = {0}; /* repeats: 0 is unlimited */
    put_number(data, (uint32_t)apng->count);
    return (fwrite(png, 1, size, apng->stream) == size || no_memory(err)) &&
           put_chunk(apng, "acTL", data, sizeof data, err);
}

/* The chunks of a PNG as those of one frame. */
static bool put_frame(struct gb_image_animation *apng, const uint8_t *png, size_t size,
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
static bool keep_frame(struct gb_image_animation *apng, const struct gb_image *image,
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

bool gb_image_animation_add(struct gb_image_animation *apng, const struct gb_image *image,
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

bool gb_image_animation_write(struct gb_image_animation *apng, const char *path,
                              struct gb_error *err)
{
    return put_chunk(apng, "IEND", NULL, 0, err) &&
           (fflush(apng->stream) == 0 || no_memory(err)) &&
           gb_file_replace(path, apng->memory, apng->size, err);
}
