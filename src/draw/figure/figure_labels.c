/* Labels of the curves.  A raster of the frame marks what the curves cover; a label beside its
 * line, or the legend, takes free cells of it. */
#include "draw/figure/figure_labels.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "draw/figure/figure.h"
#include "draw/figure/figure_curve.h"
#include "draw/figure/figure_page.h"

static const double cell = 2.0;   /* points */
static const double inset = 7.0;  /* of a legend from the frame */
static const double thick = 2.0;  /* half the width kept free around a line */
static const double around = 4.5; /* the same around a marker */

/* 1 where curves or texts are. */
struct raster {
    unsigned char *on;
    const struct gb_figure_labels_room *occupancy;
};

static int clamp(double x, int most)
{
    return (int)fmin(fmax(x, 0.0), most);
}

static void fill(struct raster *raster, double left, double top, double right,
                 double bottom)
{
    const struct gb_figure_labels_room *occupancy = raster->occupancy;
    const int x0 = clamp(floor((left - occupancy->left) / cell), occupancy->wide);
    const int x1 = clamp(ceil((right - occupancy->left) / cell), occupancy->wide);
    const int y0 = clamp(floor((top - occupancy->top) / cell), occupancy->high);
    const int y1 = clamp(ceil((bottom - occupancy->top) / cell), occupancy->high);
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            raster->on[y * occupancy->wide + x] = 1;
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

static void sum_up(struct gb_figure_labels_room *occupancy, const unsigned char *on)
{
    const int row = occupancy->wide + 1;
    for (int y = 0; y < occupancy->high; y++) {
        for (int x = 0; x < occupancy->wide; x++) {
            int *sum = &occupancy->occupied[(y + 1) * row + x + 1];
            *sum = on[y * occupancy->wide + x] + sum[-1] + sum[-row] - sum[-row - 1];
        }
    }
}

void gb_figure_labels_room_init(struct gb_figure_labels_room *occupancy,
                                const struct gb_figure *figure,
                                const struct gb_figure_layout *layout)
{
    const double *frame = layout->frame;
    occupancy->left = frame[0];
    occupancy->top = frame[1];
    occupancy->wide = (int)fmax((frame[2] - frame[0]) / cell, 1.0);
    occupancy->high = (int)fmax((frame[3] - frame[1]) / cell, 1.0);
    occupancy->occupied =
        g_new0(int, (gsize)(occupancy->wide + 1) * (gsize)(occupancy->high + 1));
    struct raster raster = {
        g_new0(unsigned char, (gsize)occupancy->wide *(gsize)occupancy->high), occupancy};
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
    sum_up(occupancy, raster.on);
    g_free(raster.on);
}

void gb_figure_labels_room_finish(struct gb_figure_labels_room *occupancy)
{
    g_free(occupancy->occupied);
    *occupancy = (struct gb_figure_labels_room){0};
}

static int count_occupied(const struct gb_figure_labels_room *occupancy, int x0, int y0,
                          int x1, int y1)
{
    const int row = occupancy->wide + 1;
    return occupancy->occupied[y1 * row + x1] - occupancy->occupied[y0 * row + x1] -
           occupancy->occupied[y1 * row + x0] + occupancy->occupied[y0 * row + x0];
}

/* Marks a rectangle (left, top, right, bottom) as covered. */
static void occupy(struct gb_figure_labels_room *occupancy, const double box[4])
{
    unsigned char *on =
        g_new0(unsigned char, (gsize)occupancy->wide *(gsize)occupancy->high);
    struct raster raster = {on, occupancy};
    for (int y = 0; y < occupancy->high; y++) {
        for (int x = 0; x < occupancy->wide; x++) {
            on[y * occupancy->wide + x] =
                count_occupied(occupancy, x, y, x + 1, y + 1) > 0;
        }
    }
    fill(&raster, box[0], box[1], box[2], box[3]);
    sum_up(occupancy, on);
    g_free(on);
}

/* Whether a rectangle is in the frame and free. */
static bool is_free(const struct gb_figure_labels_room *occupancy, const double box[4])
{
    const int x0 = (int)floor((box[0] - occupancy->left) / cell);
    const int y0 = (int)floor((box[1] - occupancy->top) / cell);
    const int x1 = (int)ceil((box[2] - occupancy->left) / cell);
    const int y1 = (int)ceil((box[3] - occupancy->top) / cell);
    return x0 >= 0 && y0 >= 0 && x1 <= occupancy->wide && y1 <= occupancy->high &&
           count_occupied(occupancy, x0, y0, x1, y1) == 0;
}

bool gb_figure_labels_room_find(const struct gb_figure_labels_room *occupancy,
                                double wide, double high, double box[4])
{
    const double max_x = cell * occupancy->wide - wide - inset;
    const double max_y = cell * occupancy->high - high - inset;
    double best = INFINITY;
    for (double y = inset; y <= max_y; y += cell) {
        for (double x = inset; x <= max_x; x += cell) {
            const double at[4] = {occupancy->left + x, occupancy->top + y,
                                  occupancy->left + x + wide, occupancy->top + y + high};
            /* corners first, then edges; the upper ones before the lower */
            const double cost = fmin(x - inset, max_x - x) + fmin(y - inset, max_y - y) +
                                (y > 0.5 * max_y ? 1.5 : 0.0);
            if (cost < best && is_free(occupancy, at)) {
                best = cost;
                for (int k = 0; k < 4; k++) {
                    box[k] = at[k];
                }
            }
        }
    }
    return isfinite(best);
}

static const double size = GB_FIGURE_LABELS_SIZE;
static const double pitch = 12.6;  /* of legend lines */
static const double sample = 24.0; /* length of a sample */
static const double pad = 5.0;

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
    return box[0] > f[0] + pad && box[1] > f[1] + pad && box[2] < f[2] - pad &&
           box[3] < f[3] - pad;
}

