#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/scene.h"
#include "io/lock.h"
#include "io/store.h"
#include "many/ensemble.h"
#include "many/param_sweep.h"
#include "many/reading.h"

/* Grids, workers and tables of many runs.  The runs are stand-ins with known curves:
 * density = 0.3 + mu p / GPa + the seed's part, unloaded from 100 MPa by one point. */

static char *folder;

static double seed_part(uint64_t seed)
{
    return 0.001 * (double)((seed * 7919) % 13);
}

static bool put(struct gb_store *store, int branch, double density, double p_pa)
{
    const struct gb_point point = {.branch = branch,
                                   .branch_from_pa = 100e6,
                                   .density = density,
                                   .px_pa = p_pa / 2.0,
                                   .p_pa = p_pa,
                                   .coordination = 10.0 * density};
    return gb_store_point(store, &point, NULL);
}

/* What gb_single_run leaves, without an engine. */
static bool stand_in(const struct gb_params *params, const char *directory,
                     const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct gb_store *store = NULL;
    struct gb_snapshot shot = {.state = GB_RUN_DONE};
    (void)callbacks;
    if (!gb_store_create(&store, directory, params, GB_RUNDIR_REPLACE, err)) {
        return false;
    }
    for (int i = 0; i <= 20; i++) {
        const double p = 10e6 * i;
        const double density = 0.3 + params->mu * p / 1e9 + seed_part(params->seed);
        g_assert_true(put(store, GB_BRANCH_LOAD, density, p));
        if (i == 10) {
            g_assert_true(put(store, 1, density - 0.005, 50e6));
            g_assert_true(put(store, 1, density - 0.01, 0.0));
        }
    }
    g_assert_true(gb_store_status(store, &shot, err));
    gb_store_destroy(store);
    return true;
}

/* Every third replica fails in another way. */
static bool unreliable(const struct gb_params *params, const char *directory,
                       const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    switch (params->seed % 6) {
    case 2:
        raise(SIGKILL);
        return false;
    case 5:
        return gb_error_set(err, GB_ERR_GUARD, "overlap of 0.6 d, \"too much\"");
    default:
        g_usleep(2000 * (params->seed * 5 % 7)); /* another order of ending */
        return stand_in(params, directory, callbacks, err);
    }
}

static char *name_of(const char *what, uint64_t seed)
{
    return g_strdup_printf("%s/%s-%d", folder, what, (int)seed);
}

static bool exists(const char *what, uint64_t seed)
{
    char *path = name_of(what, seed);
    const bool found = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return found;
}

static void leave(const char *what, uint64_t seed)
{
    char *path = name_of(what, seed);
    g_assert_true(g_file_set_contents(path, "", 0, NULL));
    g_free(path);
}

static bool endless(const struct gb_params *params, const char *directory,
                    const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    (void)directory;
    leave("endless", params->seed);
    while (!callbacks->cancelled(callbacks->data)) {
        g_usleep(1000);
    }
    return gb_error_set(err, GB_ERR_CANCELLED, "stopped");
}

static void make(struct gb_ensemble *ensemble, const struct gb_axes *axes,
                 size_t replicas, const char *name)
{
    struct gb_error err = {0};
    g_assert_true(
        gb_ensemble_init(ensemble, gb_param_sweep_points(axes), replicas, &err));
    for (size_t i = 0; i < ensemble->points * replicas; i++) {
        struct gb_ensemble_run *run = &ensemble->run[i];
        run->params = scene_params("loading.until=200 MPa", NULL);
        g_assert_true(
            gb_params_assign(&run->params, "loading.unload_from=100 MPa", &err));
        g_assert_true(gb_param_sweep_apply(axes, run->point, &run->params, &err));
        run->params.seed += run->replica;
        char *point = gb_param_sweep_point_name(axes, run->point);
        run->directory = g_strdup_printf("%s/%s/%s_seed-%d", folder, name, point,
                                         (int)run->params.seed);
        g_free(point);
    }
}

