#include "run/run_recorder.h"

#include <stddef.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "io/hdf/hdf_record.h"
#include "io/preset.h"
#include "run/checkpoint.h"
#include "run/kept_states.h"
#include "run/writer.h"

/* What a checkpoint keeps of the directory, beside the experiment. */
struct journal {
    struct gb_store_place place;
    int64_t events;
    double seconds;
    int64_t preset; /* digest of the parameters that make the run what it is */
};

#define AT(member) offsetof(struct journal, member)
static const struct gb_record_member members[] = {
    {"journal/points", GB_RECORD_INT64, 1, AT(place.points), "1"},
    {"journal/curve_bytes", GB_RECORD_INT64, 1, AT(place.curve_bytes), "1"},
    {"journal/events_bytes", GB_RECORD_INT64, 1, AT(place.events_bytes), "1"},
    {"journal/events", GB_RECORD_INT64, 1, AT(events), "1"},
    {"journal/seconds", GB_RECORD_DOUBLE, 1, AT(seconds), "s"},
    {"journal/preset", GB_RECORD_INT64, 1, AT(preset), "1"},
};
#undef AT

enum { MEMBERS = sizeof members / sizeof members[0] };

struct gb_run_recorder {
    struct gb_params params;
    struct gb_model model;
    struct gb_store *store;
    struct gb_writer *writer;
    struct gb_kept_states album;
    struct journal journal; /* events and seconds as they grow */
    bool fresh;             /* the record in memory is newer than state.h5 */
    double written_at;      /* seconds of the run */
};

/* Parameters that may change from stop to resume: they change no result. */
static bool is_free(const struct gb_field *field)
{
    return strcmp(field->group, "output") == 0 || strcmp(field->key, "threads") == 0 ||
           strcmp(field->key, "title") == 0;
}

static int64_t digest(const struct gb_params *params)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (size_t i = 0; i < count; i++) {
        char value[2048];
        if (!is_free(&fields[i])) {
            gb_params_format(params, &fields[i], value, sizeof value);
            g_checksum_update(sum, (const guchar *)fields[i].key, -1);
            g_checksum_update(sum, (const guchar *)value, -1);
        }
    }
    guint8 bytes[32];
    gsize size = sizeof bytes;
    int64_t number = 0;
    g_checksum_get_digest(sum, bytes, &size);
    memcpy(&number, bytes, sizeof number);
    g_checksum_free(sum);
    return number;
}

static bool make(struct gb_run_recorder **out, const struct gb_params *params,
                 struct gb_error *err)
{
    struct gb_run_recorder *keep = gb_alloc_array(1, sizeof *keep, err);
    if (!keep) {
        return false;
    }
    keep->params = *params;
    keep->journal.preset = digest(params);
    gb_kept_states_init(&keep->album, params);
    if (!gb_params_check(params, err) || !gb_model_init(&keep->model, params, err)) {
        gb_alloc_free(keep);
        return false;
    }
    *out = keep;
    return true;
}

static bool start_writer(struct gb_run_recorder *keep, struct gb_error *err)
{
    return !gb_checkpoint_known(&keep->params) ||
           gb_writer_create(&keep->writer, keep->store, &keep->params, &keep->model, err);
}

bool gb_run_recorder_create(struct gb_run_recorder **out, const char *directory,
                            const struct gb_params *params, bool force,
                            struct gb_error *err)
{
    struct gb_run_recorder *keep = NULL;
    if (!make(&keep, params, err)) {
        return false;
    }
    if (!gb_store_create(&keep->store, directory, params, force, err)) {
        gb_alloc_free(keep);
        return false;
    }
    if (!start_writer(keep, err)) {
        gb_store_discard(keep->store);
        gb_alloc_free(keep);
        return false;
    }
    *out = keep;
    return true;
}

