#ifndef GB_DRAW_IMAGE_PALETTE_H
#define GB_DRAW_IMAGE_PALETTE_H

#include <stdint.h>

/* Highest coordination number with a colour of its own, shared by larger ones. */
enum { GB_PALETTE_CONTACTS = 12 };

/* Perceptually uniform scale, also for colour-blind readers and in grey: viridis (van der
 * Walt and Smith 2015, CC0).  x is limited to [0, 1]; rgb is sRGB. */
void gb_palette_scale(double x, uint8_t rgb[3]);

/* Colour of a coordination number; below 0 counts as 0. */
void gb_palette_contacts(int contacts, uint8_t rgb[3]);

/* Scale of continuous values: viridis without its nearly black end, which would hide the
 * shading; x is limited to [0, 1]. */
void gb_palette_field(double x, uint8_t rgb[3]);

#endif
