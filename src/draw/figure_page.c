/* Arranges the page of a figure: ranges of the axes, frame, inset, second panel, legend.  Text
 * sizes are fixed; the frame gets what they leave.  A raster of the frame marks what the curves
 * cover; a label next to its line, or the legend, takes free cells of it. */

#include "draw/figure_page.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "draw/figure.h"
#include "draw/figure_curve.h"
#include "draw/image.h"
#include "draw/text.h"

/* Raster of the parts of the frame that curves cover, to find free space for texts. */
struct room {
    double left, top; /* of the frame, points */
    int wide, high;   /* cells */
    int *occupied;    /* (wide + 1) x (high + 1) counts of covered cells above and left */
};

static const double cell = 2.0;          /* points */
static const double legend_margin = 7.0; /* of a legend from the frame */
static const double thick = 2.0;         /* half the width kept free around a line */
static const double around = 4.5;        /* the same around a marker */

/* 1 where curves or texts are. */
struct raster {
    unsigned char *on;
    const struct room *room;
};

static int clamp(double x, int most)
{
    return (int)fmin(fmax(x, 0.0), most);
}

static void fill(struct raster *raster, double left, double top, double right,
                 double bottom)
{
    const struct room *room = raster->room;
    const int x0 = clamp(floor((left - room->left) / cell), room->wide);
    const int x1 = clamp(ceil((right - room->left) / cell), room->wide);
    const int y0 = clamp(floor((top - room->top) / cell), room->high);
    const int y1 = clamp(ceil((bottom - room->top) / cell), room->high);
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            raster->on[y * room->wide + x] = 1;
        }
    }
}

static void stroke(struct raster *raster, const double a[2], const double b[2])
{
    const double far = 4000.0; /* no line of a page is longer */
    const double length = fmin(hypot(b[0] - a[0], b[1] - a[1]), far);
    const int steps = (int)ceil(length / cell) + 1;
    for (int k = 0; k <= steps; k++) {
        const double t = (double)k / steps;
        const double x = a[0] + t * (b[0] - a[0]);
        const double y = a[1] + t * (b[1] - a[1]);
        fill(raster, x - thick, y - thick, x + thick, y + thick);
    }
}

static double error_length(const struct gb_figure_layout *layout,
                           const struct gb_figure_curve *curve, size_t k)
{
    if (curve->error == NULL || !isfinite(curve->error[k])) {
        return 0.0;
    }
    const double high =
        gb_figure_axis_position(&layout->y, curve->y[k] + curve->error[k]);
    const double at = gb_figure_axis_position(&layout->y, curve->y[k]);
    return fmin(fabs(at - high), 4000.0);
}

static void add_curve(struct raster *raster, const struct gb_figure_layout *layout,
                      const struct gb_figure_curve *curve)
{
    const bool marks = curve->kind == GB_FIGURE_POINTS || curve->kind == GB_FIGURE_BOTH;
    const double half = marks ? around : thick;
    double last[2] = {NAN, NAN};
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            last[0] = NAN;
            continue;
        }
        const double spread = error_length(layout, curve, k);
        fill(raster, at[0] - half, at[1] - half - spread, at[0] + half,
             at[1] + half + spread);
        if (curve->kind == GB_FIGURE_STEPS) {
            fill(raster, isfinite(last[0]) ? last[0] : at[0],
                 fmin(at[1], last[1]) - thick, at[0], layout->frame[3]);
        } else if (isfinite(last[0]) && curve->kind != GB_FIGURE_POINTS) {
            stroke(raster, last, at);
        }
        last[0] = at[0];
        last[1] = at[1];
    }
}

static void sum_up(struct room *room, const unsigned char *on)
{
    const int row = room->wide + 1;
    for (int y = 0; y < room->high; y++) {
        for (int x = 0; x < room->wide; x++) {
            int *sum = &room->occupied[(y + 1) * row + x + 1];
            *sum = on[y * room->wide + x] + sum[-1] + sum[-row] - sum[-row - 1];
        }
    }
}

