/* Arranges the page of a figure: ranges of the axes, frame, inset, second panel, legend.  Text
 * sizes are fixed; the frame gets what they leave. */
#include "draw/figure/figure_page.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/figure/figure.h"
#include "draw/figure/figure_labels.h"
#include "draw/image/image.h"
#include "draw/image/palette.h"

char *gb_figure_page_name(const char *label, const struct gb_figure_axis_scale *scale)
{
    return scale->power == 0
               ? g_strdup(label)
               : g_strdup_printf("%s × 10<sup>%s%d</sup>", label,
                                 scale->power < 0 ? "−" : "", abs(scale->power));
}

static double name_height(const struct gb_figure_page *page, const char *label)
{
    double wide = 0.0, high = 0.0;
    if (label != NULL) {
        gb_text_measure(&page->text, label, GB_FIGURE_PAGE_LEAST, 0.0, &wide, &high);
    }
    return wide;
}

/* Length of the page along y that its names take at the smallest letters. */
static double names_height(const struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    return GB_FIGURE_PAGE_NAME_MARGIN +
           fmax(fmax(name_height(page, figure->y.label),
                     name_height(page, figure->right.label)),
                figure->map != NULL ? name_height(page, figure->map->label) : 0.0);
}

/* The scale of a second axis along that of the first. */
void gb_figure_page_fit_second(const struct gb_figure_axis_scale *first, double factor,
                               struct gb_figure_axis_scale *scale)
{
    const int wanted = MAX(first->ticks, 3);
    gb_figure_axis_fit(scale, first->log ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR,
                       factor * first->low, factor * first->high, wanted,
                       (const bool[2]){true, true});
    scale->from = first->from;
    scale->to = first->to;
}

static double widest_tick(const struct gb_figure_page *page,
                          const struct gb_figure_axis_scale *scale)
{
    double max = 0.0;
    for (int k = 0; k < scale->ticks; k++) {
        double wide = 0.0;
        double high = 0.0;
        gb_text_measure(&page->text, scale->label[k], page->tick_size, 0.0, &wide, &high);
        max = fmax(max, wide);
    }
    return max;
}

/* Height above the frame, and width right of it, that they take; 0 without them. */
static double second_height(const struct gb_figure *figure)
{
    return figure->top.label != NULL
               ? 2.0 * GB_FIGURE_PAGE_LABEL + 1.5 * GB_FIGURE_PAGE_TICK
               : 0.0;
}

double gb_figure_page_second_width(const struct gb_figure_page *page)
{
    struct gb_figure_axis_scale scale;
    if (page->figure->right.label == NULL) {
        return 0.0;
    }
    gb_figure_page_fit_second(&page->layout.y, page->figure->right.factor, &scale);
    return widest_tick(page, &scale) + 2.0 * GB_FIGURE_PAGE_LABEL + GB_FIGURE_PAGE_GAP;
}

enum direction { ALONG_X, ALONG_Y };

/* Extends a range by the values of a curve along one axis, with its errors. */
static void extend(const struct gb_figure_axis *axis, const double *value,
                   const double *error, size_t count, double *low, double *high)
{
    for (size_t k = 0; k < count; k++) {
        const double spread = error != NULL && isfinite(error[k]) ? error[k] : 0.0;
        if (!isfinite(value[k]) || (axis->log && value[k] <= 0.0)) {
            continue;
        }
        const double bottom = value[k] - spread;
        *low = fmin(*low, axis->log && bottom <= 0.0 ? value[k] : bottom);
        *high = fmax(*high, value[k] + spread);
    }
}

/* Markers and annotations extend beyond the outermost values. */
static bool has_markers(const struct gb_figure *figure)
{
    for (size_t i = 0; i < figure->count; i++) {
        if (figure->curve[i].kind == GB_FIGURE_POINTS ||
            figure->curve[i].kind == GB_FIGURE_BOTH) {
            return true;
        }
    }
    return figure->annotations > 0;
}