static bool work(struct gb_ensemble *ensemble, size_t workers, gb_pool_work *how,
                 const struct gb_ensemble_callbacks *callbacks, struct gb_error *err)
{
    struct gb_pool *pool = NULL;
    static const struct gb_ensemble_callbacks no_callbacks = {0};
    g_assert_true(gb_ensemble_find_done(ensemble, err));
    g_assert_true(gb_pool_create(&pool, workers, how, err));
    const bool good =
        gb_ensemble_work(ensemble, pool, callbacks ? callbacks : &no_callbacks, err);
    gb_pool_destroy(pool);
    return good;
}

static char *tables(struct gb_ensemble *ensemble, const struct gb_axes *axes)
{
    struct gb_sweep_table_pressures at;
    g_assert_true(gb_param_sweep_pressures(&at, "25;100 MPa", NULL));
    GString *means = gb_param_sweep_means(ensemble, axes, &at);
    GString *runs = gb_param_sweep_runs(ensemble);
    char *both = g_strconcat(means->str, runs->str, NULL);
    g_string_free(means, TRUE);
    g_string_free(runs, TRUE);
    return both;
}

static void add(struct gb_axes *axes, const char *text)
{
    struct gb_error err = {0};
    if (!gb_param_sweep_add_axis(axes, text, &err)) {
        g_error("%s: %s", text, err.text);
    }
}

static void test_axes(void)
{
    struct gb_axes axes = {0};
    add(&axes, "contact.mu=0.05:0.4:8");
    add(&axes, "particles.diameter=9.7;16;21;38 nm");
    add(&axes, "loading.geometry=uniaxial; isotropic");
    g_assert_cmpuint(gb_param_sweep_points(&axes), ==, 64);
    g_assert_cmpstr(gb_param_sweep_value(&axes, 0, 0), ==, "0.05");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 8, 0), ==,
                    "0.1"); /* not 0.1 and a tail */
    g_assert_cmpstr(gb_param_sweep_value(&axes, 63, 0), ==, "0.4");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 7, 1), ==, "38 nm");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 7, 2), ==, "isotropic");
    char *name = gb_param_sweep_point_name(&axes, 10);
    g_assert_cmpstr(name, ==, "mu-0.1_diameter-16nm_geometry-uniaxial");
    g_free(name);
    char *column = gb_param_sweep_column(&axes, 1);
    char cell[GB_PARAMS_VALUE_MAX];
    g_assert_cmpstr(column, ==, "particles.diameter_nm");
    g_assert_cmpstr(gb_param_sweep_cell(&axes, 2, 1, cell, sizeof cell), ==, "16");
    g_free(column);
    struct gb_params params = scene_params(NULL, NULL);
    g_assert_true(gb_param_sweep_apply(&axes, 10, &params, NULL));
    g_assert_cmpfloat(params.mu, ==, 0.1);
    g_assert_cmpfloat(params.diameter_m, ==, 16e-9);
    gb_param_sweep_axes_finish(&axes);
    add(&axes, "loading.until=100:10000:3:log MPa");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 1, 0), ==, "1 GPa");
    column = gb_param_sweep_column(&axes, 0); /* two units: one for all */
    g_assert_cmpstr(column, ==, "loading.until_SI");
    g_assert_cmpstr(gb_param_sweep_cell(&axes, 0, 0, cell, sizeof cell), ==, "100000000");
    g_free(column);
    gb_param_sweep_axes_finish(&axes);
}

