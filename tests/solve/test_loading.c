/* The two tables of loading modes, scene/loading_kind.c and solve/loading/loading.c: same
 * rows, every function set; and the outcomes of steps on small scenes. */
#include <glib.h>
#include <string.h>

#include "common/die.h"
#include "common/scene.h"
#include "scene/loading_kind.h"
#include "solve/loading/loading.h"

static void test_rows(void)
{
    const char *const *names = gb_params_find("scene", "kind")->choices;
    for (int k = 0; k < GB_LOADING_KINDS; k++) {
        const struct gb_loading_kind *kind = gb_loading_kind_at(k);
        const struct gb_loading_mode *mode = gb_loading_modes[k];
        g_assert_nonnull(mode);
        g_assert_cmpstr(kind->name, ==, names[k]);
        g_assert_cmpint((int)strlen(kind->doc), >, 0);
        g_assert_true(kind->check && kind->freeze && kind->note);
        g_assert_true(mode->build && mode->build_from && mode->finish && mode->advance);
        g_assert_true(mode->after_point && mode->record && mode->report);
        g_assert_nonnull(mode->progress);
        g_assert_cmpuint(mode->size, >=, sizeof(struct gb_loading));
    }
    g_assert_null(names[GB_LOADING_KINDS]);
    g_assert_true(gb_loading_modes[GB_KIND_QUASISTATIC] == &gb_loading_quasistatic);
    g_assert_true(gb_loading_modes[GB_KIND_DYNAMIC] == &gb_loading_dynamic);
    g_assert_true(gb_loading_modes[GB_KIND_DIE] == &gb_loading_die);
}

/* Properties of a row agree with each other, with its fields and with its mode. */
static void test_properties(void)
{
    for (int k = 0; k < GB_LOADING_KINDS; k++) {
        const struct gb_loading_kind *kind = gb_loading_kind_at(k);
        g_assert_cmpuint(kind->normals, !=, 0);
        g_assert_true(kind->follows_time || !kind->given_rate);
        g_assert_true(kind->periodic_cell || !kind->plane);
        g_assert_true((kind->columns == GB_COLUMNS_COMMON) == !kind->follows_time);
        g_assert_true((gb_loading_modes[k]->decide_again != NULL) == kind->changes);
        const bool rate = gb_params_find("loading", "rate")->kinds >> k & 1u;
        const bool unloads = gb_params_find("loading", "unload_from")->kinds >> k & 1u;
        g_assert_true(rate == kind->given_rate);
        g_assert_true(unloads == kind->unloading_branches);
    }
}

static bool unloads(const struct gb_loading_kind *kind)
{
    return kind->unloading_branches;
}

static bool has_cell(const struct gb_loading_kind *kind)
{
    return kind->periodic_cell;
}

static void test_lookup(void)
{
    char names[80];
    struct gb_params params = scene_params(NULL);
    for (int k = 0; k < GB_LOADING_KINDS; k++) {
        params.kind = k;
        g_assert_true(gb_loading_kind_of(&params) == &gb_loading_kind_table[k]);
    }
    g_assert_cmpstr(gb_loading_kind_names(unloads, names, sizeof names), ==,
                    "quasistatic");
    g_assert_cmpstr(gb_loading_kind_names(has_cell, names, sizeof names), ==,
                    "quasistatic or dynamic");
}

static bool always(void *data)
{
    (void)data;
    return true;
}

static void check_cancelled(const struct gb_params *params)
{
    const struct gb_model model = scene_model(params);
    struct gb_loading *loading = NULL;
    struct gb_error err = {0};
    g_assert_false(gb_loading_create(&loading, params, &model, always, NULL, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_CANCELLED);
    g_assert_null(loading);
}

/* To the end: MORE within a step, POINT at recorded points, DONE, each of them seen. */
static void check_done(const struct gb_params *params)
{
    const struct gb_model model = scene_model(params);
    struct gb_loading *loading = NULL;
    struct gb_error err = {0};
    struct gb_event_queue events = {0};
    enum gb_step_outcome outcome = GB_STEP_MORE;
    int seen[GB_STEP_STOPPED + 1] = {0};
    g_assert_true(gb_loading_create(&loading, params, &model, NULL, NULL, &err));
    while (outcome == GB_STEP_MORE) {
        outcome = loading->mode->advance(loading, 1, &events, &err);
        seen[outcome]++;
        if (outcome == GB_STEP_POINT) {
            outcome = loading->mode->after_point(loading, &events, &err);
            seen[outcome]++;
        }
    }
    g_assert_cmpint(outcome, ==, GB_STEP_DONE);
    g_assert_cmpint(seen[GB_STEP_MORE], >, 0);
    g_assert_cmpint(seen[GB_STEP_POINT], >, 0);
    g_assert_cmpint(gb_loading_evaluations(loading), >, 0);
    gb_loading_destroy(loading);
}

static void test_outcomes(void)
{
    const struct gb_params quasistatic =
        scene_params("loading.until=density = 0.242", NULL);
    const struct gb_params dynamic = scene_params(
        "scene.kind=dynamic", "loading.until=density = 0.245", "loading.relax=1 ps",
        "loading.hold=1 ps", "loading.rate=6.8e9 1/s", NULL);
    check_cancelled(&quasistatic);
    check_cancelled(&dynamic);
    check_done(&quasistatic);
    check_done(&dynamic);
}

/* A small bed, pressed to a tenth of the pressure of the other die tests. */
static void test_die(void)
{
    const struct gb_params die = die_params("particles.count=40", "loading.until=5 MPa",
                                            "loading.record_pressure=1 MPa", NULL);
    check_cancelled(&die);
    check_done(&die);
}

/* Too few evaluations leave a residual far above the tolerance: STOPPED, with the error. */
static void test_stopped(void)
{
    const struct gb_params params =
        scene_params("loading.until=density = 0.3", "numerics.tolerance=1e-9",
                     "numerics.max_evaluations=20", NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_loading *loading = NULL;
    struct gb_error err = {0};
    struct gb_event_queue events = {0};
    g_assert_true(gb_loading_create(&loading, &params, &model, NULL, NULL, &err));
    g_assert_cmpint(loading->mode->advance(loading, 1000, &events, &err), ==,
                    GB_STEP_STOPPED);
    g_assert_cmpint(err.code, ==, GB_ERR_NOT_CONVERGED);
    gb_loading_destroy(loading);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/loading/rows", test_rows);
    g_test_add_func("/loading/properties", test_properties);
    g_test_add_func("/loading/lookup", test_lookup);
    g_test_add_func("/loading/outcomes", test_outcomes);
    g_test_add_func("/loading/die", test_die);
    g_test_add_func("/loading/stopped", test_stopped);
    return g_test_run();
}
