/* Records a run in its directory.
 *
 * A thread writes states and the status, so that the engine never waits for the disk.  The
 * engine fills one record and hands it over.  Between checkpoints the record of a recent
 * point is held in memory; a run that stops is saved from it.
 *
 * Below: the writer, the held record, then the recorder. */
#include "run/record/run_recorder.h"

#include <glib.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/record.h"
#include "base/team.h"
#include "hdf/hdf_record.h"
#include "io/follow.h"
#include "io/rundir.h"
#include "io/state_record.h"
#include "io/store.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/record/kept_states.h"
#include "run/record/live_export.h"
#include "run/record/run_journal.h"
#include "run/repeat_points.h"
#include "scene/model.h"

struct gb_writer {
    /* const once the thread runs */
    const struct gb_store *store;
    const struct gb_params *params;
    const struct gb_model *model;
    pthread_t thread;
    pid_t process; /* that has the thread; a child of it has none */

    /* guarded by the mutex */
    pthread_mutex_t mutex;
    pthread_cond_t change;
    bool busy, quit;
    bool writing_status;
    char *status;        /* the next one; NULL: none */
    struct gb_error err; /* the first failure; nothing is written after it */
    double seconds;      /* that the last state took */

    struct gb_record record; /* the thread reads it while busy; else the engine's */
};

static void write_record(const struct gb_writer *writer, const struct gb_record *record,
                         struct gb_error *err)
{
    struct gb_state *state = NULL;
    if (gb_state_record_to_write(&state, record, writer->params, writer->model, err)) {
        gb_store_state(writer->store, state, record, err);
    }
    gb_state_destroy(state);
}

static void finish_write(struct gb_writer *writer, const struct gb_error *err)
{
    if (writer->err.code == GB_OK) {
        writer->err = *err;
    }
    pthread_cond_broadcast(&writer->change);
}

/* Both are called with the mutex held and release it while they write. */
static void write_state(struct gb_writer *writer)
{
    struct gb_error err = {0};
    pthread_mutex_unlock(&writer->mutex);
    const double from = gb_clock_s();
    write_record(writer, &writer->record, &err);
    pthread_mutex_lock(&writer->mutex);
    writer->seconds = gb_clock_s() - from;
    writer->busy = false;
    finish_write(writer, &err);
}

static void write_status(struct gb_writer *writer)
{
    char *text = g_steal_pointer(&writer->status);
    struct gb_error err = {0};
    writer->writing_status = true;
    pthread_mutex_unlock(&writer->mutex);
    (void)gb_store_put_status(writer->store, text, &err);
    g_free(text);
    pthread_mutex_lock(&writer->mutex);
    writer->writing_status = false;
    finish_write(writer, &err);
}

static void *work(void *data)
{
    struct gb_writer *writer = data;
    pthread_mutex_lock(&writer->mutex);
    for (;;) {
        if (writer->busy) {
            write_state(writer);
        } else if (writer->status != NULL) {
            write_status(writer);
        } else if (writer->quit) {
            break;
        } else {
            pthread_cond_wait(&writer->change, &writer->mutex);
        }
    }
    pthread_mutex_unlock(&writer->mutex);
    return NULL;
}

bool gb_run_recorder_writer_create(struct gb_writer **out, const struct gb_store *store,
                                   const struct gb_params *params,
                                   const struct gb_model *model, struct gb_error *err)
{
    struct gb_writer *writer = gb_alloc_array(1, sizeof *writer, err);
    if (!writer) {
        return false;
    }
    writer->store = store;
    writer->params = params;
    writer->model = model;
    writer->process = getpid();
    pthread_mutex_init(&writer->mutex, NULL);
    pthread_cond_init(&writer->change, NULL);
    if (!gb_team_start_thread(&writer->thread, work, writer, "the writer thread", err)) {
        pthread_cond_destroy(&writer->change);
        pthread_mutex_destroy(&writer->mutex);
        gb_alloc_free(writer);
        return false;
    }
    *out = writer;
    return true;
}

