#include <string.h>

#include <glib.h>

#include "io/preset.h"
#include "scene/model.h"

/* Pressed from all sides, a cell keeps its shape: it is a square or a cube from the start. */
static void check_dynamic(const struct gb_model *model)
{
    g_assert_cmpfloat_with_epsilon(model->edges[2], model->edges[0],
                                   1e-6 * model->edges[0]);
    g_assert_cmpfloat(model->start_density, <, model->until_density);
    g_assert_cmpfloat(model->dynamics.rate, >, 0.0);
    g_assert_cmpfloat(model->dynamics.time_step, ==, 0.0);
}

/* Usage: test_presets FOLDER: every preset in it must load, pass the checks, freeze into a
 * model and name its source in the first line. */
static void test_preset(gconstpointer data)
{
    const char *path = data;
    struct gb_error err = {0};
    struct gb_preset *preset = NULL;
    struct gb_model model;
    char *text = NULL;
    if (!gb_preset_load(&preset, path, &err) ||
        !gb_params_check(gb_preset_params(preset), &err) ||
        !gb_model_init(&model, gb_preset_params(preset), &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpstr(gb_preset_params(preset)->title, !=, "");
    if (model.kind == GB_KIND_DYNAMIC) {
        check_dynamic(&model);
    }
    char *name = g_path_get_basename(path);
    if (g_str_has_prefix(name, "p2-")) {
        g_assert_cmpfloat(model.slip.mu, ==, 0.5);
    }
    g_free(name);
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    g_assert_true(g_str_has_prefix(text, "# "));
    g_free(text);
    gb_preset_destroy(preset);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    GDir *dir = argc == 2 ? g_dir_open(argv[1], 0, NULL) : NULL;
    g_assert_nonnull(dir);
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    const char *name;
    while ((name = g_dir_read_name(dir)) != NULL) {
        if (!g_str_has_suffix(name, ".ini")) {
            continue; /* tables of sizes */
        }
        char *path = g_build_filename(argv[1], name, NULL);
        char *test = g_strconcat("/presets/", name, NULL);
        g_ptr_array_add(paths, path);
        g_test_add_data_func(test, path, test_preset);
        g_free(test);
    }
    g_dir_close(dir);
    g_assert_cmpuint(paths->len, >, 0);
    const int status = g_test_run();
    g_ptr_array_free(paths, TRUE);
    return status;
}
