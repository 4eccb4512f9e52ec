#ifndef GB_CLI_FOREGROUND_H
#define GB_CLI_FOREGROUND_H

#include "cli/progress.h"
#include "run/run_loop.h"

/* A run without screen: the run loop (run/run_loop.h) with signals, progress on stderr
 * and the exit status of the command. */
struct gb_foreground {
    struct gb_run_loop loop;
    struct gb_progress progress;
};

/* Starts the clock of the run and installs the signal handlers (cli/signals.h).  HUP is
 * handled as output.on_hangup says. */
void gb_foreground_init(struct gb_foreground *run, bool quiet);
void gb_foreground_finish(struct gb_foreground *run);

/* Runs to the end; returns the exit status.  Errors have been printed. */
int gb_foreground_run(struct gb_foreground *run);

/* Prints err of a run that fails before its loop, and writes it to the status when there
 * is a directory; returns the exit status. */
int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err);

#endif
