#ifndef GB_DRAW_FIGURE_FIGURE_OCCUPANCY_H
#define GB_DRAW_FIGURE_FIGURE_OCCUPANCY_H

#include <stdbool.h>

#include "draw/figure/figure.h"

/* Raster of the parts of the frame that curves cover, to find free space for texts. */
struct gb_figure_occupancy {
    double left, top; /* of the frame, points */
    int wide, high;   /* cells */
    int *occupied;    /* (wide + 1) x (high + 1) counts of covered cells above and left */
};

/* Marks all curves of a figure.  g_free(room->taken) by finish. */
void gb_figure_occupancy_init(struct gb_figure_occupancy *occupancy,
                              const struct gb_figure *figure,
                              const struct gb_figure_layout *layout);
void gb_figure_occupancy_finish(struct gb_figure_occupancy *occupancy);

/* Marks a rectangle (left, top, right, bottom) as covered. */
void gb_figure_occupancy_add(struct gb_figure_occupancy *occupancy, const double box[4]);

/* Whether a rectangle is in the frame and free. */
bool gb_figure_occupancy_is_free(const struct gb_figure_occupancy *occupancy,
                                 const double box[4]);

/* Finds a free rectangle of the given size, as near to a corner as possible. */
bool gb_figure_occupancy_find(const struct gb_figure_occupancy *occupancy, double wide,
                              double high, double box[4]);

#endif
