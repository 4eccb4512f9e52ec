#ifndef GB_DRAW_FIGURE_FIGURE_AXIS_H
#define GB_DRAW_FIGURE_FIGURE_AXIS_H

#include <stdbool.h>
#include <stddef.h>

enum { GB_FIGURE_AXIS_TICKS = 16, GB_FIGURE_AXIS_MINOR = 96 };

/* Map from values to coordinates (points) along one axis, with its ticks. */
struct gb_figure_axis_scale {
    bool log;
    double low, high; /* values at the two ends */
    double from, to;  /* their coordinates */
    int power;        /* ticks are labelled in units of 10^power */
    int ticks, minors;
    double tick[GB_FIGURE_AXIS_TICKS];
    char label[GB_FIGURE_AXIS_TICKS][40]; /* Pango markup; "" between labelled decades */
    double minor[GB_FIGURE_AXIS_MINOR];
};

enum gb_figure_axis_kind { GB_FIGURE_AXIS_LINEAR, GB_FIGURE_AXIS_LOG };

/* Ends and ticks for values from low to high (low > 0 when logarithmic), about `wanted` of them.
 * exact keeps the ends as they are.  Ends that are not finite, equal or reversed are
 * replaced by valid ones. */
void gb_figure_axis_fit(struct gb_figure_axis_scale *scale, enum gb_figure_axis_kind kind,
                        double low, double high, int wanted, const bool exact[2]);

double gb_figure_axis_position(const struct gb_figure_axis_scale *scale, double value);

#endif
