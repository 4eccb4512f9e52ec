#include "draw/figure/figure_names.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

/* Distance of a name from the edge of the page. */
static const double margin = 4.0;
/* Of names of two panels, half of it. */
static const double panel_gap = 2.0;

char *gb_figure_names_of(const char *label, const struct gb_figure_axis_scale *scale)
{
    return scale->power == 0 ? g_strdup(label)
                             : g_strdup_printf("%s \xc3\x97 10<sup>%s%d</sup>", label,
                                               scale->power < 0 ? "\xe2\x88\x92" : "",
                                               abs(scale->power));
}

/* Whether it is the panel below another one. */
static bool is_below(const struct gb_figure_page *page)
{
    const double *below = page->layout.below;
    return below[3] > below[1] && page->layout.frame[1] >= below[1];
}

/* Room of a name along y: above those along x, and beside its own panel alone. */
static void find_room(const struct gb_figure_page *page, double room[2])
{
    const double *frame = page->layout.frame;
    room[0] = is_below(page) ? frame[1] - panel_gap : margin;
    room[1] = page->figure->below_count > 0
                  ? frame[3]
                  : frame[3] + gb_figure_page_gap + 1.5 * gb_figure_page_tick_size;
}

void gb_figure_names_draw(const struct gb_figure_page *page, const char *name,
                          enum gb_figure_names_direction direction, double middle,
                          double across, double edge)
{
    const bool along_x = direction == GB_FIGURE_NAMES_ALONG_X;
    double room[2] = {margin, page->width - margin};
    double wide = 0.0, high = 0.0;
    if (!along_x) {
        find_room(page, room);
    }
    const double most = room[1] - room[0];
    gb_text_measure(&page->text, name, gb_figure_page_label_size, 0.0, &wide, &high);
    const double half = 0.5 * fmin(wide, most);
    const double along = fmin(fmax(middle, room[0] + half), room[1] - half);
    const double at[2] = {along_x ? along : across, along_x ? across : along};
    gb_text_write_line(&page->text, name, gb_figure_page_label_size,
                       gb_figure_page_least_size, most, at, (double[2]){0.5, edge},
                       along_x ? 0 : 1);
}

static double name_height(const struct gb_figure_page *page, const char *label)
{
    double wide = 0.0, high = 0.0;
    if (label != NULL) {
        gb_text_measure(&page->text, label, gb_figure_page_least_size, 0.0, &wide, &high);
    }
    return wide;
}

double gb_figure_names_height(const struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    return margin +
           fmax(fmax(name_height(page, figure->y.label),
                     name_height(page, figure->right.label)),
                figure->map != NULL ? name_height(page, figure->map->label) : 0.0);
}
