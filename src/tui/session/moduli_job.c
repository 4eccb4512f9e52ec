#include "tui/session/moduli_job.h"

#include <string.h>

#include "scene/loading_kind.h"

static const char name[] = "moduli";

static void drop_table(struct gb_moduli_job *job)
{
    if (job->states != NULL) {
        g_array_free(job->states, TRUE);
    }
    g_free(job->directory);
    job->states = NULL;
    job->directory = NULL;
}

void gb_moduli_job_finish(struct gb_moduli_job *job)
{
    drop_table(job);
    memset(job, 0, sizeof *job);
}

static bool start_command(struct gb_moduli_job *job, const char *directory,
                          struct gb_child_command *child, struct gb_error *err)
{
    char *path = g_build_filename(directory, GB_MODULI_STATES_FILE, NULL);
    const char *const words[] = {name, directory, "--out", directory, NULL};
    char *state = g_build_filename(directory, "state.h5", NULL);
    const bool stored = g_file_test(state, G_FILE_TEST_EXISTS);
    g_free(state);
    job->waits_for = NULL;
    const bool good =
        (stored || gb_error_set(err, GB_ERR_INPUT, "the run has no stored state yet")) &&
        gb_child_command_start(child, name, path, GB_CHILD_COMMAND_QUIET, words, err);
    g_free(path);
    return good;
}

bool gb_moduli_job_start(struct gb_moduli_job *job, struct gb_runner *runner, bool live,
                         struct gb_child_command *child, struct gb_error *err)
{
    if (runner == NULL || gb_runner_directory(runner) == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "no stored run yet: r starts one");
    }
    if (!gb_loading_kind_check_cell(gb_runner_params(runner), name, err)) {
        return false;
    }
    if (child->pid != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the %s is not finished yet", child->name);
    }
    if (!live) {
        return start_command(job, gb_runner_directory(runner), child, err);
    }
    const int64_t stored = gb_runner_stored(runner);
    if (!gb_runner_send(runner, GB_COMMAND_STORE)) {
        return gb_error_set(err, GB_ERR_INPUT, "the engine is busy: try again");
    }
    job->waits_for = runner;
    job->stored = stored;
    return true;
}

bool gb_moduli_job_runs(const struct gb_moduli_job *job,
                        const struct gb_child_command *child)
{
    return job->waits_for != NULL || (child->pid != 0 && strcmp(child->name, name) == 0);
}

bool gb_moduli_job_measures(const struct gb_moduli_job *job,
                            const struct gb_child_command *child)
{
    return gb_moduli_job_runs(job, child) &&
           (job->waits_for != NULL ||
            (job->directory != NULL && g_str_has_prefix(child->path, job->directory)));
}

void gb_moduli_job_stop(struct gb_moduli_job *job, const struct gb_child_command *child)
{
    if (job->waits_for != NULL) {
        job->waits_for = NULL;
    } else if (gb_moduli_job_runs(job, child)) {
        gb_child_command_stop(child);
    }
}

/* A run that has ended has stored its last state. */
static void follow_store(struct gb_moduli_job *job, struct gb_runner *runner,
                         struct gb_child_command *child)
{
    if (job->waits_for != runner) { /* another run is shown */
        job->waits_for = NULL;
        return;
    }
    const bool over = gb_runner_snapshot(runner, NULL)->state >= GB_RUN_DONE;
    if (over || gb_runner_stored(runner) > job->stored) {
        (void)start_command(job, gb_runner_directory(runner), child, &job->failed);
    }
}

static bool is_shown(const struct gb_moduli_job *job, const char *directory)
{
    return g_strcmp0(job->directory, directory) == 0;
}

/* An error of reading keeps what is shown: the next reading may succeed. */
static void read_table(struct gb_moduli_job *job, const char *directory)
{
    GArray *states = g_array_new(FALSE, TRUE, sizeof(struct gb_moduli_state));
    char *path = g_build_filename(directory, GB_MODULI_STATES_FILE, NULL);
    if (g_file_test(path, G_FILE_TEST_EXISTS) &&
        gb_moduli_states_read(states, path, NULL)) {
        if (job->states != NULL) {
            g_array_free(job->states, TRUE);
        }
        job->states = states;
    } else {
        g_array_free(states, TRUE);
    }
    g_free(path);
}

bool gb_moduli_job_refresh(struct gb_moduli_job *job, struct gb_runner *runner,
                           struct gb_child_command *child, bool news)
{
    const char *directory = runner != NULL ? gb_runner_directory(runner) : NULL;
    const bool waited = job->waits_for != NULL;
    const bool other = !is_shown(job, directory);
    if (waited) {
        follow_store(job, runner, child);
    }
    if (other) {
        drop_table(job);
        job->directory = g_strdup(directory);
    }
    if (directory != NULL && (other || news)) {
        read_table(job, directory);
    }
    return other || (waited && job->waits_for == NULL);
}
