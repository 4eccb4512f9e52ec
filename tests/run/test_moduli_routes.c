/* Moduli of compacts by two independent routes (suite slow): probes, and the slope of an
 * unloading branch at its beginning.
 *
 * Both begin at the same relaxed state of a uniaxially pressed cell.  The branch is a
 * sequence of expansions along z, each relaxed by FIRE from the end of the last one; the
 * probe is one increment relaxed by Newton's method.  Contacts at their friction cap slide
 * one way and stick the other, so the slope of unloading is that of a probe by expansion;
 * C, the mean of both ways, is smaller. */
#include <glib.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

#include "base/deformation.h"
#include "common/scene.h"
#include "pack/cell/world.h"
#include "run/experiment.h"
#include "scene/tolerances.h"
#include "solve/moduli/moduli.h"
#include "solve/moduli/probe.h"
#include "solve/relax/relax.h"

enum { CELLS = 8, STEPS = 11 };

/* The mean of both ways over the slope of unloading. */
static const double least_mean = 0.8, most_mean = 1.005;

/* Moduli of a compression along z, E: dp_z/de, and the mean of dp_x/de and dp_y/de. */
struct slopes {
    double c33, c13;
};

struct cell {
    double pz; /* E */
    struct slopes mean, probe, branch;
};

static struct gb_experiment *press(const struct gb_params *params)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    enum gb_step_outcome outcome = GB_STEP_MORE;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    while (outcome != GB_STEP_DONE) {
        outcome = gb_experiment_advance(experiment, 100000, &err);
        if (outcome == GB_STEP_STOPPED) {
            g_error("%s", err.text);
        }
    }
    return experiment;
}

static struct slopes slopes_of(const double before[3][3], const double after[3][3],
                               double compression)
{
    const double lateral = after[0][0] + after[1][1] - before[0][0] - before[1][1];
    return (struct slopes){(after[2][2] - before[2][2]) / compression,
                           0.5 * lateral / compression};
}

/* One expansion of the relaxed copy by Newton's method. */
static struct slopes probe_expansion(struct gb_probe *probe, double size)
{
    struct gb_error err = {0};
    double strain[3][3], pressure[3][3];
    gb_moduli_strain(2, size, strain);
    if (!gb_probe_strain(probe, (const double(*)[3])strain, 0.0, GB_PROBE_SHARE, pressure,
                         &err)) {
        g_error("%s", err.text);
    }
    return slopes_of((const double(*)[3])probe->pressure, (const double(*)[3])pressure,
                     -size);
}

static void relax(struct gb_relax *relax, struct gb_world *world)
{
    struct gb_error err = {0};
    enum gb_relax_outcome outcome = GB_RELAX_MORE;
    gb_relax_start(relax, world);
    while (outcome == GB_RELAX_MORE) {
        outcome = gb_relax_advance(relax, world, 1000, &err);
    }
    if (outcome != GB_RELAX_DONE) {
        g_error("not relaxed: residual %.1e %s", relax->residual, err.text);
    }
}

/* Slope at the first point of a parabola through it, by least squares. */
static double first_slope(const double x[STEPS], const double y[STEPS])
{
    double xx = 0.0, xxx = 0.0, xxxx = 0.0, xy = 0.0, xxy = 0.0;
    for (int i = 1; i < STEPS; i++) {
        const double from = x[i] - x[0], rise = y[i] - y[0], square = from * from;
        xx += square;
        xxx += square * from;
        xxxx += square * square;
        xy += from * rise;
        xxy += square * rise;
    }
    return (xy * xxxx - xxy * xxx) / (xx * xxxx - xxx * xxx);
}

/* A world and its relaxer at the saved state of the probe. */
static void copy_state(const struct gb_probe *probe, struct gb_world **world,
                       struct gb_relax **fire)
{
    struct gb_error err = {0};
    struct gb_world_copy *start = NULL;
    if (!gb_probe_save(probe, &start, &err) ||
        !gb_world_create(world, &probe->model, gb_world_position(probe->world), &err) ||
        !gb_world_copy_restore(*world, start, &err) || !gb_world_evaluate(*world, &err) ||
        !gb_relax_create(fire, &probe->model, &err)) {
        g_error("%s", err.text);
    }
    gb_world_copy_destroy(start);
}

/* The branch in steps of `size`.  In the first one FIRE settles: where Newton's method has
 * found an equilibrium that is not stable, the stress jumps. */
