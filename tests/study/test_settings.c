/* Numbers of the studies of compacts do not depend on their numerical settings: elastic
 * constants of a card against central differences along loading paths, yield surface and
 * lost bridges against a tolerance five times tighter.  With -m slow: larger cells, two
 * densities and two seeds. */
#include <glib.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "common/scene.h"
#include "common/tree.h"
#include "measure/elastic.h"
#include "study/card.h"
#include "study/strength.h"
#include "study/yield.h"

static const double tighter = 0.2;

static char *folder;

static struct gb_params scene(int count, const char *more)
{
    char particles[64];
    g_snprintf(particles, sizeof particles, "particles.count=%d", count);
    return scene_params(particles, "particles.diameter=10 nm", "structure.base=auto",
                        more, NULL);
}

/* --- elastic constants -------------------------------------------------------------- */

static bool until_density(void *data, const struct gb_point *point)
{
    return point->density < *(const double *)data;
}

/* Keeps the end of the first leg. */
static bool first_leg(void *data, const struct gb_point *point)
{
    if (point->leg >= 2.0) {
        return false;
    }
    *(struct gb_point *)data = *point;
    return true;
}

/* A compact as the card presses and unloads it, in a cell that can be sheared: in double
 * precision from the beginning. */
static void press(struct gb_compact *inside, const struct gb_params *preset, int replica,
                  double density, const struct gb_card_options *options)
{
    const struct gb_keep_point at_once = {.by_density = true, .value = 0.0};
    const struct gb_compact_walk walk = {until_density, &density, NULL};
    struct gb_compact loose = {.sheared = true}, top = {.sheared = true};
    struct gb_params params;
    struct gb_error err = {0};
    g_assert_true(gb_compact_params(&params, preset, &err));
    params.geometry = GB_GEOMETRY_ISOTROPIC;
    params.seed += (uint64_t)(replica - 1);
    params.threads = 1;
    params.tolerance = options->press_tolerance;
    params.tolerance_scale = GB_TOLERANCE_CONTACT;
    g_strlcpy(params.path, "isotropic to density 0.99", sizeof params.path);
    if (!gb_compact_press(&loose, &params, &at_once, NULL, &err) ||
        gb_compact_follow(&loose, gb_card_paths[options->path].leg, params.strain_step,
                          &walk, &top, &err) != GB_COMPACT_TAKEN) {
        g_error("%s", err.text);
    }
    top.tolerance = tighter * options->tolerance;
    if (!gb_compact_unload(&top, options->inside * gb_compact_state_of(&top.point).p,
                           NULL, inside, &err)) {
        g_error("%s", err.text);
    }
    gb_compact_finish(&loose);
    gb_compact_finish(&top);
}

/* Pressures, in the order of the components of C. */
static void pressures(const struct gb_point *point, double p[6])
{
    const double *shear = point->shear_pa; /* xy, xz, yz */
    const double all[6] = {point->px_pa, point->py_pa, point->pz_pa,
                           shear[2],     shear[1],     shear[0]};
    memcpy(p, all, sizeof all);
}

/* C in Pa by two legs of 1e-6 for each strain.  Normal strains of legs are positive in
 * compression, as pressures are; shears are not. */
static void by_paths(struct gb_compact *inside, double c[6][6])
{
    static const char *const legs[6] = {"strain x = 1 to %g %%", "strain y = 1 to %g %%",
                                        "strain z = 1 to %g %%", "shear yz to %g %%",
                                        "shear xz to %g %%",     "shear xy to %g %%"};
    static const double size = 1e-6;
    inside->tolerance = 1e-8;
    for (int k = 0; k < 6; k++) {
        double p[2][6];
        for (int side = 0; side < 2; side++) {
            char leg[64];
            struct gb_point point;
            const struct gb_compact_walk walk = {first_leg, &point, NULL};
            struct gb_error err = {0};
            g_snprintf(leg, sizeof leg, legs[k], 100.0 * (side == 0 ? size : -size));
            if (gb_compact_follow(inside, leg, size, &walk, NULL, &err) !=
                GB_COMPACT_TAKEN) {
                g_error("%s: %s", leg, err.text);
            }
            pressures(&point, p[side]);
        }
        for (int m = 0; m < 6; m++) {
            const double slope = (p[0][m] - p[1][m]) / (2.0 * size);
            c[m][k] = k < 3 ? slope : -slope;
        }
    }
}

