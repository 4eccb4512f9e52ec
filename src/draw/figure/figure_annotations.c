#include "draw/figure/figure_annotations.h"

#include <math.h>

/* Distances of a text from its point, and from the frame. */
static const double beside = 4.0, above = 3.0, edge = 1.0;

/* The corner of its text at a point, and which one it is. */
static void find_corner(const struct gb_figure_page *page,
                        const struct gb_figure_annotation *note, double at[2],
                        double align[2])
{
    const bool left =
        note->corner == GB_FIGURE_BELOW_LEFT || note->corner == GB_FIGURE_ABOVE_LEFT;
    const bool below =
        note->corner == GB_FIGURE_BELOW_LEFT || note->corner == GB_FIGURE_BELOW_RIGHT;
    at[0] = gb_figure_axis_position(&page->layout.x, note->x) + (left ? -beside : beside);
    at[1] = gb_figure_axis_position(&page->layout.y, note->y) + (below ? above : -above);
    align[0] = left ? 1.0 : 0.0;
    align[1] = below ? 0.0 : 1.0;
}

void gb_figure_annotations_overrun(const struct gb_figure_page *page, double overrun[2])
{
    const double *frame = page->layout.frame;
    overrun[0] = overrun[1] = 0.0;
    for (size_t k = 0; k < page->figure->annotations; k++) {
        const struct gb_figure_annotation *note = &page->figure->annotation[k];
        double at[2], align[2], wide = 0.0, high = 0.0;
        find_corner(page, note, at, align);
        gb_text_measure(&page->text, note->text, gb_figure_page_tick_size, 0.0, &wide,
                        &high);
        const double top = at[1] - align[1] * high;
        overrun[0] = fmax(overrun[0], frame[1] + edge - top);
        overrun[1] = fmax(overrun[1], top + high + edge - frame[3]);
    }
}

void gb_figure_annotations_draw(const struct gb_figure_page *page)
{
    for (size_t k = 0; k < page->figure->annotations; k++) {
        const struct gb_figure_annotation *note = &page->figure->annotation[k];
        double at[2], align[2];
        find_corner(page, note, at, align);
        gb_text_write(&page->text, note->text, gb_figure_page_tick_size, 0.0, at, align,
                      0);
    }
}
