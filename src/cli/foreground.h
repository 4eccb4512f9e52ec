#ifndef GB_CLI_FOREGROUND_H
#define GB_CLI_FOREGROUND_H

#include <signal.h>

#include "cli/progress.h"
#include "run/pace.h"
#include "run/run_recorder.h"
#include "run/warmup.h"

/* A run without a screen, from the moment its packing is there: pressed to the end, a
 * guard or a signal, and kept in its directory. */
struct gb_foreground {
    struct gb_run_recorder *keep;
    struct gb_experiment *experiment;
    struct gb_warmup warmup; /* of a dynamic run that begins */
    struct gb_pace pace;
    struct gb_progress progress;
    struct gb_snapshot shot;
    struct gb_error stopped; /* by a guard or a signal: the run is kept */
    double started;          /* clock when the run had taken no second */
    double packed;           /* seconds of the run when pressing began */
    double status_at;
};

/* Signals from now on: the first INT or TERM ends the run in good order, the second at
 * once.  HUP is obeyed as output.on_hangup says, or ignored where nohup wants it. */
void gb_foreground_catch_signals(void);
/* Number of the signal that asks the run to end, 0 before. */
const volatile sig_atomic_t *gb_foreground_caught(void);

/* Sets the clock of a run that has taken `gone` seconds so far. */
void gb_foreground_begin(struct gb_foreground *run, double gone);
double gb_foreground_elapsed(const struct gb_foreground *run);

/* First status; the pace is begun. */
bool gb_foreground_open(struct gb_foreground *run, struct gb_error *err);

bool gb_foreground_event(struct gb_foreground *run, const char *text,
                         struct gb_error *err);

/* All of it; returns the exit status.  What went wrong has been told. */
int gb_foreground_perform(struct gb_foreground *run);

/* Tells err, in the status too when there is a directory; returns the exit status. */
int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err);

void gb_foreground_finish(struct gb_foreground *run);

#endif
