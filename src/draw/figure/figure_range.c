#include "draw/figure/figure_range.h"

#include <math.h>

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

void gb_figure_range_find(const struct gb_figure *figure, enum gb_figure_range_axis which,
                          double *low, double *high)
{
    const bool along_x = which == GB_FIGURE_RANGE_X;
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

void gb_figure_range_inset(const struct gb_figure *figure, double *low, double *high)
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
