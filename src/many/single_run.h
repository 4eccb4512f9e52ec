#ifndef GB_MANY_SINGLE_RUN_H
#define GB_MANY_SINGLE_RUN_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* One run of a sweep, from the initial structure to the last file. */

/* Runs params into directory; an old run there is replaced.
 *
 * callbacks   NULL: none
 * True when all stages of loading are done.  Errors: GB_ERR_GUARD and
 * GB_ERR_NOT_CONVERGED (results kept), GB_ERR_CANCELLED (points kept), GB_ERR_INPUT,
 * GB_ERR_MACHINE, GB_ERR_MEMORY; status.json says the same where there is one. */
bool gb_single_run(const struct gb_params *params, const char *directory,
                   const struct gb_pool_callbacks *callbacks, struct gb_error *err);

/* The same, with other parameters up to its first point, which is not recorded: beds that
 * were filled alike.  The two may differ in numerics and in the loading after that point. */
bool gb_single_run_after(const struct gb_params *params, const struct gb_params *first,
                         const char *directory, const struct gb_pool_callbacks *callbacks,
                         struct gb_error *err);

/* The same for directories that other processes work in, too: a run that another one does or
 * has done is left to it, with an error that gb_single_run_is_taken knows (GB_ERR_INPUT).
 * gb_ensemble_work looks at it again. */
bool gb_single_run_missing(const struct gb_params *params, const char *directory,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err);
bool gb_single_run_is_taken(const struct gb_error *error);

/* Does status.json tell of a run that its scene has ended, not a signal?  Then the error is
 * that one, as GB_ERR_GUARD. */
bool gb_single_run_failed(const char *directory, struct gb_error *error);

enum gb_single_run_found {
    GB_SINGLE_RUN_DONE,
    GB_SINGLE_RUN_NOT_DONE, /* a run that was not finished, or no preset to be read */
    GB_SINGLE_RUN_OTHER     /* a run of another experiment */
};

/* What a directory holds of the run of these parameters.  Title, threads and [output] may
 * differ: they change no result. */
enum gb_single_run_found gb_single_run_find(const struct gb_params *params,
                                            const char *directory);

#endif
