#ifndef GB_DRAW_CAPTION_CAPTION_NUMBER_H
#define GB_DRAW_CAPTION_CAPTION_NUMBER_H

#include <stddef.h>

#include "base/units.h"

/* A quantity with its unit; the prefix micro as a Greek letter. */
void gb_caption_number_format(double value, enum gb_dimension dimension, int digits,
                              char *text, size_t size);

#endif