static bool find_position(const struct gb_figure *figure,
                          const struct gb_figure_layout *layout,
                          const struct gb_figure_labels_room *occupancy, size_t own,
                          double wide, double high, double box[4])
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
            if (is_inside(layout, box) && is_free(occupancy, box) &&
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
                              const struct gb_text *text,
                              struct gb_figure_labels_room *occupancy)
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
        gb_text_measure(text, curve->label, size, 0.0, &wide, &high);
        if (!find_position(figure, layout, occupancy, i, wide, high, labels->at[i])) {
            return false;
        }
        occupy(occupancy, labels->at[i]);
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
    gb_text_measure(text, figure->curve[i].label, size, 0.0, &wide, &high);
    return wide + sample + 3.0 * pad;
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

double gb_figure_labels_columns(struct gb_figure_labels *labels,
                                const struct gb_figure *figure,
                                const struct gb_text *text, double most)
{
    const int count = count_lines(labels, figure);
    double wide = 0.0;
    for (int columns = GB_FIGURE_LABELS_COLUMNS; columns > 0; columns--) {
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
    labels->legend[3] = labels->rows * pitch + pad;
    labels->outside = true;
    return labels->legend[3];
}

void gb_figure_labels_arrange(struct gb_figure_labels *labels,
                              const struct gb_figure *figure,
                              const struct gb_figure_layout *layout,
                              const struct gb_text *text)
{
    struct gb_figure_labels_room occupancy;
    double wide = 0.0;
    double high = 0.0;
    *labels = (struct gb_figure_labels){
        .at = g_malloc0_n(figure->count + 1, sizeof *labels->at)};
    gb_figure_labels_room_init(&occupancy, figure, layout);
    if (!set_direct_labels(labels, figure, layout, text, &occupancy)) {
        memset(labels->at, 0, figure->count * sizeof *labels->at);
        gb_figure_labels_room_finish(&occupancy);
        gb_figure_labels_room_init(&occupancy, figure, layout);
    }
    const int lines = count_lines(labels, figure);
    if (lines > 0) {
        wide = set_columns(labels, figure, text, lines);
        high = lines * pitch + pad;
    }
    if (high > 0.0 &&
        !gb_figure_labels_room_find(&occupancy, wide, high, labels->legend)) {
        labels->outside = true;
        labels->legend[2] = wide;
        labels->legend[3] = high;
    }
    gb_figure_labels_room_finish(&occupancy);
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
        const double x = labels->legend[0] + labels->left[column] + pad;
        const double y =
            labels->legend[1] + (line % labels->rows + 0.5) * pitch + 0.5 * pad;
        const double most =
            labels->left[column + 1] - labels->left[column] - sample - 2.5 * pad;
        char *markup = shorten(text, figure->curve[i].label, most);
        gb_figure_curve_sample(text->cairo, &figure->curve[i], x, y, sample);
        cairo_set_source_rgb(text->cairo, 0.1, 0.1, 0.12);
        gb_text_write_line(text, markup, size, GB_FIGURE_PAGE_LEAST, most,
                           (double[2]){x + sample + pad, y}, align, 0);
        g_free(markup);
        line++;
    }
}

void gb_figure_labels_draw(const struct gb_figure_labels *labels,
                           const struct gb_figure *figure, const struct gb_text *text)
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
        gb_text_write(text, figure->curve[i].label, size, 0.0, labels->at[i], align, 0);
    }
    if (labels->legend[2] > 0.0) {
        draw_legend(labels, figure, text);
    }
}

void gb_figure_labels_finish(struct gb_figure_labels *labels)
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

void gb_figure_labels_overrun(const struct gb_figure *figure,
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

void gb_figure_labels_annotate(const struct gb_figure *figure,
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