/* Any two values have directories of their own. */
static void test_axes_names(void)
{
    static const char *const expected[] = {"name-a~2Fb", "name-ab", "name-a~20b",
                                           "name-a~5Fb", "name-a~7E20b"};
    struct gb_axes axes = {0};
    add(&axes, "material.name=a/b;ab;a b;a_b;a~20b");
    for (size_t i = 0; i < G_N_ELEMENTS(expected); i++) {
        char *name = gb_param_sweep_point_name(&axes, i);
        g_assert_cmpstr(name, ==, expected[i]);
        g_free(name);
    }
    gb_param_sweep_axes_finish(&axes);
    /* longer than a file's name may be, and different at the end only */
    char *same = g_strnfill(62, 'x');
    char *line = g_strdup_printf("material.name=%sa;%sb", same, same);
    add(&axes, line);
    char *a = gb_param_sweep_point_name(&axes, 0),
         *b = gb_param_sweep_point_name(&axes, 1);
    g_assert_cmpstr(a, !=, b);
    g_assert_cmpuint(strlen(a), ==, strlen("name-") + 40 + 2 + 16);
    g_free(a);
    g_free(b);
    g_free(same);
    g_free(line);
    gb_param_sweep_axes_finish(&axes);
}

/* All keys of a material, in front of those of other axes. */
static void test_axes_material(void)
{
    struct gb_axes axes = {0};
    add(&axes, "material.young=5;6 GPa");
    add(&axes, "material=yttria,microcrystalline-cellulose");
    g_assert_cmpuint(gb_param_sweep_points(&axes), ==, 4);
    char *name = gb_param_sweep_point_name(&axes, 3);
    g_assert_cmpstr(name, ==, "young-6GPa_material-microcrystalline-cellulose");
    g_free(name);
    char *column = gb_param_sweep_column(&axes, 1);
    char cell[GB_PARAMS_VALUE_MAX];
    g_assert_cmpstr(column, ==, "material.name");
    g_assert_cmpstr(gb_param_sweep_cell(&axes, 2, 1, cell, sizeof cell), ==, "yttria");
    g_free(column);
    struct gb_params params = scene_params(NULL, NULL);
    g_assert_true(gb_param_sweep_apply(&axes, 2, &params, NULL));
    g_assert_cmpstr(params.material, ==, "yttria");
    g_assert_cmpfloat(params.density_kg_m3, ==, 5020.0);
    g_assert_cmpfloat(params.young_pa, ==, 6e9);
    g_assert_false(gb_param_sweep_add_axis(&axes, "material.name=a;b", NULL));
    gb_param_sweep_axes_finish(&axes);
}

/* Points of a Sobol sequence: one value of each key at a point, a longer design contains
 * the shorter, whole numbers for keys that count. */
static void test_axes_design(void)
{
    struct gb_axes axes = {0}, longer = {0};
    struct gb_error err = {0};
    g_assert_true(gb_param_sweep_design(&axes, "sobol:8", &err));
    g_assert_true(gb_param_sweep_design(&longer, "sobol:16", &err));
    static const char *const keys[] = {"contact.mu=0.05:0.45",
                                       "particles.diameter=10:1000:log nm",
                                       "particles.count=100:200"};
    for (size_t k = 0; k < G_N_ELEMENTS(keys); k++) {
        add(&axes, keys[k]);
        add(&longer, keys[k]);
    }
    g_assert_cmpuint(gb_param_sweep_points(&axes), ==, 8);
    g_assert_cmpstr(gb_param_sweep_value(&axes, 0, 0), ==, "0.25");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 0, 1), ==, "100 nm");
    g_assert_cmpstr(gb_param_sweep_value(&axes, 0, 2), ==, "150");
    bool low[3] = {false}, high[3] = {false};
    for (size_t p = 0; p < 8; p++) {
        for (size_t k = 0; k < 3; k++) {
            g_assert_cmpstr(gb_param_sweep_value(&axes, p, k), ==,
                            gb_param_sweep_value(&longer, p, k));
            low[k] = low[k] || axes.axis[k].share[p] < 0.25;
            high[k] = high[k] || axes.axis[k].share[p] > 0.75;
        }
    }
    for (size_t k = 0; k < 3; k++) { /* spread over each range */
        g_assert_true(low[k] && high[k]);
    }
    struct gb_params params = scene_params(NULL, NULL);
    g_assert_true(gb_param_sweep_apply(&axes, 0, &params, NULL));
    g_assert_cmpfloat(params.mu, ==, 0.25);
    g_assert_cmpint(params.count, ==, 150);
    gb_param_sweep_axes_finish(&axes);
    gb_param_sweep_axes_finish(&longer);
    static const char *const bad[] = {"contact.mu=0.1:0.2:3", "contact.mu=0.1;0.2",
                                      "contact.mu=0.1",       "loading.geometry=0:1",
                                      "contact.mu=0.1:0.1",   "material=iron;copper"};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        struct gb_axes refused = {.design = 8};
        g_assert_false(gb_param_sweep_add_axis(&refused, bad[i], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        gb_param_sweep_axes_finish(&refused);
    }
    g_assert_false(gb_param_sweep_design(&axes, "sobol:1", &err));
    g_assert_false(gb_param_sweep_design(&axes, "grid:8", &err));
    g_assert_nonnull(strstr(err.text, "expected sobol:N"));
}