static struct slopes unload(const struct gb_probe *probe, double size)
{
    struct gb_world *world = NULL;
    struct gb_relax *fire = NULL;
    const double factor[3] = {1.0, 1.0, 1.0 + size};
    const struct gb_deformation expansion = gb_deformation_scaling(factor);
    double x[STEPS], c33[STEPS], c13[STEPS], pressure[3][3];
    copy_state(probe, &world, &fire);
    /* a share of the strain, and above what rounding leaves */
    fire->tolerance = fmax(1e-3 * size, 2e-11);
    for (int i = 0; i < STEPS; i++) {
        gb_world_deform(world, &expansion);
        relax(fire, world);
        gb_world_pressure(world, pressure);
        const struct slopes rise = slopes_of((const double(*)[3])probe->pressure,
                                             (const double(*)[3])pressure, -1.0);
        x[i] = (i + 1) * log1p(size);
        c33[i] = rise.c33;
        c13[i] = rise.c13;
    }
    gb_relax_destroy(fire);
    gb_world_destroy(world);
    return (struct slopes){first_slope(x, c33), first_slope(x, c13)};
}

static struct cell measure(const struct gb_params *params)
{
    struct gb_error err = {0};
    struct gb_probe *probe = NULL;
    struct gb_moduli moduli;
    const struct gb_moduli_options options = {.range = false};
    struct gb_experiment *experiment = press(params);
    const struct gb_world *world = gb_experiment_world(experiment);
    if (!gb_moduli_measure(&moduli, world, &options, &err) ||
        !gb_probe_create(&probe, world, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    const struct cell cell = {
        .pz = moduli.pressure[2][2],
        .mean = {moduli.c[2][2], 0.5 * (moduli.c[0][2] + moduli.c[1][2])},
        .probe = probe_expansion(probe, moduli.strain),
        .branch = unload(probe, moduli.strain)};
    g_test_message("p_z %.3g, strain %.0e: C33 %.6f probe %.6f branch %.6f, C13 %.6f "
                   "probe %.6f branch %.6f (E)",
                   cell.pz, moduli.strain, cell.mean.c33, cell.probe.c33, cell.branch.c33,
                   cell.mean.c13, cell.probe.c13, cell.branch.c13);
    gb_probe_destroy(probe);
    gb_experiment_destroy(experiment);
    return cell;
}

/* Of one modulus over the cells. */
struct sample {
    double mean[CELLS], probe[CELLS], branch[CELLS];
};

static double standard_error(const double *value)
{
    return gsl_stats_sd(value, 1, CELLS) / sqrt(CELLS);
}

/* The routes agree cell by cell, and on average within the error over the cells. */
static void judge(const char *name, const struct sample *sample, double accepted,
                  double gpa)
{
    double share[CELLS];
    for (int c = 0; c < CELLS; c++) {
        share[c] = sample->branch[c] / sample->probe[c] - 1.0;
    }
    const double probe = gsl_stats_mean(sample->probe, 1, CELLS);
    const double branch = gsl_stats_mean(sample->branch, 1, CELLS);
    const double mean = gsl_stats_mean(sample->mean, 1, CELLS);
    const double difference = gsl_stats_mean(share, 1, CELLS);
    g_test_message("%s GPa: probe %.3f +- %.3f, branch %.3f +- %.3f, difference %.2f +- "
                   "%.2f %%; both ways %.3f +- %.3f",
                   name, gpa * probe, gpa * standard_error(sample->probe), gpa * branch,
                   gpa * standard_error(sample->branch), 100.0 * difference,
                   100.0 * standard_error(share), gpa * mean,
                   gpa * standard_error(sample->mean));
    g_assert_cmpfloat(fabs(difference), <=, accepted);
    g_assert_cmpfloat(fabs(branch - probe), <=, standard_error(sample->probe));
    g_assert_cmpfloat(mean / branch, >=, least_mean);
    g_assert_cmpfloat(mean / branch, <=, most_mean);
}

struct system {
    const char *name, *assignment[6];
};

static const struct system system_one = {
    "I",
    {"particles.diameter=10.4 nm", "contact.alpha=0.37", "contact.mu=0.13",
     "contact.bridge_length=1 d", "contact.shear_strength=auto", NULL}};
static const struct system system_two = {"II", {NULL}};

/* K and G are those of an isotropic body with this C33 and C13. */
static void compare(const struct system *system, const char *until)
{
    enum { C33, C13, BULK, SHEAR, MODULI };
    static const char *const names[MODULI] = {"C33", "C13", "K", "G"};
    static const double weight[MODULI][2] = {
        {1.0, 0.0}, {0.0, 1.0}, {1.0 / 3.0, 2.0 / 3.0}, {0.5, -0.5}};
    /* paired difference of the routes: the branch feels contacts that slide or open within
     * its strain, and C13 is a quarter of C33 */
    static const double accepted[MODULI] = {0.005, 0.02, 0.01, 0.01};
    struct sample sample[MODULI];
    double gpa = 0.0;
    for (int c = 0; c < CELLS; c++) {
        struct gb_error err = {0};
        struct gb_params params =
            scene_params("particles.count=1000", "structure.base=9 d", until, NULL);
        for (int i = 0; system->assignment[i] != NULL; i++) {
            g_assert_true(gb_params_assign(&params, system->assignment[i], &err));
        }
        params.seed = (uint64_t)c + 1;
        gpa = 1e-9 * params.young_pa;
        const struct cell cell = measure(&params);
        for (int k = 0; k < MODULI; k++) {
            const double *w = weight[k];
            sample[k].mean[c] = w[0] * cell.mean.c33 + w[1] * cell.mean.c13;
            sample[k].probe[c] = w[0] * cell.probe.c33 + w[1] * cell.probe.c13;
            sample[k].branch[c] = w[0] * cell.branch.c33 + w[1] * cell.branch.c13;
        }
    }
    g_test_message("system %s, %s", system->name, until);
    for (int k = 0; k < MODULI; k++) {
        judge(names[k], &sample[k], accepted[k], gpa);
    }
}

static void test_one_loose(void)
{
    compare(&system_one, "loading.until=density=0.45");
}

static void test_one_dense(void)
{
    compare(&system_one, "loading.until=density=0.55");
}

static void test_two_loose(void)
{
    compare(&system_two, "loading.until=density=0.45");
}

static void test_two_dense(void)
{
    compare(&system_two, "loading.until=density=0.55");
}

/* The smallest strains of both signs change the stress by opposite amounts.  In the second cell
 * the equilibrium nearest to the pressed state is not stable: at any strain particles leave it,
 * and the stress jumps by more than the strain changes it. */
static void test_stable(void)
{
    static const double size = GB_PROBE_STRAIN_MIN;
    for (uint64_t seed = 6; seed <= 8; seed++) {
        struct gb_error err = {0};
        struct gb_probe *probe = NULL;
        struct gb_params params =
            scene_params("particles.count=200", "structure.base=auto",
                         "loading.until=density=0.6", NULL);
        params.seed = seed;
        struct gb_experiment *experiment = press(&params);
        double pressure[2][3][3], apart = 0.0, change = 0.0;
        if (!gb_probe_create(&probe, gb_experiment_world(experiment), NULL, NULL, &err)) {
            g_error("%s", err.text);
        }
        for (int side = 0; side < 2; side++) {
            const double e = side == 0 ? size : -size;
            const double strain[3][3] = {{0.0, 0.0, e}, {0.0, 0.0, 0.0}, {e, 0.0, e}};
            if (!gb_probe_strain(probe, strain, 0.0, GB_PROBE_SHARE, pressure[side],
                                 &err)) {
                g_error("%s", err.text);
            }
        }
        for (int k = 0; k < 9; k++) {
            const double rest = probe->pressure[k / 3][k % 3];
            const double one = pressure[0][k / 3][k % 3] - rest;
            const double other = pressure[1][k / 3][k % 3] - rest;
            apart = fmax(apart, fabs(one + other));
            change = fmax(change, fabs(one - other));
        }
        g_test_message("seed %d: both sides differ by %.2f of the change", (int)seed,
                       apart / change);
        g_assert_cmpfloat(apart, <, 0.5 * change);
        gb_probe_destroy(probe);
        gb_experiment_destroy(experiment);
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/moduli-stable", test_stable);
    g_test_add_func("/moduli-routes/one/0.45", test_one_loose);
    g_test_add_func("/moduli-routes/one/0.55", test_one_dense);
    g_test_add_func("/moduli-routes/two/0.45", test_two_loose);
    g_test_add_func("/moduli-routes/two/0.55", test_two_dense);
    return g_test_run();
}
