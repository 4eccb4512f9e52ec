#ifndef GB_RUN_RUN_LOOP_H
#define GB_RUN_RUN_LOOP_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/outcome.h"
#include "greenbody/snapshot.h"
#include "run/cost.h"
#include "run/experiment.h"
#include "run/record/run_recorder.h"

/* The loop of a run, from the built packing to the last file: it advances the experiment
 * in slices of 5 to 20 ms, records points and events, writes status and checkpoints when
 * they are due.  The foreground command, the engine thread of the workbench and the
 * workers of many runs share it and differ in their hooks. */

/* Called by the thread of the loop, between two slices.  Each member may be NULL. */
struct gb_run_loop_hooks {
    /* Before each slice; false with GB_ERR_CANCELLED ends the run.  May wait: see
     * gb_run_loop_exclude. */
    bool (*may_continue)(void *data, struct gb_error *err);
    /* After an event was recorded. */
    void (*on_event)(void *data, int64_t step, const char *text);
    /* After a point was recorded; false ends the run as failed. */
    bool (*on_point)(void *data, const struct gb_point *point, struct gb_error *err);
    /* After each slice that is not the last, for progress on a screen. */
    void (*on_tick)(void *data);
    /* The result is known and in the snapshot; the last files are not written yet. */
    void (*on_end)(void *data);
    /* The run directory can't be written.  True: the run continues without it; false, or
     * no hook: the run fails. */
    bool (*on_record_error)(void *data, const struct gb_error *err);
    void *data;
};

struct gb_run_loop {
    struct gb_run_loop_hooks hooks;
    struct gb_experiment *experiment; /* owned; NULL before gb_run_loop_attach */
    struct gb_run_recorder *recorder; /* owned, set by the caller; NULL: not recorded */
    struct gb_snapshot snapshot;      /* as of the last gb_run_loop_observe */
    struct gb_error error;            /* why the run ended early, or what it has missed */
    struct gb_pace pace;
    enum gb_step_outcome last; /* result of the last slice */
    bool record_failed;        /* the run directory could not be written */
    bool begun;                /* the first status is written, the last one is not */
    int64_t points_left;       /* of the advance under way */
    double started_s;          /* clock reading at second 0 of the run */
    double packed_s;           /* seconds of the run when its packing was built */
    double status_at_s;        /* seconds of the run at the last status */
};

/* Starts the clock of the run: packing counts. */
void gb_run_loop_init(struct gb_run_loop *loop, const struct gb_run_loop_hooks *hooks);
/* Destroys experiment and recorder.  A zeroed loop is fine. */
void gb_run_loop_finish(struct gb_run_loop *loop);

/* Seconds of the run so far; set: those of a run that is resumed; exclude: takes a pause
 * out of them. */
double gb_run_loop_seconds(const struct gb_run_loop *loop);
void gb_run_loop_set_seconds(struct gb_run_loop *loop, double seconds);
void gb_run_loop_exclude(struct gb_run_loop *loop, double seconds);

/* The packing is built; the experiment belongs to the loop from now on. */
void gb_run_loop_attach(struct gb_run_loop *loop, struct gb_experiment *experiment);

/* Records points from before the run, the last one with its state: it is the state of the
 * experiment. */
void gb_run_loop_inherit(struct gb_run_loop *loop, const struct gb_curve *curve);

/* Runs to the end and writes the last files; never GB_RUN_OUTCOME_NONE.  The reason of an
 * early end is loop->error, and an event; so are goals that a run which is done has
 * missed (GB_ERR_GUARD). */
enum gb_run_outcome gb_run_loop_run(struct gb_run_loop *loop);
/* The same for at most so many points: GB_RUN_OUTCOME_NONE when they are recorded and the
 * run has not ended.  May be called again then, and after GB_RUN_OUTCOME_CANCELLED: the run
 * continues with the same bits. */
enum gb_run_outcome gb_run_loop_advance(struct gb_run_loop *loop, int64_t points);
/* Writes the last files of a run that is left before its end; nothing to do where no advance
 * is unfinished. */
void gb_run_loop_leave(struct gb_run_loop *loop);

/* For a run that fails before its loop: status.json says so where there is one. */
enum gb_run_outcome gb_run_loop_fail(struct gb_run_loop *loop,
                                     const struct gb_error *err);

/* Outcome of a run that ends with err, and the state that it leaves. */
enum gb_run_outcome gb_run_loop_outcome(const struct gb_error *err);
enum gb_run_state gb_run_loop_state(enum gb_run_outcome outcome);

/* For hooks.  Fills the snapshot; costs a sweep over the contacts. */
void gb_run_loop_observe(struct gb_run_loop *loop, enum gb_run_state state);
/* Records an event and calls on_event. */
void gb_run_loop_event(struct gb_run_loop *loop, const char *text);
/* Checkpoint and status now, the status as in the snapshot. */
void gb_run_loop_save(struct gb_run_loop *loop);
/* The checkpoint alone, and waits until it is written. */
void gb_run_loop_store(struct gb_run_loop *loop);

#endif