void gb_run_recorder_writer_destroy(struct gb_writer *writer)
{
    if (!writer) {
        return;
    }
    if (writer->process == getpid()) {
        pthread_mutex_lock(&writer->mutex);
        writer->quit = true;
        pthread_cond_broadcast(&writer->change);
        pthread_mutex_unlock(&writer->mutex);
        pthread_join(writer->thread, NULL);
        pthread_cond_destroy(&writer->change);
        pthread_mutex_destroy(&writer->mutex);
    }
    g_free(writer->status);
    gb_record_finish(&writer->record);
    gb_alloc_free(writer);
}

struct gb_record *gb_run_recorder_writer_record(struct gb_writer *writer)
{
    return &writer->record;
}

static bool writer_busy(struct gb_writer *writer)
{
    pthread_mutex_lock(&writer->mutex);
    const bool busy = writer->busy;
    pthread_mutex_unlock(&writer->mutex);
    return busy;
}

enum gb_writer_outcome gb_run_recorder_writer_send(struct gb_writer *writer,
                                                   struct gb_error *err)
{
    enum gb_writer_outcome outcome = GB_WRITER_BUSY;
    pthread_mutex_lock(&writer->mutex);
    if (writer->busy) {
        outcome = GB_WRITER_BUSY;
    } else if (writer->err.code != GB_OK) {
        *err = writer->err;
        outcome = GB_WRITER_FAILED;
    } else {
        writer->busy = true;
        pthread_cond_broadcast(&writer->change);
        outcome = GB_WRITER_SENT;
    }
    pthread_mutex_unlock(&writer->mutex);
    return outcome;
}

/* Replaces status.json by text, which belongs to the writer from now on; it supersedes a
 * text that still waits.  False with err when writing has failed before. */
static bool writer_status(struct gb_writer *writer, char *text, struct gb_error *err)
{
    pthread_mutex_lock(&writer->mutex);
    const bool good = writer->err.code == GB_OK;
    if (good) {
        g_free(writer->status);
        writer->status = text;
        pthread_cond_broadcast(&writer->change);
    } else {
        g_free(text);
        *err = writer->err;
    }
    pthread_mutex_unlock(&writer->mutex);
    return good;
}

bool gb_run_recorder_writer_wait(struct gb_writer *writer, struct gb_error *err)
{
    pthread_mutex_lock(&writer->mutex);
    while (writer->busy || writer->writing_status || writer->status != NULL) {
        pthread_cond_wait(&writer->change, &writer->mutex);
    }
    const bool good = writer->err.code == GB_OK;
    if (!good) {
        *err = writer->err;
    }
    pthread_mutex_unlock(&writer->mutex);
    return good;
}

double gb_run_recorder_writer_seconds(struct gb_writer *writer)
{
    pthread_mutex_lock(&writer->mutex);
    const double seconds = writer->seconds;
    pthread_mutex_unlock(&writer->mutex);
    return seconds;
}

/* The record of the last point of a run: the writer's.  Taking it costs as much as some
 * evaluations, so it is taken at some of the points only, not while it is being written, and
 * computed up to the last one when it is needed. */
struct held_record {
    const struct gb_params *params;
    struct gb_writer *writer;
    struct gb_run_journal journal; /* as of the last point */
    bool fresh;                    /* there is a record that is newer than state.h5 */
    int64_t missing; /* gb_checkpoint_step of the last point; -1: it has the record */
    double taken_s, cost_s; /* clock at the last record, and how long it took */
};

/* How much computing may have to be repeated, s: so long that records cost a twentieth of
 * the time, within these limits. */
static const double age_least_s = 0.1, age_most_s = 10.0, cost_share = 0.05;

/* params and writer must outlive it. */
static void held_record_init(struct held_record *held, const struct gb_params *params,
                             struct gb_writer *writer)
{
    *held = (struct held_record){.params = params, .writer = writer, .missing = -1};
}

/* True where the last point needs a record of its own: there is none since the last
 * checkpoint, or it would soon be too old, or the run is over.  Not while a checkpoint is
 * written: the points of that time are computed from it. */
