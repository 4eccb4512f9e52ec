#ifndef GB_TUI_APP_KEY_COMMANDS_H
#define GB_TUI_APP_KEY_COMMANDS_H

#include "tui/app/app.h"

/* Command functions of the key table (keys.c) and accept functions of the dialog table
 * (dialogs.c), by the file that defines them. */

/* pane_commands.c: focus, navigation, parameters. */
void gb_pane_commands_navigate(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_next(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_previous(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_zoom(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_find(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_list_all(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_increase(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_decrease(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_undo(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_redo(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_revert(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_accept_find(struct gb_app *app);

/* pane_commands.c: the legs of loading.path. */
void gb_pane_commands_leg_open(struct gb_screen *screen);
void gb_pane_commands_leg_add(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_insert(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_delete(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_down(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_up(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_text(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_leg_take(struct gb_app *app, const struct gb_key *key);

/* view_commands.c: the list of curves. */
void gb_view_commands_curve_open(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_curve_pin(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_curve_hide(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_curve_delete(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_curve_accept_name(struct gb_app *app);

/* view_commands.c: views and their options. */
void gb_view_commands_show(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_next(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_previous(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_log(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_colour(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_previous_curves(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_glyphs(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_pressure(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_densities(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_ranges(struct gb_app *app, const struct gb_key *key);
void gb_view_commands_accept_ranges(struct gb_app *app);
void gb_view_commands_accept_pressure(struct gb_app *app);

/* The table of densities with tabs between columns; g_free. */
char *gb_view_commands_densities_text(struct gb_app *app);

/* pane_commands.c: the clipboard. */
void gb_pane_commands_copy(struct gb_app *app, const struct gb_key *key);

/* file_commands.c: run and quick cell. */
void gb_file_commands_start(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_pause(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_freeze(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_take_over(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_auto_start(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_what_if(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_drop_changes(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_accept_what_if(struct gb_app *app);
void gb_file_commands_accept_cost(struct gb_app *app);
void gb_file_commands_decline_cost(struct gb_app *app);
/* Starts a scene that was opened: the quick cell first, unless the scene itself is
 * fast. */
void gb_file_commands_start_scene(struct gb_app *app);
/* Starts the full cell after its quick cell has finished.  An expensive one waits for
 * r. */
void gb_file_commands_follow_quick(struct gb_app *app);

/* file_commands.c: presets, materials, measured data, pictures, reports. */
void gb_file_commands_save(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_open(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_material(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_data(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_picture(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_accept_picture(struct gb_app *app);
void gb_file_commands_report(struct gb_app *app, const struct gb_key *key);
void gb_file_commands_shell(struct gb_app *app, const struct gb_key *key);
/* The shell command of the run on one line; g_free. */
char *gb_file_commands_shell_text(struct gb_app *app);
void gb_file_commands_accept_save(struct gb_app *app);
void gb_file_commands_accept_open(struct gb_app *app);
void gb_file_commands_accept_material(struct gb_app *app);
void gb_file_commands_accept_data(struct gb_app *app);
void gb_file_commands_accept_reading(struct gb_app *app);

/* job_commands.c: replicas, calibrations and moduli, computed by a child command. */
void gb_job_commands_replicas(struct gb_app *app, const struct gb_key *key);
void gb_job_commands_calibrate(struct gb_app *app, const struct gb_key *key);
void gb_job_commands_moduli(struct gb_app *app, const struct gb_key *key);
void gb_job_commands_accept_replicas(struct gb_app *app);
void gb_job_commands_accept_calibrate(struct gb_app *app);

/* job_commands.c: accuracy against cost; in its view, stability. */
void gb_job_commands_chart_open(struct gb_app *app, const struct gb_key *key);
void gb_job_commands_chart_accept(struct gb_app *app);
/* Sets the setting under the cursor in the parameters. */
void gb_job_commands_chart_apply(struct gb_screen *screen);

void gb_job_commands_stability_accept(struct gb_app *app);

/* job_commands.c: results of the jobs. */
void gb_job_commands_result_show(struct gb_app *app, const struct gb_key *key);
void gb_job_commands_result_accept(struct gb_app *app);
/* The text of the card for the clipboard; g_free. */
char *gb_job_commands_result_text(struct gb_app *app);
bool gb_job_commands_result_press(struct gb_app *app, const struct gb_term_event *event);
/* Shows the result of a completed job. */
void gb_job_commands_result_follow(struct gb_app *app);

/* pane_commands.c: mouse, theme, help, quitting. */
void gb_pane_commands_mouse(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_theme(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_repaint(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_help(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_quit(struct gb_app *app, const struct gb_key *key);
void gb_pane_commands_accept_quit(struct gb_app *app);
bool gb_pane_commands_press_quit(struct gb_app *app, const struct gb_term_event *event);
/* Asks before quitting with a live run. */
void gb_pane_commands_ask_quit(struct gb_app *app);
void gb_pane_commands_leave(struct gb_app *app, int status);
/* Sets the text of the message line. */
void gb_pane_commands_message(struct gb_app *app, enum gb_style style, const char *text);

#endif
