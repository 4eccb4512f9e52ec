#ifndef GB_DRAW_FIGURE_PAGE_H
#define GB_DRAW_FIGURE_PAGE_H

#include <stdbool.h>

#include "draw/figure.h"
#include "draw/text.h"

/* Font size of labels, points of the page. */
#define GB_FIGURE_PAGE_LABELS_SIZE 8.6

enum { GB_FIGURE_PAGE_LABELS_COLUMNS = 4 };

/* Labels of the curves: next to the lines where all of them have space, a legend for the
 * rest, in a free part of the frame or right of it. */
struct gb_figure_labels {
    double (*at)[4];  /* box of each label; right end 0: in the legend */
    double legend[4]; /* all 0: none */
    bool outside;     /* no space in the frame: legend[2], [3] are width and height */
    int rows;         /* of each column of the legend */
    double
        left[GB_FIGURE_PAGE_LABELS_COLUMNS + 1]; /* of the columns in it, and its width */
};

void gb_figure_page_draw_labels(const struct gb_figure_labels *labels,
                                const struct gb_figure *figure,
                                const struct gb_text *text);

void gb_figure_page_annotate(const struct gb_figure *figure,
                             const struct gb_figure_layout *layout,
                             const struct gb_text *text);

void gb_figure_page_finish_labels(struct gb_figure_labels *labels); /* zeroed is fine */

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
#define GB_FIGURE_PAGE_LABEL   10.0
#define GB_FIGURE_PAGE_TICK    8.8
#define GB_FIGURE_PAGE_TITLE   10.6
#define GB_FIGURE_PAGE_CAPTION 8.0
/* Letters of text that is reduced to fit are not smaller. */
#define GB_FIGURE_PAGE_LEAST                                                             \
    (GB_IMAGE_PRINT_TEXT_LEAST / GB_IMAGE_PRINT_TEXT * GB_FIGURE_PAGE_LABELS_SIZE)
#define GB_FIGURE_PAGE_GAP         4.0
#define GB_FIGURE_PAGE_NAME_MARGIN 4.0 /* of a name from the edge of the page */
#define GB_FIGURE_PAGE_BAR         62.0 /* width right of the frame that the bar of a map takes */

/* Name of an axis with the power of ten of its tick labels; g_free. */
char *gb_figure_page_name(const char *label, const struct gb_figure_axis_scale *scale);
/* The scale of a second axis along the first axis. */
void gb_figure_page_fit_second(const struct gb_figure_axis_scale *first, double factor,
                               struct gb_figure_axis_scale *scale);
/* Width right of the frame that the second axis takes; 0 without one. */
double gb_figure_page_second_width(const struct gb_figure_page *page);
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
