#include <glib.h>
#include <math.h>

#include "common/scene.h"
#include "solve/loading/loading_quasistatic.h"

/* A made-up powder: pressure follows density, unloading is ten times stiffer. */
struct powder {
    double density, pressure, top_density, top_pressure;
};

static void follow(struct powder *powder, const double factor[3], bool unloading)
{
    powder->density /= factor[0] * factor[1] * factor[2];
    if (unloading) {
        powder->pressure =
            powder->top_pressure - 0.3 * (powder->top_density - powder->density);
    } else {
        powder->pressure = 0.03 * (powder->density - 0.24);
    }
}

struct outcome {
    int loads, unloads, restores;
    double end_density, end_pressure, unloaded_pressure[4];
};

static struct outcome run(const struct gb_model *model)
{
    struct gb_quasistatic load;
    struct powder powder = {.density = 0.24};
    struct outcome out = {0};
    double factor[3];
    gb_loading_quasistatic_init(&load, model);
    for (int i = 0; i < 100000; i++) {
        const double p[3] = {powder.pressure, powder.pressure, powder.pressure};
        switch (gb_loading_quasistatic_next(&load, p, powder.density, factor)) {
        case GB_QUASISTATIC_END:
            out.end_density = powder.density;
            out.end_pressure = powder.pressure;
            return out;
        case GB_QUASISTATIC_RESTORE:
            out.unloaded_pressure[out.restores++] = powder.pressure;
            powder.density = powder.top_density;
            powder.pressure = powder.top_pressure;
            break;
        case GB_QUASISTATIC_UNLOAD:
            powder.top_density = powder.density;
            powder.top_pressure = powder.pressure;
            out.unloads++;
            follow(&powder, factor, true);
            break;
        case GB_QUASISTATIC_STRAIN:
            out.loads += load.branch == 0;
            follow(&powder, factor, load.branch > 0);
            break;
        }
    }
    g_error("the schedule does not end");
}

static void test_unloading(void)
{
    const struct gb_params params =
        scene_params("loading.until=1 GPa", "loading.unload_from=200 MPa; 1 GPa", NULL);
    const struct gb_model model = scene_model(&params);
    const struct outcome out = run(&model);
    g_assert_cmpint(out.unloads, ==, 2);
    g_assert_cmpint(out.restores, ==, 2);
    g_assert_cmpfloat(out.end_pressure, >=, model.until_pressure);
    g_assert_cmpfloat(out.end_pressure, <, 1.02 * model.until_pressure);
    for (int i = 0; i < 2; i++) {
        g_assert_cmpfloat(fabs(out.unloaded_pressure[i]), <, 2e-3 * model.unload_from[i]);
    }
}

/* A density is reached exactly, in every geometry. */
static void test_density(void)
{
    const char *geometry[] = {"loading.geometry=uniaxial", "loading.geometry=biaxial",
                              "loading.geometry=isotropic"};
    for (int g = 0; g < 3; g++) {
        const struct gb_params params =
            scene_params("loading.until=density = 0.5", geometry[g], NULL);
        const struct gb_model model = scene_model(&params);
        const struct outcome out = run(&model);
        g_assert_cmpfloat_with_epsilon(out.end_density, 0.5, 1e-12);
        const int expected = (int)ceil(log(0.5 / 0.24) / ((g + 1) * -log(1.0 - 1e-3)));
        g_assert_cmpint(out.loads, ==, expected);
    }
}

static void test_axes(void)
{
    const struct gb_params params = scene_params("loading.geometry=biaxial", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_quasistatic load;
    double factor[3];
    const double p[3] = {1e-6, 2e-6, 4e-6};
    gb_loading_quasistatic_init(&load, &model);
    g_assert_cmpint(gb_loading_quasistatic_next(&load, p, 0.3, factor), ==,
                    GB_QUASISTATIC_STRAIN);
    g_assert_cmpfloat(factor[0], ==, 1.0);
    g_assert_cmpfloat(factor[1], ==, 1.0 - 1e-3);
    g_assert_cmpfloat(factor[2], ==, 1.0 - 1e-3);
    g_assert_cmpfloat_with_epsilon(gb_loading_quasistatic_pressure(&load, p), 3e-6,
                                   1e-20);
    gb_loading_quasistatic_halve(&load, factor);
    g_assert_cmpfloat_with_epsilon(factor[2] * factor[2], 1.0 - 1e-3, 1e-15);
    g_assert_cmpfloat(load.step, ==, 5e-4);
    gb_loading_quasistatic_recover(&load);
    gb_loading_quasistatic_recover(&load);
    g_assert_cmpfloat(load.step, ==, 1e-3);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/load/unloading", test_unloading);
    g_test_add_func("/load/density", test_density);
    g_test_add_func("/load/axes", test_axes);
    return g_test_run();
}
