/* The velocity update in single precision against the same in double, particle by particle. */
#include <glib.h>
#include <math.h>

#include "common/world.h"
#include "pack/f32/integrate_f32.h"

enum { PARTICLES = 1100 }; /* three blocks, the last tile is not whole */

/* Of one particle: translation and rotation. */
struct state {
    double velocity[2][3], displacement[2][3];
};

static struct state reference(const struct gb_world *world,
                              const struct gb_integrate_f32 *by, int64_t i)
{
    const float *force = world->engine.f32.rows.row[i];
    const float *velocity = world->engine.f32.velocity[i];
    struct state state;
    double speed2 = 0.0;
    for (int part = 0; part < 2; part++) {
        const double mass = gb_world_diameter(world, i) * (part == 0 ? 1.0 : by->inertia);
        for (int c = 0; c < 3; c++) {
            const int at = part * GB_WRENCH_ROWS_TORQUE + c;
            const double before = (double)velocity[at];
            const double after = by->keep * before + by->kick * (double)force[at] / mass;
            state.velocity[part][c] = after;
            state.displacement[part][c] = by->step * after - by->back * before;
            speed2 += part == 0 ? after * after : 0.0;
        }
    }
    const double most = by->displacement_max / by->step, speed = sqrt(speed2);
    const double kept = speed > most ? most / speed : 1.0;
    for (int k = 0; k < 6; k++) {
        state.displacement[k / 3][k % 3] -=
            by->step * (1.0 - kept) * state.velocity[k / 3][k % 3];
        state.velocity[k / 3][k % 3] *= kept;
    }
    return state;
}

static void set_velocities(struct gb_world *world, GRand *random, double usual,
                           double few)
{
    for (int64_t i = 0; i < PARTICLES; i++) {
        const double most = i % 97 == 5 ? few : usual;
        for (int c = 0; c < GB_WRENCH_ROWS_WIDTH; c++) {
            world->engine.f32.velocity[i][c] =
                c % GB_WRENCH_ROWS_TORQUE == 3
                    ? 0.0F
                    : (float)g_rand_double_range(random, -most, most);
        }
    }
}

/* Compares one update with the reference; returns how many particles were slowed down.
 * rounding: of displacements in single precision, d; fixed point rounds to the nearest. */
static int check_update(struct gb_world *world, const struct gb_integrate_f32 *by,
                        double rounding)
{
    const struct gb_f32_state *f32 = &world->engine.f32;
    const struct gb_cell *cell = &world->engine.particles.cell;
    struct state *expected = g_new(struct state, PARTICLES);
    struct gb_f32_particle *before = g_memdup2(f32->particle, PARTICLES * sizeof *before);
    float *total = g_new(float, 3 * PARTICLES);
    double speed2 = 0.0;
    int slow = 0;
    for (int64_t i = 0; i < PARTICLES; i++) {
        expected[i] = reference(world, by, i);
        total[3 * i] = total[3 * i + 1] = total[3 * i + 2] = 0.25F;
        const double limit = by->displacement_max / by->step;
        const double square =
            gb_vec_dot(expected[i].velocity[0], expected[i].velocity[0]);
        speed2 += square + by->inertia * gb_vec_dot(expected[i].velocity[1],
                                                    expected[i].velocity[1]);
        slow += sqrt(square) > limit * (1.0 - 1e-6);
    }
    const double sum = gb_integrate_f32_step(world, by, total);
    g_assert_cmpfloat(fabs(sum / speed2 - 1.0), <, 1e-5);
    for (int64_t i = 0; i < PARTICLES; i++) {
        double moved2 = 0.0;
        for (int c = 0; c < 3; c++) {
            const double *by_c = &expected[i].displacement[0][c];
            const double apart =
                gb_fixed_position_unit(cell, c) *
                gb_fixed_position_difference((uint32_t)f32->particle[i].position[c],
                                             (uint32_t)before[i].position[c]);
            const double rotated = expected[i].displacement[1][c];
            g_assert_cmpfloat(fabs(apart - *by_c), <,
                              0.51 * gb_fixed_position_unit(cell, c) + rounding);
            g_assert_cmpfloat(
                fabs((double)f32->velocity[i][c] - expected[i].velocity[0][c]), <, 1e-6);
            g_assert_cmpfloat(fabs((double)f32->velocity[i][GB_WRENCH_ROWS_TORQUE + c] -
                                   expected[i].velocity[1][c]),
                              <, 1e-6);
            g_assert_cmpfloat(fabs((double)f32->particle[i].rotation[c] - rotated), <,
                              1e-6);
            g_assert_cmpfloat(fabs((double)total[3 * i + c] - 0.25 - rotated), <, 1e-6);
            moved2 += apart * apart;
        }
        g_assert_cmpfloat((double)f32->bound[i / GB_F32_STATE_GROUP] + 1e-8, >=,
                          sqrt(moved2) * (1.0 - 1e-6)); /* a fixed-point unit: 3e-9 */
    }
    g_free(total);
    g_free(before);
    g_free(expected);
    return slow;
}

