#include "greenbody/recorded_run.h"

#include <string.h>

#include <glib.h>

#include "api/arguments.h"
#include "api/parameters_private.h"
#include "base/alloc.h"
#include "hdf/hdf_record.h"
#include "io/curve_csv.h"
#include "io/follow.h"
#include "io/status_json.h"
#include "run/checkpoint.h"

struct gb_recorded_run {
    struct gb_params params;
    struct gb_curve *curve;
    struct gb_snapshot snapshot;
    GPtrArray *packings; /* paths */
};

/* A kept state and the step at which it was written. */
struct kept {
    char *path;
    int64_t step;
};

static int by_step(const void *a, const void *b)
{
    const struct kept *first = a, *second = b;
    const int order = (first->step > second->step) - (first->step < second->step);
    return order ? order : strcmp(first->path, second->path);
}

/* Step of a state; -1 for a file that cannot be read, so that it sorts first. */
static int64_t step_of(const char *path)
{
    int64_t step = -1;
    struct gb_record *record = gb_alloc_array(1, sizeof *record, NULL);
    if (record && gb_hdf_record_read(record, path, NULL)) {
        step = gb_checkpoint_step(record);
    }
    if (record) {
        gb_record_finish(record);
    }
    gb_alloc_free(record);
    return step;
}

static void find_kept(const char *directory, GPtrArray *packings)
{
    char *folder = g_build_filename(directory, "snapshots", NULL);
    GDir *dir = g_dir_open(folder, 0, NULL);
    GArray *all = g_array_new(FALSE, FALSE, sizeof(struct kept));
    const char *name;
    while (dir && (name = g_dir_read_name(dir)) != NULL) {
        if (g_str_has_suffix(name, ".h5")) {
            struct kept kept = {.path = g_build_filename(folder, name, NULL)};
            kept.step = step_of(kept.path);
            g_array_append_val(all, kept);
        }
    }
    g_array_sort(all, by_step);
    for (guint i = 0; i < all->len; i++) {
        g_ptr_array_add(packings, g_array_index(all, struct kept, i).path);
    }
    g_array_free(all, TRUE);
    if (dir) {
        g_dir_close(dir);
    }
    g_free(folder);
}

static void find_packings(struct gb_recorded_run *run, const char *directory)
{
    run->packings = g_ptr_array_new_with_free_func(g_free);
    find_kept(directory, run->packings);
    char *last = g_build_filename(directory, "state.h5", NULL);
    if (g_file_test(last, G_FILE_TEST_EXISTS)) {
        g_ptr_array_add(run->packings, last);
    } else {
        g_free(last);
    }
}

bool gb_recorded_run_open(struct gb_recorded_run **out, const char *directory,
                          struct gb_error *err)
{
    struct gb_follow_engine engine;
    if (!gb_arguments_given(out, "out", err) ||
        !gb_arguments_given(directory, "directory", err)) {
        return false;
    }
    struct gb_recorded_run *run = gb_alloc_array(1, sizeof *run, err);
    if (!run) {
        return false;
    }
    if (!gb_follow_params(directory, &run->params, err) ||
        !gb_curve_create(&run->curve, err) ||
        !gb_curve_csv_read(directory, &run->params, run->curve, err) ||
        !gb_follow_status(directory, &run->snapshot, &engine, err)) {
        gb_recorded_run_destroy(run);
        return false;
    }
    find_packings(run, directory);
    *out = run;
    return true;
}

void gb_recorded_run_destroy(struct gb_recorded_run *run)
{
    if (!run) {
        return;
    }
    gb_curve_destroy(run->curve);
    if (run->packings) {
        g_ptr_array_free(run->packings, TRUE);
    }
    gb_alloc_free(run);
}

const char *gb_recorded_run_state(const struct gb_recorded_run *run)
{
    return run ? gb_status_json_word(run->snapshot.state) : NULL;
}

const char *gb_recorded_run_reason(const struct gb_recorded_run *run)
{
    return run ? run->snapshot.error.text : NULL;
}

size_t gb_recorded_run_points(const struct gb_recorded_run *run)
{
    return run ? gb_curve_count(run->curve) : 0;
}

const struct gb_point *gb_recorded_run_point(const struct gb_recorded_run *run,
                                             size_t index)
{
    return index < gb_recorded_run_points(run) ? gb_curve_at(run->curve, index) : NULL;
}

bool gb_recorded_run_parameters(const struct gb_recorded_run *run,
                                struct gb_parameters **out, struct gb_error *err)
{
    return gb_arguments_given(run, "run", err) && gb_arguments_given(out, "out", err) &&
           gb_parameters_wrap(out, &run->params, err);
}

const char *gb_recorded_run_saved(const struct gb_recorded_run *run, size_t index)
{
    return run && index < run->packings->len ? g_ptr_array_index(run->packings, index)
                                             : NULL;
}
