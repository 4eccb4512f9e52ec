#ifndef GB_MANY_SINGLE_RUN_H
#define GB_MANY_SINGLE_RUN_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "many/pool.h"

/* One run of a sweep, from the initial packing to the last file. */

/* Runs params in directory, replacing an old run there.
 *
 * callbacks   NULL: none
 * True if all stages of loading are done.  Errors: GB_ERR_GUARD and
 * GB_ERR_NOT_CONVERGED (results kept), GB_ERR_CANCELLED (points kept), GB_ERR_INPUT,
 * GB_ERR_MACHINE, GB_ERR_MEMORY. status.json has the same error if it exists. */
bool gb_single_run(const struct gb_params *params, const char *directory,
                   const struct gb_pool_callbacks *callbacks, struct gb_error *err);

/* The same, with other parameters up to the first point, which is not recorded; for
 * beds with the same filling.  The two may differ in numerics and in the loading after
 * that point. */
bool gb_single_run_after(const struct gb_params *params, const struct gb_params *first,
                         const char *directory, const struct gb_pool_callbacks *callbacks,
                         struct gb_error *err);

/* The same for directories that other processes also use.  A run that another process
 * computes or has done is left to it: GB_ERR_INPUT, which gb_single_run_is_taken
 * recognises. gb_ensemble_work then checks the run again. */
bool gb_single_run_missing(const struct gb_params *params, const char *directory,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err);
bool gb_single_run_is_taken(const struct gb_error *error);

/* Does status.json report that the run ended because of its scene and not by a signal?
 * Then *error receives this error as GB_ERR_GUARD. */
bool gb_single_run_failed(const char *directory, struct gb_error *error);

enum gb_single_run_found {
    GB_SINGLE_RUN_DONE,
    GB_SINGLE_RUN_NOT_DONE, /* an unfinished run, or no readable preset */
    GB_SINGLE_RUN_OTHER     /* a run of another experiment */
};

/* Looks for the run of these parameters in a directory.  Title, threads and [output]
 * may differ, because they change no result. */
enum gb_single_run_found gb_single_run_find(const struct gb_params *params,
                                            const char *directory);

#endif
