#include "run/verify.h"

#include <stdio.h>

#include <glib.h>

#include "base/alloc.h"
#include "io/rundir.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/record/run_journal.h"
#include "run/record/run_recorder.h"
#include "run/repeat_points.h"

struct pair {
    struct gb_record kept, other; /* the state to arrive at; where to begin, then there */
};

/* The experiment at the checkpoint before, or at its beginning. */
static bool begin(struct gb_experiment **out, struct gb_verify *verify,
                  const char *directory, const struct gb_params *params,
                  struct gb_record *before, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    struct gb_params same;
    struct gb_error ignored;
    const bool has =
        gb_run_recorder_read(directory, "state-before.h5", &same, before, &ignored);
    verify->from = has ? gb_checkpoint_step(before) : -1;
    if (verify->from > 0 && verify->from < verify->to) {
        return gb_experiment_resume(out, params, before, err);
    }
    verify->from = 0;
    return gb_experiment_create(out, params, cancelled, data, err);
}

static void compare(struct gb_verify *verify, struct pair *pair)
{
    gb_record_remove(&pair->kept, "journal/"); /* belongs to the directory */
    const char *name = gb_record_difference(&pair->kept, &pair->other, &verify->row);
    verify->kept = gb_record_hash(&pair->kept);
    verify->repeated = gb_record_hash(&pair->other);
    verify->equal = name == NULL;
    snprintf(verify->name, sizeof verify->name, "%s", name ? name : "");
}

/* A curve that another program has changed is no result of the run. */
static bool check_curve(const char *directory, const struct gb_params *params,
                        struct gb_record *kept, struct gb_error *err)
{
    struct gb_run_journal journal = {.preset = gb_run_journal_digest(params)};
    return gb_run_journal_load(&journal, kept, directory, err) &&
           gb_store_check_curve(directory, &journal.extent, err);
}

static bool has_checkpoint(const char *directory)
{
    char *path = g_build_filename(directory, "state.h5", NULL);
    const bool there = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return there;
}

static bool verify_locked(struct gb_verify *verify, const char *directory,
                          struct pair *pair, bool (*cancelled)(void *data), void *data,
                          struct gb_error *err)
{
    struct gb_params params;
    struct gb_experiment *experiment = NULL;
    if (!has_checkpoint(directory)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.300s: there is no checkpoint yet, nothing to repeat; "
                            "greenbody resume starts the run again",
                            directory);
    }
    if (!gb_run_recorder_read(directory, "state.h5", &params, &pair->kept, err)) {
        return false;
    }
    verify->to = gb_checkpoint_step(&pair->kept);
    const bool done =
        check_curve(directory, &params, &pair->kept, err) &&
        begin(&experiment, verify, directory, &params, &pair->other, cancelled, data,
              err) &&
        gb_repeat_points(experiment, verify->from, verify->to, cancelled, data, err) &&
        gb_checkpoint_take(experiment, &pair->other, err);
    if (done) {
        compare(verify, pair);
    }
    gb_experiment_destroy(experiment);
    return done;
}

bool gb_verify_run(struct gb_verify *verify, const char *directory,
                   bool (*cancelled)(void *data), void *data, struct gb_error *err)
{
    struct gb_rundir dir = GB_RUNDIR_NONE;
    *verify = (struct gb_verify){0};
    if (!gb_rundir_open(&dir, directory, err)) {
        return false;
    }
    struct pair *pair = gb_alloc_array(1, sizeof *pair, err);
    const bool done =
        pair && verify_locked(verify, directory, pair, cancelled, data, err);
    if (pair) {
        gb_record_finish(&pair->kept);
        gb_record_finish(&pair->other);
    }
    gb_alloc_free(pair);
    gb_rundir_finish(&dir);
    return done;
}
