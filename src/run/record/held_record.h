#ifndef GB_RUN_RECORD_HELD_RECORD_H
#define GB_RUN_RECORD_HELD_RECORD_H

#include "run/experiment.h"
#include "run/record/run_journal.h"
#include "run/record/writer.h"

/* The record of the last point of a run: the writer's.  Taking it costs as much as some
 * evaluations, so it is taken at some of the points only, not while it is being written, and
 * computed up to the last one when it is needed. */
struct gb_held_record {
    const struct gb_params *params;
    struct gb_writer *writer;
    struct gb_run_journal journal; /* as of the last point */
    bool fresh;                    /* there is a record that is newer than state.h5 */
    int64_t missing; /* gb_checkpoint_step of the last point; -1: it has the record */
    double taken_s, cost_s; /* clock at the last record, and how long it took */
};

/* params and writer must outlive it. */
void gb_held_record_init(struct gb_held_record *held, const struct gb_params *params,
                         struct gb_writer *writer);

/* True where the last point needs a record of its own: there is none since the last
 * checkpoint, or it would soon be too old, or the run is over.  Not while a checkpoint is
 * written: the points of that time are computed from it. */
bool gb_held_record_due(const struct gb_held_record *held,
                        const struct gb_experiment *experiment);

/* Right after a point: takes its record, without the journal, as soon as the last one is
 * written; or goes without. */
bool gb_held_record_take(struct gb_held_record *held, struct gb_experiment *experiment,
                         struct gb_error *err);
void gb_held_record_skip(struct gb_held_record *held, const struct gb_point *point);

/* Adds the journal to the record of the last point, which is complete then. */
bool gb_held_record_complete(struct gb_held_record *held, struct gb_error *err);

/* Computes the record up to the last point; the bits are those of a record taken there.
 * Nothing is done while it is written.  Where the run cannot be repeated, the record stays:
 * a checkpoint some points before.
 * Errors: GB_ERR_MEMORY. */
bool gb_held_record_catch_up(struct gb_held_record *held, struct gb_error *err);

/* A record to be written: fresh, and of the last point. */
bool gb_held_record_ready(const struct gb_held_record *held);

#endif
