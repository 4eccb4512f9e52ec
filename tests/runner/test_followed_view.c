/* The packing of a run of another process: that of its state.h5, and of each new one. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "base/mat.h"
#include "common/patience.h"
#include "common/run_directory.h"
#include "common/scene.h"
#include "io/state.h"
#include "runner/runner.h"

/* A run that goes on until it is stopped. */
static struct gb_params long_scene(void)
{
    return scene_params("particles.count=60", "loading.until=density = 0.9",
                        "loading.step=0.01 %", "numerics.fidelity=fast",
                        "numerics.threads=1", "output.checkpoint_every=1000 s", NULL);
}

static void wait_for_points(struct gb_runner *runner, size_t points)
{
    const gint64 from = g_get_monotonic_time();
    while (gb_curve_count(gb_runner_curve(runner)) < points) {
        patience_check(from, "points of the run");
        g_usleep(1000);
    }
}

/* Writes the present state to state.h5, and waits for it; the run pauses, so that none
 * follows. */
static void store(struct gb_runner *runner)
{
    const gint64 from = g_get_monotonic_time();
    g_assert_true(gb_runner_send(runner, GB_COMMAND_PAUSE));
    const int64_t before = gb_runner_stored(runner);
    g_assert_true(gb_runner_send(runner, GB_COMMAND_STORE));
    while (gb_runner_stored(runner) == before) {
        patience_check(from, "the state of the run");
        g_usleep(1000);
    }
}

static struct gb_state *read_state(const struct run_directory *run_dir)
{
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    g_assert_true(gb_state_read(&state, run_dir->state, &err));
    return state;
}

/* The sample shows the particles of a state at their places; all of them fit. */
static bool shows(const struct gb_view_sample *sample, const struct gb_state *state)
{
    bool same = sample->valid && sample->count == state->count &&
                sample->density == state->point.density;
    for (int64_t i = 0; i < state->count && same; i++) {
        for (int k = 0; k < 3; k++) {
            same = same && fabs((double)sample->position[i][k] -
                                state->position[3 * i + k]) < 1e-5;
        }
    }
    return same;
}

static void wait_for_view(struct gb_runner *follower, const struct gb_state *state)
{
    const gint64 from = g_get_monotonic_time();
    while (!shows(gb_runner_view_sample(follower, NULL), state)) {
        patience_check(from, "the packing of the state");
        g_usleep(1000);
    }
}

/* Of a run under way, its state and the next one; of a run that has ended, its last. */
static void test_states(void)
{
    const struct gb_params params = long_scene();
    struct run_directory run_dir = run_directory_make("run");
    struct gb_runner *runner = NULL, *follower = NULL;
    struct gb_state *state[2];
    struct gb_error err = {0};
    g_assert_true(gb_runner_create_in(&runner, &params, run_dir.directory, &err));
    wait_for_points(runner, 3);
    store(runner);
    state[0] = read_state(&run_dir);
    g_assert_true(gb_runner_follow(&follower, run_dir.directory, &err));
    wait_for_view(follower, state[0]);
    g_assert_true(gb_runner_send(runner, GB_COMMAND_RESUME));
    wait_for_points(runner, gb_curve_count(gb_runner_curve(runner)) + 5);
    store(runner);
    state[1] = read_state(&run_dir);
    g_assert_cmpfloat(state[1]->point.density, >, state[0]->point.density);
    wait_for_view(follower, state[1]);
    gb_runner_destroy(follower);
    gb_runner_destroy(runner);
    gb_state_destroy(state[1]);
    state[1] = read_state(&run_dir);
    g_assert_true(gb_runner_follow(&follower, run_dir.directory, &err));
    wait_for_view(follower, state[1]);
    gb_runner_destroy(follower);
    for (int k = 0; k < 2; k++) {
        gb_state_destroy(state[k]);
    }
    run_directory_finish(&run_dir);
}

/* An affine shear moves no particle relative to its cell, and the upright window holds all
 * particles of a tilted cell. */
static void test_tilted(void)
{
    enum { COUNT = 50 };
    struct gb_view_start start = {0};
    struct gb_view_sample *sample = g_new0(struct gb_view_sample, 1);
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    GRand *random = g_rand_new_with_seed(2);
    g_assert_true(gb_state_create(&state, COUNT, 0, &err));
    state->dimension = 3;
    for (int k = 0; k < 3; k++) {
        state->cell[k] = 6.0 + k;
    }
    for (int k = 0; k < 3 * COUNT; k++) {
        state->position[k] = g_rand_double_range(random, 0.0, state->cell[k % 3]);
    }
    gb_runner_view_of_state(state, true, &start, sample);
    const struct gb_deformation shear = {
        .f = {{1.1, -0.1, 0.3}, {0.0, 0.9, -0.2}, {0.0, 0.0, 0.8}}};
    struct gb_cell cell = gb_state_cell(state);
    gb_cell_deform(&cell, &shear);
    memcpy(state->cell, cell.edge, sizeof cell.edge);
    memcpy(state->tilt, cell.tilt, sizeof cell.tilt);
    for (int64_t i = 0; i < COUNT; i++) {
        double at[3];
        gb_mat_apply(shear.f, state->position + 3 * i, at);
        memcpy(state->position + 3 * i, at, sizeof at);
    }
    gb_runner_view_of_state(state, true, &start, sample);
    g_assert_cmpint(sample->count, ==, COUNT);
    for (int i = 0; i < COUNT; i++) {
        g_assert_cmpfloat(sample->value[GB_VIEW_VALUE_DISPLACEMENT][i], <, 1e-6);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(sample->position[i][k], >=, 0.0);
            g_assert_cmpfloat(sample->position[i][k], <=, sample->window[k] + 1e-6);
        }
    }
    gb_runner_view_start_finish(&start);
    gb_state_destroy(state);
    g_rand_free(random);
    g_free(sample);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/runner/followed-view/states", test_states);
    g_test_add_func("/runner/followed-view/tilted", test_tilted);
    return g_test_run();
}
