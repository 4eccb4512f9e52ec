#include <math.h>

#include "tui/watch/watch_views.h"

enum { ENTRIES = 64 };

static void find_ends(const struct gb_watch *watch, double x[2], double y[2])
{
    const struct gb_runset_view *runset = &watch->runset;
    x[0] = y[0] = HUGE_VAL;
    x[1] = y[1] = -HUGE_VAL;
    for (size_t g = 0; g < runset->groups; g++) {
        for (size_t k = 0; k < runset->levels; k++) {
            const double error = runset->group[g].error[k];
            const double mean = runset->group[g].mean[k];
            const double wide = isfinite(error) ? error : 0.0;
            if (isfinite(mean)) {
                x[0] = fmin(x[0], mean - wide);
                x[1] = fmax(x[1], mean + wide);
                y[0] = fmin(y[0], runset->level_pa[k] / 1e6);
                y[1] = fmax(y[1], runset->level_pa[k] / 1e6);
            }
        }
    }
}

/* The mean plus `off` standard errors. */
static void draw_curve(struct gb_watch *watch, const struct gb_runset_view_group *group,
                       double off, int ink, int marker)
{
    double x[GB_RUNSET_VIEW_LEVELS];
    double y[GB_RUNSET_VIEW_LEVELS];
    for (size_t k = 0; k < watch->runset.levels; k++) {
        x[k] = group->mean[k] + (off != 0.0 ? off * group->error[k] : 0.0);
        y[k] = watch->runset.level_pa[k] / 1e6;
    }
    gb_plot_line(&watch->plot, &(struct gb_plot_series){.x = x,
                                                        .y = y,
                                                        .count = watch->runset.levels,
                                                        .ink = ink,
                                                        .marker = marker,
                                                        .spacing = 8});
}

/* Draws all groups and the legend, with `foot` rows for it below the plot; false when the
 * legend is incomplete or covers a line.  *needed: rows of a complete foot. */
static bool draw_groups(struct gb_watch *watch, const struct gb_paint *paint,
                        const double x[2], const double y[2], int foot, int *needed)
{
    const struct gb_runset_view *runset = &watch->runset;
    struct gb_plot_entry entry[ENTRIES];
    int entries = 0;
    if (!gb_plot_resize(&watch->plot, paint->rect.rows - 1, paint->rect.cols - 2,
                        (enum gb_plot_glyphs)watch->glyphs, NULL)) {
        return true;
    }
    watch->plot.foot = foot;
    gb_plot_axes(&watch->plot, x, y, watch->linear ? GB_PLOT_LINEAR : GB_PLOT_LOG,
                 "relative density", "p, MPa");
    for (size_t g = 0; g < runset->groups; g++) { /* bands first */
        draw_curve(watch, &runset->group[g], -1.0, GB_PLOT_INK_DIM, 0);
        draw_curve(watch, &runset->group[g], 1.0, GB_PLOT_INK_DIM, 0);
    }
    for (size_t g = 0; g < runset->groups; g++) {
        const int ink = GB_PLOT_INK_SERIES + (int)(g % GB_PLOT_COLOURS);
        const int marker = 1 + (int)(g % 7);
        draw_curve(watch, &runset->group[g], 0.0, ink, marker);
        if (entries < ENTRIES) {
            entry[entries] = (struct gb_plot_entry){.ink = ink, .marker = marker};
            gb_watch_views_group_name(&runset->group[g], entry[entries].name,
                                      GB_PLOT_NAME);
            entries++;
        }
    }
    *needed = gb_plot_legend_foot(&watch->plot, entry, entries);
    return gb_plot_legend(&watch->plot, entry, entries);
}

void gb_watch_curves_draw(struct gb_watch *watch, const struct gb_paint *paint)
{
    double x[2], y[2];
    int foot = 0;
    find_ends(watch, x, y);
    if (!(x[1] > x[0])) {
        gb_paint_text(paint, 2, 2, GB_STYLE_PLAIN, "no curve has reached 1 MPa yet");
        return;
    }
    if (!draw_groups(watch, paint, x, y, 0, &foot)) { /* no free area inside */
        (void)draw_groups(watch, paint, x, y, foot, &foot);
    }
    gb_paint_plot(paint, 1, 1, &watch->plot);
}
