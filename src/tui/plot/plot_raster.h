#ifndef GB_TUI_PLOT_PLOT_RASTER_H
#define GB_TUI_PLOT_PLOT_RASTER_H

#include "tui/plot/plot.h"

/* Dots of the field of a plot, and their characters. */

/* Dots per cell. */
int gb_plot_raster_dots_x(enum gb_plot_glyphs glyphs);
int gb_plot_raster_dots_y(enum gb_plot_glyphs glyphs);

/* Line of a series, clipped to the field; NaN interrupts it. */
void gb_plot_raster_line(struct gb_plot *plot, const struct gb_plot_series *series);

/* Fills a column of the field from the bottom to a fraction of the height. */
void gb_plot_raster_column(struct gb_plot *plot, int col, double share, int ink);

#endif
