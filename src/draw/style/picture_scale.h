#ifndef GB_DRAW_STYLE_PICTURE_SCALE_H
#define GB_DRAW_STYLE_PICTURE_SCALE_H

#include <stddef.h>

#include "draw/style/picture_style.h"

/* Scale from values to colours. */

enum gb_picture_scale_start { GB_PICTURE_SCALE_FROM_DATA, GB_PICTURE_SCALE_FROM_ZERO };

/* Ends, in the unit of the values: those of the request (per_si: of its SI numbers), else of the data,
 * rounded outwards to ticks.  Of the data: minimum and maximum, or the quantiles 2 % and 98 %
 * where the outliers beyond them would extend the scale by more than half; equal for one
 * value.  A diverging scale of values of both signs is centred at 0.  A logarithmic scale
 * takes the values above 0.
 * Errors: GB_ERR_INPUT for a logarithmic scale without such values or from 0 down,
 * GB_ERR_MEMORY. */
bool gb_picture_scale_fit(struct gb_picture_style_scale *scale, const double *value,
                          size_t count, enum gb_picture_scale_start start, double per_si,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err);

/* Whole numbers from 0 to the last one with a colour of its own, or of the request. */
bool gb_picture_scale_fit_whole(struct gb_picture_style_scale *scale,
                                const int32_t *number, size_t count,
                                const struct gb_picture_style_request *request,
                                struct gb_error *err);

/* Colour of a value; the middle of a scale of one value. */
void gb_picture_scale_colour(const struct gb_picture_style_scale *scale, double value,
                             uint8_t rgb[3]);

#endif
