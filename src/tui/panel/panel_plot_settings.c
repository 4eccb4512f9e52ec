#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "tui/panel/panels.h"
#include "tui/view/views.h"

/* The cursor over the settings of a chart, along their cost. */

enum { PAGE_SETTINGS = 10, DESCRIPTION = 160 };

bool gb_panel_plot_settings_at(const struct gb_panel_plot *panel,
                               const struct gb_session *session, size_t *row)
{
    const struct gb_chart_csv *chart = session->chart;
    *row = panel->setting;
    return panel->view->abscissa == GB_VIEW_SETTINGS && panel->setting_on &&
           chart != NULL && panel->setting < chart->count &&
           gb_chart_csv_is_known(chart, panel->setting);
}

/* Rank of a row by its cost; 0 for one that is not known. */
static long long rank_of(const struct gb_chart_csv *chart, size_t row)
{
    for (size_t k = 0; k < chart->known; k++) {
        if (chart->by_cost[k] == row) {
            return (long long)k;
        }
    }
    return 0;
}

/* The first movement shows the recommended setting, or the cheapest one. */
static void move(struct gb_panel_plot *panel, const struct gb_chart_csv *chart,
                 long long by)
{
    const long long last = (long long)chart->known - 1;
    const long long from =
        rank_of(chart, panel->setting_on ? panel->setting : chart->chosen);
    const long long to = CLAMP(from + (panel->setting_on ? by : 0), 0, last);
    panel->setting = chart->by_cost[to];
    panel->setting_on = true;
}

void gb_panel_plot_settings_navigate(struct gb_panel_plot *panel,
                                     const struct gb_session *session,
                                     enum gb_action action)
{
    const struct gb_chart_csv *chart = session->chart;
    static const int steps[] = {
        [GB_ACTION_LEFT] = -1,
        [GB_ACTION_UP] = -1,
        [GB_ACTION_RIGHT] = 1,
        [GB_ACTION_DOWN] = 1,
        [GB_ACTION_PAGE_UP] = -PAGE_SETTINGS,
        [GB_ACTION_PAGE_DOWN] = PAGE_SETTINGS,
    };
    if (action == GB_ACTION_BACK) {
        panel->setting_on = false;
    } else if (chart != NULL && chart->known > 0) {
        if (action == GB_ACTION_HOME || action == GB_ACTION_END) {
            panel->setting_on = true;
            panel->setting =
                chart->by_cost[action == GB_ACTION_HOME ? 0 : chart->known - 1];
        } else if ((size_t)action < G_N_ELEMENTS(steps) && steps[action] != 0) {
            move(panel, chart, steps[action]);
        }
    }
}

void gb_panel_plot_settings_describe(const struct gb_panel_plot *panel,
                                     const struct gb_session *session,
                                     struct gb_message *message)
{
    const struct gb_chart_csv *chart = session->chart;
    char text[DESCRIPTION];
    size_t row = 0;
    message->style = GB_STYLE_PLAIN;
    if (!gb_panel_plot_settings_at(panel, session, &row)) {
        message->style = GB_STYLE_DIM;
        snprintf(message->text, sizeof message->text, "%s; v and V change the view",
                 panel->view->hint);
        return;
    }
    snprintf(message->text, sizeof message->text,
             "%.3g CPU s a cell, error below %.2g%s%s; Enter applies %s",
             chart->seconds[row], chart->error[row], chart->noise[row] ? " (noise)" : "",
             row == chart->chosen ? ", recommended"
             : chart->front[row]  ? ", Pareto-optimal"
                                  : "",
             gb_chart_describe(&chart->setting[row], text, sizeof text));
}
