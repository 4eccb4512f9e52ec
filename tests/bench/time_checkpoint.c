/* Times a checkpoint of a pressed packing: how long the engine is blocked, the processor
 * time of the writing thread, the wall clock until the file stands, and of this the disk.
 * Usage: time_checkpoint [group.key=value]...
 * Writes in a temporary folder (TMPDIR) as a run does. */
#include <stdint.h>

#include <glib.h>
#include <glib/gstdio.h>
#include <gsl/gsl_statistics.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/file.h"
#include "bench.h"
#include "io/store.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "run/record/run_recorder.h"

enum { TIMES = 15 };

/* What each repetition took, s. */
struct timing {
    double held[TIMES], processor[TIMES], written[TIMES], disk[TIMES];
    gsize bytes;
};

static void print_median(const char *name, double *seconds)
{
    print_fact(name, 1e3 * gsl_stats_median(seconds, 1, TIMES), "ms");
}

/* Writes the same bytes to another file: the time of the disk. */
static bool copy_file(const char *directory, double *seconds, gsize *bytes,
                      struct gb_error *err)
{
    char *from = g_build_filename(directory, "state.h5", NULL);
    char *to = g_build_filename(directory, "again.h5", NULL);
    char *data = NULL;
    bool good = gb_file_read(from, SIZE_MAX, &data, bytes, err);
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
    if (!gb_checkpoint_take(experiment, gb_run_recorder_writer_record(writer), err)) {
        return false;
    }
    timing->held[k] = gb_clock_s() - start;
    start = gb_clock_process_s();
    if (gb_run_recorder_writer_send(writer, err) != GB_WRITER_SENT ||
        !gb_run_recorder_writer_wait(writer, err)) {
        return false;
    }
    timing->processor[k] = gb_clock_process_s() - start;
    timing->written[k] = gb_run_recorder_writer_seconds(writer);
    return copy_file(gb_store_directory(store), &timing->disk[k], &timing->bytes, err);
}

static bool time_all(struct timing *timing, struct gb_experiment *experiment,
                     const struct gb_params *params, const char *folder,
                     struct gb_error *err)
{
    struct gb_store *store = NULL;
    struct gb_writer *writer = NULL;
    bool good =
        gb_store_create(&store, folder, params, GB_RUNDIR_KEEP, err) &&
        gb_run_recorder_writer_create(&writer, store, params, experiment->model, err);
    /* the first one allocates the arrays and is not counted */
    for (int k = -1; good && k < TIMES; k++) {
        good = time_one(timing, k < 0 ? 0 : k, experiment, store, writer, err);
    }
    gb_run_recorder_writer_destroy(writer);
    gb_store_discard(store);
    return good;
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_params params;
    struct packing packing = {0};
    struct gb_experiment *experiment = NULL;
    struct timing timing = {0};
    (void)argc;
    g_set_prgname("time_checkpoint");
    char *folder = g_dir_make_tmp("greenbody-bench-XXXXXX", NULL);
    if (folder == NULL) {
        gb_error_set(&err, GB_ERR_MACHINE, "no temporary folder");
        return finish(false, &err);
    }
    const bool good =
        make_scene(&params, argv + 1, &err) && packing_press(&packing, &params, &err) &&
        gb_experiment_create(&experiment, &params, NULL, NULL, &err) &&
        gb_world_copy_restore(experiment->loading->world, packing.copy, &err) &&
        gb_world_evaluate(experiment->loading->world, &err) &&
        time_all(&timing, experiment, &params, folder, &err);
    if (good) {
        print_fact("checkpoint", (double)timing.bytes / (double)params.count,
                   "bytes per particle");
        print_median("engine blocked", timing.held);
        print_median("processor time of the writer", timing.processor);
        print_median("time to write", timing.written);
        print_median("of this the disk", timing.disk);
    }
    gb_experiment_destroy(experiment);
    packing_finish(&packing);
    (void)g_rmdir(folder);
    g_free(folder);
    return finish(good, &err);
}