static bool held_record_due(const struct held_record *held,
                            const struct gb_experiment *experiment)
{
    const double allowed_s =
        fmin(fmax(held->cost_s / cost_share, age_least_s), age_most_s);
    const double age_s = gb_clock_s() - held->taken_s; /* negative: the clock went back */
    return gb_experiment_over(experiment) ||
           ((!held->fresh || age_s < 0.0 || age_s >= allowed_s) &&
            !writer_busy(held->writer));
}

/* Right after a point: takes its record, without the journal, as soon as the last one is
 * written; or goes without. */
static bool held_record_take(struct held_record *held, struct gb_experiment *experiment,
                             struct gb_error *err)
{
    if (!gb_run_recorder_writer_wait(held->writer, err)) {
        return false;
    }
    const double from_s = gb_clock_s();
    const bool good =
        gb_checkpoint_take(experiment, gb_run_recorder_writer_record(held->writer), err);
    held->taken_s = gb_clock_s();
    held->cost_s = held->taken_s - from_s;
    return good;
}

static void held_record_skip(struct held_record *held, const struct gb_point *point)
{
    held->missing = point->step + 1;
}

/* Adds the journal to the record of the last point, which is complete then. */
static bool held_record_complete(struct held_record *held, struct gb_error *err)
{
    held->fresh = gb_run_journal_record(&held->journal,
                                        gb_run_recorder_writer_record(held->writer), err);
    held->missing = -1;
    return held->fresh;
}

/* Computes the record up to the last point; the bits are those of a record taken there.
 * Nothing is done while it is written.  Where the run cannot be repeated, the record stays:
 * a checkpoint some points before.
 * Errors: GB_ERR_MEMORY. */
static bool held_record_catch_up(struct held_record *held, struct gb_error *err)
{
    struct gb_record *record = gb_run_recorder_writer_record(held->writer);
    struct gb_error why = {0};
    if (held->missing < 0 || writer_busy(held->writer)) {
        return true;
    }
    if (gb_repeat_points_record(record, held->params, held->missing, &why)) {
        return held_record_complete(held, err);
    }
    held->missing = -1;
    held->fresh = held->fresh && record->count > 0;
    return why.code != GB_ERR_MEMORY || gb_error_set(err, why.code, "%s", why.text);
}

/* A record to be written: fresh, and of the last point. */
static bool held_record_ready(const struct held_record *held)
{
    return held->fresh && held->missing < 0;
}

struct gb_run_recorder {
    struct gb_params params;
    struct gb_model model;
    struct gb_store *store;
    struct gb_writer *writer;
    struct gb_kept_states states;
    struct gb_live_export live;
    struct gb_run_journal journal; /* events and seconds as they grow */
    struct held_record held;
    double written_at; /* seconds of the run at the last checkpoint */
    int not_kept;      /* states of rows without a state, until an event names them */
};

static bool create(struct gb_run_recorder **out, const struct gb_params *params,
                   struct gb_error *err)
{
    struct gb_run_recorder *recorder = gb_alloc_array(1, sizeof *recorder, err);
    if (!recorder) {
        return false;
    }
    recorder->params = *params;
    recorder->journal.preset = gb_run_journal_digest(params);
    gb_kept_states_init(&recorder->states, &recorder->params);
    gb_live_export_init(&recorder->live, params);
    if (!gb_params_check(params, err) || !gb_model_init(&recorder->model, params, err)) {
        gb_alloc_free(recorder);
        return false;
    }
    *out = recorder;
    return true;
}

static bool start_writer(struct gb_run_recorder *recorder, struct gb_error *err)
{
    if (!gb_run_recorder_writer_create(&recorder->writer, recorder->store,
                                       &recorder->params, &recorder->model, err)) {
        return false;
    }
    held_record_init(&recorder->held, &recorder->params, recorder->writer);
    return true;
}

bool gb_run_recorder_create(struct gb_run_recorder **out, const char *directory,
                            const struct gb_params *params, enum gb_rundir_mode mode,
                            struct gb_error *err)
{
    struct gb_run_recorder *recorder = NULL;
    if (!create(&recorder, params, err)) {
        return false;
    }
    if (!gb_store_create(&recorder->store, directory, params, mode, err)) {
        gb_alloc_free(recorder);
        return false;
    }
    if (!start_writer(recorder, err)) {
        gb_store_discard(recorder->store);
        gb_alloc_free(recorder);
        return false;
    }
    *out = recorder;
    return true;
}

