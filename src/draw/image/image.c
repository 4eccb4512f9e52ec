/* Images in memory, and the sizes that users give: pixels, or a width in print. */
#include "draw/image/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/units.h"
#include "greenbody/status.h"

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

static bool side_fits(int side)
{
    return side >= GB_IMAGE_MIN && side <= GB_IMAGE_MAX;
}

bool gb_image_create(struct gb_image **out, int width, int height, struct gb_error *err)
{
    *out = NULL;
    if (!side_fits(width) || !side_fits(height)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "an image of %d x %d pixels: %d to %d a side are accepted",
                            width, height, GB_IMAGE_MIN, GB_IMAGE_MAX);
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

/* Up to five digits; moves *text behind them. */
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
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--size %s: WIDTHxHEIGHT in pixels is accepted, %d to %d a side", text,
            GB_IMAGE_MIN, GB_IMAGE_MAX);
    }
    *width = w;
    *height = h;
    return true;
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
