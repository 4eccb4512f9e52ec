#include "cli/foreground.h"

#include <string.h>

#include <glib.h>

#include "cli/options.h"
#include "cli/signals.h"

/* --- hooks of the loop ----------------------------------------------------------- */

/* After a hang-up messages go to the run directory only. */
static void handle_hangup(struct gb_foreground *run)
{
    if (gb_experiment_params(run->loop.experiment)->on_hangup == GB_ON_HANGUP_STOP) {
        gb_signals_stop_by_hangup();
        return;
    }
    run->progress.quiet = true;
    gb_run_loop_save(&run->loop);
    gb_run_loop_event(&run->loop, "terminal closed; the run continues");
}

static bool may_continue(void *data, struct gb_error *err)
{
    struct gb_foreground *run = data;
    if (run->loop.recorder != NULL && gb_signals_take_hangup()) {
        handle_hangup(run);
    }
    const int signal = gb_signals_caught();
    return signal == 0 || gb_error_set(err, GB_ERR_CANCELLED, "stopped by signal %d (%s)",
                                       signal, strsignal(signal));
}

static void on_event(void *data, int64_t step, const char *text)
{
    struct gb_foreground *run = data;
    gb_progress_say(&run->progress, "step %" G_GINT64_FORMAT ": %s", step, text);
}

static void on_tick(void *data)
{
    struct gb_foreground *run = data;
    if (gb_progress_due(&run->progress, gb_run_loop_seconds(&run->loop))) {
        gb_run_loop_observe(&run->loop, GB_RUN_RUNNING);
        gb_progress_show(&run->progress, &run->loop.snapshot);
    }
}

/* --------------------------------------------------------------------------------- */

void gb_foreground_init(struct gb_foreground *run, bool quiet)
{
    const struct gb_run_loop_hooks hooks = {.may_continue = may_continue,
                                            .on_event = on_event,
                                            .on_tick = on_tick,
                                            .data = run};
    gb_progress_init(&run->progress, quiet);
    gb_run_loop_init(&run->loop, &hooks);
    gb_signals_install(GB_SIGNALS_HANGUP_NOTED);
}

void gb_foreground_finish(struct gb_foreground *run)
{
    gb_run_loop_finish(&run->loop);
}

int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err)
{
    (void)gb_run_loop_fail(&run->loop, err);
    gb_progress_clear(&run->progress);
    (void)gb_options_fail(err);
    return gb_signals_exit_status(err);
}

static void summarise(struct gb_foreground *run, enum gb_run_outcome outcome)
{
    struct gb_run_recorder *recorder = run->loop.recorder;
    const struct gb_point *now = &run->loop.snapshot.now;
    gb_progress_say(
        &run->progress,
        "%s after %.1f s: density %.4f, p %.4g MPa, %" G_GINT64_FORMAT " points in %s",
        outcome == GB_RUN_OUTCOME_DONE ? "done" : "stopped", run->loop.snapshot.seconds,
        now->density, now->p_pa / 1e6, gb_run_recorder_points(recorder),
        gb_store_directory(gb_run_recorder_store(recorder)));
}

int gb_foreground_run(struct gb_foreground *run)
{
    const enum gb_run_outcome outcome = gb_run_loop_run(&run->loop);
    const struct gb_error *error = &run->loop.error;
    if (outcome == GB_RUN_OUTCOME_FAILED) {
        gb_progress_clear(&run->progress);
        (void)gb_options_fail(error);
        return gb_signals_exit_status(error);
    }
    summarise(run, outcome);
    if (error->code != GB_OK && run->progress.quiet) {
        (void)gb_options_fail(error);
    }
    return gb_signals_exit_status(error);
}
