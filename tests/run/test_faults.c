/* The k-th write and the k-th allocation fail, for every k until the run passes: one
 * clear line, nothing half written, and what was kept goes on to the undisturbed end. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "common/scene.h"
#include "run/checkpoint.h"
#include "run/hdf_record.h"
#include "run/keep.h"
#include "run/solo.h"

struct place {
    char *folder, *directory, *state, *curve;
};

static struct place place_make(const char *name)
{
    struct place place;
    place.folder = g_dir_make_tmp("greenbody-faults-XXXXXX", NULL);
    g_assert_nonnull(place.folder);
    place.directory = g_build_filename(place.folder, name, NULL);
    place.state = g_build_filename(place.directory, "state.h5", NULL);
    place.curve = g_build_filename(place.directory, "curve.csv", NULL);
    return place;
}

static void place_clear(const struct place *place)
{
    GDir *dir = g_dir_open(place->directory, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *path = g_build_filename(place->directory, name, NULL);
        g_unlink(path);
        g_free(path);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_rmdir(place->directory);
}

static void place_finish(struct place *place)
{
    place_clear(place);
    g_assert_cmpint(g_rmdir(place->folder), ==, 0);
    g_free(place->folder);
    g_free(place->directory);
    g_free(place->state);
    g_free(place->curve);
}

static struct gb_params scene(void)
{
    return scene_params("particles.count=60", "structure.base=5.5 d",
                        "loading.until=8 MPa", "loading.unload_from=3 MPa",
                        "loading.step=0.6 %", "numerics.tolerance=1e-2",
                        "output.checkpoint_every=0.1 s", "numerics.threads=1", NULL);
}

/* The rows without the last column, which is of the clock. */
static char *rows_of(const struct place *place)
{
    char *text = NULL;
    g_assert_true(g_file_get_contents(place->curve, &text, NULL, NULL));
    char **lines = g_strsplit(text, "\n", -1);
    for (int i = 0; lines[i] != NULL; i++) {
        char *comma = lines[i][0] == '#' ? NULL : strrchr(lines[i], ',');
        if (comma != NULL) {
            *comma = '\0';
        }
    }
    char *joined = g_strjoinv("\n", lines);
    g_strfreev(lines);
    g_free(text);
    return joined;
}

/* What there is, is whole: rows end with a line, a state can be read. */
static void check_whole(const struct place *place)
{
    char *text = NULL;
    gsize size = 0;
    if (g_file_get_contents(place->curve, &text, &size, NULL)) {
        g_assert_true(size == 0 || text[size - 1] == '\n');
        g_free(text);
    }
    if (g_file_test(place->state, G_FILE_TEST_EXISTS)) {
        struct gb_record record = {0};
        struct gb_error err = {0};
        if (!gb_hdf_record_read(&record, place->state, &err)) {
            g_error("%s", err.text);
        }
        gb_record_finish(&record);
    }
}

/* Goes on with what was kept, to the end. */
static void finish_run(const struct place *place)
{
    struct gb_keep *keep = NULL;
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    struct gb_snapshot shot = {0};
    if (!gb_keep_resume(&keep, &experiment, place->directory, &err)) {
        g_error("%s", err.text);
    }
    if (experiment == NULL &&
        !gb_experiment_create(&experiment, gb_keep_params(keep), NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    enum gb_advance how = GB_ADVANCE_MORE;
    while (how == GB_ADVANCE_MORE || how == GB_ADVANCE_POINT) {
        char text[640];
        how = gb_experiment_advance(experiment, 1000, &err);
        while (gb_experiment_event(experiment, text, sizeof text)) {
            g_assert_true(gb_keep_event(keep, 0, text, &err));
        }
        if (how == GB_ADVANCE_POINT) {
            g_assert_true(
                gb_keep_point(keep, experiment, gb_experiment_point(experiment), &err));
        }
    }
    g_assert_cmpint(how, ==, GB_ADVANCE_DONE);
    g_assert_true(gb_keep_conclude(keep, &shot, &err));
    gb_keep_destroy(keep);
    gb_experiment_destroy(experiment);
}

static void check_line(const struct gb_error *err, enum gb_status code)
{
    g_assert_cmpint(err->code, ==, code);
    g_assert_cmpstr(err->text, !=, "");
    g_assert_null(strchr(err->text, '\n'));
}

static void test_writes(void)
{
    const struct gb_params params = scene();
    struct place place = place_make("run");
    struct gb_error err = {0};
    g_assert_true(gb_solo_run(&params, place.directory, NULL, NULL, &err));
    char *whole = rows_of(&place);
    bool done = false;
    long k = 1;
    for (; !done; k++) {
        place_clear(&place);
        err = (struct gb_error){0};
        gb_file_fail_after(k);
        done = gb_solo_run(&params, place.directory, NULL, NULL, &err);
        gb_file_fail_after(0);
        if (done) {
            break;
        }
        check_line(&err, GB_ERR_MACHINE);
        g_assert_nonnull(strstr(err.text, place.directory));
        check_whole(&place);
        if (g_file_test(place.directory, G_FILE_TEST_IS_DIR)) {
            finish_run(&place);
            char *rows = rows_of(&place);
            g_assert_cmpstr(rows, ==, whole);
            g_free(rows);
        }
    }
    g_assert_cmpint(k, >, 20);
    g_free(whole);
    place_finish(&place);
}

static void test_memory(void)
{
    const struct gb_params params = scene();
    struct place place = place_make("run");
    bool done = false;
    long k = 1, tried = 0;
    /* every one of the first, which make all there is; then ever wider steps */
    for (; !done; k += k > 150 ? k / 20 : 1, tried++) {
        struct gb_error err = {0};
        const size_t before = gb_alloc_bytes();
        place_clear(&place);
        gb_alloc_fail_after(k);
        done = gb_solo_run(&params, place.directory, NULL, NULL, &err);
        gb_alloc_fail_after(0);
        if (!done) {
            check_line(&err, GB_ERR_MEMORY);
        }
        check_whole(&place);
        g_assert_cmpuint(gb_alloc_bytes(), ==, before);
    }
    g_assert_cmpint(tried, >, 60);
    place_finish(&place);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/faults/writes", test_writes);
    g_test_add_func("/faults/memory", test_memory);
    return g_test_run();
}
