#ifndef GB_DRAW_IMAGE_PRINT_SIZE_H
#define GB_DRAW_IMAGE_PRINT_SIZE_H

#include "greenbody/status.h"

/* Pixels of an image that is printed at a width. */
struct gb_print_size {
    int width, height; /* of the shape 4:3 */
    int per_inch;      /* pixels per inch */
};

/* Letters of captions and labels in print, points: journals ask for 7 to 8, and no
 * smaller than 6 anywhere. */
#define GB_PRINT_SIZE_TEXT  7.4
#define GB_PRINT_SIZE_LEAST 6.0

/* Column widths of journals; 0: it has none of this kind. */
struct gb_print_size_journal {
    const char *name;
    double single_mm, middle_mm, double_mm; /* one column, one and a half, the page */
    const char *source;                     /* the guide that has them */
};

/* The last row has no name.  Widths are called by the name, "-1.5" or "-2" behind it. */
extern const struct gb_print_size_journal gb_print_size_journals[];

/* width      "8cm", "80 mm", "3.3 in", or a column as "elsevier" or "elsevier-2"
 * per_inch   100 to 1200
 * Errors: GB_ERR_INPUT saying what is accepted, also for more pixels than an image has. */
bool gb_print_size_parse(const char *width, int per_inch, struct gb_print_size *size,
                         struct gb_error *err);

/* Pixels of a length in points. */
static inline double gb_print_size_pixels(int per_inch, double points)
{
    return points * per_inch / 72.0;
}

#endif
