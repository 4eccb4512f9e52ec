#ifndef GB_DRAW_PICTURE_COLOURS_H
#define GB_DRAW_PICTURE_COLOURS_H

#include <stddef.h>

#include "draw/picture_style.h"
#include "greenbody/dimension.h"

/* The table of quantities that colour a picture (`--color`).  A quantity is a function and a
 * row in picture_colours.c; parser, messages and help follow from the row. */

enum gb_picture_colours_kind { GB_PICTURE_COLOURS_PARTICLES, GB_PICTURE_COLOURS_FORCES };

struct gb_picture_colours_row {
    const char *name;
    const char *doc;
    enum gb_picture_colours_kind kind;
    /* Of particles: fills colours and scale. */
    bool (*particles)(struct gb_picture_style *style, const struct gb_state *state,
                      const struct gb_picture_style_request *request,
                      struct gb_error *err);
    enum gb_dimension dimension; /* of --range */
    /* Of forces: two classes, and the class of a contact (0 or 1). */
    struct gb_picture_style_legend legend[2];
    int (*force_class)(const struct gb_state *state, int64_t pair);
    int (*wall_class)(double normal); /* of a contact with a wall */
};

/* NULL: no quantity of this name. */
const struct gb_picture_colours_row *gb_picture_colours_find(const char *name);
/* Names of one kind, separated by commas; g_free. */
char *gb_picture_colours_names(enum gb_picture_colours_kind kind);

/* Colour of a value; the middle of a scale of one value. */
void gb_picture_colours_at(const struct gb_picture_style_scale *scale, double value,
                           uint8_t rgb[3]);

#endif
