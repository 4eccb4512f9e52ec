#include "study/bench/bench_state.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <stdint.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/read_file.h"
#include "io/store.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "run/record/writer.h"

enum { TIMES = 15 };

/* What each repetition took, s. */
struct timing {
    double held[TIMES], processor[TIMES], written[TIMES], disk[TIMES];
    gsize bytes;
};

static double median(double *seconds)
{
    gsl_sort(seconds, 1, TIMES);
    return gsl_stats_median_from_sorted_data(seconds, 1, TIMES);
}

/* The file as it is, put elsewhere: what the disk takes of the time. */
static bool copy_file(const char *directory, double *seconds, gsize *bytes,
                      struct gb_error *err)
{
    char *from = g_build_filename(directory, "state.h5", NULL);
    char *to = g_build_filename(directory, "again.h5", NULL);
    char *data = NULL;
    bool good = gb_read_file(from, SIZE_MAX, &data, bytes, err);
    const double start = gb_clock_s();
    good = good && gb_file_replace(to, data, *bytes, err);
    *seconds = gb_clock_s() - start;
    (void)g_unlink(to);
    gb_alloc_free(data);
    g_free(to);
    g_free(from);
    return good;
}

/* One checkpoint.  Nothing else runs while it is written, so that the processor time is
 * all of the writing thread. */
static bool time_one(struct timing *timing, int k, struct gb_experiment *experiment,
                     const struct gb_store *store, struct gb_writer *writer,
                     struct gb_error *err)
{
    double start = gb_clock_s();
    if (!gb_checkpoint_take(experiment, gb_writer_record(writer), err)) {
        return false;
    }
    timing->held[k] = gb_clock_s() - start;
    start = gb_clock_process_s();
    if (gb_writer_send(writer, err) != GB_WRITER_SENT || !gb_writer_wait(writer, err)) {
        return false;
    }
    timing->processor[k] = gb_clock_process_s() - start;
    timing->written[k] = gb_writer_seconds(writer);
    return copy_file(gb_store_directory(store), &timing->disk[k], &timing->bytes, err);
}

static bool time_all(struct timing *timing, struct gb_experiment *experiment,
                     const struct gb_params *params, const char *folder,
                     struct gb_error *err)
{
    struct gb_store *store = NULL;
    struct gb_writer *writer = NULL;
    bool good = gb_store_create(&store, folder, params, GB_RUNDIR_KEEP, err) &&
                gb_writer_create(&writer, store, params, experiment->model, err);
    /* the first one makes the arrays and is not counted */
    for (int k = -1; good && k < TIMES; k++) {
        good = time_one(timing, k < 0 ? 0 : k, experiment, store, writer, err);
    }
    gb_writer_destroy(writer);
    gb_store_discard(store);
    return good;
}

bool gb_bench_state_run(struct gb_bench_state *bench, const struct gb_params *params,
                        const struct gb_world_copy *copy, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct timing timing = {0};
    GError *failure = NULL;
    char *folder = g_dir_make_tmp("greenbody-bench-XXXXXX", &failure);
    if (folder == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "%s", failure->message);
        g_error_free(failure);
        return false;
    }
    const bool good = gb_experiment_create(&experiment, params, NULL, NULL, err) &&
                      gb_world_copy_restore(experiment->loading->world, copy, err) &&
                      gb_world_evaluate(experiment->loading->world, err) &&
                      time_all(&timing, experiment, params, folder, err);
    if (good) {
        *bench = (struct gb_bench_state){.held = median(timing.held),
                                         .processor = median(timing.processor),
                                         .written = median(timing.written),
                                         .disk = median(timing.disk),
                                         .bytes_per_particle = (double)timing.bytes /
                                                               (double)params->count};
    }
    gb_experiment_destroy(experiment);
    (void)g_rmdir(folder);
    g_free(folder);
    return good;
}
