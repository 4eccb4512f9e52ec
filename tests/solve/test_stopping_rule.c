/* Where a relaxation ends in each unit of numerics.tolerance. */
#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/scene.h"
#include "scene/normal_law.h"
#include "solve/relax/relax.h"

static const char *const scales[] = {"contact", "attraction", "displacement"};

enum { PARTICLES = 10 };

/* Five equal pairs without bridges and friction, h deep, in a cell of 3 x 3 x 58 d: other
 * pairs and images are beyond the cutoff. */
struct pair {
    struct gb_model model;
    struct gb_world *world;
    double force, pull, stiffness, equilibrium; /* by the printed formulas */
};

/* P1 (1): f_e / (E d^2) and its slope, nu = 0.25. */
static double elastic(double h)
{
    const double m = 0.75 / (0.5 * 1.25);
    return pow(h, 1.5) / (3.0 * (1.0 - 0.0625)) - 0.25 * G_PI * m * (h + log(1.0 - h));
}

static double slope(double h)
{
    const double m = 0.75 / (0.5 * 1.25);
    return sqrt(h) / (2.0 * (1.0 - 0.0625)) + 0.25 * G_PI * m * h / (1.0 - h);
}

/* P1 (3) at r = d over E d^2: alumina, d = 9.7 nm, alpha = 0.24. */
static double attraction(void)
{
    const double d = 9.7e-9, gap = 0.24 * 0.392e-9, far = d + gap;
    const double energy = 1224.0 * 1.380649e-23;
    const double ends = far * far - d * d;
    const double newton =
        G_PI * G_PI / 3.0 * 2.0 * energy * pow(d, 6.0) / (pow(far, 3.0) * ends * ends);
    return newton / (382e9 * d * d);
}

/* f_e(h) = f_a by bisection. */
static double equilibrium(double pull)
{
    double low = 0.0, high = 0.1;
    for (int i = 0; i < 80; i++) {
        const double h = 0.5 * (low + high);
        *(elastic(h) < pull ? &low : &high) = h;
    }
    return low;
}

static void pair_open(struct pair *pair, double h, const char *scale,
                      const char *precision)
{
    char named[64], set[64];
    g_snprintf(named, sizeof named, "numerics.tolerance_scale=%s", scale);
    g_snprintf(set, sizeof set, "numerics.precision=%s", precision);
    const struct gb_params params = scene_params(
        "particles.count=10", "structure.base=3 d", "structure.density=0.01",
        "contact.bridge_length=1 d", "contact.mu=0", "contact.alpha=0.24",
        "numerics.relaxer=fire", "numerics.tolerance=0.01", named, set, NULL);
    double position[3 * PARTICLES];
    for (int i = 0; i < PARTICLES; i++) {
        position[3 * i] = position[3 * i + 1] = 1.5;
        position[3 * i + 2] = 5.0 + 10.0 * (i / 2) + (i % 2 ? 1.0 - h : 0.0);
    }
    struct gb_error err = {0};
    pair->model = scene_model(&params);
    g_assert_true(gb_world_create(&pair->world, &pair->model, position, &err));
    pair->pull = attraction();
    pair->equilibrium = equilibrium(pair->pull);
    pair->force = fabs(elastic(h) - pair->pull);
    pair->stiffness = fmax(slope(h), slope(pair->equilibrium));
}

/* The residual by hand. */
static double expected(const struct pair *pair, const char *scale)
{
    if (strcmp(scale, "contact") == 0) {
        return pair->force / fmax(pair->force, pair->pull);
    }
    return strcmp(scale, "attraction") == 0
               ? pair->force / pair->pull
               : pair->force / (pair->stiffness * pair->equilibrium);
}

/* A tolerance just above the residual ends the relaxation at its first evaluation, one
 * just below does not. */
static void check_pair(double h, const char *scale, const char *precision)
{
    const double width = strcmp(precision, "double") == 0 ? 1e-6 : 1e-3;
    for (int above = 0; above < 2; above++) {
        struct pair pair;
        struct gb_relax *relax = NULL;
        struct gb_error err = {0};
        pair_open(&pair, h, scale, precision);
        g_assert_true(gb_relax_create(&relax, &pair.model, &err));
        const double residual = expected(&pair, scale);
        relax->tolerance = residual * (above ? 1.0 + width : 1.0 - width);
        gb_relax_start(relax, pair.world);
        const enum gb_relax_outcome outcome =
            gb_relax_advance(relax, pair.world, 1, &err);
        g_test_message("%s, h = %g, %s: %.12g, by hand %.12g", scale, h, precision,
                       relax->residual, residual);
        g_assert_cmpfloat_with_epsilon(relax->residual, residual, 0.5 * width * residual);
        g_assert_cmpint(outcome, ==, above ? GB_RELAX_DONE : GB_RELAX_MORE);
        gb_relax_destroy(relax);
        gb_world_destroy(pair.world);
    }
}

