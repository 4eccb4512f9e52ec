#include <math.h>

#include "tui/view/views.h"

enum { MARK_LOAD = 1 };

static double ratio(const struct gb_point *point)
{
    return point->branch <= 0 && point->pz_pa > 0.0 ? point->px_pa / point->pz_pa
                                                    : (double)NAN;
}

/* Below this fraction of the highest pressure the ratio is noise. */
static const double noise = 0.01;

void gb_view_ratio_draw(struct gb_panel_plot *panel, const struct gb_session *session)
{
    const struct gb_session_shown shown = gb_session_shown(session);
    struct gb_plot *plot = &panel->plot;
    double x_ends[2] = {HUGE_VAL, -HUGE_VAL};
    double y_ends[2] = {0.0, 1.2};
    double max = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < shown.points; i++) {
        max = fmax(max, gb_curve_at(shown.curve, i)->pz_pa);
    }
    if (shown.points < 2 || !gb_panel_plot_reserve(panel, shown.points)) {
        gb_plot_text(plot, plot->rows / 2, 2, GB_PLOT_INK_TEXT, "no points yet");
        return;
    }
    for (size_t i = 0; i < shown.points; i++) {
        const struct gb_point *point = gb_curve_at(shown.curve, i);
        const double value = point->pz_pa > noise * max ? ratio(point) : (double)NAN;
        panel->x[count] = point->density;
        panel->y[count++] = value;
        if (isfinite(value)) {
            x_ends[0] = fmin(x_ends[0], point->density);
            x_ends[1] = fmax(x_ends[1], point->density);
        }
    }
    gb_panel_plot_ranges_x(&panel->ranges, GB_PLOT_RANGE_DENSITY, 1.0, plot, x_ends);
    gb_panel_plot_ranges_y(&panel->ranges, GB_PLOT_RANGE_RATIO, 1.0, plot, y_ends);
    gb_plot_axes(plot, x_ends, y_ends, GB_PLOT_LINEAR, "relative density",
                 "px/pz, loading");
    const double one[2] = {1.0, 1.0};
    const double ends[2] = {plot->x.low, plot->x.high};
    gb_plot_line(plot, &(struct gb_plot_series){
                           .x = ends, .y = one, .count = 2, .ink = GB_PLOT_INK_AXIS});
    gb_plot_line(plot, &(struct gb_plot_series){.x = panel->x,
                                                .y = panel->y,
                                                .count = count,
                                                .ink = GB_PLOT_INK_SERIES,
                                                .marker = MARK_LOAD});
    if (panel->cursor_on && panel->cursor < shown.points) {
        gb_plot_cursor(plot, panel->x[panel->cursor], panel->y[panel->cursor]);
    }
}
