#ifndef GB_TUI_TERM_PAINT_H
#define GB_TUI_TERM_PAINT_H

#include <stddef.h>

#include "tui/panel/plot.h"
#include "tui/term/term.h"

/* Cuts the text to at most `cols` cells; g_free. */
char *gb_paint_fit(const char *text, int cols);

/* Cuts the text to a buffer of `size` bytes.  Returns to. */
char *gb_paint_fit_copy(char *to, size_t size, const char *text);

/* Drawing into a rectangle of the screen.  Rows and columns count from its top left
 * corner.  Drawing outside is clipped; text is cut on the right with an ellipsis.
 * Control characters become '?'; without UTF-8, symbols are replaced by ASCII. */
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

/* Text in exactly `cols` cells: padded, or truncated with an ellipsis. */
int gb_paint_cell(const struct gb_paint *paint, int row, int col, int cols,
                  enum gb_style style, const char *text);

/* Wraps text at blanks, except between a number and its unit.  Returns the number of
 * rows used, at most `rows`. */
int gb_paint_wrap(const struct gb_paint *paint, int row, int rows, enum gb_style style,
                  const char *text);

/* Number of rows that gb_paint_wrap would use. */
int gb_paint_wrap_rows(const struct gb_paint *paint, int rows, const char *text);

enum gb_paint_focus { GB_PAINT_UNFOCUSED, GB_PAINT_FOCUSED };

/* Draws the first row of a pane: a rule with the name of the pane, brighter if the pane
 * has the focus. */
void gb_paint_title(const struct gb_paint *paint, const char *title,
                    enum gb_paint_focus focus);

/* Draws a fraction 0..1 as a bar of `cols` cells. */
void gb_paint_bar(const struct gb_paint *paint, int row, int col, int cols, double share);

/* Draws a vertical line in a column, from row to row. */
void gb_paint_column(const struct gb_paint *paint, int col, int from, int to);

/* Clears the rectangle and draws a border around it. */
void gb_paint_box(const struct gb_paint *paint, const char *title);

/* Draws a finished plot with its top left corner at row, col. */
void gb_paint_plot(const struct gb_paint *paint, int row, int col,
                   const struct gb_plot *plot);

/* Width of a text in cells. */
int gb_paint_width(const char *text);

/* "0:07", "12:34", "3:04:05". */
char *gb_paint_time(double seconds, char *buffer, size_t size);

#endif
