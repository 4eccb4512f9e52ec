#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/view/views.h"

/* Accuracy against cost of this scene, measured by `greenbody chart` as a child process. */

/* As many cells as the command takes by itself; a quarter of an hour of one core. */
static const char default_answer[] = "4 15min";

enum { CELLS_MIN = 2, CELLS_MAX = 1000, DESCRIPTION = 160 };

void gb_chart_commands_open(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    (void)key;
    if (gb_chart_job_runs(&session->child)) {
        gb_child_command_stop(&session->child);
        gb_screen_commands_message(app, GB_STYLE_PLAIN,
                                   session->chart_job.stability
                                       ? "the measurement is stopped"
                                       : "the chart is stopped");
        return;
    }
    if (app->screen.plot.view->need == GB_VIEW_NEEDS_STABILITY) {
        gb_stability_commands_open(app);
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_chart, default_answer);
}

/* What was typed: cells, CPU time, pressures. */
struct answer {
    char **parts;
    char *pressures; /* NULL: those of the scene */
};

static bool parse(struct answer *answer, const char *text, struct gb_error *err)
{
    guint64 cells = 0;
    double budget_s = 0.0;
    char *stripped = g_strstrip(g_strdup(text));
    answer->parts = g_strsplit(stripped, " ", 3);
    g_free(stripped);
    const bool one = answer->parts[0] != NULL;
    const bool two = one && answer->parts[1] != NULL;
    answer->pressures =
        two && answer->parts[2] != NULL ? g_strstrip(answer->parts[2]) : NULL;
    if (!one || !g_ascii_string_to_unsigned(answer->parts[0], 10, CELLS_MIN, CELLS_MAX,
                                            &cells, NULL)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the number of cells must be between %d and %d; then, if "
                            "wanted, a CPU time and pressures: 4 15min 100MPa;1GPa",
                            CELLS_MIN, CELLS_MAX);
    }
    return !two ||
           (gb_units_parse(answer->parts[1], GB_DIM_TIME, &budget_s, NULL) &&
            budget_s > 0.0) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.40s: accepted a CPU time above 0, as in 15min",
                        answer->parts[1]);
}

static void start(struct gb_app *app, const struct answer *answer)
{
    struct gb_session *session = &app->screen.session;
    const bool budget = answer->parts[1] != NULL;
    const char *words[] = {"chart",
                           NULL,
                           "-o",
                           NULL,
                           "--seeds",
                           answer->parts[0],
                           budget ? "--budget" : NULL,
                           answer->parts[1],
                           answer->pressures != NULL ? "--at" : NULL,
                           answer->pressures,
                           NULL};
    if (gb_job_commands_start(app, "chart", GB_CHILD_COMMAND_QUIET, words)) {
        g_clear_pointer(&session->chart, gb_chart_csv_destroy);
        gb_chart_job_follow(&session->chart_job, session->child.path, false);
        app->screen.plot.view = gb_views_with(GB_VIEW_NEEDS_CHART);
        app->screen.plot.setting_on = NULL;
        app->screen.focus = GB_PANE_PLOT;
        gb_screen_commands_message(app, GB_STYLE_PLAIN,
                                   "measuring the settings; X again stops");
    }
}

void gb_chart_commands_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct answer answer;
    struct gb_error err = {0};
    if (parse(&answer, gb_dialog_answer(dialog), &err)) {
        start(app, &answer);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
    g_strfreev(answer.parts);
}

void gb_chart_commands_apply(struct gb_screen *screen)
{
    struct gb_session *session = &screen->session;
    char text[DESCRIPTION];
    size_t row = 0;
    if (!gb_panel_plot_settings_at(&screen->plot, session, &row)) {
        return;
    }
    if (screen->plot.view->need == GB_VIEW_NEEDS_STABILITY) {
        gb_stability_commands_apply(screen, row);
        return;
    }
    const struct gb_chart_setting *setting = &session->chart->setting[row];
    screen->message.style = GB_STYLE_WARN;
    if (setting->relaxer[0] == '\0') {
        snprintf(screen->message.text, sizeof screen->message.text,
                 "this chart.csv has no settings to apply");
        return;
    }
    gb_chart_csv_apply(session->chart, row, gb_session_params(session));
    gb_chart_describe(setting, text, sizeof text);
    gb_session_note(session, "setting of the chart: %s", text);
    gb_panel_params_edit_changed(session, &screen->message);
    if (screen->message.text[0] == '\0') {
        screen->message.style = GB_STYLE_GOOD;
        snprintf(screen->message.text, sizeof screen->message.text,
                 "applied: %s; u undoes", text);
    }
}
