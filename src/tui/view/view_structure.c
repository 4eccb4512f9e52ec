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

/* Draws each bin in four directions, because the distribution depends only on the angle
 * to z. */
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

/* Equal scales of both axes make a circle round, because dots are square in all glyph
 * sets. */
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

void gb_view_structure_rose(struct gb_panel_plot *panel, const struct gb_session *session)
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

/* Upper limit of the axis.  The first peak is a delta function and would hide the rest.
 */
static const double shown_max = 8.0;

void gb_view_structure_distances(struct gb_panel_plot *panel,
                                 const struct gb_session *session)
{
    const struct gb_view_sample *sample = gb_session_shown(session).sample;
    struct gb_plot *plot = &panel->plot;
    if (sample == NULL || !sample->valid || !(sample->rdf_reach > 0.0) ||
        !gb_panel_plot_reserve(panel, GB_VIEW_SAMPLE_RDF)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, "no packing yet");
        return;
    }
    double max = 2.0;
    double peak = 0.0;
    for (int i = 0; i < GB_VIEW_SAMPLE_RDF; i++) {
        panel->x[i] = (i + 0.5) * sample->rdf_reach / GB_VIEW_SAMPLE_RDF;
        panel->y[i] = fmin(sample->rdf[i], shown_max);
        /* not fmax: gcc 12.2 for aarch64 fails on its reduction */
        max = panel->y[i] > max ? panel->y[i] : max;
        peak = sample->rdf[i] > peak ? sample->rdf[i] : peak;
    }
    const double x_ends[2] = {0.0, sample->rdf_reach};
    const double y_ends[2] = {0.0, max};
    const double one[2] = {1.0, 1.0};
    char text[64];
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "r / d", "g(r)");
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = x_ends, .y = one, .count = 2, .ink = GB_PLOT_INK_AXIS});
    gb_plot_line(plot, &(struct gb_plot_series){.x = panel->x,
                                                .y = panel->y,
                                                .count = GB_VIEW_SAMPLE_RDF,
                                                .ink = GB_PLOT_INK_SERIES});
    snprintf(text, sizeof text, "first peak %.3g, relative density %.4f", peak,
             sample->density);
    gb_plot_text(plot, 1, plot->left + plot->field_cols / 3, GB_PLOT_INK_TEXT, text);
}

void gb_view_structure_histogram(struct gb_panel_plot *panel,
                                 const struct gb_session *session)
{
    const double *share = gb_session_shown(session).now->histogram;
    const double x_ends[2] = {0.0, GB_SNAPSHOT_HISTOGRAM};
    double y_ends[2] = {0.0, 1.0};
    double max = 0.0;
    for (int i = 0; i < GB_SNAPSHOT_HISTOGRAM; i++) {
        max = fmax(max, 100.0 * share[i]);
    }
    y_ends[1] = max > 0.0 ? max : 1.0;
    gb_plot_axes(&panel->plot, x_ends, y_ends, GB_PLOT_LINEAR, "coordination number",
                 "share of particles, %");
    for (int i = 0; i < GB_SNAPSHOT_HISTOGRAM; i++) {
        gb_plot_bar(&panel->plot, i, i + 1.0, 100.0 * share[i], GB_PLOT_INK_SERIES);
    }
}
