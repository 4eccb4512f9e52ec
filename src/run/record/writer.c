#include "run/record/writer.h"

#include <pthread.h>
#include <unistd.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/team.h"
#include "io/state_record.h"

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

bool gb_writer_create(struct gb_writer **out, const struct gb_store *store,
                      const struct gb_params *params, const struct gb_model *model,
                      struct gb_error *err)
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

void gb_writer_destroy(struct gb_writer *writer)
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

struct gb_record *gb_writer_record(struct gb_writer *writer)
{
    return &writer->record;
}

bool gb_writer_busy(struct gb_writer *writer)
{
    pthread_mutex_lock(&writer->mutex);
    const bool busy = writer->busy;
    pthread_mutex_unlock(&writer->mutex);
    return busy;
}

enum gb_writer_outcome gb_writer_send(struct gb_writer *writer, struct gb_error *err)
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

bool gb_writer_status(struct gb_writer *writer, char *text, struct gb_error *err)
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

bool gb_writer_wait(struct gb_writer *writer, struct gb_error *err)
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

double gb_writer_seconds(struct gb_writer *writer)
{
    pthread_mutex_lock(&writer->mutex);
    const double seconds = writer->seconds;
    pthread_mutex_unlock(&writer->mutex);
    return seconds;
}
