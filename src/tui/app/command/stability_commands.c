#include <glib.h>
#include <stdio.h>

#include "scene/field/keep_points.h"
#include "scene/loading_kind.h"
#include "tui/app/command/key_commands.h"
#include "tui/app/dialog/dialogs.h"
#include "tui/view/views.h"

/* Stability of the methods of this scene, measured by `greenbody stability` as a child
 * process; key and cursor are those of the chart. */

void gb_stability_commands_open(struct gb_app *app)
{
    struct gb_error err = {0};
    if (!gb_loading_kind_check_cell(gb_session_params(&app->screen.session), "stability",
                                    &err)) {
        gb_screen_commands_message(app, GB_STYLE_WARN, err.text);
        return;
    }
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_stability, "");
}

static void start(struct gb_app *app, char *points)
{
    struct gb_session *session = &app->screen.session;
    const char *words[] = {"stability", NULL,   "-o", NULL, *points != '\0' ? "--at" : NULL,
                           points,      NULL};
    if (gb_job_commands_start(app, "stability", GB_CHILD_COMMAND_QUIET, words)) {
        g_clear_pointer(&session->stability, gb_stability_csv_destroy);
        gb_chart_job_follow(&session->chart_job, session->child.path, true);
        app->screen.plot.view = gb_views_with(GB_VIEW_NEEDS_STABILITY);
        app->screen.plot.setting_on = NULL;
        app->screen.focus = GB_PANE_PLOT;
        gb_screen_commands_message(app, GB_STYLE_PLAIN,
                                   "measuring the methods; X again stops");
    }
}

void gb_stability_commands_accept(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    struct gb_keep_points points;
    struct gb_error err = {0};
    char *answer = g_strstrip(g_strdup(gb_dialog_answer(dialog)));
    if (gb_keep_points_parse(answer, &points, &err) && points.every == 0) {
        start(app, answer);
    } else {
        gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR,
                           "%.40s: accepted pressures or densities, as 10 MPa; "
                           "density=0.5, or nothing",
                           answer);
    }
    g_free(answer);
}

void gb_stability_commands_apply(struct gb_screen *screen, size_t row)
{
    struct gb_session *session = &screen->session;
    struct gb_error err = {0};
    char text[64];
    if (!gb_stability_csv_apply(session->stability, row, gb_session_params(session), text,
                                sizeof text, &err)) {
        screen->message.style = GB_STYLE_WARN;
        snprintf(screen->message.text, sizeof screen->message.text, "%s", err.text);
        return;
    }
    gb_session_note(session, "stable method: %s", text);
    gb_panel_params_edit_changed(session, &screen->message);
    if (screen->message.text[0] == '\0') {
        screen->message.style = GB_STYLE_GOOD;
        snprintf(screen->message.text, sizeof screen->message.text, "applied: %s; u undoes",
                 text);
    }
}