static void test_axes_refuse(void)
{
    static const char *const bad[] = {"",
                                      "contact.mu",
                                      "=1",
                                      "contact.mu=",
                                      "contact.mu=0.1:0.2",
                                      "contact.mu=0.1:0.2:1",
                                      "contact.mu=0.1:0.2:2.5",
                                      "contact.mu=0.1:0.2:1e9",
                                      "contact.mu=0.1;;0.2",
                                      "contact.mu=0.1;0.1",
                                      "contact.mu=-1;0.1",
                                      "contact.mu=0:1:3:log",
                                      "contact.mu=0.1:0.2:3:lin",
                                      "contact.mu=0.1:x:3",
                                      "contact.nu=0.1;0.2",
                                      "nu=0.1;0.2",
                                      "particles.diameter=9.7;16",
                                      "particles.diameter=9.7 nm:16 um:3",
                                      "particles.diameter=1:2:3 MPa",
                                      "structure.seed=1:3:3",
                                      "scene.title=a;b",
                                      "output.checkpoint_every=1;2 s",
                                      "numerics.threads=1;2",
                                      "loading.unload_from=100 MPa",
                                      "loading.geometry=uniaxial;sideways",
                                      "material=",
                                      "material=iron;iron",
                                      "material=iron;rust",
                                      "material=1:2:3"};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        struct gb_axes axes = {0};
        struct gb_error err = {0};
        g_test_message("%s", bad[i]);
        g_assert_false(gb_param_sweep_add_axis(&axes, bad[i], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_cmpstr(err.text, !=, "");
        gb_param_sweep_axes_finish(&axes);
    }
    struct gb_axes axes = {0};
    add(&axes, "contact.mu=0.1;0.2");
    g_assert_false(gb_param_sweep_add_axis(&axes, "contact.mu=0.3;0.4", NULL));
    gb_param_sweep_axes_finish(&axes);
}

/* The means of the stand-in's curves, exactly. */
static void test_table(void)
{
    struct gb_axes axes = {0};
    struct gb_ensemble ensemble;
    struct gb_error err = {0};
    add(&axes, "contact.mu=0.1;0.2");
    make(&ensemble, &axes, 3, "table");
    g_assert_true(work(&ensemble, 2, stand_in, NULL, &err));
    struct gb_sweep_table_pressures at;
    g_assert_true(gb_param_sweep_pressures(&at, "25;100;900 MPa", NULL));
    GString *means = gb_param_sweep_means(&ensemble, &axes, &at);
    char **lines = g_strsplit(means->str, "\n", -1);
    g_assert_cmpuint(g_strv_length(lines), ==, 3 + 1 + 6 + 1);
    double parts[3], mean = 0.0, error = 0.0;
    for (uint64_t s = 0; s < 3; s++) {
        parts[s] = seed_part(1 + s);
        mean += parts[s] / 3.0;
    }
    for (int s = 0; s < 3; s++) {
        error += (parts[s] - mean) * (parts[s] - mean) / 6.0;
    }
    const double want[] = {0.3 + 0.1 * 0.025, 0.3 + 0.1 * 0.1, 0.3 + 0.1 * 0.1 - 0.01,
                           0.3 + 0.2 * 0.025, 0.3 + 0.2 * 0.1, 0.3 + 0.2 * 0.1 - 0.01};
    static const char *const start[] = {"1,0.1,load,25,3,",    "1,0.1,load,100,3,",
                                        "1,0.1,unload,100,3,", "2,0.2,load,25,3,",
                                        "2,0.2,load,100,3,",   "2,0.2,unload,100,3,"};
    for (int i = 0; i < 6; i++) {
        char **cells = g_strsplit(lines[4 + i], ",", -1);
        g_assert_true(g_str_has_prefix(lines[4 + i], start[i]));
        g_assert_cmpfloat_with_epsilon(g_ascii_strtod(cells[5], NULL), want[i] + mean,
                                       1e-10);
        g_assert_cmpfloat_with_epsilon(g_ascii_strtod(cells[6], NULL), sqrt(error),
                                       1e-10);
        g_assert_cmpfloat_with_epsilon(g_ascii_strtod(cells[7], NULL),
                                       10.0 * (want[i] + mean), 1.0);
        g_strfreev(cells);
    }
    g_strfreev(lines);
    g_string_free(means, TRUE);
    gb_ensemble_finish(&ensemble);
    gb_param_sweep_axes_finish(&axes);
}

/* Crashes and guards cost one run each; one worker and five give the same tables. */
static void test_failures(void)
{
    char *text[2];
    static const size_t workers[] = {1, 5};
    static const char *const name[] = {"one", "five"};
    struct gb_axes axes = {0};
    add(&axes, "contact.mu=0.1:0.3:3");
    for (int k = 0; k < 2; k++) {
        struct gb_ensemble ensemble;
        struct gb_error err = {0};
        make(&ensemble, &axes, 6, name[k]);
        g_assert_true(work(&ensemble, workers[k], unreliable, NULL, &err));
        for (size_t i = 0; i < 18; i++) {
            const struct gb_ensemble_run *run = &ensemble.run[i];
            const enum gb_status want = run->params.seed == 2   ? GB_ERR_MACHINE
                                        : run->params.seed == 5 ? GB_ERR_GUARD
                                                                : GB_OK;
            g_assert_true(run->ended);
            g_assert_cmpint(run->error.code, ==, want);
        }
        text[k] = tables(&ensemble, &axes);
        gb_ensemble_finish(&ensemble);
    }
    g_assert_cmpstr(text[0], ==, text[1]);
    g_assert_nonnull(strstr(text[0],
                            "mu-0.2_seed-2,2,2,failed,\"the process of the run was "
                            "ended by Killed\""));
    g_assert_nonnull(strstr(text[0], "\"overlap of 0.6 d, \"\"too much\"\"\""));
    g_assert_nonnull(strstr(text[0], "1,0.1,load,25,4,"));
    g_free(text[0]);
    g_free(text[1]);
    gb_param_sweep_axes_finish(&axes);
}

static long made_at(const struct gb_ensemble_run *run)
{
    char *path = g_build_filename(run->directory, "curve.csv", NULL);
    GStatBuf info = {0};
    const int found = g_stat(path, &info);
    g_free(path);
    return found == 0 ? info.st_mtim.tv_nsec : 0;
}

/* A second start does what failed and what is new, and nothing else. */
static void test_restart(void)
{
    struct gb_axes axes = {0};
    struct gb_ensemble ensemble;
    struct gb_error err = {0};
    long before[6];
    add(&axes, "contact.mu=0.1");
    make(&ensemble, &axes, 6, "restart");
    g_assert_true(work(&ensemble, 3, unreliable, NULL, &err));
    for (int i = 0; i < 6; i++) {
        before[i] = made_at(&ensemble.run[i]);
    }
    gb_ensemble_finish(&ensemble);
    make(&ensemble, &axes, 8, "restart");
    g_assert_true(work(&ensemble, 3, stand_in, NULL, &err));
    for (int i = 0; i < 8; i++) {
        const struct gb_ensemble_run *run = &ensemble.run[i];
        const bool failed = run->params.seed % 6 == 2 || run->params.seed % 6 == 5;
        g_assert_true(run->ended && run->error.code == GB_OK);
        g_assert_cmpint(run->before, ==, i < 6 && !failed);
        if (run->before) {
            g_assert_cmpint(made_at(run), ==, before[i]);
        }
    }
    gb_ensemble_finish(&ensemble);
    /* the same names for another experiment: refused, nothing touched */
    make(&ensemble, &axes, 8, "restart");
    for (int i = 0; i < 8; i++) {
        g_assert_true(
            gb_params_assign(&ensemble.run[i].params, "contact.alpha=0.3", &err));
    }
    g_assert_false(gb_ensemble_find_done(&ensemble, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, "other parameters"));
    gb_ensemble_finish(&ensemble);
    gb_param_sweep_axes_finish(&axes);
}

/* Once both workers are at work. */
static bool both_work(void *data)
{
    (void)data;
    return exists("endless", 1) && exists("endless", 2);
}

static void test_cancel(void)
{
    struct gb_axes axes = {0};
    struct gb_ensemble ensemble;
    struct gb_error err = {0};
    const struct gb_ensemble_callbacks callbacks = {.cancelled = both_work};
    make(&ensemble, &axes, 5, "cancel");
    g_assert_false(work(&ensemble, 2, endless, &callbacks, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    for (size_t i = 0; i < 5; i++) {
        g_assert_cmpint(ensemble.run[i].ended, ==, i < 2);
        g_assert_cmpint(ensemble.run[i].error.code, ==, i < 2 ? GB_ERR_CANCELLED : GB_OK);
    }
    gb_ensemble_finish(&ensemble);
}

/* While a run is kept the next one is pressed, never two: each is kept until the next one
 * begins, and none may begin before. */
static bool relay(const struct gb_params *params, const char *directory,
                  const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    const uint64_t seed = params->seed;
    if (seed > 1 && !exists("pressed", seed - 1)) {
        return gb_error_set(err, GB_ERR_MACHINE, "two at once");
    }
    leave("begun", seed);
    g_usleep(20000); /* for another one that should not begin */
    leave("pressed", seed);
    callbacks->loaded(callbacks->data);
    while (seed < 4 && !exists("begun", seed + 1)) {
        g_usleep(1000);
    }
    return stand_in(params, directory, callbacks, err);
}

static void test_keeping(void)
{
    struct gb_axes axes = {0};
    struct gb_ensemble ensemble;
    struct gb_error err = {0};
    add(&axes, "contact.mu=0.1");
    make(&ensemble, &axes, 4, "keeping");
    g_assert_true(work(&ensemble, 1, relay, NULL, &err));
    for (size_t i = 0; i < 4; i++) {
        g_assert_true(ensemble.run[i].ended);
        g_assert_cmpstr(ensemble.run[i].error.text, ==, "");
    }
    gb_ensemble_finish(&ensemble);
    gb_param_sweep_axes_finish(&axes);
}

/* What is kept for a while. */
static bool slow_to_keep(const struct gb_params *params, const char *directory,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    callbacks->loaded(callbacks->data);
    g_usleep(20000);
    return stand_in(params, directory, callbacks, err);
}

/* Three of the first replicas are enough; nothing is begun ahead of them. */
static bool three(const struct gb_ensemble *ensemble, size_t point, void *data)
{
    (void)data;
    bool ended = ensemble->replicas >= 3;
    for (size_t r = 0; r < 3 && ended; r++) {
        ended = gb_ensemble_at(ensemble, point, r)->ended;
    }
    return ended;
}

static void test_enough(void)
{
    char *text[2];
    static const size_t workers[] = {1, 4};
    static const char *const name[] = {"enough1", "enough4"};
    struct gb_axes axes = {0};
    add(&axes, "contact.mu=0.1;0.2");
    for (int k = 0; k < 2; k++) {
        struct gb_ensemble ensemble;
        struct gb_error err = {0};
        make(&ensemble, &axes, 20, name[k]);
        ensemble.converged = three;
        g_assert_true(work(&ensemble, workers[k], slow_to_keep, NULL, &err));
        size_t ended = 0;
        for (size_t i = 0; i < 40; i++) {
            ended += ensemble.run[i].ended;
        }
        /* several go ahead while one of the first takes its time */
        g_assert_cmpuint(ended, >=, 6);
        g_assert_true(ended == 6 || workers[k] > 1);
        g_assert_cmpuint(gb_ensemble_used(&ensemble, 0), ==, 3);
        struct gb_sweep_table_pressures at;
        g_assert_true(gb_param_sweep_pressures(&at, "100 MPa", NULL));
        GString *means = gb_param_sweep_means(&ensemble, &axes, &at);
        text[k] = g_string_free(means, FALSE);
        gb_ensemble_finish(&ensemble);
    }
    g_assert_cmpstr(text[0], ==, text[1]);
    g_free(text[0]);
    g_free(text[1]);
    gb_param_sweep_axes_finish(&axes);
}

/* Another process that has the directory of a run, until it is killed. */
static pid_t hold(const char *directory)
{
    int ready[2];
    char sign;
    g_assert_cmpint(g_mkdir_with_parents(directory, 0777), ==, 0);
    g_assert_cmpint(pipe(ready), ==, 0);
    const pid_t holder = fork();
    if (holder == 0) {
        struct gb_lock lock;
        if (gb_lock_take(&lock, directory, ".lock")) {
            (void)!write(ready[1], "y", 1);
        }
        while (true) {
            pause();
        }
    }
    g_assert_cmpint(read(ready[0], &sign, 1), ==, 1);
    close(ready[0]);
    close(ready[1]);
    return holder;
}

static void end(pid_t holder)
{
    g_assert_cmpint(kill(holder, SIGKILL), ==, 0);
    g_assert_cmpint(waitpid(holder, NULL, 0), ==, holder);
}

struct waiting {
    pid_t holder;
    int calls;
    const struct gb_ensemble_run *run;
};

/* The wait is over when it was told. */
static void on_wait(const struct gb_ensemble_run *run, void *data)
{
    struct waiting *waiting = data;
    waiting->calls++;
    waiting->run = run;
    end(waiting->holder);
}

/* A run that another process holds is waited for, told once, and done when that one is
 * gone; an ensemble that leaves ends without it. */
static void test_elsewhere(void)
{
    struct gb_axes axes = {0};
    struct gb_ensemble ensemble;
    struct gb_error err = {0};
    struct waiting waiting = {0};
    struct gb_ensemble_callbacks callbacks = {
        .on_wait = on_wait, .data = &waiting, .patience_s = 3600.0};
    add(&axes, "contact.mu=0.1");
    make(&ensemble, &axes, 3, "elsewhere");
    waiting.holder = hold(ensemble.run[0].directory); /* all that is found at first */
    ensemble.leaves = true;
    g_assert_true(work(&ensemble, 2, stand_in, &callbacks, &err));
    g_assert_cmpint(waiting.calls, ==, 0);
    g_assert_true(ensemble.run[0].elsewhere && !ensemble.run[0].ended);
    g_assert_cmpuint(gb_ensemble_refresh(&ensemble), ==, 1);
    ensemble.leaves = false; /* nothing but that one is left */
    callbacks.patience_s = 0.1;
    g_assert_true(work(&ensemble, 2, stand_in, &callbacks, &err));
    g_assert_cmpint(waiting.calls, ==, 1);
    g_assert_true(waiting.run == &ensemble.run[0]);
    g_assert_cmpuint(gb_ensemble_refresh(&ensemble), ==, 0);
    for (int i = 0; i < 3; i++) {
        g_assert_true(ensemble.run[i].ended && ensemble.run[i].error.code == GB_OK);
    }
    gb_ensemble_finish(&ensemble);
    gb_param_sweep_axes_finish(&axes);
}

/* Parts have their runs only, each run is of one part. */
static void test_parts(void)
{
    struct gb_axes axes = {0};
    struct gb_error err = {0};
    int ended[7] = {0};
    add(&axes, "contact.mu=0.1");
    for (size_t part = 0; part < 3; part++) {
        struct gb_ensemble ensemble;
        make(&ensemble, &axes, 7, "parts");
        ensemble.part = part;
        ensemble.parts = 3;
        g_assert_true(work(&ensemble, 2, stand_in, NULL, &err));
        for (size_t i = 0; i < 7; i++) {
            const struct gb_ensemble_run *run = &ensemble.run[i];
            g_assert_cmpint(run->ended, ==, run->before || i % 3 == part);
            ended[i] += run->ended && !run->before;
        }
        gb_ensemble_finish(&ensemble);
    }
    for (size_t i = 0; i < 7; i++) {
        g_assert_cmpint(ended[i], ==, 1);
    }
    gb_param_sweep_axes_finish(&axes);
}

static void test_pressures(void)
{
    struct gb_sweep_table_pressures at;
    const struct gb_params params = scene_params(
        "loading.until=150 MPa", "loading.unload_from=100 MPa; 120 MPa", NULL);
    gb_param_sweep_default_pressures(&at, &params);
    static const double want[] = {1, 2, 5, 10, 20, 50, 100, 120, 150};
    g_assert_cmpuint(at.count, ==, G_N_ELEMENTS(want));
    for (size_t i = 0; i < at.count; i++) {
        g_assert_cmpfloat_with_epsilon(at.pa[i] / 1e6, want[i], 1e-9);
    }
    static const char *const bad[] = {"",      "100",       "100 nm",
                                      "0 MPa", "-5;10 MPa", "1;;2 MPa"};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        struct gb_error err = {0};
        g_assert_false(gb_param_sweep_pressures(&at, bad[i], &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    }
}

static void remove_all(const char *path)
{
    GDir *dir = g_dir_open(path, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        char *full = g_build_filename(path, name, NULL);
        remove_all(full);
        g_free(full);
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_remove(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    folder = g_dir_make_tmp("greenbody-ensemble-XXXXXX", NULL);
    g_assert_nonnull(folder);
    g_test_add_func("/axes/values", test_axes);
    g_test_add_func("/axes/material", test_axes_material);
    g_test_add_func("/axes/names", test_axes_names);
    g_test_add_func("/axes/refuse", test_axes_refuse);
    g_test_add_func("/ensemble/design", test_axes_design);
    g_test_add_func("/sweeptable/pressures", test_pressures);
    g_test_add_func("/sweeptable/means", test_table);
    g_test_add_func("/ensemble/failures", test_failures);
    g_test_add_func("/ensemble/restart", test_restart);
    g_test_add_func("/ensemble/cancel", test_cancel);
    g_test_add_func("/ensemble/keeping", test_keeping);
    g_test_add_func("/ensemble/enough", test_enough);
    g_test_add_func("/ensemble/elsewhere", test_elsewhere);
    g_test_add_func("/ensemble/parts", test_parts);
    const int status = g_test_run();
    remove_all(folder);
    g_free(folder);
    return status;
}
