#ifndef GB_RUN_CREW_H
#define GB_RUN_CREW_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"

/* Workers that do runs at once, each a process that does one run after the other: what
 * starting a process and its libraries costs is paid once.  One that crashes or is killed
 * takes only its run with it, and another takes its place; libraries that know no threads
 * (HDF5) are met by one thread only.  The caller must not have started threads: its state
 * is copied by fork. */
struct gb_crew;
struct gb_ranks;

/* Does one run in a worker's process.  cancelled is to be polled. */
typedef bool gb_crew_work(const struct gb_params *params, const char *directory,
                          bool (*cancelled)(void *data), void *data,
                          struct gb_error *err);

/* What became of a run. */
struct gb_crew_report {
    size_t ticket;
    struct gb_error error; /* GB_OK: done; a process that died is GB_ERR_MACHINE */
    double seconds;        /* since it was given */
    bool lost;             /* not its fault: whoever did it is gone */
};

/* workers here, and those of other ranks if there are any (NULL: none; kept by the
 * caller). */
bool gb_crew_create(struct gb_crew **out, size_t workers, gb_crew_work *work,
                    struct gb_ranks *ranks, struct gb_error *err);
/* Ends what is still running and waits for it.  NULL is fine. */
void gb_crew_destroy(struct gb_crew *crew);

/* How long to wait for a report before looking for what other ranks send, s. */
double gb_crew_patience(const struct gb_crew *crew);

/* Workers without a run. */
size_t gb_crew_idle(const struct gb_crew *crew);
/* Runs that were given and not yet reported. */
size_t gb_crew_busy(const struct gb_crew *crew);

/* Starts a run on an idle worker.  Errors: GB_ERR_MACHINE (no process, no
 * socket), GB_ERR_INPUT (the name of the directory is too long). */
bool gb_crew_give(struct gb_crew *crew, size_t ticket, const struct gb_params *params,
                  const char *directory, struct gb_error *err);

/* Waits up to seconds for a report; false when there was none.  A signal may end the wait
 * early. */
bool gb_crew_take(struct gb_crew *crew, double seconds, struct gb_crew_report *report);

/* Asks all runs to stop; they still report. */
void gb_crew_stop(struct gb_crew *crew);

#endif