/* Marks all curves of a figure.  g_free(room->taken) by finish. */
static void room_init(struct room *room, const struct gb_figure *figure,
                      const struct gb_figure_layout *layout)
{
    const double *frame = layout->frame;
    room->left = frame[0];
    room->top = frame[1];
    room->wide = (int)fmax((frame[2] - frame[0]) / cell, 1.0);
    room->high = (int)fmax((frame[3] - frame[1]) / cell, 1.0);
    room->occupied = g_new0(int, (gsize)(room->wide + 1) * (gsize)(room->high + 1));
    struct raster raster = {g_new0(unsigned char, (gsize)room->wide *(gsize)room->high),
                            room};
    for (size_t i = 0; i < figure->count; i++) {
        add_curve(&raster, layout, &figure->curve[i]);
    }
    for (size_t i = 0; i < figure->annotations; i++) {
        const struct gb_figure_annotation *note = &figure->annotation[i];
        const double x = gb_figure_axis_position(&layout->x, note->x);
        const double y = gb_figure_axis_position(&layout->y, note->y);
        fill(&raster, x - 14.0, y - 14.0, x + 14.0, y + 14.0);
    }
    if (layout->inset[2] > layout->inset[0]) {
        fill(&raster, layout->inset[0], layout->inset[1], layout->inset[2],
             layout->inset[3]);
    }
    sum_up(room, raster.on);
    g_free(raster.on);
}

static void room_finish(struct room *room)
{
    g_free(room->occupied);
    *room = (struct room){0};
}

static int count_occupied(const struct room *room, int x0, int y0, int x1, int y1)
{
    const int row = room->wide + 1;
    return room->occupied[y1 * row + x1] - room->occupied[y0 * row + x1] -
           room->occupied[y1 * row + x0] + room->occupied[y0 * row + x0];
}

/* Marks a rectangle (left, top, right, bottom) as covered. */
static void occupy(struct room *room, const double box[4])
{
    unsigned char *on = g_new0(unsigned char, (gsize)room->wide *(gsize)room->high);
    struct raster raster = {on, room};
    for (int y = 0; y < room->high; y++) {
        for (int x = 0; x < room->wide; x++) {
            on[y * room->wide + x] = count_occupied(room, x, y, x + 1, y + 1) > 0;
        }
    }
    fill(&raster, box[0], box[1], box[2], box[3]);
    sum_up(room, on);
    g_free(on);
}

/* Whether a rectangle is in the frame and free. */
static bool is_free(const struct room *room, const double box[4])
{
    const int x0 = (int)floor((box[0] - room->left) / cell);
    const int y0 = (int)floor((box[1] - room->top) / cell);
    const int x1 = (int)ceil((box[2] - room->left) / cell);
    const int y1 = (int)ceil((box[3] - room->top) / cell);
    return x0 >= 0 && y0 >= 0 && x1 <= room->wide && y1 <= room->high &&
           count_occupied(room, x0, y0, x1, y1) == 0;
}

/* Finds a free rectangle of the given size, as near to a corner as possible. */
static bool room_find(const struct room *room, double wide, double high, double box[4])
{
    const double max_x = cell * room->wide - wide - legend_margin;
    const double max_y = cell * room->high - high - legend_margin;
    double best = INFINITY;
    for (double y = legend_margin; y <= max_y; y += cell) {
        for (double x = legend_margin; x <= max_x; x += cell) {
            const double at[4] = {room->left + x, room->top + y, room->left + x + wide,
                                  room->top + y + high};
            /* corners first, then edges; the upper ones before the lower */
            const double cost = fmin(x - legend_margin, max_x - x) +
                                fmin(y - legend_margin, max_y - y) +
                                (y > 0.5 * max_y ? 1.5 : 0.0);
            if (cost < best && is_free(room, at)) {
                best = cost;
                for (int k = 0; k < 4; k++) {
                    box[k] = at[k];
                }
            }
        }
    }
    return isfinite(best);
}

