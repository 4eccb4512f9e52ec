#ifndef GB_DRAW_FIGURE_FIGURE_PAGE_H
#define GB_DRAW_FIGURE_FIGURE_PAGE_H

#include "draw/figure/figure_labels.h"

/* Layout of a figure on a page; lengths in points. */
struct gb_figure_page {
    const struct gb_figure *figure;
    struct gb_text text;
    double width, height;
    double tick_size;     /* font size of tick labels */
    double legend_width;  /* of a legend right of the frame; 0: none there */
    double legend_height; /* of a legend below the axes; 0: none there */
    struct gb_figure_layout layout;
    struct gb_figure_labels labels;
};

/* Font sizes and distances. */
extern const double gb_figure_page_label_size;
extern const double gb_figure_page_tick_size;
extern const double gb_figure_page_title_size;
extern const double gb_figure_page_caption_size;
extern const double
    gb_figure_page_least_size; /* what is reduced to fit has no smaller letters */
extern const double gb_figure_page_gap;
/* Width of a title or caption: that of the page without its margins. */
double gb_figure_page_text_width(const struct gb_figure_page *page);

/* Sets layout and labels. */
void gb_figure_page_arrange(struct gb_figure_page *page);

/* Height of an arranged page with which its frame is high enough, and its names fit. */
double gb_figure_page_wanted_height(const struct gb_figure_page *page);

/* The page of the inset: the same figure over the range of the inset, in the inset's box. */
void gb_figure_page_inset(const struct gb_figure_page *page, struct gb_figure *part,
                          struct gb_figure_page *inset);

/* The page of the panel below, in its frame, over the same x axis. */
void gb_figure_page_below(const struct gb_figure_page *page, struct gb_figure *part,
                          struct gb_figure_page *below);

#endif
