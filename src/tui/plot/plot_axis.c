#include "tui/plot/plot_axis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Decades shown below the largest value if the smallest one is not positive. */
static const double log_decades = 3.0;

/* The smallest number 1, 2 or 5 x 10^k not below a step. */
static double nice_step(double step)
{
    const double decade = pow(10.0, floor(log10(step)));
    static const double nice[] = {1.0, 2.0, 5.0, 10.0};
    for (size_t i = 0; i < 4; i++) {
        /* the tolerance keeps 0.2 when 2 x 0.1 rounds up */
        if (nice[i] * decade >= step * (1.0 - 1e-9)) {
            return nice[i] * decade;
        }
    }
    return 10.0 * decade;
}

/* Decimal digits where they are short, otherwise powers of ten. */
static void write_tick(char *text, double value, double step)
{
    const double size = fabs(value);
    int decimals = (int)ceil(-log10(step) - 1e-9);
    decimals = decimals < 0 ? 0 : decimals;
    if (size < 1e-12 * step) {
        snprintf(text, GB_PLOT_TICK_TEXT, "0");
    } else if (size >= 1e5 || decimals > 4) {
        snprintf(text, GB_PLOT_TICK_TEXT, "%.3g", value);
    } else {
        snprintf(text, GB_PLOT_TICK_TEXT, "%.*f", decimals, value);
    }
}

static void add_tick(struct gb_plot_axis *axis, double value, double step)
{
    if (axis->ticks < GB_PLOT_TICKS) {
        axis->tick[axis->ticks] = value;
        write_tick(axis->text[axis->ticks], value, step);
        axis->ticks++;
    }
}

/* Multiples of the step between two values. */
static double steps_inside(const struct gb_plot_axis *axis, double step, double *first)
{
    *first = ceil(axis->low / step - 1e-6);
    return floor(axis->high / step + 1e-6) - *first;
}

/* Ends are multiples of a fifth of a tick: whole ticks would leave up to half of a small
 * plot empty.  Fewer than two ticks would leave the scale undefined. */
static void fit_linear(struct gb_plot_axis *axis, double low, double high, int max)
{
    double step = nice_step((high - low) / (max > 2 ? max - 1 : 1));
    const double fine = step / 5.0;
    double first = 0.0;
    axis->low = floor(low / fine + 1e-9) * fine;
    axis->high = ceil(high / fine - 1e-9) * fine;
    double count = steps_inside(axis, step, &first);
    if (count < 1.0) {
        step = nice_step(step * 0.4);
        count = steps_inside(axis, step, &first);
    }
    for (double i = 0.0; i <= count; i += 1.0) {
        add_tick(axis, (first + i) * step, step);
    }
}

/* The largest number 1, 2 or 5 x 10^k not above a value. */
static double nice_floor(double value)
{
    const double decade = pow(10.0, floor(log10(value) + 1e-9));
    const double mantissa = value / decade * (1.0 + 1e-9);
    return decade * (mantissa >= 5.0 ? 5.0 : mantissa >= 2.0 ? 2.0 : 1.0);
}

static void add_log_tick(struct gb_plot_axis *axis, double value, double decade)
{
    if (value >= axis->low * (1.0 - 1e-9) && value <= axis->high * (1.0 + 1e-9)) {
        add_tick(axis, value, decade);
    }
}

/* Ticks at the decades: every second, third, ... where space is short; with 2 and 5
 * between them where there are few decades or enough space. */
static void fit_log(struct gb_plot_axis *axis, double low, double high, int max)
{
    axis->low = nice_floor(low);
    axis->high = nice_step(high);
    if (axis->high <= axis->low * (1.0 + 1e-9)) {
        axis->high = nice_step(axis->low * 1.5);
    }
    const double first = floor(log10(axis->low) + 1e-9);
    const double last = ceil(log10(axis->high) - 1e-9);
    const double decades = log10(axis->high / axis->low);
    const bool between = decades < 1.2 || 3.0 * decades + 1.0 <= max;
    const double stride = fmax(ceil((decades + 1.0) / max), 1.0);
    for (double e = first; e <= last + 0.5; e += stride) {
        const double decade = pow(10.0, e);
        add_log_tick(axis, decade, decade);
        if (between) {
            add_log_tick(axis, 2.0 * decade, decade);
            add_log_tick(axis, 5.0 * decade, decade);
        }
    }
}

void gb_plot_axis_fit(struct gb_plot_axis *axis, double low, double high, bool log,
                      int max)
{
    memset(axis, 0, sizeof *axis);
    if (!isfinite(low) || !isfinite(high)) {
        low = 0.0;
        high = 1.0;
    }
    if (low > high) {
        const double swap = low;
        low = high;
        high = swap;
    }
    axis->log = log && high > 0.0;
    if (axis->log) {
        if (low <= 0.0) {
            low = high * pow(10.0, -log_decades);
        }
        fit_log(axis, low, high, max);
        return;
    }
    if (!(high - low > 1e-9 * fmax(fabs(low), fabs(high)))) {
        const double half = high != 0.0 ? 0.1 * fabs(high) : 0.5;
        low -= half;
        high += half;
    }
    fit_linear(axis, low, high, max);
}

void gb_plot_axis_end(struct gb_plot_axis *axis, double low, double high)
{
    const struct gb_plot_axis fitted = *axis;
    axis->low = axis->log && low <= 0.0 ? fitted.low : low;
    axis->high = high;
    const double rest = 1e-9 * (axis->high - axis->low);
    axis->ticks = 0;
    for (int i = 0; i < fitted.ticks; i++) {
        if (fitted.tick[i] >= axis->low - rest && fitted.tick[i] <= axis->high + rest) {
            axis->tick[axis->ticks] = fitted.tick[i];
            memcpy(axis->text[axis->ticks++], fitted.text[i], GB_PLOT_TICK_TEXT);
        }
    }
    if (axis->ticks < 2) {
        axis->ticks = 0;
        add_tick(axis, axis->low, (axis->high - axis->low) / 10.0);
        add_tick(axis, axis->high, (axis->high - axis->low) / 10.0);
    }
}

double gb_plot_axis_position(const struct gb_plot_axis *axis, double value)
{
    if (!axis->log) {
        return (value - axis->low) / (axis->high - axis->low);
    }
    if (!(value > 0.0)) {
        return NAN;
    }
    return log10(value / axis->low) / log10(axis->high / axis->low);
}
