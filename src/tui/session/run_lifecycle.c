#include "tui/session/run_lifecycle.h"

#include <glib.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "base/program.h"
#include "base/units.h"
#include "base/visible.h"
#include "greenbody/params.h"
#include "io/run_list.h"
#include "io/rundir.h"
#include "io/store.h"
#include "run/cost.h"
#include "scene/derived.h"
#include "scene/loading_kind.h"
#include "tui/session/session.h"

/* A run from its start to the end of the program: its estimated cost, its directory,
 * and which process continues it. */

/* Suggests cheaper parameters for the stage that takes most time.  A longer time step
 * shortens every stage; auto may be longer than a given step. */
static void write_advice(const struct gb_params *params, const struct gb_cost *cost,
                         char *text, size_t size)
{
    const bool compression = cost->compress_steps >= cost->relax_steps + cost->hold_steps;
    snprintf(text, size, "%s%s or fewer particles.count",
             compression ? "a higher loading.rate" : "a shorter loading.relax or hold",
             isnan(gb_derived_time_step_s(params)) ? "" : ", numerics.time_step = auto");
}

bool gb_run_lifecycle_cost_question(const struct gb_params *params,
                                    double particle_steps_per_s, char *text, size_t size)
{
    struct gb_cost cost;
    struct gb_error err = {0};
    const bool measured = particle_steps_per_s > 0.0;
    const double rate = measured ? particle_steps_per_s : gb_cost_rate_assumed(params);
    if (!gb_loading_kind_of(params)->given_rate ||
        !gb_cost_estimate(params, rate, &cost, &err) ||
        gb_cost_check_limit(&cost, &err)) {
        return false;
    }
    char duration[48], step[48], advice[128];
    gb_cost_duration(cost.seconds, duration, sizeof duration);
    gb_units_format_short(cost.time_step_s, GB_DIM_TIME, 3, step, sizeof step);
    write_advice(params, &cost, advice, sizeof advice);
    snprintf(text, size,
             "This run will take about %s: %.3g steps of %s%s for %lld particles at "
             "%.3g million particle-steps/s (%s). Cheaper: %s.",
             duration, cost.steps, step, cost.step_assumed ? " (assumed)" : "",
             (long long)params->count, cost.particle_steps_per_s / 1e6,
             measured ? "as the last run" : "assumed", advice);
    return true;
}

bool gb_run_lifecycle_cost_after_quick(const struct gb_params *full,
                                       const struct gb_params *quick, double quick_s,
                                       double *seconds, char *text, size_t size)
{
    char duration[48];
    struct gb_error err = {0};
    const struct gb_cost cost = {.seconds = gb_cost_from_quick(full, quick, quick_s)};
    *seconds = cost.seconds;
    if (!isfinite(cost.seconds) || gb_cost_check_limit(&cost, &err)) {
        return false;
    }
    gb_cost_duration(cost.seconds, duration, sizeof duration);
    snprintf(
        text, size,
        "This run will take about %s: %lld particles, estimated from the %.1f s of its "
        "quick cell. Cheaper: fewer particles.count%s.",
        duration, (long long)full->count, quick_s,
        full->fidelity == GB_FIDELITY_FAST ? "" : " or numerics.fidelity = fast");
    return true;
}

enum { STATUS_SIGNAL = 128 };

char *gb_run_lifecycle_folder(void)
{
    return g_build_filename(g_get_user_state_dir(), "greenbody", "runs", NULL);
}

static int count_runs(const char *folder)
{
    int runs = 0;
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *preset = g_build_filename(folder, name, "preset.ini", NULL);
        runs += g_file_test(preset, G_FILE_TEST_IS_REGULAR);
        g_free(preset);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return runs;
}

void gb_run_lifecycle_print_runs(FILE *out, const char *folder)
{
    const int runs = count_runs(folder);
    char *size = g_format_size((guint64)gb_run_list_bytes(folder));
    gb_visible_print(out,
                     "runs       %s: %d kept, %s on the disk; the program removes none\n",
                     folder, runs, size);
    g_free(size);
}

char *gb_run_lifecycle_directory(const struct gb_session *session)
{
    return session->folder != NULL
               ? gb_store_new_directory(session->folder, gb_preset_path(session->preset))
               : NULL;
}

bool gb_run_lifecycle_start(struct gb_runner **out, const struct gb_session *session,
                            const struct gb_params *params, struct gb_error *err)
{
    char *directory = gb_run_lifecycle_directory(session);
    const bool done = gb_runner_create_in(out, params, directory, err);
    g_free(directory);
    return done;
}

bool gb_run_lifecycle_attach(struct gb_session *session, struct gb_error *err)
{
    struct gb_runner *runner = NULL;
    if (!gb_runner_follow(&runner, session->attached, err)) {
        return false;
    }
    gb_session_replace(session, runner);
    gb_session_note(session,
                    gb_rundir_busy(session->attached)
                        ? "attached to %s: t takes it over"
                        : "%s: no engine is running there; t resumes the run",
                    session->attached);
    return true;
}

void gb_run_lifecycle_take_over(struct gb_session *session, struct gb_message *message)
{
    struct gb_runner *runner = NULL;
    struct gb_error err = {0};
    message->style = GB_STYLE_WARN;
    if (session->attached == NULL) {
        snprintf(message->text, sizeof message->text,
                 "no run is attached: greenbody attach DIR shows one");
        return;
    }
    if (!gb_runner_resume(&runner, session->attached, &err)) {
        snprintf(message->text, sizeof message->text, "%s", err.text);
        return;
    }
    gb_session_replace(session, runner);
    gb_session_note(session, "continues here: %s", session->attached);
    session->attached = NULL;
}

