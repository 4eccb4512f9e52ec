#ifndef GB_DRAW_FIGURE_FIGURE_ROOM_H
#define GB_DRAW_FIGURE_FIGURE_ROOM_H

#include <stdbool.h>

#include "draw/figure/figure.h"

/* Which parts of the frame are taken by ink: a raster that words keep clear of. */
struct gb_figure_room {
    double left, top; /* of the frame, points */
    int wide, high;   /* cells */
    int *taken;       /* (wide + 1) x (high + 1) counts of taken cells above and left */
};

/* Marks all curves of a figure.  g_free(room->taken) by finish. */
void gb_figure_room_init(struct gb_figure_room *room, const struct gb_figure *figure,
                         const struct gb_figure_layout *layout);
void gb_figure_room_finish(struct gb_figure_room *room);

/* Takes a rectangle (left, top, right, bottom). */
void gb_figure_room_take(struct gb_figure_room *room, const double box[4]);

/* Whether a rectangle lies in the frame and on no ink. */
bool gb_figure_room_is_free(const struct gb_figure_room *room, const double box[4]);

/* Finds a free rectangle of the given size, as near to a corner as there is one. */
bool gb_figure_room_find(const struct gb_figure_room *room, double wide, double high,
                         double box[4]);

#endif
