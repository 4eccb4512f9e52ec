#include <math.h>

#include "tui/view/views.h"

void gb_view_histogram_draw(struct gb_panel_plot *panel, const struct gb_session *session)
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