static const double label_size = GB_FIGURE_PAGE_LABELS_SIZE;
static const double pitch = 12.6;  /* of legend lines */
static const double sample = 24.0; /* length of a sample */
static const double label_pad = 5.0;

enum { MAX_DIRECT = 6, ANCHORS = 48, SIDES = 8 };

/* Whether a curve has a label and a visible point. */
static bool has_label(const struct gb_figure_curve *curve)
{
    if (curve->label == NULL || curve->label[0] == '\0') {
        return false;
    }
    for (size_t k = 0; k < curve->count; k++) {
        if (isfinite(curve->x[k]) && isfinite(curve->y[k])) {
            return true;
        }
    }
    return false;
}

static bool is_line(const struct gb_figure_curve *curve)
{
    return curve->kind == GB_FIGURE_LINE || curve->kind == GB_FIGURE_BOTH;
}

/* Distance of a point from a rectangle. */
static double point_distance(const double box[4], const double at[2])
{
    const double dx = fmax(fmax(box[0] - at[0], at[0] - box[2]), 0.0);
    const double dy = fmax(fmax(box[1] - at[1], at[1] - box[3]), 0.0);
    return hypot(dx, dy);
}

/* Distance of a rectangle from the line of a curve, sampled along its segments. */
static double distance(const double box[4], const struct gb_figure_layout *layout,
                       const struct gb_figure_curve *curve)
{
    double nearest = INFINITY;
    double last[2] = {0.0, 0.0};
    bool have = false;
    for (size_t k = 0; k < curve->count; k++) {
        double at[2];
        if (!gb_figure_curve_position(layout, curve, k, at)) {
            have = false;
            continue;
        }
        const double length = have ? hypot(at[0] - last[0], at[1] - last[1]) : 0.0;
        const int parts = (int)fmin(ceil(length / 6.0) + 1.0, 200.0);
        for (int j = have ? 0 : parts; j <= parts; j++) {
            const double t = (double)j / parts;
            const double p[2] = {have ? last[0] + t * (at[0] - last[0]) : at[0],
                                 have ? last[1] + t * (at[1] - last[1]) : at[1]};
            nearest = fmin(nearest, point_distance(box, p));
        }
        last[0] = at[0];
        last[1] = at[1];
        have = true;
    }
    return nearest;
}

/* The distance of a label to its own curve must be well below that to any other. */
static bool is_clear(const struct gb_figure *figure,
                     const struct gb_figure_layout *layout, size_t own,
                     const double box[4])
{
    const double own_distance = distance(box, layout, &figure->curve[own]);
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *other = &figure->curve[i];
        if (i != own && other->kind != GB_FIGURE_FAINT &&
            distance(box, layout, other) < 2.0 * own_distance + 6.0) {
            return false;
        }
    }
    return true;
}

/* Point of the line at a share of the frame's width from its right end. */
static bool anchor(const struct gb_figure_layout *layout,
                   const struct gb_figure_curve *curve, int number, double at[2])
{
    const double share = 1.0 - (double)number / ANCHORS;
    const size_t k = (size_t)lround(share * (double)(curve->count - 1));
    return gb_figure_curve_position(layout, curve, k, at);
}

/* Inside the frame, without overlap with the ticks. */
static bool is_inside(const struct gb_figure_layout *layout, const double box[4])
{
    const double *f = layout->frame;
    return box[0] > f[0] + label_pad && box[1] > f[1] + label_pad &&
           box[2] < f[2] - label_pad && box[3] < f[3] - label_pad;
}

