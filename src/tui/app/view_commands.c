#include "tui/app/key_commands.h"
#include "tui/view/views.h"

/* Focuses the plot where the compact layout hides it. */
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
