#ifndef GB_DRAW_FIGURE_H
#define GB_DRAW_FIGURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/image.h"
#include "greenbody/status.h"

enum { GB_FIGURE_AXIS_TICKS = 16, GB_FIGURE_AXIS_MINOR = 96 };

/* Map from values to coordinates (points) along one axis, with its ticks. */
struct gb_figure_axis_scale {
    bool log;
    double low, high; /* values at the two ends */
    double from, to;  /* their coordinates */
    int power;        /* ticks are labelled in units of 10^power */
    int ticks, minors;
    double tick[GB_FIGURE_AXIS_TICKS];
    char label[GB_FIGURE_AXIS_TICKS][40]; /* Pango markup; "" between labelled decades */
    double minor[GB_FIGURE_AXIS_MINOR];
};

enum gb_figure_axis_kind { GB_FIGURE_AXIS_LINEAR, GB_FIGURE_AXIS_LOG };

/* Ends and ticks for values from low to high (low > 0 when logarithmic), about `wanted` of them.
 * exact keeps the ends as they are.  Ends that are not finite, equal or reversed are
 * replaced by valid ones. */
void gb_figure_axis_fit(struct gb_figure_axis_scale *scale, enum gb_figure_axis_kind kind,
                        double low, double high, int wanted, const bool exact[2]);

double gb_figure_axis_position(const struct gb_figure_axis_scale *scale, double value);

/* Colours of the curves of figures, sRGB: sky blue, orange, green, purple, red, blue, the
 * hues of the workbench (tui/term/term.c) in its order.  Two of them, or one and
 * black, differ by 14 at least in CIEDE2000, also for protanopia, deuteranopia and tritanopia
 * (matrices of Machado et al. 2009); contrast with white 2.8 at least.
 * tests/draw/test_figure_colours.c computes both. */
enum { GB_FIGURE_COLOURS = 6 };

extern const uint8_t gb_figure_colours[GB_FIGURE_COLOURS][3];

/* Of measured points and of lines that are no run. */
extern const uint8_t gb_figure_colours_black[3];

/* Figures for print: curves, bands and points over two axes.  Colour, dashes and markers
 * all differ, for colour-blind readers and black-and-white print.  All texts are Pango
 * markup. */
enum gb_figure_kind {
    GB_FIGURE_LINE,   /* with a band where it has errors */
    GB_FIGURE_POINTS, /* markers, with bars where they have errors */
    GB_FIGURE_BOTH,   /* markers joined by a line */
    GB_FIGURE_STEPS,  /* a histogram: y holds from each x to the next, filled */
    GB_FIGURE_FAINT,  /* thin and pale, without a label: one of many */
    GB_FIGURE_ARROWS, /* pairs of points, tail and head, each followed by a gap */
};

struct gb_figure_curve {
    const char *label; /* NULL or "": none */
    enum gb_figure_kind kind;
    int style; /* colour, dash and marker; colours repeat after GB_FIGURE_STYLES; below 0:
                * gb_figure_black */
    bool open; /* hollow markers, for points that are not in equilibrium */
    size_t count;
    const double *x, *y;   /* NaN: a gap; on a log axis also values <= 0 */
    const double *error;   /* of y, half the length of the bar; NULL or NaN: none */
    const double *x_error; /* of points */
};

enum { GB_FIGURE_STYLES = GB_FIGURE_COLOURS };

/* Style of measured points and of lines that are no run: black, with dash and marker of a
 * number; and the number of such a style. */
static inline int gb_figure_black(int number)
{
    return -1 - number;
}

struct gb_figure_axis {
    const char *label; /* with its unit */
    bool log;
    double low, high; /* given ends; NaN: from the data */
};

/* An axis opposite to another one, with its values times a factor above 0. */
struct gb_figure_second_axis {
    const char *label; /* with its unit; NULL: none */
    double factor;
};

/* Side of a point on which its text stands. */
enum gb_figure_corner {
    GB_FIGURE_ABOVE_RIGHT,
    GB_FIGURE_ABOVE_LEFT,
    GB_FIGURE_BELOW_RIGHT,
    GB_FIGURE_BELOW_LEFT,
};

/* Text at a point of the plot. */
struct gb_figure_annotation {
    double x, y;
    const char *text;
    enum gb_figure_corner corner;
};

/* Coloured cells behind the curves: `columns` along x times `rows` along y. */
struct gb_figure_map {
    int columns, rows;
    const double *x, *y; /* columns + 1 and rows + 1 edges, ascending */
    const double *value; /* column by column; NaN: no cell */
    double low, high;    /* of the colours */
    const char *label;   /* of the colour bar, with its unit */
};

struct gb_figure {
    const struct gb_figure_map *map; /* NULL: none */
    const char *title, *caption;     /* NULL: none */
    struct gb_figure_axis x, y;
    struct gb_figure_second_axis top, right;
    int per_inch;      /* pixels in print, whose letters have their size there (image.h);
                   * 0: a page of a size of its own */
    bool equal_scales; /* of linear axes in one unit: directions keep their angles */
    const struct gb_figure_curve *curve;
    size_t count;
    const struct gb_figure_annotation *annotation;
    size_t annotations;
    /* A second panel below, over the same x axis; no curves: none. */
    struct gb_figure_axis below_y;
    const struct gb_figure_curve *below;
    size_t below_count;
    double
        inset[2]; /* x range of the inset, drawn where it has space; equal or NaN: none */
};

/* Positions in the image, pixels. */
struct gb_figure_layout {
    struct gb_figure_axis_scale x, y;
    double frame[4];  /* left, top, right, bottom */
    double legend[4]; /* of the box; all 0: there is none */
    double inset[4];  /* with its tick labels; all 0: none */
    double below[4];  /* frame of the panel below; all 0: none */
    bool direct;      /* labels stand beside the lines */
    double unit;      /* pixels per point */
};

/* In print the height grows where legend, caption or names would leave too little of it.
 * Errors: GB_ERR_MACHINE (no font), GB_ERR_MEMORY, GB_ERR_INPUT (size). */
bool gb_figure_render(struct gb_image **out, const struct gb_figure *figure, int width,
                      int height, struct gb_figure_layout *layout, struct gb_error *err);

/* Writers of a figure.  Width and height are pixels of the PNG; vector formats have its
 * shape.  texts: chunks of the PNG.  Errors: as above, and as gb_file_replace. */
typedef bool gb_figure_writer(const struct gb_figure *figure, int width, int height,
                              const struct gb_image_text *texts, int text_count,
                              const char *path, struct gb_error *err);
gb_figure_writer gb_figure_write_png;
gb_figure_writer gb_figure_write_svg;
gb_figure_writer gb_figure_write_pdf;

#endif
