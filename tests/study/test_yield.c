/* Yield surfaces on small cells: leg of a direction, same answers for any number of workers,
 * an answer is used again. */
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "common/scene.h"
#include "common/tree.h"
#include "study/compact.h"
#include "study/yield.h"

static char *folder;

static struct gb_params scene(void)
{
    return scene_params("loading.geometry=isotropic", "structure.base=8 d",
                        "particles.count=200", NULL);
}

static void test_leg(void)
{
    char leg[GB_LEG_TEXT];
    struct gb_path path;
    struct gb_error err = {0};
    gb_compact_probe_leg(0.0, 1.0, 0.03, leg, sizeof leg);
    g_assert_true(gb_path_parse(&path, leg, 3, &err));
    g_assert_cmpint(path.leg[0].leading, ==, 2);
    g_assert_cmpfloat_with_epsilon(path.leg[0].component[0].value, -0.5, 1e-9);
    gb_compact_probe_leg(-1.0, -1.0 / 6.0 + 1.0, 0.03, leg, sizeof leg);
    g_assert_true(gb_path_parse(&path, leg, 3, &err));
    g_assert_cmpint(path.leg[0].leading, ==, 0);
    g_assert_cmpfloat(path.leg[0].end[0].value, <, 0.0);
}

static char *study_text(const char *name, int jobs)
{
    struct gb_yield_study study = {0};
    struct gb_yield_options options;
    struct gb_error err = {0};
    const struct gb_params params = scene();
    char *directory = g_build_filename(folder, name, NULL);
    gb_yield_options_init(&options);
    options.marks = (struct gb_keep_points){.count = 1, .point = {{true, 0.5}}};
    options.replicas = 2;
    options.directions = 8;
    if (!gb_yield_run(&study, &params, &options, directory, jobs, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(study.failed, ==, 0);
    const struct gb_yield_surface *surface =
        gb_yield_study_surface(&study, 0, GB_YIELD_OFFSET_CHOSEN);
    g_assert_cmpfloat(surface->quantity[GB_YIELD_CENTRE_P].value, >, 0.0);
    g_assert_cmpfloat(surface->quantity[GB_YIELD_HALF_Q].value, >, 0.0);
    GString *points = gb_yield_points(&study, "");
    g_string_append(points, gb_yield_fit(&study, "")->str);
    gb_yield_finish(&study);
    g_free(directory);
    return g_string_free(points, FALSE);
}

static void test_workers(void)
{
    char *one = study_text("one", 1);
    char *two = study_text("two", 2);
    char *again = study_text("two", 1);
    g_assert_cmpstr(one, ==, two);
    g_assert_cmpstr(one, ==, again);
    g_free(one);
    g_free(two);
    g_free(again);
}

static void test_refused(void)
{
    struct gb_yield_study study = {0};
    struct gb_yield_options options;
    struct gb_error err = {0};
    struct gb_params params = scene();
    gb_yield_options_init(&options);
    options.directions = 10;
    g_assert_false(gb_yield_run(&study, &params, &options, folder, 1, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    gb_yield_finish(&study);
    gb_yield_options_init(&options);
    params.kind = GB_KIND_DYNAMIC;
    g_assert_false(gb_yield_run(&study, &params, &options, folder, 1, NULL, &err));
    g_assert_nonnull(strstr(err.text, "quasistatic"));
    gb_yield_finish(&study);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("greenbody-yield-XXXXXX", NULL);
    g_test_add_func("/yield/leg", test_leg);
    g_test_add_func("/yield/workers", test_workers);
    g_test_add_func("/yield/refused", test_refused);
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
