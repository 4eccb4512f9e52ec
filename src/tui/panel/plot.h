#ifndef GB_TUI_PANEL_PLOT_H
#define GB_TUI_PANEL_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"

/* Plots in character cells, without curses, so that tests can compare the text. */

/* Dots per character: 2 x 4 (braille), 1 x 2 (half blocks, which every console font has),
 * 1 x 2 by ' . : (ASCII). */
enum gb_plot_glyphs { GB_PLOT_BRAILLE, GB_PLOT_BLOCK, GB_PLOT_ASCII, GB_PLOT_GLYPHS };

enum { GB_PLOT_TICKS = 24, GB_PLOT_TICK_TEXT = 16 };

/* An axis: round ends, and ticks at 1, 2 or 5 times a power of ten. */
struct gb_plot_axis {
    double low, high;
    bool log;
    int ticks;
    double tick[GB_PLOT_TICKS];
    char text[GB_PLOT_TICKS][GB_PLOT_TICK_TEXT];
};

struct gb_plot_cell {
    uint32_t ch; /* Unicode */
    int ink;     /* enum gb_plot_ink, or GB_PLOT_INK_SERIES + colour */
    bool fixed;  /* a marker or a text: lines pass behind it */
    bool tone;   /* only dots of a band, which a line replaces */
    int back; /* 1 + shade of the background of a cell; 0: background of the terminal */
};

struct gb_plot {
    int rows, cols; /* size of the whole picture */
    int top, left;  /* position of the field inside the axes */
    int field_rows, field_cols;
    enum gb_plot_glyphs glyphs;
    bool log_x;            /* set before gb_plot_axes; cleared by gb_plot_resize */
    bool exact_x, exact_y; /* axes end exactly at the given ends; set like log_x */
    int foot;              /* rows for the legend below the axes; set like log_x */
    struct gb_plot_axis x, y;
    struct gb_plot_cell *cell; /* rows x cols */
    uint8_t *dots;             /* rows x cols: bits of the raster */
    size_t capacity;
};

/* Fits an axis around data between low and high.
 *
 * most   number of ticks for which there is room (at least 2)
 * log    linear if high is not positive; a low that is not positive becomes three
 *        decades below high
 * Never fails: equal or non-finite ends become an axis from 0 to 1 or around the value.
 */
void gb_plot_axis_fit(struct gb_plot_axis *axis, double low, double high, bool log,
                      int max);

/* 0 at low, 1 at high; NaN for a value without a logarithm on a logarithmic axis. */
double gb_plot_axis_position(const struct gb_plot_axis *axis, double value);

/* Meaning of a cell; gb_paint_plot assigns the colours. */
enum gb_plot_ink {
    GB_PLOT_INK_NONE,
    GB_PLOT_INK_AXIS,
    GB_PLOT_INK_TEXT,
    GB_PLOT_INK_CURSOR,
    GB_PLOT_INK_DIM,    /* earlier runs */
    GB_PLOT_INK_SERIES, /* + number of the series' colour, 0..GB_PLOT_COLOURS - 1 */
    GB_PLOT_INK_SHADE = GB_PLOT_INK_SERIES + 6 /* + 0 (dark) .. GB_PLOT_SHADES - 1 */
};

enum gb_plot_scale { GB_PLOT_LINEAR, GB_PLOT_LOG };

enum { GB_PLOT_COLOURS = 6, GB_PLOT_SHADES = 8 };

/* A series of points.  NaN interrupts the line; the part outside the axes is clipped. */
struct gb_plot_series {
    const double *x, *y;
    size_t count;
    int ink;
    int marker;  /* 0: none; 1.. one of the marker shapes */
    int spacing; /* cells between markers; 0: one at the last point only */
    bool points; /* no line between the points */
};

/* The area between two lines with equal numbers of points.  NaN interrupts it. */
struct gb_plot_band {
    const double *x[2], *y[2];
    size_t count;
    int ink;
};

enum { GB_PLOT_NAME = 64 };

struct gb_plot_entry {
    int ink, marker;
    char name[GB_PLOT_NAME];
};

void gb_plot_init(struct gb_plot *plot);
void gb_plot_finish(struct gb_plot *plot);

/* Empties the plot and sets its size; allocates only when it grows. */
bool gb_plot_resize(struct gb_plot *plot, int rows, int cols, enum gb_plot_glyphs glyphs,
                    struct gb_error *err);

/* Draws axes, ticks and labels around the field.  The ranges contain the given ends. */
void gb_plot_axes(struct gb_plot *plot, const double x_ends[2], const double y_ends[2],
                  enum gb_plot_scale y_scale, const char *x_label, const char *y_label);
/* Sets up a plot without axes: the whole picture is the field (polar pictures). */
void gb_plot_bare(struct gb_plot *plot, const double x_ends[2], const double y_ends[2]);

void gb_plot_line(struct gb_plot *plot, const struct gb_plot_series *series);

/* Draws a band as an even tone of few dots in empty cells; call it before drawing
 * lines. */
void gb_plot_band(struct gb_plot *plot, const struct gb_plot_band *band);

/* Draws a vertical bar from the bottom of the field. */
void gb_plot_bar(struct gb_plot *plot, double x_from, double x_to, double y, int ink);

/* Draws cross hairs at a point, in empty cells and over bands. */
void gb_plot_cursor(struct gb_plot *plot, double x, double y);

/* Writes UTF-8 text in the picture; at the edge it is cut with an ellipsis. */
void gb_plot_text(struct gb_plot *plot, int row, int col, int ink, const char *text);

/* Draws one character if it is inside the picture; lines do not overwrite it. */
void gb_plot_put(struct gb_plot *plot, int row, int col, uint32_t ch, int ink);
/* Character of a marker: 1.. a shape, larger numbers a letter. */
uint32_t gb_plot_mark_char(const struct gb_plot *plot, int marker);

/* Draws the legend; call it after the lines.  It is in the foot if there is one, or in
 * a free area (top left, bottom right or anywhere, in up to three columns), or where it
 * covers least.  A last line counts the entries that do not fit.  False: it covers
 * something or is incomplete. */
bool gb_plot_legend(struct gb_plot *plot, const struct gb_plot_entry *entry, int count);
/* Number of rows of a foot for the entries; at most a third of the plot. */
int gb_plot_legend_foot(const struct gb_plot *plot, const struct gb_plot_entry *entry,
                        int count);

/* The picture as UTF-8 lines without trailing blanks; g_free. */
char *gb_plot_dump(const struct gb_plot *plot);

#endif