/* Fraction of the range added to the y axis of the inset. */
static const double inset_margin = 0.06;

enum markers { NO_MARKERS, MARKERS }; /* at a zero low end */

/* A low end of zero stays without markers there. */
static void add_margin(const struct gb_figure_axis *axis, double fraction,
                       enum markers markers, double *low, double *high)
{
    if (axis->log && *low > 0.0) {
        const double factor = pow(*high / *low, fraction);
        *low /= factor;
        *high *= factor;
    } else if (!axis->log) {
        const double span = *high - *low;
        *low -= *low == 0.0 && markers == NO_MARKERS ? 0.0 : fraction * span;
        *high += fraction * span;
    }
}

/* Range of an axis: the given ends, else those of the data with a margin for markers.  A
 * linear range whose minimum is positive and small against its maximum starts at zero. */
static void find_range(const struct gb_figure *figure, enum direction which, double *low,
                       double *high)
{
    const bool along_x = which == ALONG_X;
    const struct gb_figure_axis *axis = along_x ? &figure->x : &figure->y;
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        extend(axis, along_x ? curve->x : curve->y,
               along_x ? curve->x_error : curve->error, curve->count, low, high);
        if (!along_x && curve->kind == GB_FIGURE_STEPS) {
            *low = fmin(*low, 0.0);
        }
    }
    const enum markers markers =
        *low == 0.0 && has_markers(figure) ? MARKERS : NO_MARKERS;
    if (!axis->log && *low > 0.0 && *low < 0.2 * *high) {
        *low = 0.0;
    }
    if (isfinite(*high - *low)) {
        const double fraction = figure->annotations > 0 ? 0.08
                                : has_markers(figure)   ? 0.04
                                                        : 0.0;
        add_margin(axis, along_x ? fraction : fmax(fraction, 0.03), markers, low, high);
    }
    *low = isfinite(axis->low) ? axis->low : *low;
    *high = isfinite(axis->high) ? axis->high : *high;
}

/* Range of y over the x range of the inset. */
static void inset_range(const struct gb_figure *figure, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        for (size_t k = 0; k < curve->count; k++) {
            if (curve->x[k] >= figure->inset[0] && curve->x[k] <= figure->inset[1]) {
                extend(&figure->y, &curve->y[k], curve->error ? &curve->error[k] : NULL,
                       1, low, high);
            }
        }
    }
    add_margin(&figure->y, inset_margin, MARKERS, low, high);
}

static const double inset_tick_size = 7.4;
static const double margin = 12.0;
static const double legend_most = 0.3; /* of the page, beside an inset */
/* Widest legend right of the frame, with a second axis there, of the page in print and of
 * others; a wider one stands below the axes. */
static const double beside_most[2] = {0.36, 0.5};
/* Height over width of the frame, where the height of the page is free. */
static const double frame_shape = 0.62;

/* Height of the panel below over that of both, and the gap between them. */
static const double below_share = 0.28;
static const double below_gap = 7.0;

double gb_figure_page_text_width(const struct gb_figure_page *page)
{
    return page->width - 2.0 * margin;
}

/* About so many ticks along an axis. */
static int wanted_ticks(const struct gb_figure_page *page, bool along_x)
{
    return (int)fmax(along_x ? (page->width - page->legend_width) / 62.0
                             : (page->height - page->legend_height) / 48.0,
                     2.0);
}

static void fit_axes(struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    struct gb_figure_layout *layout = &page->layout;
    for (int k = 0; k < 2; k++) {
        const struct gb_figure_axis *axis = k == 0 ? &figure->x : &figure->y;
        const bool exact[2] = {isfinite(axis->low), isfinite(axis->high)};
        const int wanted = wanted_ticks(page, k == 0);
        double low = 0.0;
        double high = 1.0;
        find_range(figure, k == 0 ? ALONG_X : ALONG_Y, &low, &high);
        gb_figure_axis_fit(k == 0 ? &layout->x : &layout->y,
                           axis->log ? GB_FIGURE_AXIS_LOG : GB_FIGURE_AXIS_LINEAR, low,
                           high, wanted, exact);
    }
}

