#include "study/card/card_threads.h"

#include <pthread.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/thread.h"

enum { JOBS_MAX = 256 };

bool gb_card_threads_init(struct gb_card_threads *threads, struct gb_error *err)
{
    const size_t replicas = (size_t)threads->options->replicas;
    g_mutex_init(&threads->mutex);
    threads->cell = gb_alloc_array(replicas, sizeof *threads->cell, err);
    threads->error = gb_alloc_array(replicas, sizeof *threads->error, err);
    return threads->cell && threads->error;
}

void gb_card_threads_finish(struct gb_card_threads *threads)
{
    for (int c = 0; c < threads->options->replicas && threads->cell; c++) {
        gb_card_cell_finish(&threads->cell[c]);
    }
    g_mutex_clear(&threads->mutex);
    gb_alloc_free(threads->cell);
    gb_alloc_free(threads->error);
}

static bool is_stopped(void *data)
{
    struct gb_card_threads *threads = data;
    const struct gb_card_callbacks *callbacks = threads->callbacks;
    g_mutex_lock(&threads->mutex);
    if (callbacks->cancelled != NULL && callbacks->cancelled(callbacks->data)) {
        threads->stop = true;
    }
    const bool stop = threads->stop;
    g_mutex_unlock(&threads->mutex);
    return stop;
}

static int take_next(struct gb_card_threads *threads)
{
    g_mutex_lock(&threads->mutex);
    const int next = threads->stop || threads->next >= threads->options->replicas
                         ? -1
                         : threads->next++;
    g_mutex_unlock(&threads->mutex);
    return next;
}

static void report(struct gb_card_threads *threads, bool good)
{
    const struct gb_card_callbacks *callbacks = threads->callbacks;
    g_mutex_lock(&threads->mutex);
    threads->done++;
    threads->stop = threads->stop || !good;
    if (good && callbacks->progress != NULL) {
        callbacks->progress(callbacks->data, threads->done, threads->options->replicas);
    }
    g_mutex_unlock(&threads->mutex);
}

static void *work(void *data)
{
    struct gb_card_threads *threads = data;
    const struct gb_pool_callbacks polled = {.cancelled = is_stopped, .data = threads};
    for (int c = take_next(threads); c >= 0; c = take_next(threads)) {
        report(threads,
               gb_card_cell_measure(&threads->cell[c], threads->preset, c + 1,
                                    threads->options, &polled, &threads->error[c]));
    }
    return NULL;
}

/* The first error that is not the end of the others. */
static bool check_cells(const struct gb_card_threads *threads, struct gb_error *err)
{
    const struct gb_error *first = NULL;
    for (int c = 0; c < threads->options->replicas; c++) {
        const struct gb_error *one = &threads->error[c];
        if (one->code != GB_OK && (first == NULL || first->code == GB_ERR_CANCELLED)) {
            first = one;
        }
    }
    if (first != NULL) {
        return gb_error_set(err, first->code, "%s", first->text);
    }
    return threads->done == threads->options->replicas ||
           gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
}

bool gb_card_threads_work(struct gb_card_threads *threads, int jobs, struct gb_error *err)
{
    pthread_t thread[JOBS_MAX];
    const int replicas = threads->options->replicas;
    const int wanted = jobs > 0 ? jobs : (int)sysconf(_SC_NPROCESSORS_ONLN);
    const int most = MIN(MIN(MAX(wanted, 1), JOBS_MAX), replicas);
    int started = 0;
    while (started < most && gb_thread_start(&thread[started], work, threads,
                                             "a thread of the card", err)) {
        started++;
    }
    for (int t = 0; t < started; t++) {
        pthread_join(thread[t], NULL);
    }
    return started > 0 && check_cells(threads, err);
}
