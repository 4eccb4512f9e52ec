/* Steps of parameters, and completion of paths. */
#include <glib.h>
#include <glib/gstdio.h>

#include "tui/panel/prompt.h"
#include "tui/panel/panels.h"

static void expect(const char *group, const char *key, const char *value, int direction,
                   const char *wanted)
{
    char text[64] = "";
    const struct gb_field *field = gb_params_find(group, key);
    g_assert_nonnull(field);
    const bool stepped = gb_panel_params_next_value(field, value, direction, text, sizeof text);
    if (wanted == NULL) {
        g_assert_false(stepped);
    } else {
        g_assert_true(stepped);
        g_assert_cmpstr(text, ==, wanted);
    }
}

static void test_numbers(void)
{
    expect("contact", "mu", "0.1", 1, "0.11");
    expect("contact", "mu", "0.1", -1, "0.095");
    expect("contact", "mu", "0.3", 1, "0.32");
    expect("contact", "mu", "0", 1, "0.01");
    expect("particles", "diameter", "9.7 nm", 1, "10.2 nm");
    expect("particles", "count", "8000", -1, "7500");
    expect("contact", "bridge_length", "0.008 d", 1, "0.0085 d");
    expect("structure", "seed", "1", 1, "2");
    expect("structure", "seed", "0", -1, "0");
}

static void test_choices(void)
{
    expect("loading", "geometry", "uniaxial", 1, "biaxial");
    expect("scene", "dimension", "3", 1, "2");
    expect("contact", "mu_pivot", "auto", 1, NULL);
    expect("scene", "title", "1 more", 1, NULL);
    expect("loading", "unload_from", "100 MPa; 1 GPa", 1, NULL);
}

/* A step up and one down restore the value, and gb_params_set accepts both. */
static void test_there_and_back(void)
{
    const struct gb_field *mu = gb_params_find("contact", "mu");
    char up[64];
    char back[64];
    for (int i = 5; i < 190; i++) {
        struct gb_params params;
        char value[64];
        gb_params_init(&params);
        g_snprintf(value, sizeof value, "%.2g", 0.01 * i);
        g_assert_true(gb_panel_params_next_value(mu, value, 1, up, sizeof up));
        g_assert_true(gb_panel_params_next_value(mu, up, -1, back, sizeof back));
        g_assert_cmpfloat_with_epsilon(g_ascii_strtod(back, NULL),
                                       g_ascii_strtod(value, NULL), 0.06);
        g_assert_true(gb_params_set(&params, mu, up, NULL));
    }
}

static void touch(const char *folder, const char *name)
{
    char *path = g_build_filename(folder, name, NULL);
    g_assert_true(g_file_set_contents(path, "", 0, NULL));
    g_free(path);
}

static void expect_path(const char *folder, const char *begun, const char *wanted,
                        int fits)
{
    int count = -1;
    char *path = g_strdup_printf("%s/%s", folder, begun);
    char *full = g_strdup_printf("%s/%s", folder, wanted);
    char *done = gb_prompt_complete_path(path, &count);
    g_assert_cmpstr(done, ==, full);
    g_assert_cmpint(count, ==, fits);
    g_free(done);
    g_free(full);
    g_free(path);
}

static void test_paths(void)
{
    char *folder = g_dir_make_tmp("gb-complete-XXXXXX", NULL);
    char *sub = g_build_filename(folder, "sub", NULL);
    g_assert_nonnull(folder);
    touch(folder, "one-a.csv");
    touch(folder, "one-b.csv");
    touch(folder, ".hidden");
    g_assert_cmpint(g_mkdir(sub, 0700), ==, 0);
    expect_path(folder, "o", "one-", 2);
    expect_path(folder, "one-b", "one-b.csv", 1);
    expect_path(folder, "s", "sub/", 1);
    expect_path(folder, "x", "x", 0);
    char *command = g_strdup_printf("rm -r '%s'", folder);
    g_assert_true(g_spawn_command_line_sync(command, NULL, NULL, NULL, NULL));
    g_free(command);
    g_free(sub);
    g_free(folder);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/value_step/numbers", test_numbers);
    g_test_add_func("/tui/value_step/choices", test_choices);
    g_test_add_func("/tui/value_step/there-and-back", test_there_and_back);
    g_test_add_func("/tui/complete/paths", test_paths);
    return g_test_run();
}
