#ifndef GB_DRAW_FIGURE_FIGURE_NAMES_H
#define GB_DRAW_FIGURE_FIGURE_NAMES_H

#include "draw/figure/figure.h"
#include "draw/image/text.h"

/* Which curve is which: names beside the lines where there is room for all of them, a
 * legend for the rest, in the frame where it is empty, else beside it. */
struct gb_figure_names {
    double (*at)[4];  /* of each curve's name; right end 0: it is in the legend */
    double legend[4]; /* all 0: none */
    bool outside;     /* no room in the frame: the legend is as large as said, not
                         placed */
};

void gb_figure_names_place(struct gb_figure_names *names, const struct gb_figure *figure,
                           const struct gb_figure_layout *layout,
                           const struct gb_text *text);
void gb_figure_names_draw(const struct gb_figure_names *names,
                          const struct gb_figure *figure, const struct gb_text *text);
void gb_figure_names_finish(struct gb_figure_names *names); /* zeroed is fine */

#endif
