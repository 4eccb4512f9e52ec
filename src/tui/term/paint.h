#ifndef GB_TUI_TERM_PAINT_H
#define GB_TUI_TERM_PAINT_H

#include "tui/plot/plot.h"
#include "tui/term/rect.h"
#include "tui/term/term.h"

/* Drawing into a rectangle of the screen.  Rows and columns count from its top left
 * corner; what lies outside is cut.  Control characters become '?', and on a screen
 * without UTF-8 the few signs the workbench uses are replaced. */
struct gb_paint {
    const struct gb_term *term;
    struct gb_rect rect;
};

struct gb_paint gb_paint_at(const struct gb_term *term, struct gb_rect rect);

/* Both return the column after the text. */
int gb_paint_text(const struct gb_paint *paint, int row, int col, enum gb_style style,
                  const char *text);
int gb_paint_format(const struct gb_paint *paint, int row, int col, enum gb_style style,
                    const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Text in exactly `cols` cells: padded, or cut with an ellipsis. */
int gb_paint_cell(const struct gb_paint *paint, int row, int col, int cols,
                  enum gb_style style, const char *text);

/* Breaks at blanks; returns the rows used, at most `rows`. */
int gb_paint_wrap(const struct gb_paint *paint, int row, int rows, enum gb_style style,
                  const char *text);

/* The rows that gb_paint_wrap would use. */
int gb_paint_wrapped(const struct gb_paint *paint, int rows, const char *text);

/* First row of a pane: a line with its name, marked when the pane has the focus. */
void gb_paint_title(const struct gb_paint *paint, const char *title, bool focus);

/* A share of 0..1 as a bar of `cols` cells. */
void gb_paint_bar(const struct gb_paint *paint, int row, int col, int cols, double share);

/* Vertical line down a column, from row to row. */
void gb_paint_column(const struct gb_paint *paint, int col, int from, int to);

/* Empties the rectangle and draws a border around it. */
void gb_paint_box(const struct gb_paint *paint, const char *title);

/* A finished plot, its top left corner at row, col. */
void gb_paint_plot(const struct gb_paint *paint, int row, int col,
                   const struct gb_plot *plot);

/* Cells a text takes. */
int gb_paint_width(const char *text);

/* "0:07", "12:34", "3:04:05". */
char *gb_paint_time(double seconds, char *buffer, size_t size);

#endif