static bool read_preset(const char *directory, struct gb_params *params,
                        struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_error why = {0};
    char *path = g_build_filename(directory, "preset.ini", NULL);
    bool done = gb_preset_load(&preset, path, err);
    if (done) {
        *params = *gb_preset_params(preset);
        done = gb_params_check(params, &why) ||
               gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    gb_preset_destroy(preset);
    g_free(path);
    return done;
}

bool gb_run_recorder_read(const char *directory, const char *name,
                          struct gb_params *params, struct gb_record *record,
                          struct gb_error *err)
{
    char *path = g_build_filename(directory, name, NULL);
    const bool done =
        read_preset(directory, params, err) && gb_hdf_record_read(record, path, err);
    g_free(path);
    return done;
}

/* The checkpoint's own words about the directory; a preset that was edited since makes
 * another run. */
static bool load_journal(struct gb_run_recorder *keep, struct gb_record *record,
                         const char *directory, struct gb_error *err)
{
    const int64_t preset = keep->journal.preset;
    struct gb_error why = {0};
    record->loading = true;
    if (!gb_record_members(record, members, MEMBERS, &keep->journal, &why)) {
        return gb_error_set(err, why.code, "%s/state.h5: %s", directory, why.text);
    }
    if (keep->journal.preset != preset) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s/preset.ini: was changed since the checkpoint: it would "
                            "be another run; only [output], title and threads may change",
                            directory);
    }
    return true;
}

/* The experiment out of the checkpoint; a record that does not fit names the file. */
static bool revive(struct gb_run_recorder *keep, struct gb_experiment **experiment,
                   const char *directory, struct gb_error *err)
{
    struct gb_error why = {0};
    char *path = g_build_filename(directory, "state.h5", NULL);
    struct gb_record *record = gb_alloc_array(1, sizeof *record, err);
    bool done = record && gb_hdf_record_read(record, path, err) &&
                load_journal(keep, record, directory, err);
    if (done && !gb_experiment_resume(experiment, &keep->params, record, &why)) {
        done = gb_error_set(err, why.code, "%s: %s", path, why.text);
    }
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    g_free(path);
    return done;
}

static bool has_state(const char *directory)
{
    char *path = g_build_filename(directory, "state.h5", NULL);
    const bool has = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return has;
}

bool gb_run_recorder_resume(struct gb_run_recorder **out,
                            struct gb_experiment **experiment, const char *directory,
                            struct gb_error *err)
{
    struct gb_rundir dir = {.lock = -1};
    struct gb_params params;
    struct gb_run_recorder *keep = NULL;
    *experiment = NULL;
    if (!gb_rundir_open(&dir, directory, err)) {
        return false;
    }
    const bool had = has_state(directory);
    if (!read_preset(directory, &params, err) || !make(&keep, &params, err) ||
        (had && !revive(keep, experiment, directory, err)) ||
        !gb_store_reopen(&keep->store, &dir, &params, had ? &keep->journal.place : NULL,
                         err) ||
        !start_writer(keep, err)) {
        gb_experiment_destroy(*experiment);
        *experiment = NULL;
        gb_run_recorder_destroy(keep);
        gb_rundir_finish(&dir);
        return false;
    }
    keep->written_at = keep->journal.seconds;
    if (*experiment != NULL) {
        gb_kept_states_pass(&keep->album, gb_experiment_point(*experiment));
    }
    *out = keep;
    return true;
}

void gb_run_recorder_destroy(struct gb_run_recorder *keep)
{
    if (!keep) {
        return;
    }
    gb_writer_destroy(keep->writer);
    gb_store_destroy(keep->store);
    gb_alloc_free(keep);
}

const struct gb_params *gb_run_recorder_params(const struct gb_run_recorder *keep)
{
    return &keep->params;
}

struct gb_store *gb_run_recorder_store(struct gb_run_recorder *keep)
{
    return keep->store;
}

int64_t gb_run_recorder_points(const struct gb_run_recorder *keep)
{
    return gb_store_place(keep->store).points;
}

double gb_run_recorder_seconds(const struct gb_run_recorder *keep)
{
    return keep->journal.seconds;
}

