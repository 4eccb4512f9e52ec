#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "io/material.h"
#include "io/preset.h"
#include "io/preset_folders.h"
#include "scene/model.h"

/* Another folder of presets for materials of our own. */
static char *own;

static char *write_own(const char *name, const char *text)
{
    char *path = g_build_filename(own, name, NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    return path;
}

static bool is_material_field(const struct gb_field *field)
{
    return strcmp(field->group, GB_MATERIAL_GROUP) == 0;
}

/* With each scene the material gives parameters that are accepted and a model. */
static void check_model(const char *name, const char *scene)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    struct gb_model model;
    if (!gb_preset_load(&preset, scene, &err) ||
        !gb_material_apply(gb_preset_params(preset), name, &err) ||
        !gb_params_check(gb_preset_params(preset), &err) ||
        !gb_model_init(&model, gb_preset_params(preset), &err)) {
        g_error("%s, %s: %s", name, scene, err.text);
    }
    gb_preset_destroy(preset);
}

/* Each number follows a comment, its source, and the essential keys are there. */
static void check_sources(const char *name)
{
    char *path = gb_preset_folders_find_material(name), *text = NULL;
    bool told = false;
    int keys = 0;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    char **line = g_strsplit(text, "\n", -1);
    for (int i = 0; line[i] != NULL; i++) {
        const bool value = strchr(line[i], '=') != NULL && line[i][0] != '#';
        if (value && !g_str_has_prefix(line[i], "name =")) {
            g_test_message("%s:%d: %s", path, i + 1, line[i]);
            g_assert_true(told);
            keys++;
        }
        told = line[i][0] == '#' && strlen(line[i]) > 8;
    }
    g_assert_cmpint(keys, >=, 8);
    g_strfreev(line);
    g_free(text);
    g_free(path);
}

static void test_shipped(gconstpointer data)
{
    static const char *const scenes[] = {"default", "p2-v1", "p3-storakers-m0.1-mu0",
                                         "p3-pair"};
    for (size_t i = 0; i < G_N_ELEMENTS(scenes); i++) {
        check_model(data, scenes[i]);
    }
    check_sources(data);
}

/* The attraction at contact of P1 II.B: f_a(d) = pi gamma d, so that epsilon = 6 gamma (0.24
 * d0)^2/pi; gammas of solids lie between those of polymers and of hard metals. */
static void test_surface_energy(gconstpointer data)
{
    struct gb_params params;
    gb_params_init(&params);
    g_assert_true(gb_material_apply(&params, data, NULL));
    const double gap = 0.24 * params.d0_m;
    const double gamma = G_PI * params.epsilon_j / (6.0 * gap * gap);
    g_test_message("%s: gamma %g J/m2", (const char *)data, gamma);
    g_assert_cmpfloat(gamma, >, 0.03);
    g_assert_cmpfloat(gamma, <, 2.5);
}

/* The alumina of P1 stays the alumina of the presets. */
static void test_alumina(void)
{
    struct gb_preset *preset = NULL;
    g_assert_true(gb_preset_load(&preset, "p1-set1-uniaxial", NULL));
    struct gb_params params = *gb_preset_params(preset);
    g_assert_true(gb_material_apply(&params, "alumina", NULL));
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        char now[GB_PARAMS_VALUE_MAX], then[GB_PARAMS_VALUE_MAX];
        gb_params_format(&params, &field[i], now, sizeof now);
        gb_params_format(gb_preset_params(preset), &field[i], then, sizeof then);
        if (strcmp(field[i].key, "yield") != 0) {
            g_assert_cmpstr(now, ==, then);
        }
    }
    gb_preset_destroy(preset);
}

static void guessed(const char *name, const char *keys)
{
    char *path = gb_material_path(name, NULL);
    char *found = gb_material_guessed(path);
    g_assert_cmpstr(found, ==, keys);
    g_free(found);
    g_free(path);
}

static void test_guessed(void)
{
    guessed("alumina", "yield, hardening");
    guessed("copper", "");
    guessed("NiAl", "epsilon");
    char *path =
        write_own("guess.ini", "[material]\n# 5 (guessed)\n# of another\n\n"
                               "young = 1 Pa\n# (guessed)\n poisson=0\nd0 = 1 nm\n");
    guessed(path, "poisson");
    g_assert_cmpint(g_remove(path), ==, 0);
    g_free(path);
}

