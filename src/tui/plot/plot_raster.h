#ifndef GB_TUI_PLOT_PLOT_RASTER_H
#define GB_TUI_PLOT_PLOT_RASTER_H

#include "tui/plot/plot.h"

/* Dots of the field of a plot, and their characters. */

/* Dots per cell. */
int gb_plot_raster_dots_x(enum gb_plot_glyphs glyphs);
int gb_plot_raster_dots_y(enum gb_plot_glyphs glyphs);

/* Line of a series, clipped to the field; NaN interrupts it. */
void gb_plot_raster_line(struct gb_plot *plot, const struct gb_plot_series *series);

/* Sets a dot of the field, from its top left corner, if it belongs to the even tone of a band:
 * a dot of four in braille, a light shade for each cell in blocks, and in ASCII a dot in every
 * second cell.  Cells with a line or a text stay. */
void gb_plot_raster_tone(struct gb_plot *plot, int x, int y, int ink);

/* Fills a column of the field from the bottom to a fraction of the height. */
void gb_plot_raster_column(struct gb_plot *plot, int col, double share, int ink);

#endif
