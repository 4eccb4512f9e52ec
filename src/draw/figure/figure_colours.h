#ifndef GB_DRAW_FIGURE_FIGURE_COLOURS_H
#define GB_DRAW_FIGURE_FIGURE_COLOURS_H

#include <stdint.h>

/* Colours of the curves of figures, sRGB: sky blue, orange, green, purple, red, blue, the
 * hues of the workbench (tui/term/term.c) in its order.  Two of them, or one and
 * black, differ by 14 at least in CIEDE2000, also for protanopia, deuteranopia and tritanopia
 * (matrices of Machado et al. 2009); contrast with white 2.8 at least.
 * tests/draw/test_figure_colours.c computes both. */
enum { GB_FIGURE_COLOURS = 6 };
extern const uint8_t gb_figure_colours[GB_FIGURE_COLOURS][3];

/* Of measured points and of lines that are no run. */
extern const uint8_t gb_figure_colours_black[3];

#endif
