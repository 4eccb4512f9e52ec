#ifndef GB_TUI_PLOT_PLOT_RASTER_H
#define GB_TUI_PLOT_PLOT_RASTER_H

#include "tui/plot/plot.h"

/* Dots inside the field of a plot, and the characters they become. */

/* Dots per cell. */
int gb_plot_raster_dots_x(enum gb_plot_glyphs glyphs);
int gb_plot_raster_dots_y(enum gb_plot_glyphs glyphs);

/* The series' line, clipped to the field; NaN breaks it. */
void gb_plot_raster_line(struct gb_plot *plot, const struct gb_plot_series *series);

/* A column of the field filled from the bottom up to a share of the height. */
void gb_plot_raster_column(struct gb_plot *plot, int col, double share, int ink);

#endif
