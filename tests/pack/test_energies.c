/* Random packings: forces and pressures are minus the derivatives of the energy of the whole
 * packing, along random motions and strains, within the error of the difference. */
#include <float.h>
#include <glib.h>
#include <math.h>

#include "base/vec.h"
#include "common/transform.h"
#include "measure/observe.h"

/* Without stored springs a contact gives back what it took: bridges of any length, and their
 * lines where a contact opens. */
static struct gb_model random_model(GRand *random)
{
    static const char *const laws[] = {
        "contact.bridge_length=0.008 d",
        "contact.bridge_length=1 d",
        "material.epsilon=0 kB",
    };
    char length[48], poisson[48], seed[48];
    const bool plane = cases_choice(random, 3) == 0;
    g_snprintf(length, sizeof length, "contact.alpha=%.3f",
               cases_between(random, 0.2, 0.5));
    g_snprintf(poisson, sizeof poisson, "material.poisson=%.3f",
               cases_between(random, 0.0, 0.4));
    g_snprintf(seed, sizeof seed, "structure.seed=%d", cases_choice(random, 1000000));
    const struct gb_params params = scene_params(
        plane ? "scene.dimension=2" : "scene.dimension=3",
        plane ? "particles.count=80" : "particles.count=200",
        laws[cases_choice(random, G_N_ELEMENTS(laws))], length, poisson, seed,
        "contact.mu=0", "contact.mu_pivot=0",
        cases_choice(random, 2) == 1 ? "particles.distribution=lognormal"
                                     : "particles.distribution=mono",
        "particles.median=9.7 nm", "particles.sigma=0.2", "particles.largest=16 nm",
        "numerics.precision=double", "numerics.cutoff=1.1 d", NULL);
    return scene_model(&params);
}

/* A motion of all particles, or a stretch of one axis. */
struct path {
    const double *direction; /* count x 3; NULL: a stretch of the axis */
    int axis;
};

static double energy_at(struct packed *packed, const struct gb_world_copy *copy,
                        const struct path *path, double distance)
{
    struct gb_error err = {0};
    g_assert_true(gb_world_copy_restore(packed->world, copy, &err));
    if (path->direction) {
        const struct gb_bodies b = gb_world_bodies(packed->world);
        for (int64_t i = 0; i < 3 * b.count; i++) {
            b.position[i] += distance * path->direction[i];
        }
    } else {
        double factor[3] = {1.0, 1.0, 1.0};
        factor[path->axis] += distance;
        gb_world_strain(packed->world, factor);
    }
    scene_evaluate(packed->world);
    return gb_observe_elastic(packed->world);
}

/* What the kinks add to the error of the difference: attraction ends with a jump at the
 * cutoff, and has one in its slope where two particles touch. */
static double kinks_within(const struct packed *packed, double reach)
{
    const struct gb_model *model = &packed->model;
    const double *x = gb_world_position(packed->world);
    double sum = 0.0;
    for (int64_t j = 0; j < model->count; j++) {
        for (int64_t i = 0; i < j; i++) {
            double r[3] = {x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                           x[3 * i + 2] - x[3 * j + 2]};
            gb_cell_nearest(gb_world_cell(packed->world), r);
            const double touch = 0.5 * (packed->diameter[i] + packed->diameter[j]),
                         gap = gb_vec_length(r) - touch;
            const bool ends = fabs(gap - model->numerics.cutoff + 1.0) < reach;
            sum += ends || fabs(gap) < reach ? 4.0 * model->adhesion : 0.0;
        }
    }
    return sum;
}

/* Central difference of fourth order. */
static void check_path(struct packed *packed, const struct gb_world_copy *copy,
                       const struct path *path, double want, double scale)
{
    const double step = 1e-6;
    double odd[3];
    for (int k = 1; k <= 2; k++) {
        odd[k] = energy_at(packed, copy, path, k * step) -
                 energy_at(packed, copy, path, -k * step);
    }
    const double size = fabs(energy_at(packed, copy, path, 0.0)) + scale;
    const double second = odd[1] / (2.0 * step);
    const double fourth = (8.0 * odd[1] - odd[2]) / (12.0 * step);
    const double longest =
        path->direction ? 4.0 : 2.0 * gb_world_cell(packed->world)->edge[path->axis];
    const double smooth = fabs(fourth - second) + 64.0 * DBL_EPSILON * size / step;
    const double bound = smooth + kinks_within(packed, 2.0 * step * longest);
    if (!(fabs(fourth - want) <= bound)) {
        g_test_message("energy falls by %.12g, want %.12g within %.3g", -fourth, -want,
                       bound);
        g_test_fail();
    }
    g_assert_cmpfloat(smooth, <=, 1e-7 * scale); /* or it would prove nothing */
}

static void check_energy(GRand *random)
{
    const struct gb_model model = random_model(random);
    struct packed packed;
    struct gb_world_copy *copy = NULL;
    struct gb_error err = {0};
    packed_init(&packed, &model, 0.99, 1e-3, random);
    scene_evaluate(packed.world);
    g_assert_true(gb_world_copy_save(packed.world, &copy, &err));
    const struct gb_bodies b = gb_world_bodies(packed.world);
    const double scale = gb_world_tally(packed.world)->normal_sum;
    double *direction = g_new0(double, (gsize)(3 * b.count)), power = 0.0;
    for (int64_t i = 0; i < 3 * b.count; i++) {
        const bool flat = model.dimension == 2 && i % 3 == 1;
        direction[i] = flat ? 0.0 : cases_between(random, -1.0, 1.0);
        power += b.force[i] * direction[i];
    }
    double pressure[3][3];
    gb_observe_pressure(packed.world, pressure);
    const double volume = gb_cell_volume(gb_world_cell(packed.world));
    check_path(&packed, copy, &(struct path){.direction = direction}, -power, scale);
    for (int k = 0; k < 3; k++) {
        if (model.dimension == 3 || k != 1) {
            check_path(&packed, copy, &(struct path){.axis = k}, -volume * pressure[k][k],
                       scale);
        }
    }
    g_free(direction);
    gb_world_copy_destroy(copy);
    packed_finish(&packed);
}

static void test_energy(void)
{
    cases_run(40, 1000, check_energy);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/energies/slope", test_energy);
    return g_test_run();
}
