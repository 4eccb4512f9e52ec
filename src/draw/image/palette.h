#ifndef GB_DRAW_IMAGE_PALETTE_H
#define GB_DRAW_IMAGE_PALETTE_H

#include <stdbool.h>
#include <stdint.h>

/* Highest coordination number with a colour of its own, shared by larger ones. */
enum { GB_PALETTE_CONTACTS = 12, GB_PALETTE_ANCHORS = 17 };

/* A scale of colours, sRGB, with equal steps for the eye (CIELAB).  All but viridis (van der
 * Walt and Smith 2015, CC0) are straight or curved paths in CIELAB with even lightness. */
struct gb_palette_map {
    const char *name, *doc;
    bool diverging; /* two arms from a light middle */
    double
        start; /* share where values begin: a nearly black end would hide the shading */
    uint8_t anchor[GB_PALETTE_ANCHORS][3]; /* at 0, 1/16, ..., 1 */
};

/* The last row has no name; the first one is the default. */
const struct gb_palette_map *gb_palette_maps(void);
/* NULL: no scale of this name. */
const struct gb_palette_map *gb_palette_find(const char *name);
/* Colour of a value; map NULL: the default; x is limited to [0, 1]. */
void gb_palette_value(const struct gb_palette_map *map, double x, uint8_t rgb[3]);

/* Viridis from end to end; x is limited to [0, 1]. */
void gb_palette_scale(double x, uint8_t rgb[3]);

#endif