static bool find_position(const struct gb_figure *figure,
                          const struct gb_figure_layout *layout, const struct room *room,
                          size_t own, double wide, double high, double box[4])
{
    /* corner or edge of the label that faces the line: right of the line first */
    static const double sides[SIDES][2] = {{0.0, 0.5}, {0.0, 0.0}, {1.0, 1.0},
                                           {0.0, 1.0}, {1.0, 0.0}, {1.0, 0.5},
                                           {0.5, 1.0}, {0.5, 0.0}};
    for (int number = 0; number <= ANCHORS; number++) {
        double at[2];
        if (!anchor(layout, &figure->curve[own], number, at)) {
            continue;
        }
        for (int side = 0; side < SIDES; side++) {
            const double gap_x = 7.0 * (1.0 - 2.0 * sides[side][0]);
            const double gap_y = 5.0 * (1.0 - 2.0 * sides[side][1]);
            box[0] = at[0] + gap_x - sides[side][0] * wide;
            box[1] = at[1] + gap_y - sides[side][1] * high;
            box[2] = box[0] + wide;
            box[3] = box[1] + high;
            if (is_inside(layout, box) && is_free(room, box) &&
                is_clear(figure, layout, own, box)) {
                return true;
            }
        }
    }
    return false;
}

static bool set_direct_labels(struct gb_figure_labels *labels,
                              const struct gb_figure *figure,
                              const struct gb_figure_layout *layout,
                              const struct gb_text *text, struct room *room)
{
    size_t lines = 0;
    for (size_t i = 0; i < figure->count; i++) {
        lines += has_label(&figure->curve[i]) && is_line(&figure->curve[i]);
    }
    if (lines < 1 || lines > MAX_DIRECT) {
        return false;
    }
    for (size_t i = 0; i < figure->count; i++) {
        const struct gb_figure_curve *curve = &figure->curve[i];
        double wide = 0.0;
        double high = 0.0;
        if (!has_label(curve) || !is_line(curve)) {
            continue;
        }
        gb_text_measure(text, curve->label, label_size, 0.0, &wide, &high);
        if (!find_position(figure, layout, room, i, wide, high, labels->at[i])) {
            return false;
        }
        occupy(room, labels->at[i]);
    }
    return true;
}

static bool in_legend(const struct gb_figure_labels *labels,
                      const struct gb_figure *figure, size_t i)
{
    return has_label(&figure->curve[i]) && labels->at[i][2] <= 0.0;
}

/* Width of the line of a curve in the legend; 0: it has none. */
static double line_width(const struct gb_figure_labels *labels,
                         const struct gb_figure *figure, const struct gb_text *text,
                         size_t i)
{
    double wide = 0.0;
    double high = 0.0;
    if (!in_legend(labels, figure, i)) {
        return 0.0;
    }
    gb_text_measure(text, figure->curve[i].label, label_size, 0.0, &wide, &high);
    return wide + sample + 3.0 * label_pad;
}

/* Columns of so many rows; returns the width of all. */
static double set_columns(struct gb_figure_labels *labels, const struct gb_figure *figure,
                          const struct gb_text *text, int rows)
{
    double wide = 0.0;
    int line = 0;
    labels->rows = rows;
    memset(labels->left, 0, sizeof labels->left);
    for (size_t i = 0; i < figure->count; i++) {
        const double own = line_width(labels, figure, text, i);
        if (own > 0.0 && line > 0 && line % rows == 0) {
            labels->left[line / rows] = labels->left[line / rows - 1] + wide;
            wide = 0.0;
        }
        wide = fmax(wide, own);
        line += own > 0.0;
        labels->left[(line + rows - 1) / rows] =
            labels->left[line > 0 ? (line - 1) / rows : 0] + wide;
    }
    return labels->left[(line + rows - 1) / rows];
}

static int count_lines(const struct gb_figure_labels *labels,
                       const struct gb_figure *figure)
{
    int count = 0;
    for (size_t i = 0; i < figure->count; i++) {
        count += in_legend(labels, figure, i);
    }
    return count;
}

/* Divides a legend outside of the frame into as many columns as fit into a width: legend[2], [3]
 * become those of all.  Returns its height. */