static void test_pair(void)
{
    static const double overlap[] = {0.004, 0.012, 0.03, 0.06};
    for (size_t s = 0; s < G_N_ELEMENTS(scales); s++) {
        for (size_t k = 0; k < G_N_ELEMENTS(overlap); k++) {
            check_pair(overlap[k], scales[s], "double");
            check_pair(overlap[k], scales[s], "single");
        }
    }
}

/* Largest force or torque, as a displacement of (15), from the arrays of the particles. */
static double largest_move(struct gb_world *world, double stiffness)
{
    const struct gb_bodies b = gb_world_bodies(world);
    double most = 0.0;
    for (int64_t i = 0; i < b.count; i++) {
        most = fmax(most, gb_vec_length(b.force + 3 * i));
        most = fmax(most, 0.5 / GB_RELAX_INERTIA * gb_vec_length(b.torque + 3 * i));
    }
    return most / stiffness;
}

/* The relaxed packing against its own forces: rms for contact and attraction. */
static void check_packing(struct gb_world *world, const struct gb_relax *relax, int scale)
{
    const struct gb_model *model = gb_world_model(world);
    const struct gb_tally *tally = gb_world_tally(world);
    const double mean = tally->normal_sum / (double)tally->contacts;
    double *sum = g_new0(double, (size_t)model->count);
    const double stiffness = gb_relax_steepest_stiffest(world, sum);
    const double rms = gb_world_residual(world) * fmax(mean, model->adhesion);
    const double found = scale == GB_TOLERANCE_CONTACT ? rms / fmax(mean, model->adhesion)
                         : scale == GB_TOLERANCE_ATTRACTION
                             ? rms / model->adhesion
                             : largest_move(world, stiffness) / model->h_eq;
    g_assert_cmpfloat_with_epsilon(relax->residual, found, 1e-6 * found);
    g_assert_cmpfloat(relax->residual, <=, relax->tolerance);
    g_free(sum);
}

/* Strain steps up to contact forces above the attraction: every relaxer ends each of them
 * where its unit says.  Returns the evaluations. */
static int64_t press(const char *relaxer, int scale, const char *precision, double *load)
{
    char sets[3][64];
    g_snprintf(sets[0], sizeof sets[0], "numerics.relaxer=%s", relaxer);
    g_snprintf(sets[1], sizeof sets[1], "numerics.tolerance_scale=%s", scales[scale]);
    g_snprintf(sets[2], sizeof sets[2], "numerics.precision=%s", precision);
    const struct gb_params params =
        scene_params("particles.diameter=38 nm", "particles.count=100",
                     "numerics.tolerance=0.05", sets[0], sets[1], sets[2], NULL);
    const struct gb_model model = scene_model(&params);
    struct gb_world *world = scene_world(&model);
    struct gb_relax *relax = NULL;
    struct gb_error err = {0};
    int64_t spent = 0;
    g_assert_true(gb_relax_create(&relax, &model, &err));
    for (int step = 0; step < 77; step++) {
        static const double factor[3] = {0.996, 0.996, 0.996};
        gb_relax_start(relax, world);
        g_assert_cmpint(gb_relax_advance(relax, world, 200000, &err), ==, GB_RELAX_DONE);
        check_packing(world, relax, scale);
        spent += relax->evaluations;
        gb_world_strain(world, factor);
    }
    const struct gb_tally *tally = gb_world_tally(world);
    *load = tally->normal_sum / (double)tally->contacts / model.adhesion;
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    return spent;
}

static void test_packing(void)
{
    static const char *const precision[] = {"double", "single"};
    for (int m = 0; gb_relax_table()[m]; m++) {
        for (int p = 0; p < 2; p++) {
            int64_t spent[G_N_ELEMENTS(scales)];
            double load = 0.0;
            for (int s = 0; s < (int)G_N_ELEMENTS(scales); s++) {
                spent[s] = press(gb_relax_table()[m]->name, s, precision[p], &load);
                g_test_message(
                    "%s, %s, %s: %" G_GINT64_FORMAT " evaluations, mean force %.3g f_a",
                    gb_relax_table()[m]->name, scales[s], precision[p], spent[s], load);
                g_assert_cmpfloat(load, >, 2.0);
            }
            /* under load an attraction is less than a contact force */
            g_assert_true(gb_relax_table()[m]->light < 1.0 || spent[1] > spent[0]);
        }
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/stopping-rule/pair", test_pair);
    g_test_add_func("/stopping-rule/packing", test_packing);
    return g_test_run();
}
