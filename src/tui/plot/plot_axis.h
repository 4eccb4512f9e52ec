#ifndef GB_TUI_PLOT_PLOT_AXIS_H
#define GB_TUI_PLOT_PLOT_AXIS_H

#include <stdbool.h>
#include <stddef.h>

enum { GB_PLOT_TICKS = 24, GB_PLOT_TICK_TEXT = 16 };

/* An axis: round ends, and ticks at 1, 2 or 5 times a power of ten. */
struct gb_plot_axis {
    double low, high;
    bool log;
    int ticks;
    double tick[GB_PLOT_TICKS];
    char text[GB_PLOT_TICKS][GB_PLOT_TICK_TEXT];
};

/* Fits an axis around data between low and high.
 *
 * most   how many ticks there is room for (at least 2)
 * log    falls back to linear when high is not positive; a low that is not positive
 * becomes three decades below high Never fails: equal or non-finite ends become an axis
 * from 0 to 1 or around the value. */
void gb_plot_axis_fit(struct gb_plot_axis *axis, double low, double high, bool log,
                      int max);

/* Ends a fitted axis exactly at these values, of which a low one without a logarithm is
 * ignored; at least two ticks remain, at the ends if need be. */
void gb_plot_axis_end(struct gb_plot_axis *axis, double low, double high);

/* 0 at low, 1 at high; NaN for values without a logarithm on a logarithmic axis. */
double gb_plot_axis_position(const struct gb_plot_axis *axis, double value);

#endif
