#include <math.h>
#include <stdio.h>

#include "tui/view/views.h"

enum { SIDES = 4, ROSE_POINTS = SIDES * GB_SNAPSHOT_ROSE + 1, CIRCLE = 73 };

static void draw_line(struct gb_plot *plot, const double *x, const double *y,
                      size_t count, int ink, int marker)
{
    const struct gb_plot_series series = {
        .x = x, .y = y, .count = count, .ink = ink, .marker = marker, .spacing = 6};
    gb_plot_line(plot, &series);
}

/* The distribution depends on the angle to z only: each bin is drawn in four
 * directions. */
static size_t close_rose(const double rose[GB_SNAPSHOT_ROSE], double sign, double *x,
                         double *y)
{
    for (int i = 0; i < ROSE_POINTS; i++) {
        const int step = i % (ROSE_POINTS - 1);
        const int quarter = step / GB_SNAPSHOT_ROSE;
        const int bin_from_axis = step % GB_SNAPSHOT_ROSE;
        const int bin =
            quarter % 2 == 0 ? bin_from_axis : GB_SNAPSHOT_ROSE - 1 - bin_from_axis;
        const double angle = (step + 0.5) * 2.0 * M_PI / (ROSE_POINTS - 1);
        const double r = sign * rose[bin] > 0.0 ? sign * rose[bin] : NAN;
        x[i] = r * sin(angle);
        y[i] = r * cos(angle);
    }
    return ROSE_POINTS;
}

static void draw_frame(struct gb_plot *plot, double radius)
{
    double x[CIRCLE];
    double y[CIRCLE];
    for (int i = 0; i < CIRCLE; i++) {
        x[i] = radius * sin(2.0 * M_PI * i / (CIRCLE - 1));
        y[i] = radius * cos(2.0 * M_PI * i / (CIRCLE - 1));
    }
    draw_line(plot, x, y, CIRCLE, GB_PLOT_INK_AXIS, 0);
    const double across[2] = {-radius, radius};
    const double none[2] = {0.0, 0.0};
    draw_line(plot, across, none, 2, GB_PLOT_INK_AXIS, 0);
    draw_line(plot, none, across, 2, GB_PLOT_INK_AXIS, 0);
}

/* Dots are square in all glyph sets: equal scales of both axes make a circle round. */
static void make_square(struct gb_plot *plot, double radius)
{
    const double wide = plot->cols;
    const double high = 2.0 * plot->rows;
    const double x = radius * fmax(1.0, wide / high) * 1.02;
    const double y = radius * fmax(1.0, high / wide) * 1.02;
    const double x_ends[2] = {-x, x};
    const double y_ends[2] = {-y, y};
    gb_plot_bare(plot, x_ends, y_ends);
}

static void write_numbers(struct gb_plot *plot, const double rose[GB_SNAPSHOT_ROSE],
                          double radius)
{
    char text[96];
    const double along = rose[0];
    const double across = rose[GB_SNAPSHOT_ROSE - 1];
    snprintf(text, sizeof text, "circle %.2e E d^2", radius);
    gb_plot_text(plot, 0, 1, GB_PLOT_INK_TEXT, text);
    snprintf(text, sizeof text, "z %.2e", along);
    gb_plot_text(plot, plot->rows - 2, 1, GB_PLOT_INK_TEXT, text);
    snprintf(text, sizeof text, "x %.2e", across);
    gb_plot_text(plot, plot->rows - 1, 1, GB_PLOT_INK_TEXT, text);
    gb_plot_text(plot, 0, plot->cols / 2 + 2, GB_PLOT_INK_TEXT, "z");
}

void gb_view_rose_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_snapshot *now = gb_session_shown(session).now;
    const double *rose = now->rose;
    struct gb_plot *plot = &panel->plot;
    double radius = 0.0;
    for (int i = 0; i < GB_SNAPSHOT_ROSE; i++) {
        radius = isfinite(rose[i]) ? fmax(radius, fabs(rose[i])) : radius;
    }
    if (!now->now_valid || !(radius > 0.0)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, "no contacts yet");
        return;
    }
    double x[ROSE_POINTS];
    double y[ROSE_POINTS];
    make_square(plot, radius);
    draw_frame(plot, radius);
    draw_line(plot, x, y, close_rose(rose, -1.0, x, y), GB_PLOT_INK_SERIES + 4, 2);
    draw_line(plot, x, y, close_rose(rose, 1.0, x, y), GB_PLOT_INK_SERIES, 0);
    write_numbers(plot, rose, radius);
    gb_plot_text(plot, 1, 1, GB_PLOT_INK_SERIES, "line: compressive");
    gb_plot_text(plot, 2, 1, GB_PLOT_INK_SERIES + 4,
                 plot->glyphs == GB_PLOT_ASCII ? "o: tensile" : "\u25cb: tensile");
}
