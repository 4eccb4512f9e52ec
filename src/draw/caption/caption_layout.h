#ifndef GB_DRAW_CAPTION_CAPTION_LAYOUT_H
#define GB_DRAW_CAPTION_CAPTION_LAYOUT_H

#include <stdbool.h>

#include "draw/view.h"

/* Height of a line of the legend of forces, lines of text. */
#define GB_CAPTION_LAYOUT_LEGEND_LINE 1.45

/* Which sides of the page shrink to what is drawn. */
enum gb_caption_layout_crop {
    GB_CAPTION_LAYOUT_NO_CROP,
    GB_CAPTION_LAYOUT_CROP_HEIGHT,
    GB_CAPTION_LAYOUT_CROP_BOTH
};

/* What a page is arranged for. */
struct gb_caption_page {
    int width, height; /* pixels; the largest ones of a side that is cropped */
    int per_inch;      /* pixels in print, whose letters have their size there
                          (print_size.h); 0: letters by the size of the image */
    enum gb_caption_layout_crop crop;
    bool annotated;
    bool bar;      /* there is a colour bar */
    bool load;     /* there is an arrow of pressing with its word */
    int rods;      /* lines of the legend of forces; 0: none */
    double aspect; /* height over width of what is drawn */
};

/* Text, colour bar and scale bar around the packing. */
struct gb_caption_layout {
    int width, height;      /* of the page */
    struct gb_frame scene;  /* space of the packing */
    struct gb_frame bar;    /* colour bar */
    struct gb_frame legend; /* of forces */
    struct gb_frame axes;   /* of the cell, in the lower right corner */
    double unit;            /* height of a line of text, pixels; 0: no text */
};

/* The packing and, beside it, the column of its bar and legend fill the page; on a page that
 * is not cropped they are in its middle. */
void gb_caption_layout_arrange(const struct gb_caption_page *page,
                               struct gb_caption_layout *layout);

#endif
