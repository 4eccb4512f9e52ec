#ifndef GB_DRAW_FIGURE_FIGURE_LABELS_H
#define GB_DRAW_FIGURE_FIGURE_LABELS_H

#include <stdbool.h>

#include "draw/figure/figure.h"
#include "draw/image/text.h"

/* Font size of labels, points of the page. */
#define GB_FIGURE_LABELS_SIZE 8.6

enum { GB_FIGURE_LABELS_COLUMNS = 4 };

/* Labels of the curves: beside the lines where all of them have space, a legend for the
 * rest, in a free part of the frame or right of it. */
struct gb_figure_labels {
    double (*at)[4];  /* box of each label; right end 0: in the legend */
    double legend[4]; /* all 0: none */
    bool outside;     /* no space in the frame: legend[2], [3] are width and height */
    int rows;         /* of each column of the legend */
    double left[GB_FIGURE_LABELS_COLUMNS + 1]; /* of the columns in it, and its width */
};

void gb_figure_labels_arrange(struct gb_figure_labels *labels,
                              const struct gb_figure *figure,
                              const struct gb_figure_layout *layout,
                              const struct gb_text *text);
/* Divides a legend outside of the frame into as many columns as fit into a width: legend[2], [3]
 * become those of all.  Returns its height. */
double gb_figure_labels_columns(struct gb_figure_labels *labels,
                                const struct gb_figure *figure,
                                const struct gb_text *text, double most);
void gb_figure_labels_draw(const struct gb_figure_labels *labels,
                           const struct gb_figure *figure, const struct gb_text *text);
/* How far the texts at points (gb_figure_annotation) reach over the frame, above and below. */
void gb_figure_labels_overrun(const struct gb_figure *figure,
                              const struct gb_figure_layout *layout,
                              const struct gb_text *text, double overrun[2]);
void gb_figure_labels_annotate(const struct gb_figure *figure,
                               const struct gb_figure_layout *layout,
                               const struct gb_text *text);
void gb_figure_labels_finish(struct gb_figure_labels *labels); /* zeroed is fine */

/* Raster of the parts of the frame that curves cover, to find free space for texts. */
struct gb_figure_labels_room {
    double left, top; /* of the frame, points */
    int wide, high;   /* cells */
    int *occupied;    /* (wide + 1) x (high + 1) counts of covered cells above and left */
};

/* Marks all curves of a figure.  g_free(room->taken) by finish. */
void gb_figure_labels_room_init(struct gb_figure_labels_room *occupancy,
                                const struct gb_figure *figure,
                                const struct gb_figure_layout *layout);

void gb_figure_labels_room_finish(struct gb_figure_labels_room *occupancy);

/* Finds a free rectangle of the given size, as near to a corner as possible. */
bool gb_figure_labels_room_find(const struct gb_figure_labels_room *occupancy,
                                double wide, double high, double box[4]);

#endif