int64_t gb_run_recorder_events(const struct gb_run_recorder *keep)
{
    return keep->journal.events;
}

/* The record of the last point, completed by what belongs to the directory. */
static bool sign(struct gb_run_recorder *keep, double seconds, struct gb_error *err)
{
    keep->journal.place = gb_store_place(keep->store);
    keep->journal.seconds = seconds;
    keep->fresh = gb_record_members(gb_writer_record(keep->writer), members, MEMBERS,
                                    &keep->journal, err);
    return keep->fresh;
}

bool gb_run_recorder_point(struct gb_run_recorder *keep, struct gb_experiment *experiment,
                           const struct gb_point *point, struct gb_error *err)
{
    if (!gb_store_point(keep->store, point, err)) {
        return false;
    }
    if (!keep->writer) {
        return true;
    }
    const struct gb_rundir *dir = gb_store_rundir(keep->store);
    struct gb_record *record = gb_writer_record(keep->writer);
    return gb_checkpoint_take(experiment, record, err) &&
           sign(keep, point->seconds, err) &&
           gb_rundir_told(dir,
                          gb_kept_states_point(&keep->album, dir->held, point,
                                               gb_run_recorder_points(keep), record,
                                               &keep->params, &keep->model, err),
                          err);
}

bool gb_run_recorder_adopt(struct gb_run_recorder *keep, const struct gb_point *points,
                           int64_t count, struct gb_record *record, struct gb_error *err)
{
    for (int64_t i = 0; i < count; i++) {
        if (!gb_store_point(keep->store, &points[i], err)) {
            return false;
        }
        gb_kept_states_pass(&keep->album, &points[i]);
    }
    if (count == 0 || !keep->writer) {
        return true;
    }
    struct gb_record *own = gb_writer_record(keep->writer);
    gb_record_finish(own);
    *own = *record;
    *record = (struct gb_record){0};
    return sign(keep, points[count - 1].seconds, err);
}

bool gb_run_recorder_event(struct gb_run_recorder *keep, int64_t step, const char *text,
                           struct gb_error *err)
{
    keep->journal.events++;
    return gb_store_event(keep->store, step, text, err);
}

bool gb_run_recorder_tick(struct gb_run_recorder *keep, double seconds, bool now,
                          struct gb_error *err)
{
    const bool due = now || seconds - keep->written_at >= keep->params.checkpoint_every_s;
    if (!keep->fresh || !due) {
        return true;
    }
    struct gb_error why = {0};
    if (gb_writer_send(keep->writer, &why)) {
        keep->fresh = false;
        keep->written_at = seconds;
    } else if (why.code != GB_OK) {
        *err = why;
        return false;
    }
    return true;
}

bool gb_run_recorder_status(struct gb_run_recorder *keep,
                            const struct gb_snapshot *snapshot, struct gb_error *err)
{
    return keep->writer
               ? gb_writer_status(keep->writer,
                                  gb_store_status_text(keep->store, snapshot), err)
               : gb_store_status(keep->store, snapshot, err);
}

void gb_run_recorder_fail(struct gb_run_recorder *keep,
                          const struct gb_snapshot *snapshot)
{
    struct gb_error ignored;
    if (!keep) {
        return;
    }
    /* a status that is still being written must not come after this one */
    (void)(!keep->writer || gb_writer_wait(keep->writer, &ignored));
    (void)gb_store_sync(keep->store, &ignored);
    (void)gb_store_status(keep->store, snapshot, &ignored);
}

bool gb_run_recorder_conclude(struct gb_run_recorder *keep,
                              const struct gb_snapshot *snapshot, struct gb_error *err)
{
    return (!keep->writer || (gb_writer_wait(keep->writer, err) &&
                              gb_run_recorder_tick(keep, snapshot->seconds, true, err) &&
                              gb_writer_wait(keep->writer, err))) &&
           gb_store_sync(keep->store, err) && gb_store_status(keep->store, snapshot, err);
}
