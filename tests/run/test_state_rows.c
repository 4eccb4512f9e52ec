/* A state that is written row by row from its record has the bytes of one that is whole in
 * memory, in either precision, of one size and of many, at rest and in motion. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "common/scene.h"
#include "io/state_record.h"
#include "run/checkpoint.h"
#include "run/experiment.h"

static void take_third(const struct gb_params *params, struct gb_record *record)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    for (int points = 0; points < 3;) {
        const enum gb_step_outcome how = gb_experiment_advance(experiment, 1000, &err);
        g_assert_true(how == GB_STEP_MORE || how == GB_STEP_POINT);
        points += how == GB_STEP_POINT;
    }
    if (!gb_checkpoint_take(experiment, record, &err)) {
        g_error("%s", err.text);
    }
    gb_experiment_destroy(experiment);
}

/* The items with every contact `times` times, so that one array takes many slabs. */
static void repeat(struct gb_record *to, const struct gb_record *from, int times)
{
    const int64_t pairs = gb_record_find(from, "world/pair")->rows;
    for (int k = 0; k < from->count; k++) {
        const struct gb_record_item *item = &from->item[k];
        const bool of_pairs = strcmp(item->name, "world/pair") == 0 ||
                              strcmp(item->name, "world/history") == 0 ||
                              strcmp(item->name, "world/pair_force") == 0;
        const int64_t rows = of_pairs ? times * item->rows : item->rows;
        const size_t bytes = gb_record_bytes(item);
        g_assert_true(!of_pairs || item->rows == pairs);
        struct gb_record_item *copy =
            item->f32
                ? gb_record_add_f32(to, item->name, rows, item->columns, item->unit, NULL)
                : gb_record_add(to, item->name, item->type, rows, item->columns,
                                item->unit, NULL);
        for (int n = 0; n < (of_pairs ? times : 1) && bytes > 0; n++) {
            memcpy((char *)copy->data + (size_t)n * bytes, item->data, bytes);
        }
    }
}

/* Without a checkpoint, whose groups have the time in the file. */
static GBytes *written(const struct gb_state *state, const char *path)
{
    struct gb_error err = {0};
    char *data = NULL;
    gsize size = 0;
    if (!gb_state_write(state, NULL, path, &err)) {
        g_error("%s", err.text);
    }
    g_assert_true(g_file_get_contents(path, &data, &size, NULL));
    g_unlink(path);
    return g_bytes_new_take(data, size);
}

static void compare(const struct gb_params *params, const struct gb_record *record)
{
    const struct gb_model model = scene_model(params);
    struct gb_state *whole = NULL, *rows = NULL;
    struct gb_error err = {0};
    char *folder = g_dir_make_tmp("state-rows-XXXXXX", NULL);
    char *path = g_build_filename(folder, "state.h5", NULL);
    if (!gb_state_record(&whole, record, params, &model, &err) ||
        !gb_state_record_to_write(&rows, record, params, &model, &err)) {
        g_error("%s", err.text);
    }
    g_assert_nonnull(whole->pair_force);
    g_assert_null(rows->pair_force); /* it is made of the record */
    GBytes *one = written(whole, path), *other = written(rows, path);
    g_assert_true(g_bytes_equal(one, other));
    g_bytes_unref(one);
    g_bytes_unref(other);
    gb_state_destroy(whole);
    gb_state_destroy(rows);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void check(struct gb_params params, int times)
{
    struct gb_record record = {0}, more = {0};
    take_third(&params, &record);
    compare(&params, &record);
    repeat(&more, &record, times);
    compare(&params, &more);
    gb_record_finish(&record);
    gb_record_finish(&more);
}

static void test_single(void)
{
    check(scene_params("numerics.precision=single", NULL), 500);
}

static void test_double(void)
{
    check(scene_params("numerics.precision=double", NULL), 500);
}

static void test_sizes(void)
{
    check(scene_params("particles.distribution=lognormal", "particles.sigma=0.25",
                       "particles.largest=20 nm", NULL),
          500);
}

static void test_motion(void)
{
    check(scene_params("scene.kind=dynamic", "particles.distribution=lognormal",
                       "particles.sigma=0.25", "particles.largest=20 nm",
                       "loading.geometry=biaxial", "loading.rate=6.8e9 1/s",
                       "loading.relax=0.004 ns", "loading.hold=0.004 ns",
                       "loading.record_time=0.001 ns", "loading.until=density = 0.28",
                       NULL),
          500);
}

/* Without an item that the rows are made of there is no state. */
static void test_missing(void)
{
    static const char *const items[] = {"world/pair", "world/history",
                                        "world/pair_force"};
    const struct gb_params params = scene_params(NULL, NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_record record = {0};
    take_third(&params, &record);
    for (size_t k = 0; k < G_N_ELEMENTS(items); k++) {
        struct gb_state *state = NULL;
        struct gb_error err = {0};
        for (int i = 0; i < record.count; i++) {
            if (strcmp(record.item[i].name, items[k]) == 0) {
                record.item[i].name[0] = 'W';
                g_assert_false(
                    gb_state_record_to_write(&state, &record, &params, &model, &err));
                g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
                g_assert_nonnull(strstr(err.text, items[k]));
                record.item[i].name[0] = 'w';
                break;
            }
            g_assert_cmpint(i + 1, <, record.count);
        }
    }
    gb_record_finish(&record);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/state rows/single", test_single);
    g_test_add_func("/state rows/double", test_double);
    g_test_add_func("/state rows/sizes", test_sizes);
    g_test_add_func("/state rows/motion", test_motion);
    g_test_add_func("/state rows/missing", test_missing);
    return g_test_run();
}
