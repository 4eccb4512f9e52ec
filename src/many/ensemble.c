#include "many/ensemble.h"

#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "io/rundir.h"
#include "many/single_run.h"

/* Longest time between two looks at watch->cancelled. */
static const double patience_s = 0.2;

bool gb_ensemble_init(struct gb_ensemble *ensemble, size_t points, size_t replicas,
                      struct gb_error *err)
{
    *ensemble = (struct gb_ensemble){.points = points, .replicas = replicas};
    if (points == 0 || replicas == 0 || points > GB_ENSEMBLE_MOST / replicas) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%zu points with %zu replicas: accepted 1 to %d runs", points,
                            replicas, GB_ENSEMBLE_MOST);
    }
    ensemble->run = gb_alloc_array(points * replicas, sizeof *ensemble->run, err);
    for (size_t i = 0; ensemble->run != NULL && i < points * replicas; i++) {
        ensemble->run[i].point = i % points;
        ensemble->run[i].replica = i / points;
    }
    return ensemble->run != NULL;
}

void gb_ensemble_finish(struct gb_ensemble *ensemble)
{
    const size_t runs = ensemble->run ? ensemble->points * ensemble->replicas : 0;
    for (size_t i = 0; i < runs; i++) {
        g_free(ensemble->run[i].directory);
    }
    gb_alloc_free(ensemble->run);
    *ensemble = (struct gb_ensemble){0};
}

struct gb_ensemble_run *gb_ensemble_at(const struct gb_ensemble *ensemble, size_t point,
                                       size_t replica)
{
    return &ensemble->run[replica * ensemble->points + point];
}

bool gb_ensemble_find_done(struct gb_ensemble *ensemble, struct gb_error *err)
{
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        if (!g_file_test(run->directory, G_FILE_TEST_EXISTS)) {
            continue;
        }
        bool same = true;
        run->before = run->ended =
            gb_single_run_done(&run->params, run->directory, &same);
        if (!same) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: holds a run of other parameters; choose another "
                                "directory",
                                run->directory);
        }
        if (!run->ended && !gb_rundir_check(run->directory, GB_RUNDIR_REPLACE, err)) {
            return false;
        }
    }
    return true;
}

/* The first k replicas have all ended and are enough, for some k. */
static bool is_settled(const struct gb_ensemble *ensemble, size_t point)
{
    return ensemble->enough != NULL && ensemble->enough(ensemble, point, ensemble->data);
}

/* Runs to be given: none before `from`, so many of them. */
struct queue {
    size_t from, waiting;
};

/* The next run to be given, in the order of the list; NULL when there is none now. */
static struct gb_ensemble_run *next_run(struct gb_ensemble *ensemble, struct queue *queue)
{
    const size_t runs = ensemble->points * ensemble->replicas;
    for (; queue->from < runs; queue->from++) {
        struct gb_ensemble_run *run = &ensemble->run[queue->from];
        if (!run->ended && !run->given && !is_settled(ensemble, run->point)) {
            return run;
        }
    }
    return NULL;
}

/* Runs that can be given now.  Where those that end may be enough nothing is begun ahead
 * of need. */
static size_t room(const struct gb_ensemble *ensemble, const struct gb_pool *crew,
                   size_t waiting)
{
    const size_t idle = gb_pool_idle(crew);
    return idle > 0 || ensemble->enough != NULL ? idle : gb_pool_prefetch(crew, waiting);
}

/* Gives runs to workers; false when none can be started. */
static bool give(struct gb_ensemble *ensemble, struct gb_pool *crew, struct queue *queue,
                 struct gb_error *err)
{
    struct gb_ensemble_run *run = NULL;
    while (room(ensemble, crew, queue->waiting) > 0 &&
           (run = next_run(ensemble, queue)) != NULL) {
        const size_t ticket = (size_t)(run - ensemble->run);
        if (!gb_pool_submit(crew, ticket, &run->params, run->directory, err)) {
            return gb_pool_busy(crew) > 0; /* with fewer workers then */
        }
        run->given = true;
        queue->waiting--;
    }
    return true;
}

static void tell(const struct gb_ensemble *ensemble,
                 const struct gb_ensemble_callbacks *watch,
                 const struct gb_ensemble_run *run)
{
    if (watch->told != NULL) {
        watch->told(ensemble, run, watch->data);
    }
}

static void take(struct gb_ensemble *ensemble, struct gb_pool *crew, struct queue *queue,
                 const struct gb_ensemble_callbacks *watch)
{
    struct gb_pool_report report;
    if (!gb_pool_receive(crew, patience_s, &report)) {
        tell(ensemble, watch, NULL);
        return;
    }
    struct gb_ensemble_run *run = &ensemble->run[report.ticket];
    if (report.lost) { /* somebody else may do it */
        run->given = false;
        queue->from = MIN(queue->from, report.ticket);
        queue->waiting++;
        tell(ensemble, watch, NULL);
        return;
    }
    run->ended = true;
    run->error = report.error;
    run->seconds = report.seconds;
    tell(ensemble, watch, run);
}

bool gb_ensemble_work(struct gb_ensemble *ensemble, struct gb_pool *crew,
                      const struct gb_ensemble_callbacks *watch, struct gb_error *err)
{
    struct queue queue = {0};
    bool stopping = false;
    bool good = true;
    for (size_t i = 0; i < ensemble->points * ensemble->replicas; i++) {
        queue.waiting += !ensemble->run[i].ended;
    }
    while (true) {
        if (!stopping && watch->cancelled != NULL && watch->cancelled(watch->data)) {
            stopping = true;
            gb_pool_stop(crew);
        }
        good = good && (stopping || give(ensemble, crew, &queue, err));
        if (gb_pool_busy(crew) == 0) {
            break;
        }
        take(ensemble, crew, &queue, watch);
    }
    return good && (!stopping || gb_error_set(err, GB_ERR_CANCELLED,
                                              "stopped; the same command does what is "
                                              "missing"));
}

size_t gb_ensemble_used(const struct gb_ensemble *ensemble, size_t point)
{
    struct gb_ensemble shorter = *ensemble;
    for (shorter.replicas = 1; shorter.replicas < ensemble->replicas;
         shorter.replicas++) {
        if (is_settled(&shorter, point)) {
            break;
        }
    }
    return shorter.replicas;
}