/* Averages, and the compliance of the (p, q) plane, of the same state. */
static struct gb_elastic_averages compare(struct gb_compact *inside)
{
    struct gb_compact_elastic found;
    struct gb_yield_elastic plane;
    struct gb_error err = {0};
    double c[6][6], by_volume[2], by_shear[2];
    if (!gb_compact_elastic(&found, inside, NULL, &err)) {
        g_error("%s", err.text);
    }
    by_paths(inside, c);
    const struct gb_elastic_averages mean = gb_elastic_average((const double(*)[6])c);
    gb_elastic_plane((const double(*)[6])c, by_volume, by_shear);
    g_assert_true(gb_yield_point_elastic(&plane, by_volume, by_shear));
    const double most = plane.compliance[0][0];
    for (int k = 0; k < 4; k++) {
        const double one = found.plane.compliance[k / 2][k % 2];
        const double other = plane.compliance[k / 2][k % 2];
        g_test_message("compliance of the plane, 1/GPa: %.5f, by paths %.5f", 1e9 * one,
                       1e9 * other);
        g_assert_cmpfloat_with_epsilon(one, other, 0.05 * most);
    }
    g_assert_cmpfloat_with_epsilon(found.bulk, mean.bulk, 0.05 * mean.bulk);
    g_assert_cmpfloat_with_epsilon(found.shear_modulus, mean.shear, 0.05 * mean.shear);
    return mean;
}

enum { LEVELS = 2, CELLS = 2 };

/* E and nu of the cells of a card at each density, and by paths, added to sums. */
static void add_cell(const struct gb_params *preset, int replica,
                     const struct gb_card_options *options,
                     struct gb_elastic_averages card[LEVELS],
                     struct gb_elastic_averages paths[LEVELS])
{
    struct gb_card_cell cell;
    struct gb_error err = {0};
    memset(&cell, 0, sizeof cell);
    if (!gb_card_cell_measure(&cell, preset, replica, options, NULL, &err)) {
        g_error("%s", err.text);
    }
    for (int k = 0; k < LEVELS; k++) {
        const double bulk = cell.level[k].bulk, shear = cell.level[k].shear_modulus;
        const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
        struct gb_compact inside = {0};
        press(&inside, preset, replica, options->density[k], options);
        const struct gb_elastic_averages found = compare(&inside);
        card[k].young += young / CELLS;
        card[k].poisson += (0.5 * young / shear - 1.0) / CELLS;
        paths[k].young += found.young / CELLS;
        paths[k].poisson += found.poisson / CELLS;
        gb_compact_finish(&inside);
    }
    gb_card_cell_finish(&cell);
}

/* The same powder pressed twice, since a card's own cells cannot be sheared: a pressing is
 * chaotic, so that means over the cells are compared. */
static void test_elastic(void)
{
    const struct gb_params preset =
        scene(g_test_slow() ? 300 : 100, "numerics.precision=double");
    struct gb_elastic_averages card[LEVELS], paths[LEVELS];
    struct gb_card_options options;
    memset(card, 0, sizeof card);
    memset(paths, 0, sizeof paths);
    gb_card_options_init(&options);
    options.levels = LEVELS;
    options.directions = 2;
    options.density[0] = 0.45;
    options.density[1] = 0.55;
    for (int replica = 1; replica <= CELLS; replica++) {
        add_cell(&preset, replica, &options, card, paths);
    }
    for (int k = 0; k < LEVELS; k++) {
        g_test_message("density %.2f: E %.4g GPa, nu %.4f; by paths %.4g, %.4f",
                       options.density[k], card[k].young / 1e9, card[k].poisson,
                       paths[k].young / 1e9, paths[k].poisson);
        g_assert_cmpfloat_with_epsilon(card[k].young, paths[k].young,
                                       0.1 * paths[k].young);
        g_assert_cmpfloat_with_epsilon(card[k].poisson, paths[k].poisson,
                                       0.1 * paths[k].poisson);
    }
}

/* --- settings five times tighter ----------------------------------------------------- */