static double divide_legend(struct gb_figure_labels *labels,
                            const struct gb_figure *figure, const struct gb_text *text,
                            double most)
{
    const int count = count_lines(labels, figure);
    double wide = 0.0;
    for (int columns = GB_FIGURE_PAGE_LABELS_COLUMNS; columns > 0; columns--) {
        const int rows = (count + columns - 1) / columns;
        wide = set_columns(labels, figure, text, rows > 0 ? rows : 1);
        if (wide <= most) {
            break;
        }
    }
    if (wide > most) {
        labels->left[1] = wide = most;
    }
    labels->legend[2] = wide;
    labels->legend[3] = labels->rows * pitch + label_pad;
    labels->outside = true;
    return labels->legend[3];
}

static void arrange_labels(struct gb_figure_labels *labels,
                           const struct gb_figure *figure,
                           const struct gb_figure_layout *layout,
                           const struct gb_text *text)
{
    struct room room;
    double wide = 0.0;
    double high = 0.0;
    *labels = (struct gb_figure_labels){
        .at = g_malloc0_n(figure->count + 1, sizeof *labels->at)};
    room_init(&room, figure, layout);
    if (!set_direct_labels(labels, figure, layout, text, &room)) {
        memset(labels->at, 0, figure->count * sizeof *labels->at);
        room_finish(&room);
        room_init(&room, figure, layout);
    }
    const int lines = count_lines(labels, figure);
    if (lines > 0) {
        wide = set_columns(labels, figure, text, lines);
        high = lines * pitch + label_pad;
    }
    if (high > 0.0 && !room_find(&room, wide, high, labels->legend)) {
        labels->outside = true;
        labels->legend[2] = wide;
        labels->legend[3] = high;
    }
    room_finish(&room);
}

/* A label with what follows one of its commas replaced by an ellipsis, so that it fits with the
 * smallest letters: no number is cut.  g_free. */
static char *shorten(const struct gb_text *text, const char *label, double most)
{
    char *markup = g_strdup(label);
    for (;;) {
        double wide = 0.0, high = 0.0;
        gb_text_measure(text, markup, GB_FIGURE_PAGE_LEAST, 0.0, &wide, &high);
        char *comma = g_strrstr(markup, ", ");
        if (wide <= most || comma == NULL) {
            return markup;
        }
        *comma = '\0';
        char *shorter = g_strconcat(markup, "…", NULL);
        g_free(markup);
        markup = shorter;
    }
}

static void draw_legend(const struct gb_figure_labels *labels,
                        const struct gb_figure *figure, const struct gb_text *text)
{
    static const double align[2] = {0.0, 0.5};
    int line = 0;
    for (size_t i = 0; i < figure->count; i++) {
        if (!in_legend(labels, figure, i)) {
            continue;
        }
        const int column = line / labels->rows;
        const double x = labels->legend[0] + labels->left[column] + label_pad;
        const double y =
            labels->legend[1] + (line % labels->rows + 0.5) * pitch + 0.5 * label_pad;
        const double most =
            labels->left[column + 1] - labels->left[column] - sample - 2.5 * label_pad;
        char *markup = shorten(text, figure->curve[i].label, most);
        gb_figure_curve_sample(text->cairo, &figure->curve[i], x, y, sample);
        cairo_set_source_rgb(text->cairo, 0.1, 0.1, 0.12);
        gb_text_write_line(text, markup, label_size, GB_FIGURE_PAGE_LEAST, most,
                           (double[2]){x + sample + label_pad, y}, align, 0);
        g_free(markup);
        line++;
    }
}

void gb_figure_page_draw_labels(const struct gb_figure_labels *labels,
                                const struct gb_figure *figure,
                                const struct gb_text *text)
{
    static const double align[2] = {0.0, 0.0};
    for (size_t i = 0; i < figure->count; i++) {
        double rgb[3];
        if (labels->at[i][2] <= 0.0) {
            continue;
        }
        gb_figure_curve_colour(figure->curve[i].style, rgb);
        /* darker than the line: thin glyphs appear paler */
        cairo_set_source_rgb(text->cairo, 0.72 * rgb[0], 0.72 * rgb[1], 0.72 * rgb[2]);
        gb_text_write(text, figure->curve[i].label, label_size, 0.0, labels->at[i], align,
                      0);
    }
    if (labels->legend[2] > 0.0) {
        draw_legend(labels, figure, text);
    }
}