/* All of [material] changes, also what the file leaves out; nothing else does. */
static void test_keys(void)
{
    struct gb_params params, before, initial;
    gb_params_init(&initial);
    gb_params_init(&params);
    g_assert_true(gb_params_assign(&params, "contact.mu=0.3", NULL));
    g_assert_true(gb_params_assign(&params, "material.young_j=5 GPa", NULL));
    g_assert_true(gb_params_assign(&params, "material.hollomon=2 GPa", NULL));
    before = params;
    g_assert_true(gb_material_assign(&params, " material = yttria ", NULL));
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        char now[GB_PARAMS_VALUE_MAX], then[GB_PARAMS_VALUE_MAX];
        gb_params_format(&params, &field[i], now, sizeof now);
        gb_params_format(&before, &field[i], then, sizeof then);
        if (!is_material_field(&field[i])) {
            g_assert_cmpstr(now, ==, then);
        }
    }
    g_assert_cmpstr(params.material, ==, "yttria");
    g_assert_cmpfloat(params.young_pa, ==, 179.8e9);
    g_assert_true(params.young_j_pa != params.young_j_pa); /* auto */
    g_assert_true(params.hollomon_pa != params.hollomon_pa);
    g_assert_true(gb_material_assign(&params, "young=5 GPa", NULL));
    g_assert_cmpfloat(params.young_pa, ==, 5e9);
    g_assert_cmpfloat(params.density_kg_m3, ==, 5020.0);
    g_assert_true(gb_material_assign(&params, "material=YTTRIA", NULL));
    g_assert_cmpfloat(params.young_pa, ==, 179.8e9);
}

static const char whole[] = "[material]\nname = glass\nyoung = 70 GPa\npoisson = 0.22\n"
                            "density = 2500 kg/m3\nd0 = 0.4 nm\nn_d0_cubed = 1.4\n"
                            "epsilon = 500 kB\n";

static void refuse(const char *assignment, const char *first, const char *second)
{
    struct gb_params params, before;
    struct gb_error err = {0};
    gb_params_init(&params);
    before = params;
    g_assert_false(gb_material_assign(&params, assignment, &err));
    g_test_message("%s", err.text);
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, first));
    g_assert_nonnull(strstr(err.text, second));
    g_assert_null(strchr(err.text, '\n'));
    g_assert_cmpint(memcmp(&params, &before, sizeof params), ==, 0);
}

static void refuse_file(const char *text, const char *first, const char *second)
{
    char *path = write_own("wrong.ini", text);
    char *assignment = g_strconcat("material=", path, NULL);
    refuse(assignment, first, second);
    g_assert_cmpint(g_remove(path), ==, 0);
    g_free(assignment);
    g_free(path);
}

static void test_refused(void)
{
    refuse("material=yttira", "material=yttira: no such material",
           "NiAl, alumina, copper");
    refuse("material=", "material=: no such material", "yttria");
    refuse("material=../materials/nothing.ini", "nothing.ini", "No such file");
    refuse("material=default", "no such material", "zirconia");
    refuse("material", "missing \"=value\"", "group.key=value");
    char *text = g_strconcat(whole, "[contact]\nmu = 0.3\n", NULL);
    refuse_file(text, "wrong.ini: [contact]", "[material] only");
    g_free(text);
    refuse_file("[material]\nname = glass\nyoung = 70 GPa\n",
                "wrong.ini: no material.poisson", "needs name, young, poisson");
    text = g_strconcat(whole, "hardness = 5 GPa\n", NULL);
    refuse_file(text, "wrong.ini:9: ", "hardness");
    g_free(text);
    refuse_file("[material]\nyoung = 70\n", "wrong.ini:2: material.young", "GPa");
    refuse_file("", "no material.name", "epsilon");
}