/* Widens the range of the axis with more points per unit about its middle. */
static void equalise(struct gb_figure_page *page)
{
    static const bool exact[2] = {true, true};
    struct gb_figure_layout *layout = &page->layout;
    const double *frame = layout->frame;
    const double x_scale = (frame[2] - frame[0]) / (layout->x.high - layout->x.low);
    const double y_scale = (frame[3] - frame[1]) / (layout->y.high - layout->y.low);
    const bool widen_x = x_scale > y_scale;
    struct gb_figure_axis_scale *scale = widen_x ? &layout->x : &layout->y;
    const double pad = 0.5 * (scale->high - scale->low) *
                       (fmax(x_scale, y_scale) / fmin(x_scale, y_scale) - 1.0);
    gb_figure_axis_fit(scale, GB_FIGURE_AXIS_LINEAR, scale->low - pad, scale->high + pad,
                       wanted_ticks(page, widen_x), exact);
}

static double widest_label(const struct gb_figure_page *page)
{
    double max = 0.0;
    for (int k = 0; k < page->layout.y.ticks; k++) {
        double wide = 0.0;
        double high = 0.0;
        gb_text_measure(&page->text, page->layout.y.label[k], page->tick_size, 0.0, &wide,
                        &high);
        max = fmax(max, wide);
    }
    return max;
}

static double text_height(const struct gb_figure_page *page, const char *markup,
                          double size)
{
    double wide = 0.0;
    double high = 0.0;
    if (markup != NULL && markup[0] != '\0') {
        gb_text_measure(&page->text, markup, size, gb_figure_page_text_width(page), &wide,
                        &high);
    }
    return high;
}

/* The axes run along the frame. */
static void set_axis_ends(struct gb_figure_layout *layout)
{
    layout->x.from = layout->frame[0];
    layout->x.to = layout->frame[2];
    layout->y.from = layout->frame[3];
    layout->y.to = layout->frame[1];
}

/* Without its frame. */
static void fit_below(const struct gb_figure_page *page, struct gb_figure *part,
                      struct gb_figure_page *below)
{
    *part = *page->figure;
    part->curve = page->figure->below;
    part->count = page->figure->below_count;
    part->y = page->figure->below_y;
    part->annotations = 0;
    part->top.label = part->right.label = NULL;
    part->below_count = 0;
    *below = *page;
    below->figure = part;
    below->height = /* for the number of ticks */
        2.2 * below_share * (page->height - page->legend_height);
    below->legend_height = 0.0;
    fit_axes(below);
    below->layout.x = page->layout.x;
}

/* Divides the frame among the two panels. */
static void split_frame(struct gb_figure_page *page)
{
    double *frame = page->layout.frame;
    double *below = page->layout.below;
    memcpy(below, frame, 4 * sizeof *below);
    frame[3] -= below_share * (frame[3] - frame[1]);
    below[1] = frame[3] + below_gap;
}

static double widest_of_panels(const struct gb_figure_page *page)
{
    struct gb_figure part;
    struct gb_figure_page below;
    if (page->figure->below_count == 0) {
        return widest_label(page);
    }
    fit_below(page, &part, &below);
    return fmax(widest_label(page), widest_label(&below));
}