bool gb_run_recorder_read(const char *directory, const char *name,
                          struct gb_params *params, struct gb_record *record,
                          struct gb_error *err)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool done =
        gb_follow_params(directory, params, err) && gb_hdf_record_read(record, path, err);
    g_free(path);
    return done;
}

/* Builds the experiment from the checkpoint; errors name the file. */
static bool load_experiment(struct gb_run_recorder *recorder,
                            struct gb_experiment **experiment, const char *directory,
                            const char *name, struct gb_error *err)
{
    struct gb_error why = {0};
    char *path = g_build_filename(directory, name, NULL);
    struct gb_record *record = gb_alloc_array(1, sizeof *record, err);
    bool done = record && gb_hdf_record_read(record, path, err) &&
                gb_run_journal_load(&recorder->journal, record, directory, err);
    if (done && !gb_experiment_resume(experiment, &recorder->params, record, &why)) {
        done = gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    g_free(path);
    return done;
}

static bool has_checkpoint(const char *directory, const char *name)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool exists = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return exists;
}

static bool is_readable(struct gb_record *record, const char *directory, const char *name)
{
    struct gb_error ignored;
    char *path = g_build_filename(directory, name, NULL);
    const bool good = gb_hdf_record_read(record, path, &ignored);
    g_free(path);
    return good;
}

/* Where the last checkpoint cannot be read: says what the one before would do. */
static void offer_before(const char *directory, struct gb_error *err)
{
    struct gb_params params;
    struct gb_error ignored, why = *err;
    struct gb_record *record = gb_alloc_array(1, sizeof *record, &ignored);
    if (record &&
        gb_run_recorder_read(directory, "state-before.h5", &params, record, &ignored)) {
        (void)gb_error_set(
            err, why.code,
            "%.300s; state-before.h5 is whole: resume --before continues from "
            "step %lld and computes the points after it again",
            why.text, (long long)gb_checkpoint_step(record) - 1);
    } else if (record && !is_readable(record, directory, "state.h5")) {
        (void)gb_error_set(err, why.code,
                           "%.300s; nor is there a whole state-before.h5: without these "
                           "two files resume starts the run again",
                           why.text);
    }
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
}

/* The checkpoint that is asked for; without one the run begins anew, unless that before
 * was asked for. */
static bool load_checkpoint(struct gb_run_recorder *recorder,
                            struct gb_experiment **experiment, const char *directory,
                            enum gb_run_recorder_from from, bool *begun,
                            struct gb_error *err)
{
    static const char *const names[] = {"state.h5", "state-before.h5"};
    const bool last = from == GB_RUN_RECORDER_LAST;
    *begun = has_checkpoint(directory, names[from]);
    if (!*begun && last && !has_checkpoint(directory, names[GB_RUN_RECORDER_BEFORE])) {
        return true;
    }
    if (!*begun) {
        (void)gb_error_set(err, GB_ERR_INPUT, "%s: has no %s", directory, names[from]);
    } else if (load_experiment(recorder, experiment, directory, names[from], err)) {
        return true;
    }
    if (last && err != NULL && err->code == GB_ERR_INPUT) {
        offer_before(directory, err);
    }
    return false;
}

bool gb_run_recorder_resume(struct gb_run_recorder **out,
                            struct gb_experiment **experiment, const char *directory,
                            enum gb_run_recorder_from from, struct gb_error *err)
{
    struct gb_rundir dir = GB_RUNDIR_NONE;
    struct gb_params params;
    struct gb_run_recorder *recorder = NULL;
    bool begun = false;
    *experiment = NULL;
    if (!gb_rundir_open(&dir, directory, err)) {
        return false;
    }
    gb_rundir_files_tidy(directory);
    if (!gb_follow_params(directory, &params, err) || !create(&recorder, &params, err) ||
        !load_checkpoint(recorder, experiment, directory, from, &begun, err) ||
        !gb_store_reopen(&recorder->store, &dir, &params,
                         begun ? &recorder->journal.extent : NULL, err) ||
        !start_writer(recorder, err)) {
        gb_experiment_destroy(*experiment);
        *experiment = NULL;
        gb_run_recorder_destroy(recorder);
        gb_rundir_finish(&dir);
        return false;
    }
    recorder->written_at = recorder->journal.seconds;
    gb_live_export_resume(&recorder->live, gb_store_rundir(recorder->store)->held,
                          &recorder->journal.live);
    if (*experiment != NULL) {
        recorder->states.p_pa = recorder->journal.highest[0];
        recorder->states.density = recorder->journal.highest[1];
        gb_kept_states_pass(&recorder->states, gb_experiment_point(*experiment));
    }
    *out = recorder;
    return true;
}

