#ifndef GB_DRAW_FIGURE_FIGURE_H
#define GB_DRAW_FIGURE_FIGURE_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/figure/figure_axis.h"
#include "draw/image/image.h"
#include "draw/image/png.h"
#include "greenbody/status.h"

/* Figures for print: curves, bands and points over two axes, told apart by colour, by
 * dashes and by marks, so that they can be read by colour-blind eyes and in black and
 * white. All texts are Pango markup. */
enum gb_figure_kind {
    GB_FIGURE_LINE,   /* with a band where it has errors */
    GB_FIGURE_POINTS, /* marks, with bars where they have errors */
    GB_FIGURE_BOTH,   /* marks joined by a line */
    GB_FIGURE_STEPS,  /* a histogram: y holds from each x to the next, filled */
    GB_FIGURE_FAINT,  /* thin, pale, not named: one of many */
};

struct gb_figure_curve {
    const char *label; /* NULL or "": not named */
    enum gb_figure_kind kind;
    int style; /* colour, dash and mark; colours come again after GB_FIGURE_STYLES */
    bool open; /* marks are hollow, as experiments are */
    size_t count;
    const double *x, *y;   /* NaN: a gap; on a log axis so is what is not positive */
    const double *error;   /* of y, half the width; NULL or NaN: none */
    const double *x_error; /* of points */
};

enum { GB_FIGURE_STYLES = 7 };

struct gb_figure_axis {
    const char *label; /* with its unit */
    bool log;
    double low, high; /* given ends; NaN: from the data */
};

/* Words at a place of the plot, as letters of the points of a law; below and left of it
 * when those are set. */
struct gb_figure_note {
    double x, y;
    const char *text;
    bool below, left;
};

struct gb_figure {
    const char *title, *caption; /* NULL: none */
    struct gb_figure_axis x, y;
    const struct gb_figure_curve *curve;
    size_t count;
    const struct gb_figure_note *note;
    size_t notes;
    double inset[2]; /* part of the x axis that is drawn larger where there is room;
                      * equal: none */
};

/* Where things came to lie, in pixels of the image; for those who look for them. */
struct gb_figure_layout {
    struct gb_figure_axis_scale x, y;
    double frame[4];  /* left, top, right, bottom */
    double legend[4]; /* of the box; all 0: there is none */
    double inset[4];  /* of the part drawn larger with its numbers; all 0: none */
    bool direct;      /* lines are named where they run */
    double unit;      /* pixels per point */
};

/* Errors: GB_ERR_MACHINE (no font), GB_ERR_MEMORY, GB_ERR_INPUT (size). */
bool gb_figure_paint(struct gb_image **out, const struct gb_figure *figure, int width,
                     int height, struct gb_figure_layout *layout, struct gb_error *err);

/* By the ending of the path: .png with the texts in its chunks, .svg, .pdf.  Width and
 * height are pixels of the first; the others take their shape.  Errors: as above, and as
 * gb_file_replace. */
bool gb_figure_write(const struct gb_figure *figure, int width, int height,
                     const struct gb_png_text *texts, int text_count, const char *path,
                     struct gb_error *err);

/* Whether a path ends as one of the files above. */
bool gb_figure_is_file(const char *path);

#endif