static void set_frame(struct gb_figure_page *page)
{
    const struct gb_figure *figure = page->figure;
    struct gb_figure_layout *layout = &page->layout;
    const double title = text_height(page, figure->title, GB_FIGURE_PAGE_TITLE);
    const double caption = text_height(page, figure->caption, GB_FIGURE_PAGE_CAPTION);
    double *frame = layout->frame;
    frame[0] = 10.0 + 1.5 * GB_FIGURE_PAGE_LABEL + widest_of_panels(page) +
               2.0 * GB_FIGURE_PAGE_GAP;
    frame[1] = 8.0 + (title > 0.0 ? title + 5.0 : 0.0) + second_height(figure);
    frame[2] =
        page->width - 14.0 - page->legend_width - gb_figure_page_second_width(page);
    frame[3] = page->height - 6.0 - (caption > 0.0 ? caption + 6.0 : 0.0) -
               page->legend_height - 1.7 * GB_FIGURE_PAGE_LABEL -
               1.5 * GB_FIGURE_PAGE_TICK - GB_FIGURE_PAGE_GAP;
    frame[2] = fmax(frame[2], frame[0] + 10.0);
    frame[3] = fmax(frame[3], frame[1] + 10.0);
    if (figure->below_count > 0) {
        split_frame(page);
    }
    if (figure->equal_scales) {
        equalise(page);
    }
    set_axis_ends(layout);
}

/* Least width and height of an inset, whose tick labels would overlap. */
static const double inset_least[2] = {80.0, 60.0};

/* Finds the largest free box for the inset, from these fractions of the frame. */
static void find_inset(struct gb_figure_page *page)
{
    static const double fractions[] = {0.5, 0.46, 0.42, 0.38, 0.34};
    const double *f = page->layout.frame;
    struct gb_figure_labels_room occupancy;
    if (!(page->figure->inset[0] < page->figure->inset[1])) {
        return;
    }
    gb_figure_labels_room_init(&occupancy, page->figure, &page->layout);
    for (size_t k = 0; k < G_N_ELEMENTS(fractions); k++) {
        const double wide = fractions[k] * (f[2] - f[0]);
        const double high = fractions[k] * (f[3] - f[1]);
        if (wide < inset_least[0] || high < inset_least[1] ||
            gb_figure_labels_room_find(&occupancy, wide, high, page->layout.inset)) {
            break;
        }
    }
    gb_figure_labels_room_finish(&occupancy);
}

static void arrange_again(struct gb_figure_page *page)
{
    gb_figure_labels_finish(&page->labels);
    gb_figure_labels_arrange(&page->labels, page->figure, &page->layout, &page->text);
}

static void set_frame_again(struct gb_figure_page *page)
{
    fit_axes(page);
    set_frame(page);
    memset(page->layout.inset, 0, sizeof page->layout.inset);
    find_inset(page);
}

static void put_legend_beside(struct gb_figure_page *page)
{
    const double wide = page->labels.legend[2];
    const double high = page->labels.legend[3];
    page->legend_width = wide + GB_FIGURE_PAGE_GAP;
    set_frame_again(page);
    arrange_again(page);
    if (page->labels.outside) {
        const double left = page->layout.frame[2] + gb_figure_page_second_width(page) +
                            GB_FIGURE_PAGE_GAP;
        const double top = page->layout.frame[1];
        const double box[4] = {left, top, left + wide, top + high};
        memcpy(page->labels.legend, box, sizeof box);
    }
}

/* In columns between the name of the x axis and the caption. */
static void put_legend_below(struct gb_figure_page *page)
{
    const double most = gb_figure_page_text_width(page);
    page->legend_height =
        gb_figure_labels_columns(&page->labels, page->figure, &page->text, most);
    set_frame_again(page);
    arrange_again(page);
    gb_figure_labels_columns(&page->labels, page->figure, &page->text, most);
    const double caption =
        text_height(page, page->figure->caption, GB_FIGURE_PAGE_CAPTION);
    const double bottom = page->height - 6.0 - (caption > 0.0 ? caption + 6.0 : 0.0);
    const double left = 0.5 * (page->width - page->labels.legend[2]);
    const double box[4] = {left, bottom - page->labels.legend[3],
                           left + page->labels.legend[2], bottom};
    memcpy(page->labels.legend, box, sizeof box);
}

/* Places labels and legend; a legend without space in the frame goes to its right or below
 * the axes, and the frame shrinks.  Where that would take much of the page, the inset gives
 * way first. */