/* Ends all but the store. */
static void end(struct gb_run_recorder *recorder)
{
    gb_run_recorder_writer_destroy(recorder->writer);
    gb_live_export_finish(&recorder->live);
}

void gb_run_recorder_discard(struct gb_run_recorder *recorder)
{
    end(recorder);
    gb_store_discard(recorder->store);
    gb_alloc_free(recorder);
}

void gb_run_recorder_destroy(struct gb_run_recorder *recorder)
{
    if (!recorder) {
        return;
    }
    end(recorder);
    gb_store_destroy(recorder->store);
    gb_alloc_free(recorder);
}

const struct gb_params *gb_run_recorder_params(const struct gb_run_recorder *recorder)
{
    return &recorder->params;
}

struct gb_store *gb_run_recorder_store(struct gb_run_recorder *recorder)
{
    return recorder->store;
}

int64_t gb_run_recorder_points(const struct gb_run_recorder *recorder)
{
    return gb_store_extent(recorder->store).points;
}

double gb_run_recorder_seconds(const struct gb_run_recorder *recorder)
{
    return recorder->journal.seconds;
}

int64_t gb_run_recorder_events(const struct gb_run_recorder *recorder)
{
    return recorder->journal.events;
}

/* The directory as of the last point. */
static void note_point(struct gb_run_recorder *recorder, double seconds)
{
    recorder->journal.extent = gb_store_extent(recorder->store);
    recorder->journal.live = recorder->live.extent;
    recorder->journal.seconds = seconds;
    recorder->journal.highest[0] = recorder->states.p_pa;
    recorder->journal.highest[1] = recorder->states.density;
    recorder->held.journal = recorder->journal;
}

static bool checkpoint_due(const struct gb_run_recorder *recorder, double seconds)
{
    return seconds - recorder->written_at >= recorder->params.checkpoint_every_s;
}

/* The kept state; its frame comes before the journal, which counts it. */
static bool keep(struct gb_run_recorder *recorder, const struct gb_point *point,
                 const struct gb_kept_names *names, struct gb_state **state,
                 struct gb_error *err)
{
    const struct gb_rundir *dir = gb_store_rundir(recorder->store);
    const struct gb_record *record = gb_run_recorder_writer_record(recorder->writer);
    if (!gb_state_record(state, record, &recorder->params, &recorder->model, err)) {
        return false;
    }
    gb_live_export_frame(&recorder->live, dir->held, *state);
    note_point(recorder, point->seconds);
    if (!held_record_complete(&recorder->held, err) ||
        !gb_rundir_result(
            dir, gb_kept_states_write(dir->held, names, *state, record, err), err)) {
        return false;
    }
    gb_live_export_files(&recorder->live, dir->held, names, *state);
    return true;
}

/* The record of a point and, where one is due, the kept state. */
static bool record_state(struct gb_run_recorder *recorder,
                         struct gb_experiment *experiment, const struct gb_point *point,
                         const struct gb_kept_names *names, struct gb_error *err)
{
    struct gb_state *state = NULL;
    if (!held_record_take(&recorder->held, experiment, err)) {
        return false;
    }
    if (names->count == 0) {
        return held_record_complete(&recorder->held, err);
    }
    const bool good = keep(recorder, point, names, &state, err);
    gb_state_destroy(state);
    return good;
}