void gb_figure_page_finish_labels(struct gb_figure_labels *labels)
{
    g_free(labels->at);
    *labels = (struct gb_figure_labels){0};
}

/* The corner of its text at a point, and which one it is. */
static void find_corner(const struct gb_figure_layout *layout,
                        const struct gb_figure_annotation *note, double at[2],
                        double align[2])
{
    const bool left =
        note->corner == GB_FIGURE_BELOW_LEFT || note->corner == GB_FIGURE_ABOVE_LEFT;
    const bool below =
        note->corner == GB_FIGURE_BELOW_LEFT || note->corner == GB_FIGURE_BELOW_RIGHT;
    at[0] = gb_figure_axis_position(&layout->x, note->x) + (left ? -4.0 : 4.0);
    at[1] = gb_figure_axis_position(&layout->y, note->y) + (below ? 3.0 : -3.0);
    align[0] = left ? 1.0 : 0.0;
    align[1] = below ? 0.0 : 1.0;
}

/* How far the texts at points (gb_figure_annotation) reach over the frame, above and below. */
static void annotation_overrun(const struct gb_figure *figure,
                               const struct gb_figure_layout *layout,
                               const struct gb_text *text, double overrun[2])
{
    static const double edge = 1.0;
    overrun[0] = overrun[1] = 0.0;
    for (size_t k = 0; k < figure->annotations; k++) {
        const struct gb_figure_annotation *note = &figure->annotation[k];
        double at[2], align[2], wide = 0.0, high = 0.0;
        find_corner(layout, note, at, align);
        gb_text_measure(text, note->text, GB_FIGURE_PAGE_TICK, 0.0, &wide, &high);
        const double top = at[1] - align[1] * high;
        overrun[0] = fmax(overrun[0], layout->frame[1] + edge - top);
        overrun[1] = fmax(overrun[1], top + high + edge - layout->frame[3]);
    }
}

void gb_figure_page_annotate(const struct gb_figure *figure,
                             const struct gb_figure_layout *layout,
                             const struct gb_text *text)
{
    for (size_t k = 0; k < figure->annotations; k++) {
        const struct gb_figure_annotation *note = &figure->annotation[k];
        double at[2], align[2];
        find_corner(layout, note, at, align);
        gb_text_write(text, note->text, GB_FIGURE_PAGE_TICK, 0.0, at, align, 0);
    }
}

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

/* The scale of a second axis along the first axis. */
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
static const double legend_most = 0.3; /* of the page, next to an inset */
/* Widest legend right of the frame, with a second axis there, of the page in print and of
 * others; a wider one stands below the axes. */
static const double beside_most[2] = {0.36, 0.5};
/* Height over width of the frame, where the height of the page is free. */
static const double frame_shape = 0.62;

/* Height of the lower panel over the height of both, and the gap between them. */
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
    struct room room;
    if (!(page->figure->inset[0] < page->figure->inset[1])) {
        return;
    }
    room_init(&room, page->figure, &page->layout);
    for (size_t k = 0; k < G_N_ELEMENTS(fractions); k++) {
        const double wide = fractions[k] * (f[2] - f[0]);
        const double high = fractions[k] * (f[3] - f[1]);
        if (wide < inset_least[0] || high < inset_least[1] ||
            room_find(&room, wide, high, page->layout.inset)) {
            break;
        }
    }
    room_finish(&room);
}

static void arrange_again(struct gb_figure_page *page)
{
    gb_figure_page_finish_labels(&page->labels);
    arrange_labels(&page->labels, page->figure, &page->layout, &page->text);
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
    page->legend_height = divide_legend(&page->labels, page->figure, &page->text, most);
    set_frame_again(page);
    arrange_again(page);
    divide_legend(&page->labels, page->figure, &page->text, most);
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
    arrange_labels(&page->labels, page->figure, &page->layout, &page->text);
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
    annotation_overrun(page->figure, &page->layout, &page->text, overrun);
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
