#include <math.h>
#include <stdio.h>

#include "tui/view/views.h"

/* Upper limit of the axis: the first peak is a delta function and would hide the rest. */
static const double shown_max = 8.0;

void gb_view_distances_draw(struct gb_panel_plot *panel, const struct gb_session *session)
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
        /* not fmax: gcc 12.2 stops at its reduction on aarch64 */
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