static void set_labels(struct gb_figure_page *page)
{
    gb_figure_labels_arrange(&page->labels, page->figure, &page->layout, &page->text);
    if (page->labels.outside && page->layout.inset[2] > page->layout.inset[0] &&
        page->labels.legend[2] > legend_most * page->width) {
        memset(page->layout.inset, 0, sizeof page->layout.inset);
        arrange_again(page);
    }
    if (!page->labels.outside) {
        return;
    }
    const double beside = page->labels.legend[2] + GB_FIGURE_PAGE_GAP +
                          gb_figure_page_second_width(page) +
                          (page->figure->map != NULL ? GB_FIGURE_PAGE_BAR : 0.0);
    if (beside <= beside_most[page->figure->per_inch > 0 ? 0 : 1] * page->width) {
        put_legend_beside(page);
    } else {
        put_legend_below(page);
    }
}

/* Extends the y axis until the texts at points lie within the frame. */
static void make_room_for_annotations(struct gb_figure_page *page)
{
    const struct gb_figure_axis *axis = &page->figure->y;
    struct gb_figure_axis_scale *y = &page->layout.y;
    double overrun[2];
    gb_figure_labels_overrun(page->figure, &page->layout, &page->text, overrun);
    const bool exact[2] = {overrun[1] <= 0.0 || isfinite(axis->low),
                           overrun[0] <= 0.0 || isfinite(axis->high)};
    if (axis->log || (exact[0] && exact[1])) {
        return;
    }
    const double *frame = page->layout.frame;
    const double per_point = (y->high - y->low) / (frame[3] - frame[1]);
    gb_figure_axis_fit(y, GB_FIGURE_AXIS_LINEAR,
                       y->low - (exact[0] ? 0.0 : overrun[1] * per_point),
                       y->high + (exact[1] ? 0.0 : overrun[0] * per_point),
                       wanted_ticks(page, false), exact);
    set_frame(page);
}

void gb_figure_page_arrange(struct gb_figure_page *page)
{
    page->legend_width = (page->figure->map != NULL ? GB_FIGURE_PAGE_BAR : 0.0);
    fit_axes(page);
    set_frame(page);
    make_room_for_annotations(page);
    find_inset(page);
    set_labels(page);
    make_room_for_annotations(page);
}

double gb_figure_page_wanted_height(const struct gb_figure_page *page)
{
    const double *frame = page->layout.frame;
    const double *lowest = page->figure->below_count > 0 ? page->layout.below : frame;
    const double least =
        fmax(frame_shape * (frame[2] - frame[0]), names_height(page) - frame[1]);
    return page->height + fmax(least - (lowest[3] - frame[1]), 0.0);
}

void gb_figure_page_inset(const struct gb_figure_page *page, struct gb_figure *part,
                          struct gb_figure_page *inset)
{
    const double *box = page->layout.inset;
    *part = *page->figure;
    part->top.label = part->right.label = NULL;
    part->x.low = page->figure->inset[0];
    part->x.high = page->figure->inset[1];
    inset_range(page->figure, &part->y.low, &part->y.high);
    *inset = *page;
    inset->figure = part;
    inset->width = 1.15 * (box[2] - box[0]); /* for the number of ticks */
    inset->height = 1.3 * (box[3] - box[1]);
    inset->legend_height = 0.0;
    inset->tick_size = inset_tick_size;
    fit_axes(inset);
    double *frame = inset->layout.frame;
    frame[0] = box[0] + widest_label(inset) + GB_FIGURE_PAGE_GAP;
    frame[1] = box[1];
    frame[2] = box[2] - inset_tick_size; /* half of the last tick label */
    frame[3] = box[3] - 1.5 * inset_tick_size - GB_FIGURE_PAGE_GAP;
    set_axis_ends(&inset->layout);
}

void gb_figure_page_below(const struct gb_figure_page *page, struct gb_figure *part,
                          struct gb_figure_page *below)
{
    fit_below(page, part, below);
    memcpy(below->layout.frame, page->layout.below, sizeof below->layout.frame);
    set_axis_ends(&below->layout);
}
