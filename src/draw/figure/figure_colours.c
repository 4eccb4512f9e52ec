#include "draw/figure/figure_colours.h"

const uint8_t gb_figure_colours[GB_FIGURE_COLOURS][3] = {
    {0, 160, 215}, {215, 135, 0}, {0, 135, 95}, {175, 0, 135}, {215, 0, 0}, {0, 95, 255}};

const uint8_t gb_figure_colours_black[3] = {26, 26, 31};
