#include <glib.h>
#include <math.h>
#include <stdio.h>

#include "tui/panel/panels.h"
#include "tui/view/views.h"

/* The cursor over the settings of a chart, along their cost, and over the rows of the
 * stability, along the run. */

enum { PAGE_SETTINGS = 10, DESCRIPTION = 160 };

/* What the cursor moves over. */
struct rows {
    size_t known;        /* how many */
    const size_t *order; /* their rows; NULL: as they are */
    size_t first;        /* row of the first movement */
};

static struct rows rows_of(const struct gb_panel_plot *panel,
                           const struct gb_session *session)
{
    const struct gb_chart_csv *chart = session->chart;
    const struct gb_stability_csv *stability = session->stability;
    if (panel->view->need == GB_VIEW_NEEDS_STABILITY) {
        return stability == NULL
                   ? (struct rows){0}
                   : (struct rows){stability->count, NULL,
                                   gb_stability_csv_weakest(stability)};
    }
    return chart == NULL ? (struct rows){0}
                         : (struct rows){chart->known, chart->by_cost, chart->chosen};
}

static size_t row_at(const struct rows *rows, long long rank)
{
    return rows->order != NULL ? rows->order[rank] : (size_t)rank;
}

bool gb_panel_plot_settings_at(const struct gb_panel_plot *panel,
                               const struct gb_session *session, size_t *row)
{
    const struct rows rows = rows_of(panel, session);
    *row = panel->setting;
    for (size_t k = 0; k < rows.known && panel->setting_on == panel->view; k++) {
        if (row_at(&rows, (long long)k) == *row) {
            return panel->view->abscissa == GB_VIEW_SETTINGS;
        }
    }
    return false;
}

/* Rank of a row; 0 for one that is not known. */
static long long rank_of(const struct rows *rows, size_t row)
{
    for (size_t k = 0; k < rows->known; k++) {
        if (row_at(rows, (long long)k) == row) {
            return (long long)k;
        }
    }
    return 0;
}

static void go_to(struct gb_panel_plot *panel, const struct rows *rows, long long rank)
{
    panel->setting = row_at(rows, CLAMP(rank, 0, (long long)rows->known - 1));
    panel->setting_on = panel->view;
}

/* The first movement shows the recommended setting, or the cheapest one; the weakest state
 * of the method in use. */
static void move(struct gb_panel_plot *panel, const struct rows *rows, long long by)
{
    const bool on = panel->setting_on == panel->view;
    go_to(panel, rows, rank_of(rows, on ? panel->setting : rows->first) + (on ? by : 0));
}

void gb_panel_plot_settings_navigate(struct gb_panel_plot *panel,
                                     const struct gb_session *session,
                                     enum gb_action action)
{
    const struct rows rows = rows_of(panel, session);
    static const int steps[] = {
        [GB_ACTION_LEFT] = -1,
        [GB_ACTION_UP] = -1,
        [GB_ACTION_RIGHT] = 1,
        [GB_ACTION_DOWN] = 1,
        [GB_ACTION_PAGE_UP] = -PAGE_SETTINGS,
        [GB_ACTION_PAGE_DOWN] = PAGE_SETTINGS,
    };
    if (action == GB_ACTION_BACK) {
        panel->setting_on = NULL;
    } else if (rows.known > 0) {
        if (action == GB_ACTION_HOME || action == GB_ACTION_END) {
            go_to(panel, &rows,
                  action == GB_ACTION_HOME ? 0 : (long long)rows.known - 1);
        } else if ((size_t)action < G_N_ELEMENTS(steps) && steps[action] != 0) {
            move(panel, &rows, steps[action]);
        }
    }
}

static void describe_stability(const struct gb_stability_csv *table, size_t i,
                               struct gb_message *message)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    message->style = row->stable ? GB_STYLE_PLAIN : GB_STYLE_WARN;
    snprintf(message->text, sizeof message->text,
             "%s at %.4g MPa, density %.4f: stable to %.3g, takes %s%.3g, %.2f times: "
             "%s%s; Enter applies",
             row->method, table->p_mpa[i], row->density, row->measured,
             table->in_time ? "" : "up to ", row->used, table->margin[i], row->stable ? "stable" : "unstable",
             row->in_use ? ", in use" : "");
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
    if (panel->view->need == GB_VIEW_NEEDS_STABILITY) {
        describe_stability(session->stability, row, message);
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
