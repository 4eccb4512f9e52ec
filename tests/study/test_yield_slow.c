/* What the group of P1 found for compacts of 10 nm (arXiv 1409.6393), and the strength of the
 * two systems: small cells, each statement by several standard errors. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/tree.h"
#include "io/preset.h"
#include "study/strength.h"
#include "study/yield.h"

enum { CELLS = 16 };

/* Standard errors by which a number has to differ. */
static const double several = 3.0;

static char *folder;

/* The preset with cells of 400 particles. */
static struct gb_params small(const char *name)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    if (!gb_preset_load(&preset, name, &err)) {
        g_error("%s", err.text);
    }
    struct gb_params params = *gb_preset_params(preset);
    gb_preset_destroy(preset);
    g_assert_true(gb_params_assign(&params, "particles.count=400", &err));
    g_assert_true(gb_params_assign(&params, "structure.base=9.6 d", &err));
    return params;
}

static void say(const char *what, const struct gb_fit_value *value, double factor)
{
    g_test_message("%s %.4g +- %.2g", what, factor * value->value, factor * value->error);
}

/* Above a level by several errors. */
static void assert_above(const struct gb_fit_value *value, double level)
{
    g_assert_cmpfloat(value->error, >, 0.0);
    g_assert_cmpfloat(value->value - several * value->error, >, level);
}

static void assert_statements(const struct gb_yield_surface *surface)
{
    for (int k = 0; k < GB_YIELD_QUANTITIES; k++) {
        const struct gb_yield_surface_row *row = &gb_yield_surface_rows[k];
        say(row->name, &surface->quantity[k], row->factor);
    }
    /* shifted towards compression, and close to an ellipse */
    assert_above(&surface->quantity[GB_YIELD_CENTRE_P], 0.0);
    g_assert_cmpfloat(surface->quantity[GB_YIELD_MISFIT].value, <, 0.1);
    assert_above(&surface->quantity[GB_YIELD_DILATANCY_COMPRESSION], 0.0);
    assert_above(&surface->quantity[GB_YIELD_DILATANCY_EXTENSION], 0.0);
    /* flow deviates from the normal */
    assert_above(&surface->quantity[GB_YIELD_FLOW_DEVIATION], 0.0);
    g_assert_cmpfloat(surface->quantity[GB_YIELD_ANGLE_RMS].value, >,
                      2.0 * surface->quantity[GB_YIELD_ANGLE_NOISE].value);
}

static void test_yield(const void *data)
{
    const char *name = data;
    struct gb_yield_study study = {0};
    struct gb_yield_options options;
    struct gb_error err = {0};
    const struct gb_params params = small(name);
    char *directory = g_build_filename(folder, name, NULL);
    gb_yield_options_init(&options);
    options.marks = (struct gb_keep_points){.count = 1, .point = {{true, 0.5}}};
    options.replicas = CELLS;
    options.inside = 0.1;
    if (!gb_yield_run(&study, &params, &options, directory, 0, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(study.failed, ==, 0);
    assert_statements(gb_yield_study_surface(&study, 0, GB_YIELD_OFFSET_CHOSEN));
    gb_yield_finish(&study);
    g_free(directory);
}

/* Strengths of the three tests at density 0.5, uniaxially pressed. */
static void measure(const char *name, const char *more,
                    struct gb_strength_result result[GB_STRENGTH_TESTS])
{
    struct gb_strength_study study = {0};
    struct gb_strength_options options;
    struct gb_error err = {0};
    struct gb_params params = small(name);
    char *sub = g_strdup_printf("strength-%s%s", name, more);
    char *directory = g_build_filename(folder, sub, NULL);
    gb_strength_options_init(&options);
    options.marks = (struct gb_keep_points){.count = 1, .point = {{true, 0.5}}};
    options.replicas = CELLS;
    g_assert_true(gb_params_assign(&params, "loading.geometry=uniaxial", &err));
    g_assert_true(*more == '\0' || gb_params_assign(&params, more, &err));
    if (!gb_strength_run(&study, &params, &options, directory, 0, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(study.failed, ==, 0);
    memcpy(result, study.result->data, GB_STRENGTH_TESTS * sizeof *result);
    gb_strength_finish(&study);
    g_free(directory);
    g_free(sub);
}

/* The stronger is so by a factor, in each test. */
static void assert_stronger(const struct gb_strength_result *strong,
                            const struct gb_strength_result *weak,
                            const double factor[GB_STRENGTH_TESTS])
{
    for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
        const double error =
            hypot(strong[t].strength_error_pa, factor[t] * weak[t].strength_error_pa);
        g_test_message("%s: %.4g +- %.2g MPa against %.4g +- %.2g MPa",
                       gb_strength_tests[t].name, 1e-6 * strong[t].strength_pa,
                       1e-6 * strong[t].strength_error_pa, 1e-6 * weak[t].strength_pa,
                       1e-6 * weak[t].strength_error_pa);
        g_assert_cmpfloat(weak[t].strength_pa, >, 0.0);
        g_assert_cmpfloat(strong[t].strength_pa - factor[t] * weak[t].strength_pa, >,
                          several * error);
    }
}

/* Pressed to one density, system I is far weaker than II: its attraction at contact is 2.6
 * times weaker, and it has no bridges.  The bridges alone make II stronger. */
static void test_strength(void)
{
    static const double both[GB_STRENGTH_TESTS] = {2.0, 2.0, 2.0};
    static const double bridges[GB_STRENGTH_TESTS] = {1.0, 1.2, 1.1};
    struct gb_strength_result one[GB_STRENGTH_TESTS], two[GB_STRENGTH_TESTS],
        attraction[GB_STRENGTH_TESTS];
    measure("p1-yield-set1", "", one);
    measure("p1-yield-set2", "", two);
    measure("p1-yield-set2", "contact.bridge_length=1 d", attraction);
    assert_stronger(two, one, both);
    assert_stronger(two, attraction, bridges);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("greenbody-yield-XXXXXX", NULL);
    g_test_add_data_func("/yield_slow/set1", "p1-yield-set1", test_yield);
    g_test_add_data_func("/yield_slow/set2", "p1-yield-set2", test_yield);
    g_test_add_func("/yield_slow/strength", test_strength);
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
