#ifndef GB_DRAW_FIGURE_FIGURE_RANGE_H
#define GB_DRAW_FIGURE_FIGURE_RANGE_H

#include "draw/figure/figure.h"

enum gb_figure_range_axis { GB_FIGURE_RANGE_X, GB_FIGURE_RANGE_Y };

/* Range of an axis: the given ends, else those of the data with a margin for markers.  A
 * linear range whose minimum is positive and small against its maximum starts at zero. */
void gb_figure_range_find(const struct gb_figure *figure, enum gb_figure_range_axis which,
                          double *low, double *high);

/* Range of y over the x range of the inset. */
void gb_figure_range_inset(const struct gb_figure *figure, double *low, double *high);

#endif
