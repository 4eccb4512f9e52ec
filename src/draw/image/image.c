#include "draw/image/image.h"

#include <stdio.h>

#include "base/alloc.h"

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
