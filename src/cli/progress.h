#ifndef GB_CLI_PROGRESS_H
#define GB_CLI_PROGRESS_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/snapshot.h"
#include "greenbody/status.h"
#include "io/lock.h"
#include "many/ensemble.h"
#include "many/pool.h"

/* Effect of HUP.  Under nohup it is ignored. */
enum gb_signals_hangup {
    GB_SIGNALS_HANGUP_NOTED, /* gb_progress_take_hangup reports it */
    GB_SIGNALS_HANGUP_ENDS   /* the same as INT */
};

/* Installs the handlers.  The first INT or TERM requests an orderly end, the second
 * ends the process at once.  Exceeding a file size limit and writing to a closed pipe
 * become errors of write(). */
void gb_progress_catch_signals(enum gb_signals_hangup hangup);

/* Number of the signal that requested the end; 0: none. */
int gb_progress_caught(void);

/* The same as a callback; data is ignored. */
bool gb_progress_cancelled(void *data);

/* True once after the terminal was closed. stop: HUP also counts as a request to end. */
bool gb_progress_take_hangup(void);

void gb_progress_stop_by_hangup(void);

/* Exit status of a command that ends with err: 128 + the signal if one ended it. */
int gb_progress_exit_status(const struct gb_error *err);

enum gb_batch_progress_output {
    GB_BATCH_PROGRESS_ALL,
    GB_BATCH_PROGRESS_RUNNING, /* progress only, without first and last line */
    GB_BATCH_PROGRESS_OTHER,   /* only failures and waits */
    GB_BATCH_PROGRESS_QUIET
};

/* Many runs of one command: workers, progress on stderr, signals. */
struct gb_batch_progress {
    struct gb_launch launch; /* only the first of several processes shows progress */
    enum gb_batch_progress_output output;
    const double *cost; /* of each run, for the time left; NULL: all cost the same */
    double cost_total, cost_before, cost_ended;
    size_t total, before, ended, failed; /* runs; before: done by an earlier command */
    double started_s, printed_s;         /* clock at the start and at the last line */
    int columns;                         /* used by the rewritten line */
};

/* Sets launch.  Errors: GB_ERR_INPUT if --jobs is out of range. */
bool gb_progress_batch_init(struct gb_batch_progress *batch, int jobs, bool quiet,
                            struct gb_error *err);

/* Number of workers of all processes of the command together. */
size_t gb_progress_all_workers(const struct gb_batch_progress *batch, int jobs);

/* Computes the missing runs.  SIGINT, SIGTERM and SIGHUP stop them (GB_ERR_CANCELLED). */
bool gb_progress_batch_work(struct gb_batch_progress *batch, struct gb_ensemble *ensemble,
                            int jobs, struct gb_error *err);

/* Waits for the lock that a process holds while it writes the tables of a directory,
 * and takes it.  Errors: GB_ERR_CANCELLED, GB_ERR_MACHINE. */
bool gb_progress_batch_lock(struct gb_lock *lock, const char *directory, bool quiet,
                            struct gb_error *err);

/* Names the runs of other processes: "mu-0.1_seed-3 (process 12 on node3), ...";
 * g_free. */
char *gb_progress_batch_elsewhere(const struct gb_ensemble *ensemble);

/* As gb_options_fail; after a signal returns 128 and its number. */
int gb_progress_exit(const struct gb_error *err);

/* Progress of a run without screen on stderr: one rewritten line on a terminal, a line
 * every few seconds elsewhere, nothing when quiet. */
struct gb_progress {
    bool quiet, terminal;
    int shown;      /* columns now occupied by the rewritten line */
    double line_at; /* seconds of the run at the last line */
};

void gb_progress_init(struct gb_progress *progress, bool quiet);

/* Prints a permanent line. */
void gb_progress_say(struct gb_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "density 0.4213, p 12.3 MPa" with this separator.  A compact outside its die has no
 * density. */
enum { GB_PROGRESS_POINT = 64 };
void gb_progress_point(char text[GB_PROGRESS_POINT], const struct gb_point *point,
                       const char *separator);

/* Is gb_progress_show due?  Filling a snapshot costs an evaluation of the forces. */
bool gb_progress_due(const struct gb_progress *progress, double seconds);

/* Shows the progress of the run. */
void gb_progress_show(struct gb_progress *progress, const struct gb_snapshot *snapshot);

/* Shows "12 of 40 frames  30 %  8 s left" when it is due, and on a terminal after the
 * last one. seconds: since the start. */
void gb_progress_count(struct gb_progress *progress, size_t done, size_t total,
                       const char *what, double seconds);

/* Clears the rewritten line. */
void gb_progress_clear(struct gb_progress *progress);

#endif