/* Half of the 95 % interval that the number itself reports. */
static void assert_converged(const char *name, const struct gb_fit_value *found,
                             double converged)
{
    g_test_message("%s: %.4g (%.4g to %.4g), five times tighter %.4g", name, found->value,
                   found->low, found->high, converged);
    g_assert_cmpfloat(fabs(found->value - converged), <=,
                      0.25 * (found->high - found->low));
}

static const struct gb_yield_surface *yield(struct gb_yield_study *study, double factor)
{
    struct gb_yield_options options;
    struct gb_error err = {0};
    const struct gb_params params =
        scene(g_test_slow() ? 300 : 100, "loading.geometry=isotropic");
    char *directory =
        g_build_filename(folder, factor < 1.0 ? "yield-tight" : "yield", NULL);
    gb_yield_options_init(&options);
    options.marks = (struct gb_keep_points){.count = 1, .point = {{true, 0.5}}};
    options.replicas = g_test_slow() ? 6 : 3;
    options.directions = g_test_slow() ? 12 : 8;
    options.tolerance *= factor;
    if (!gb_yield_run(study, &params, &options, directory, 0, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(study->failed, ==, 0);
    g_free(directory);
    return gb_yield_study_surface(study, 0, GB_YIELD_OFFSET_CHOSEN);
}

static void test_yield(void)
{
    static const enum gb_yield_surface_quantity list[] = {GB_YIELD_CENTRE_P,
                                                          GB_YIELD_HALF_P,
                                                          GB_YIELD_HALF_Q,
                                                          GB_YIELD_TENSION,
                                                          GB_YIELD_DILATANCY_COMPRESSION,
                                                          GB_YIELD_DILATANCY_EXTENSION};
    struct gb_yield_study study[2];
    const struct gb_yield_surface *now = yield(&study[0], 1.0);
    const struct gb_yield_surface *tight = yield(&study[1], tighter);
    for (size_t i = 0; i < G_N_ELEMENTS(list); i++) {
        assert_converged(gb_yield_surface_rows[list[i]].name, &now->quantity[list[i]],
                         tight->quantity[list[i]].value);
    }
    gb_yield_finish(&study[0]);
    gb_yield_finish(&study[1]);
}

/* Fractions of the bridges that are lost at the peak of each test. */
static void strength(double lost[GB_STRENGTH_TESTS], double factor)
{
    struct gb_strength_study study;
    struct gb_strength_options options;
    struct gb_error err = {0};
    const struct gb_params params = scene(300, "loading.geometry=uniaxial");
    char *directory =
        g_build_filename(folder, factor < 1.0 ? "strength-tight" : "strength", NULL);
    gb_strength_options_init(&options);
    options.marks = (struct gb_keep_points){.count = 1, .point = {{true, 0.45}}};
    options.replicas = g_test_slow() ? 8 : 4;
    options.strain_most = g_test_slow() ? options.strain_most : 0.04;
    options.tolerance *= factor;
    if (!gb_strength_run(&study, &params, &options, directory, 0, NULL, &err)) {
        g_error("%s", err.text);
    }
    g_assert_cmpuint(study.failed, ==, 0);
    for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
        const struct gb_strength_result *result =
            &g_array_index(study.result, struct gb_strength_result, (guint)t);
        lost[t] = result->broken_at_peak;
        g_test_message("%s, tolerance %g: %.2f +- %.2f %% of the bridges lost",
                       gb_strength_tests[t].name, options.tolerance, 100.0 * lost[t],
                       100.0 * result->broken_at_peak_error);
    }
    gb_strength_finish(&study);
    g_free(directory);
}

/* Four cells scatter by half of this; the tolerance of a preset adds twice this. */
static void test_strength(void)
{
    static const double most = 0.01;
    double now[GB_STRENGTH_TESTS], tight[GB_STRENGTH_TESTS];
    strength(now, 1.0);
    strength(tight, tighter);
    for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
        g_assert_cmpfloat_with_epsilon(now[t], tight[t], most);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    folder = g_dir_make_tmp("greenbody-settings-XXXXXX", NULL);
    g_test_add_func("/settings/elastic", test_elastic);
    g_test_add_func("/settings/yield", test_yield);
    g_test_add_func("/settings/strength", test_strength);
    const int status = g_test_run();
    remove_tree(folder);
    g_free(folder);
    return status;
}
