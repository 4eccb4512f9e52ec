#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "io/run_list.h"
#include "io/rundir.h"

/* Deleting the directory of a run. */

static char *base; /* a folder of its own for each test */

static char *make_run(const char *name)
{
    char *directory = g_build_filename(base, name, NULL);
    char *preset = g_build_filename(directory, "preset.ini", NULL);
    char *states = g_build_filename(directory, "snapshots", NULL);
    char *state = g_build_filename(states, "1.h5", NULL);
    g_assert_cmpint(g_mkdir_with_parents(states, 0700), ==, 0);
    g_assert_true(g_file_set_contents(preset, "[scene]\n", -1, NULL));
    g_assert_true(g_file_set_contents(state, "x", -1, NULL));
    g_free(state);
    g_free(states);
    g_free(preset);
    return directory;
}

static void test_tree(void)
{
    struct gb_error err = {0};
    char *directory = make_run("past");
    g_assert_cmpint(gb_run_list_count_files(directory), ==, 2);
    g_assert_true(gb_run_list_delete(directory, &err));
    g_assert_false(g_file_test(directory, G_FILE_TEST_EXISTS));
    g_free(directory);
}

/* What a link points to stays. */
static void test_links(void)
{
    struct gb_error err = {0};
    char *directory = make_run("links");
    char *kept = g_build_filename(base, "kept", NULL);
    char *precious = g_build_filename(kept, "precious", NULL);
    char *link = g_build_filename(directory, "folder", NULL);
    g_assert_cmpint(g_mkdir(kept, 0700), ==, 0);
    g_assert_true(g_file_set_contents(precious, "x", -1, NULL));
    g_assert_cmpint(symlink(kept, link), ==, 0);
    g_assert_true(gb_run_list_delete(directory, &err));
    g_assert_false(g_file_test(directory, G_FILE_TEST_EXISTS));
    g_assert_true(g_file_test(precious, G_FILE_TEST_EXISTS));
    g_assert_cmpint(g_remove(precious), ==, 0);
    g_assert_cmpint(g_rmdir(kept), ==, 0);
    g_free(link);
    g_free(precious);
    g_free(kept);
    g_free(directory);
}

static void test_refused(void)
{
    struct gb_error err = {0};
    struct gb_rundir engine;
    char *directory = make_run("live");
    g_assert_true(gb_rundir_open(&engine, directory, &err));
    g_assert_false(gb_run_list_delete(directory, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_cmpint(gb_run_list_count_files(directory), ==, 2);
    gb_rundir_finish(&engine);
    err = (struct gb_error){0};
    g_assert_false(gb_run_list_delete(base, &err)); /* no run directory */
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_cmpint(gb_run_list_count_files(directory), ==, 2);
    err = (struct gb_error){0};
    g_assert_true(gb_run_list_delete(directory, &err));
    g_free(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    base = g_dir_make_tmp("greenbody-delete-XXXXXX", NULL);
    g_assert_nonnull(base);
    g_test_add_func("/io/run-delete/tree", test_tree);
    g_test_add_func("/io/run-delete/links", test_links);
    g_test_add_func("/io/run-delete/refused", test_refused);
    const int status = g_test_run();
    g_rmdir(base);
    g_free(base);
    return status;
}
