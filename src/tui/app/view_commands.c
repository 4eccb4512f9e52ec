#include <glib.h>

#include "base/units.h"
#include "tui/app/dialogs.h"
#include "tui/app/key_commands.h"
#include "tui/panel/density_table.h"
#include "tui/session/previous.h"
#include "tui/term/paint.h"
#include "tui/view/views.h"

/* The list of curves: pin, name, hide, delete. */

void gb_view_commands_curve_open(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_dialog_show_curves(&screen->dialog, &gb_dialogs_curves, &screen->session,
                          screen->plot.at_pa);
}

/* The focused curve; clears the note of the last command. */
static int focused(struct gb_app *app)
{
    struct gb_dialog *dialog = &app->screen.dialog;
    gb_dialog_set_note(dialog, GB_DIALOG_NOTE_ERROR, "%s", "");
    return gb_dialog_curve(&dialog->curves, &app->screen.session);
}

static void refuse(struct gb_app *app, const char *text)
{
    gb_dialog_set_note(&app->screen.dialog, GB_DIALOG_NOTE_WARNING, "%s", text);
}

void gb_view_commands_curve_pin(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index != GB_CURVE_LIST_NONE &&
        !gb_previous_list_pin(session, index,
                              !gb_previous_list_label(session, index)->pinned)) {
        gb_dialog_set_note(&app->screen.dialog, GB_DIALOG_NOTE_WARNING,
                           "%d curves are pinned, more cannot be: unpin one",
                           GB_PREVIOUS_PINNED);
    }
}

void gb_view_commands_curve_hide(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index >= 0) {
        gb_previous_list_hide(session, index, !session->previous[index].label.hidden);
    } else if (index == GB_CURVE_LIST_RUN) {
        refuse(app, "the run on display is always shown");
    }
}

void gb_view_commands_curve_delete(struct gb_app *app, const struct gb_key *key)
{
    struct gb_session *session = &app->screen.session;
    const int index = focused(app);
    (void)key;
    if (index >= 0) {
        gb_previous_list_delete(session, index);
    } else if (index == GB_CURVE_LIST_RUN) {
        refuse(app, "the run on display stays: another run replaces it");
    }
}

void gb_view_commands_curve_accept_name(struct gb_app *app)
{
    struct gb_session *session = &app->screen.session;
    struct gb_curve_list *list = &app->screen.dialog.curves;
    const int index = focused(app);
    if (index != GB_CURVE_LIST_NONE) {
        char *name = g_strstrip(g_strdup(gb_prompt_text(&list->prompt)));
        struct gb_curve_label *label = gb_previous_list_label(session, index);
        gb_paint_fit_copy(label->name, sizeof label->name, name);
        g_free(name);
    }
    list->naming = false;
}

/* Focuses the plot if the compact layout hides it. */
static void uncover_plot(struct gb_screen *screen)
{
    if (!gb_layout_shows(&screen->layout, GB_PANE_PLOT)) {
        screen->focus = GB_PANE_PLOT;
    }
}

void gb_view_commands_show(struct gb_app *app, const struct gb_key *key)
{
    uncover_plot(&app->screen);
    app->screen.plot.view = gb_views_find(key->name);
}

void gb_view_commands_next(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    uncover_plot(&app->screen);
    gb_panel_plot_step_view(&app->screen.plot, 1);
}

void gb_view_commands_previous(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    uncover_plot(&app->screen);
    gb_panel_plot_step_view(&app->screen.plot, -1);
}

void gb_view_commands_log(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    app->screen.plot.log = !app->screen.plot.log;
}

void gb_view_commands_previous_curves(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    app->screen.plot.hide_previous = !app->screen.plot.hide_previous;
}

/* Cycles through the glyph sets; without UTF-8 there is only one. */
void gb_view_commands_glyphs(struct gb_app *app, const struct gb_key *key)
{
    struct gb_panel_plot *plot = &app->screen.plot;
    (void)key;
    if (plot->utf8) {
        plot->glyphs = (plot->glyphs + 1) % GB_PLOT_GLYPHS;
    }
}

void gb_view_commands_pressure(struct gb_app *app, const struct gb_key *key)
{
    (void)key;
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_pressure, NULL);
}

void gb_view_commands_accept_pressure(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    struct gb_error err = {0};
    double pressure_pa = 0.0;
    if (!gb_units_parse(gb_dialog_answer(&screen->dialog), GB_DIM_PRESSURE, &pressure_pa,
                        &err)) {
        gb_dialog_set_note(&screen->dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    } else if (!(pressure_pa > 0.0)) {
        gb_dialog_set_note(&screen->dialog, GB_DIALOG_NOTE_ERROR,
                           "the pressure must be above 0");
    } else {
        gb_dialog_close(&screen->dialog);
        gb_panel_plot_pressure_set(&screen->plot, &screen->session, pressure_pa);
        screen->focus = GB_PANE_PLOT;
    }
}

void gb_view_commands_ranges(struct gb_app *app, const struct gb_key *key)
{
    char text[GB_PARAMS_VALUE_MAX];
    (void)key;
    gb_panel_plot_ranges_write(&app->screen.plot.ranges, text, sizeof text);
    gb_dialog_show(&app->screen.dialog, &gb_dialogs_ranges, text);
}

void gb_view_commands_accept_ranges(struct gb_app *app)
{
    struct gb_screen *screen = &app->screen;
    struct gb_error err = {0};
    if (gb_panel_plot_ranges_parse(&screen->plot.ranges,
                                   gb_dialog_answer(&screen->dialog), &err)) {
        gb_dialog_close(&screen->dialog);
    } else {
        gb_dialog_set_note(&screen->dialog, GB_DIALOG_NOTE_ERROR, "%s", err.text);
    }
}

void gb_view_commands_densities(struct gb_app *app, const struct gb_key *key)
{
    struct gb_screen *screen = &app->screen;
    (void)key;
    gb_dialog_show_densities(&screen->dialog, &gb_dialogs_densities, &screen->session,
                             screen->plot.hide_previous);
}

char *gb_view_commands_densities_text(struct gb_app *app)
{
    const struct gb_dialog *dialog = &app->screen.dialog;
    return gb_density_table_text(dialog->session, dialog->hide_previous);
}

/* Changes the colouring and switches to the view of the packing, where it is visible. */
void gb_view_commands_colour(struct gb_app *app, const struct gb_key *key)
{
    struct gb_panel_plot *plot = &app->screen.plot;
    (void)key;
    uncover_plot(&app->screen);
    if (plot->view->draw == gb_view_packing_draw) {
        plot->look.colour = (plot->look.colour + 1) % GB_PACKING_COLOURS;
    }
    plot->view = gb_views_find("9");
}