/* Does the screen show the run of another process?  An attached screen may have started
 * a run of its own. */
static bool shows_other(const struct gb_session *session)
{
    return session->attached != NULL && session->runner != NULL &&
           g_strcmp0(gb_runner_directory(session->runner), session->attached) == 0;
}

/* Describes what quitting does to the engines of this process. */
static char *describe_end(const struct gb_session *session)
{
    const bool runs = gb_session_run_is_live(session) && !shows_other(session);
    const char *directory = runs ? gb_runner_directory(session->runner) : NULL;
    if (directory != NULL) {
        return g_strdup_printf("The run ends, with a checkpoint: `greenbody resume "
                               "%.200s` continues it later. ",
                               directory);
    }
    const bool ends = runs || gb_session_quick_cell_live(&session->quick_cell);
    return g_strdup(ends ? "The run ends and is not stored. " : "");
}

enum gb_run_lifecycle_detaching
gb_run_lifecycle_detaching(const struct gb_session *session)
{
    if (gb_session_run_is_live(session)) {
        return !shows_other(session) && gb_runner_directory(session->runner) != NULL
                   ? GB_DETACH_RUN
                   : GB_DETACH_NOTHING;
    }
    return gb_session_quick_cell_live(&session->quick_cell) && session->folder != NULL
               ? GB_DETACH_START
               : GB_DETACH_NOTHING;
}

/* In the child: starts a session without a terminal and unblocks all signals. */
static void leave_terminal(gpointer data)
{
    sigset_t none;
    (void)data;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    (void)setsid();
}

void gb_run_lifecycle_detach(const char *directory)
{
    static char program[] = "greenbody", command[] = "resume", quiet[] = "--quiet";
    char *file = gb_program_executable();
    char *argv[] = {file, program, command, quiet, (char *)directory, NULL};
    GError *error = NULL;
    const bool started =
        g_spawn_async(NULL, argv, NULL,
                      G_SPAWN_FILE_AND_ARGV_ZERO | G_SPAWN_STDOUT_TO_DEV_NULL |
                          G_SPAWN_STDERR_TO_DEV_NULL,
                      leave_terminal, NULL, NULL, &error);
    if (started) {
        gb_visible_line(
            stderr,
            "greenbody: the run continues without a terminal; `greenbody attach "
            "%s` shows it",
            directory);
    } else {
        gb_visible_line(stderr, "greenbody: %s; `greenbody resume %s` continues the run",
                        error->message, directory);
        g_error_free(error);
    }
    g_free(file);
}

void gb_run_lifecycle_quit_text(const struct gb_session *session, char *text, size_t size)
{
    char *own = describe_end(session);
    const bool other = session->attached != NULL &&
                       ((shows_other(session) && gb_session_run_is_live(session)) ||
                        gb_rundir_busy(session->attached));
    const bool child =
        session->child.pid != 0 && session->child.kind == GB_CHILD_COMMAND_LONG;
    g_snprintf(text, size, "%s%s%s%s", own,
               other ? "The attached run continues in its process. " : "",
               child ? session->child.name : "",
               child ? ": continued by a process of its own." : "");
    g_strchomp(text);
    g_free(own);
}

static bool survives_hangup(const struct gb_session *session)
{
    return session->attached == NULL && gb_session_live(session) &&
           gb_session_params((struct gb_session *)session)->on_hangup ==
               GB_ON_HANGUP_DETACH;
}

/* Starts the full cell that is due after the quick one, unless it is expensive. */
static void follow(struct gb_session *session)
{
    char question[400];
    struct gb_error err;
    gb_session_refresh(session);
    if (gb_session_quick_take_due(session) &&
        !gb_session_cost_question(session, question, sizeof question)) {
        gb_session_start(session, &err);
    }
}

int gb_run_lifecycle_run_detached(struct gb_session *session)
{
    const struct timespec interval = {.tv_sec = 1};
    sigset_t stop_signals;
    sigemptyset(&stop_signals);
    sigaddset(&stop_signals, SIGINT);
    sigaddset(&stop_signals, SIGTERM);
    sigaddset(&stop_signals, SIGQUIT);
    if (!survives_hangup(session)) {
        return STATUS_SIGNAL + SIGHUP;
    }
    gb_session_note(session, "terminal closed; the run continues");
    if (session->pause_wanted) { /* without a terminal the pause could never end */
        gb_session_toggle_pause(session);
    }
    while (gb_session_live(session)) {
        const int number = sigtimedwait(&stop_signals, NULL, &interval);
        if (number > 0) {
            return STATUS_SIGNAL + number;
        }
        follow(session);
    }
    return 0;
}

void gb_run_lifecycle_print_resume_hint(const struct gb_session *session)
{
    const char *directory =
        session->runner != NULL ? gb_runner_directory(session->runner) : NULL;
    if (directory != NULL && session->attached == NULL && gb_session_live(session)) {
        gb_visible_line(
            stderr, "greenbody: the run is stored; `greenbody resume %s` continues it",
            directory);
    }
    if (session->child.pid != 0 && session->child.kind == GB_CHILD_COMMAND_LONG) {
        gb_visible_line(
            stderr, "greenbody: %s: continued in %s; `greenbody attach` shows the runs",
            session->child.name, session->child.path);
    }
}