/* A scene in single precision; sizes: a key of it, or NULL. */
static struct gb_model model_of(const char *sizes)
{
    const struct gb_params params =
        scene_params("particles.count=1100", "numerics.precision=single", sizes, NULL);
    return scene_model(&params);
}

static void check_scene(const char *sizes)
{
    const struct gb_model model = model_of(sizes);
    GRand *random = g_rand_new_with_seed(23);
    struct gb_integrate_f32 by = {
        .keep = 0.9, .kick = 0.6, .back = 0.3, .step = 1.1, .inertia = 0.4};
    static const struct {
        double usual, few, displacement_max, rounding;
        int slow; /* at least so many; 0: none */
    } row[] = {{1e-3, 1e-3, 0.05, 3e-10, 0},
               {1e-3, 0.2, 0.02, 1e-7, 5},
               {0.02, 0.02, 0.01, 1e-8, 500}};
    for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
        struct gb_world *world = scene_world(&model);
        scene_evaluate(world);
        set_velocities(world, random, row[k].usual, row[k].few);
        by.displacement_max = row[k].displacement_max;
        const int slow = check_update(world, &by, row[k].rounding);
        g_assert_true(row[k].slow == 0 ? slow == 0 : slow >= row[k].slow);
        gb_world_destroy(world);
    }
    g_rand_free(random);
}

static void test_equal(void)
{
    check_scene(NULL);
}

static void test_unequal(void)
{
    check_scene("particles.distribution=lognormal");
}

/* Displacements of up to a fourth of an edge along each axis, farther than it in all. */
static void test_far(void)
{
    const struct gb_model model = model_of(NULL);
    struct gb_world *world = scene_world(&model);
    GRand *random = g_rand_new_with_seed(29);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 1e3};
    scene_evaluate(world);
    const double *edge = world->engine.particles.cell.edge;
    const double most = 0.24 * fmin(edge[0], fmin(edge[1], edge[2]));
    set_velocities(world, random, 1e-3, most);
    g_assert_cmpint(check_update(world, &by, 1e-6), ==, 0);
    g_rand_free(random);
    gb_world_destroy(world);
}

/* A number that is not finite is reported, wherever it is. */
static void test_not_finite(void)
{
    const struct gb_model model = model_of(NULL);
    const struct gb_integrate_f32 by = {
        .keep = 1.0, .step = 1.0, .inertia = 0.4, .displacement_max = 0.1};
    static const int64_t at[] = {0, 31, 32, 600, PARTICLES - 1};
    for (size_t k = 0; k < G_N_ELEMENTS(at); k++) {
        for (int c = 0; c < 6; c++) {
            struct gb_world *world = scene_world(&model);
            struct gb_error err = {0};
            scene_evaluate(world);
            world->engine.f32.velocity[at[k]][c + c / 3] = k % 2 == 0 ? NAN : INFINITY;
            g_assert_false(isfinite(gb_integrate_f32_step(world, &by, NULL)));
            g_assert_false(gb_world_evaluate_along(world, NULL, NULL, &err));
            g_assert_cmpint(err.code, ==, GB_ERR_GUARD);
            gb_world_destroy(world);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/integrate-f32/equal", test_equal);
    g_test_add_func("/integrate-f32/unequal", test_unequal);
    g_test_add_func("/integrate-f32/far", test_far);
    g_test_add_func("/integrate-f32/not-finite", test_not_finite);
    return g_test_run();
}