/* A folder materials/ of the user's own comes first, a path needs no folder. */
static void test_own(void)
{
    struct gb_params params;
    gb_params_init(&params);
    char *folder = g_build_filename(g_get_user_config_dir(), "greenbody", "presets",
                                    "materials", NULL);
    char *file = g_build_filename(folder, "yttria.ini", NULL);
    char *path = write_own("glass.ini", whole);
    g_assert_cmpint(g_mkdir_with_parents(folder, 0700), ==, 0);
    g_assert_true(g_file_set_contents(file, whole, -1, NULL));
    g_assert_true(gb_material_apply(&params, "yttria", NULL));
    g_assert_cmpstr(params.material, ==, "glass");
    g_assert_cmpint(g_remove(file), ==, 0);
    g_assert_true(gb_material_apply(&params, "yttria", NULL));
    g_assert_cmpstr(params.material, ==, "yttria");
    g_assert_true(gb_material_apply(&params, path, NULL));
    g_assert_cmpstr(params.material, ==, "glass");
    g_assert_cmpint(g_remove(path), ==, 0);
    for (int i = 0; i < 3; i++) {
        char *above = g_path_get_dirname(folder);
        g_assert_cmpint(g_rmdir(folder), ==, 0);
        g_free(folder);
        folder = above;
    }
    g_free(folder);
    g_free(file);
    g_free(path);
}

/* Materials are no presets. */
static void test_lists(void)
{
    static const char *const shipped[] = {
        "alumina",       "yttria", "zirconia",
        "titania",       "NiAl",   "nickel",
        "iron",          "copper", "microcrystalline-cellulose",
        "polymer-binder"};
    char **materials = gb_preset_folders_list_materials();
    char **presets = gb_preset_folders_list();
    for (size_t i = 0; i < G_N_ELEMENTS(shipped); i++) {
        g_assert_true(g_strv_contains((const char *const *)materials, shipped[i]));
        g_assert_false(g_strv_contains((const char *const *)presets, shipped[i]));
    }
    g_strfreev(presets);
    g_strfreev(materials);
}

/* A title follows where it names the material. */
static void test_title(void)
{
    static const char *const titles[][2] = {
        {"alumina 10 nm, set II", "yttria 10 nm, set II"},
        {"Alumina", "yttria"},
        {"set I (alumina)", "set I (yttria)"},
        {"aluminates", "aluminates"},
        {"P3 die cycle", "P3 die cycle"},
        {"", ""},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(titles); i++) {
        struct gb_params params;
        struct gb_error err = {0};
        gb_params_init(&params);
        g_strlcpy(params.title, titles[i][0], sizeof params.title);
        g_assert_true(gb_material_apply(&params, "yttria", &err));
        g_assert_cmpstr(params.title, ==, titles[i][1]);
    }
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    memset(params.title, 'x', sizeof params.title - 1); /* no room for the longer name */
    memcpy(params.title, "alumina ", 8);
    params.title[sizeof params.title - 1] = '\0';
    g_assert_true(gb_material_apply(&params, "microcrystalline-cellulose", &err));
    g_assert_true(g_str_has_prefix(params.title, "alumina "));
}

int main(int argc, char **argv)
{
    own = g_dir_make_tmp("greenbody-XXXXXX", NULL);
    g_assert_nonnull(own);
    g_setenv("XDG_CONFIG_HOME", own, TRUE); /* before GLib looks at it */
    g_setenv("GB_PRESET_DIR", GB_TEST_PRESETS, TRUE);
    g_test_init(&argc, &argv, NULL);
    char **names = gb_preset_folders_list_materials();
    for (int i = 0; names[i] != NULL; i++) {
        char *model = g_strconcat("/material/model/", names[i], NULL);
        char *energy = g_strconcat("/material/surface-energy/", names[i], NULL);
        g_test_add_data_func(model, names[i], test_shipped);
        g_test_add_data_func(energy, names[i], test_surface_energy);
        g_free(energy);
        g_free(model);
    }
    g_test_add_func("/material/lists", test_lists);
    g_test_add_func("/material/alumina", test_alumina);
    g_test_add_func("/material/guessed", test_guessed);
    g_test_add_func("/material/keys", test_keys);
    g_test_add_func("/material/refused", test_refused);
    g_test_add_func("/material/own", test_own);
    g_test_add_func("/material/title", test_title);
    const int status = g_test_run();
    g_strfreev(names);
    g_rmdir(own);
    g_free(own);
    return status;
}
