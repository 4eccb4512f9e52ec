#include "cli/foreground.h"

#include <string.h>

#include <glib.h>

#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/signals.h"

/* --- callbacks of the simulation --------------------------------------------------- */

/* After a hang-up messages go to the run directory only. */
static void handle_hangup(struct gb_foreground *run)
{
    struct gb_run_loop *loop = &run->simulation->loop;
    if (gb_experiment_params(loop->experiment)->on_hangup == GB_ON_HANGUP_STOP) {
        gb_signals_stop_by_hangup();
        return;
    }
    run->progress.quiet = true;
    gb_run_loop_save(loop);
    gb_run_loop_event(loop, "terminal closed; the run continues");
}

static void handle_signals(struct gb_foreground *run)
{
    if (run->simulation->loop.recorder != NULL && gb_signals_take_hangup()) {
        handle_hangup(run);
    }
    const int signal = gb_signals_caught();
    if (signal != 0) {
        g_snprintf(run->stopped, sizeof run->stopped, "stopped by signal %d (%s)", signal,
                   strsignal(signal));
        gb_simulation_cancel(run->simulation, run->stopped);
    }
}

static void on_event(void *data, struct gb_simulation *simulation, int64_t step,
                     const char *text)
{
    struct gb_foreground *run = data;
    (void)simulation;
    gb_progress_say(&run->progress, "step %" G_GINT64_FORMAT ": %s", step, text);
}

static void on_progress(void *data, struct gb_simulation *simulation, double share)
{
    struct gb_foreground *run = data;
    struct gb_run_loop *loop = &simulation->loop;
    (void)share;
    handle_signals(run);
    if (loop->experiment == NULL) {
        if (run->on_packing != NULL) {
            run->on_packing(run->data);
        }
    } else if (gb_progress_due(&run->progress, gb_run_loop_seconds(loop))) {
        gb_run_loop_observe(loop, GB_RUN_RUNNING);
        gb_progress_show(&run->progress, &loop->snapshot);
    }
}

/* --------------------------------------------------------------------------------- */

void gb_foreground_init(struct gb_foreground *run, bool quiet)
{
    gb_progress_init(&run->progress, quiet);
    gb_signals_install(GB_SIGNALS_HANGUP_NOTED);
}

void gb_foreground_attach(struct gb_foreground *run, struct gb_simulation *simulation)
{
    run->simulation = simulation;
    gb_simulation_on_event(simulation, on_event, run);
    gb_simulation_on_progress(simulation, on_progress, run, 0.0);
}

void gb_foreground_finish(struct gb_foreground *run)
{
    gb_simulation_destroy(run->simulation);
    run->simulation = NULL;
}

static int fail(struct gb_foreground *run, const struct gb_error *err)
{
    gb_progress_clear(&run->progress);
    (void)gb_options_fail(err);
    return gb_signals_exit_status(err);
}

int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err)
{
    if (run->simulation != NULL) {
        (void)gb_run_loop_fail(&run->simulation->loop, err);
    }
    return fail(run, err);
}

static void summarise(struct gb_foreground *run, enum gb_run_outcome outcome)
{
    const struct gb_run_loop *loop = &run->simulation->loop;
    char where[GB_PROGRESS_POINT];
    gb_progress_point(where, &loop->snapshot.now, ", ");
    gb_progress_say(&run->progress,
                    "%s after %.1f s: %s, %" G_GINT64_FORMAT " points in %s",
                    outcome == GB_RUN_OUTCOME_DONE ? "done" : "stopped",
                    loop->snapshot.seconds, where, gb_run_recorder_points(loop->recorder),
                    gb_store_directory(gb_run_recorder_store(loop->recorder)));
}

int gb_foreground_run(struct gb_foreground *run)
{
    struct gb_error error = {0};
    const enum gb_run_outcome outcome =
        gb_simulation_advance(run->simulation, INT64_MAX, &error);
    /* without a recorder the packing was not built */
    if (outcome == GB_RUN_OUTCOME_FAILED || run->simulation->loop.recorder == NULL ||
        run->simulation->loop.experiment == NULL) {
        return fail(run, &error);
    }
    summarise(run, outcome);
    if (run->json) {
        gb_json_output_run(&run->simulation->loop);
    }
    if (error.code != GB_OK && run->progress.quiet) {
        (void)gb_options_fail(&error);
    }
    return gb_signals_exit_status(&error);
}
