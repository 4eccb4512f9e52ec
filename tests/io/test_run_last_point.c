#include <glib.h>
#include <glib/gstdio.h>

#include "io/run_list.h"

/* The last row of a curve, from the ends of its file. */

static char *folder;

static void write_curve(const char *text)
{
    char *path = g_build_filename(folder, "curve.csv", NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    g_free(path);
}

static const char head[] =
    "# greenbody\n# comment, with commas\nbranch,step,density,p_MPa\n";

static void check(const char *rows, double density, double pressure_pa)
{
    double a = 0.0, b = 0.0;
    char *text = g_strconcat(head, rows, NULL);
    write_curve(text);
    g_assert_true(gb_run_list_last_point(folder, &a, &b));
    g_assert_cmpfloat(a, ==, density);
    g_assert_cmpfloat_with_epsilon(b, pressure_pa, 1e-6);
    g_free(text);
}

static void refuse(const char *text)
{
    double a = 0.25, b = 0.5;
    write_curve(text);
    g_assert_false(gb_run_list_last_point(folder, &a, &b));
}

static void test_rows(void)
{
    check("load,1,0.25,1.5\n", 0.25, 1.5e6);
    check("load,1,0.25,1.5\nload,2,0.3,-2e-3\n", 0.3, -2e3);
    check("load,1,0.25,1.5\nload,2,0.3", 0.25, 1.5e6); /* one is being written */
    refuse(head);
    refuse("");
    refuse("# comment");
    refuse("branch,step,density\nload,1,0.25\n");
    refuse("branch,step,density,p_MPa\nload,1,0.25\n");
    refuse("branch,step,density,p_MPa\nload,1,x,1\n");
}

/* However long the file is. */
static void test_long(void)
{
    GString *rows = g_string_new(NULL);
    for (int i = 0; i < 20000; i++) {
        g_string_append_printf(rows, "load,%d,0.%05d,%d\n", i, i, i);
    }
    check(rows->str, 0.19999, 19999e6);
    g_string_free(rows, TRUE);
}

static void test_absent(void)
{
    double a = 0.0, b = 0.0;
    g_assert_false(gb_run_list_last_point("/nowhere", &a, &b));
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("greenbody-XXXXXX", NULL);
    g_assert_nonnull(folder);
    g_test_add_func("/run_last_point/rows", test_rows);
    g_test_add_func("/run_last_point/long", test_long);
    g_test_add_func("/run_last_point/absent", test_absent);
    const int status = g_test_run();
    char *path = g_build_filename(folder, "curve.csv", NULL);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return status;
}
