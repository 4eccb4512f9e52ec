#ifndef GB_RUN_RECORD_RUN_JOURNAL_H
#define GB_RUN_RECORD_RUN_JOURNAL_H

#include "base/record.h"
#include "greenbody/params.h"
#include "io/store.h"
#include "run/record/live_export.h"

/* State of the run directory in a checkpoint, beside that of the experiment. */
struct gb_run_journal {
    struct gb_store_extent extent;
    struct gb_live_extent live;
    int64_t events;
    double seconds;
    double highest[2]; /* pressure, Pa, and density on loading, for kept states */
    int64_t preset;    /* digest of the parameters that determine the results */
};

/* Digest of the parameters that differ from their defaults, but those that change no result
 * ([output], title, threads).  A key added later changes no digest. */
int64_t gb_run_journal_digest(const struct gb_params *params);

/* Adds the journal to a record. */
bool gb_run_journal_record(struct gb_run_journal *journal, struct gb_record *record,
                           struct gb_error *err);

/* Reads the journal from the record of directory/state.h5; its preset must be the digest
 * of the present parameters.  Errors: GB_ERR_INPUT when the preset was edited since. */
bool gb_run_journal_load(struct gb_run_journal *journal, struct gb_record *record,
                         const char *directory, struct gb_error *err);

#endif
