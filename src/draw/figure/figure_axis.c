#include "draw/figure/figure_axis.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"

#define MINUS "−"

/* A number in typographic form: "−0.25"; decimals after the point. */
static void write_number(double value, int decimals, char *text, size_t size)
{
    char plain[36];
    snprintf(plain, sizeof plain, "%.*f", decimals, fabs(value));
    const bool zero = strspn(plain, "0.") == strlen(plain);
    snprintf(text, size, "%s%s", value < 0.0 && !zero ? MINUS : "", plain);
}

double gb_figure_axis_position(const struct gb_figure_axis_scale *scale, double value)
{
    const double share = scale->log
                             ? log(value / scale->low) / log(scale->high / scale->low)
                             : (value - scale->low) / (scale->high - scale->low);
    return scale->from + share * (scale->to - scale->from);
}

static void put_tick(struct gb_figure_axis_scale *scale, double value, const char *label)
{
    if (scale->ticks < GB_FIGURE_AXIS_TICKS) {
        scale->tick[scale->ticks] = value;
        g_strlcpy(scale->label[scale->ticks], label, sizeof scale->label[0]);
        scale->ticks++;
    }
}

static void put_minor(struct gb_figure_axis_scale *scale, double value)
{
    if (scale->minors < GB_FIGURE_AXIS_MINOR) {
        scale->minor[scale->minors++] = value;
    }
}

/* Tick step; *parts: number of minor steps in it. */
static double tick_step(double rough, int *parts)
{
    const double step = gb_number_nearest_step(rough);
    *parts = lround(step / pow(10.0, floor(log10(step) + 1e-9))) == 2 ? 4 : 5;
    return step;
}

/* Power of 1000 that is shown in the label of the axis. */
static int common_power(double largest)
{
    if (largest >= 99999.0 || largest < 0.01) {
        return 3 * (int)floor((log10(largest) + 1e-9) / 3.0);
    }
    return 0;
}

static void fit_linear(struct gb_figure_axis_scale *scale, int wanted,
                       const bool exact[2])
{
    int parts = 5;
    const double step = tick_step((scale->high - scale->low) / wanted, &parts);
    const double part = step / parts;
    if (!exact[0]) {
        scale->low = part * floor(scale->low / part + 1e-6);
    }
    if (!exact[1]) {
        scale->high = part * ceil(scale->high / part - 1e-6);
    }
    scale->power = common_power(fmax(fabs(scale->low), fabs(scale->high)));
    const double unit = pow(10.0, scale->power);
    const int decimals = (int)fmax(0.0, ceil(-log10(step / unit) - 1e-6));
    const double first = ceil(scale->low / part - 1e-6);
    for (double k = first; k * part <= scale->high + 1e-6 * part; k += 1.0) {
        if (fabs(remainder(k, parts)) > 0.5) {
            put_minor(scale, k * part);
            continue;
        }
        char text[40];
        write_number(k * part / unit, decimals, text, sizeof text);
        put_tick(scale, k * part, text);
    }
}

/* Decades as plain numbers where they are short, as powers of ten elsewhere. */
static void decade_label(int decade, bool plain, int digit, char *text, size_t size)
{
    if (plain) {
        write_number(digit * pow(10.0, decade), decade < 0 ? -decade : 0, text, size);
    } else if (digit == 1) {
        snprintf(text, size, "10<sup>%s%d</sup>", decade < 0 ? MINUS : "", abs(decade));
    } else {
        snprintf(text, size, "%d·10<sup>%s%d</sup>", digit, decade < 0 ? MINUS : "",
                 abs(decade));
    }
}

/* Which of 1, 2, ..., 9 are labelled, by the number of decades. */
static bool is_labelled(int digit, double decades)
{
    return digit == 1 || (decades < 2.0 && (digit == 2 || digit == 5)) ||
           (decades < 0.8 && (digit == 3 || digit == 4 || digit == 7));
}

static void fit_log(struct gb_figure_axis_scale *scale, int wanted, const bool exact[2])
{
    double decades = log10(scale->high / scale->low);
    const int first = (int)floor(log10(scale->low) + 1e-9);
    if (!exact[0]) {
        const double unit = decades > 1.5 ? 10.0 : 1.0;
        const double base = pow(10.0, first);
        scale->low = unit > 1.0 && scale->low / base < 3.0
                         ? base
                         : base * floor(scale->low / base + 1e-9);
    }
    if (!exact[1]) {
        const double base = pow(10.0, floor(log10(scale->high) + 1e-9));
        const double digit = ceil(scale->high / base - 1e-9);
        scale->high = base * (decades > 1.5 && digit >= 6.0 ? 10.0 : digit);
    }
    decades = log10(scale->high / scale->low);
    const int last = (int)ceil(log10(scale->high) - 1e-9);
    const bool plain = first >= -3 && last <= 4;
    const int every = (int)fmax(1.0, ceil(decades / wanted));
    for (int decade = first; decade <= last; decade++) {
        for (int digit = 1; digit <= 9; digit++) {
            char text[40] = "";
            const double value = digit * pow(10.0, decade);
            if (value < scale->low * (1.0 - 1e-9) || value > scale->high * (1.0 + 1e-9)) {
                continue;
            }
            if (!is_labelled(digit, decades)) {
                put_minor(scale, value);
                continue;
            }
            if (digit > 1 || decade % every == 0) {
                decade_label(decade, plain, digit, text, sizeof text);
            }
            put_tick(scale, value, text);
        }
    }
}

/* Replaces ends that are not finite, equal or reversed by valid ones. */
static void make_valid(struct gb_figure_axis_scale *scale)
{
    if (!isfinite(scale->low) || !isfinite(scale->high)) {
        scale->low = scale->log ? 0.1 : 0.0;
        scale->high = 1.0;
    }
    if (scale->high < scale->low) {
        const double low = scale->high;
        scale->high = scale->low;
        scale->low = low;
    }
    if (scale->log) {
        scale->high = fmax(scale->high, 1e-290);
        scale->low = fmax(fmax(scale->low, 1e-300), scale->high * 1e-40);
    }
    const double span = scale->high - scale->low;
    const double size = fmax(fabs(scale->high), fabs(scale->low));
    if (span <= 1e-9 * size || size == 0.0) {
        const double pad = size > 0.0 ? 0.1 * size : 1.0;
        scale->low -= pad;
        scale->high += pad;
    }
}

void gb_figure_axis_fit(struct gb_figure_axis_scale *scale, enum gb_figure_axis_kind kind,
                        double low, double high, int wanted, const bool exact[2])
{
    *scale = (struct gb_figure_axis_scale){
        .log = kind == GB_FIGURE_AXIS_LOG, .low = low, .high = high};
    make_valid(scale);
    if (scale->log) {
        fit_log(scale, wanted, exact);
    } else {
        fit_linear(scale, wanted, exact);
    }
}
