#include "draw/caption/caption_layout.h"

#include <math.h>

#include "draw/image/print_size.h"

/* Minimum length of the shorter side for text, pixels, and in print inches. */
static const double min_annotated_px = 240.0, min_annotated_inches = 1.1;
/* Margin of a page without text as a share of its shorter side. */
static const double margin = 0.03;
/* Greatest height of a cropped page over its width in print. */
static const double print_height = 1.25;

/* Lengths in lines of text. */
static const double above = 2.6; /* title */
static const double load_above =
    3.2;                         /* title, and the word of pressing over the packing */
static const double below = 4.4; /* density and scale bar */
static const double text_width = 24.0;    /* density and pressure on one line */
static const double axes_side = 4.4;      /* room of the axes, beside that line */
static const double bar_column = 7.5;     /* colour bar with labels and title */
static const double legend_column = 10.2; /* longest line of the legend of forces */
static const double bar_gap = 2.5, legend_gap = 1.0;
static const double bar_width = 1.1;
static const double bar_height[2] = {12.0, 20.0}; /* shortest with all labels, longest */

/* Lengths in pixels while a page is arranged. */
struct sizes {
    double unit;
    double left, top, bottom; /* around the packing */
    double column;            /* right of it, with the margin of the page */
    double column_height;     /* shortest one without loss */
    double legend_height;
};

static struct sizes bare_sizes(const struct gb_caption_page *page)
{
    const double pad = margin * fmin(page->width, page->height);
    return (struct sizes){.left = pad, .top = pad, .bottom = pad, .column = pad};
}

static struct sizes annotated_sizes(const struct gb_caption_page *page)
{
    const double shorter = fmin(page->width, page->height);
    const double unit = page->per_inch > 0
                            ? gb_print_size_pixels(page->per_inch, GB_PRINT_SIZE_TEXT)
                            : fmax(shorter / 44.0, 10.0);
    struct sizes sizes = {.unit = unit,
                          .left = fmax(margin * shorter, unit),
                          .top = (page->load ? load_above : above) * unit,
                          .bottom = below * unit};
    sizes.legend_height =
        page->rods > 0 ? (page->rods * GB_CAPTION_LAYOUT_LEGEND_LINE) * unit : 0.0;
    sizes.column = page->rods > 0 ? (legend_gap + legend_column) * unit
                   : page->bar    ? bar_column * unit
                                  : sizes.left;
    sizes.column_height = sizes.legend_height + (page->bar ? bar_height[0] * unit : 0.0);
    return sizes;
}

/* The page, and the room of the packing on it. */
static void set_page(const struct gb_caption_page *page, const struct sizes *sizes,
                     struct gb_caption_layout *layout)
{
    const bool print = page->per_inch > 0 && page->crop != GB_CAPTION_LAYOUT_NO_CROP;
    const double max_height = print ? print_height * page->width : page->height;
    const double aspect = page->aspect > 0.0 ? page->aspect : 1.0;
    const double around = sizes->left + sizes->column;
    const double height = fmax(max_height - sizes->top - sizes->bottom, 1.0);
    const double width = fmax(fmin(page->width - around, height / aspect), 1.0);
    layout->width = page->width;
    layout->height = page->height;
    layout->scene = (struct gb_frame){sizes->left, sizes->top, width, height};
    if (page->crop == GB_CAPTION_LAYOUT_NO_CROP) {
        layout->scene.left += 0.5 * fmax(page->width - around - width, 0.0);
        return;
    }
    layout->scene.height = fmin(height, fmax(width * aspect, sizes->column_height));
    layout->height = (int)ceil(layout->scene.height + sizes->top + sizes->bottom);
    if (page->crop == GB_CAPTION_LAYOUT_CROP_BOTH && page->per_inch == 0) {
        const double least =
            fmin((double)page->width, (text_width + axes_side) * sizes->unit);
        layout->width = (int)ceil(fmax(width + around, least));
    }
    layout->scene.left += 0.5 * fmax(layout->width - around - width, 0.0);
}

/* The colour bar and, below it, the legend of forces, in the middle of the packing's height. */
static void set_column(const struct gb_caption_page *page, const struct sizes *sizes,
                       struct gb_caption_layout *layout)
{
    const double unit = sizes->unit;
    const double right = layout->scene.left + layout->scene.width;
    const double room = layout->scene.height - sizes->legend_height;
    const double height =
        page->bar ? fmax(fmin(room - 2.0 * unit, bar_height[1] * unit), unit) : 0.0;
    const double gap = page->bar && page->rods > 0 ? 2.0 * unit : 0.0;
    const double free_height = layout->scene.height - sizes->legend_height - height - gap;
    const double top = layout->scene.top + 0.5 * fmax(free_height, 0.0);
    layout->bar =
        (struct gb_frame){right + bar_gap * unit, top, bar_width * unit, height};
    layout->legend = (struct gb_frame){right + legend_gap * unit, top + height + gap,
                                       legend_column * unit, sizes->legend_height};
}

void gb_caption_layout_arrange(const struct gb_caption_page *page,
                               struct gb_caption_layout *layout)
{
    const double least =
        page->per_inch > 0 ? min_annotated_inches * page->per_inch : min_annotated_px;
    const bool annotated = page->annotated && fmin(page->width, page->height) >= least;
    const struct sizes sizes = annotated ? annotated_sizes(page) : bare_sizes(page);
    *layout = (struct gb_caption_layout){.unit = sizes.unit};
    set_page(page, &sizes, layout);
    if (annotated) {
        const double side = axes_side * sizes.unit;
        set_column(page, &sizes, layout);
        layout->axes =
            (struct gb_frame){layout->width - side, layout->height - side, side, side};
    }
}