bool gb_run_recorder_point(struct gb_run_recorder *recorder,
                           struct gb_experiment *experiment, const struct gb_point *point,
                           struct gb_error *err)
{
    if (!gb_store_point(recorder->store, point, err)) {
        return false;
    }
    if (!recorder->writer) {
        return true;
    }
    struct gb_kept_names names;
    gb_kept_states_due(&recorder->states, point, gb_run_recorder_points(recorder),
                       &names);
    gb_kept_states_pass(&recorder->states, point);
    note_point(recorder, point->seconds);
    const bool free = !writer_busy(recorder->writer);
    if (names.count > 0 || (free && checkpoint_due(recorder, point->seconds)) ||
        held_record_due(&recorder->held, experiment)) {
        return record_state(recorder, experiment, point, &names, err);
    }
    held_record_skip(&recorder->held, point);
    return true;
}

bool gb_run_recorder_row(struct gb_run_recorder *recorder, const struct gb_point *point,
                         struct gb_error *err)
{
    struct gb_kept_names names;
    if (!gb_store_point(recorder->store, point, err)) {
        return false;
    }
    gb_kept_states_due(&recorder->states, point, gb_run_recorder_points(recorder),
                       &names);
    gb_kept_states_pass(&recorder->states, point);
    recorder->not_kept += names.count;
    return true;
}

bool gb_run_recorder_event(struct gb_run_recorder *recorder, int64_t step,
                           const char *text, struct gb_error *err)
{
    recorder->journal.events++;
    return gb_store_event(recorder->store, step, text, err);
}

bool gb_run_recorder_tick(struct gb_run_recorder *recorder, double seconds,
                          enum gb_run_recorder_when when, struct gb_error *err)
{
    const bool now = when == GB_RUN_RECORDER_NOW;
    if (now && !held_record_catch_up(&recorder->held, err)) {
        return false;
    }
    /* a due checkpoint waits for a point, which will have a record */
    if (!held_record_ready(&recorder->held) ||
        !(now || checkpoint_due(recorder, seconds))) {
        return true;
    }
    switch (gb_run_recorder_writer_send(recorder->writer, err)) {
    case GB_WRITER_SENT:
        recorder->held.fresh = false;
        recorder->written_at = seconds;
        return true;
    case GB_WRITER_BUSY:
        return true;
    case GB_WRITER_FAILED:
        break;
    }
    return false;
}

bool gb_run_recorder_status(struct gb_run_recorder *recorder,
                            const struct gb_snapshot *snapshot, struct gb_error *err)
{
    return recorder->writer
               ? writer_status(recorder->writer,
                               gb_store_status_text(recorder->store, snapshot), err)
               : gb_store_status(recorder->store, snapshot, err);
}

void gb_run_recorder_fail(struct gb_run_recorder *recorder,
                          const struct gb_snapshot *snapshot)
{
    struct gb_error ignored;
    if (!recorder) {
        return;
    }
    /* a status that is still being written must not replace this one */
    (void)(!recorder->writer || gb_run_recorder_writer_wait(recorder->writer, &ignored));
    (void)gb_store_sync(recorder->store, &ignored);
    (void)gb_store_status(recorder->store, snapshot, &ignored);
}

bool gb_run_recorder_save(struct gb_run_recorder *recorder, double seconds,
                          struct gb_error *err)
{
    return !recorder->writer ||
           (gb_run_recorder_writer_wait(recorder->writer, err) &&
            gb_run_recorder_tick(recorder, seconds, GB_RUN_RECORDER_NOW, err) &&
            gb_run_recorder_writer_wait(recorder->writer, err));
}

bool gb_run_recorder_missed(struct gb_run_recorder *recorder, char *text, size_t size)
{
    if (recorder->not_kept == 0) {
        return gb_live_export_told(&recorder->live, text, size);
    }
    snprintf(text, size,
             "output.snapshots_at: %d states are not kept: their points come before "
             "the state with which this run begins",
             recorder->not_kept);
    recorder->not_kept = 0;
    return true;
}

bool gb_run_recorder_conclude(struct gb_run_recorder *recorder,
                              const struct gb_snapshot *snapshot, struct gb_error *err)
{
    return gb_run_recorder_save(recorder, snapshot->seconds, err) &&
           gb_store_sync(recorder->store, err) &&
           gb_store_status(recorder->store, snapshot, err);
}
