/* Times forces and motion of the packing in a LAMMPS data file, in its periodic box, as
 * peer_time.lmp does: Hertz, Mindlin with history, Coulomb; one core, single precision,
 * moved by FIRE.
 * Usage: time_packing FILE [BATCHES]
 * Prints coordination, virial, and the median processor time of a step per sphere. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "greenbody/params.h"
#include "measure/observe.h"
#include "pack/cell/world.h"
#include "pack/structure/hilbert.h"
#include "solve/relax/relax.h"
#include "spheres.h"

enum { STEPS = 100 };

/* So that something moves, and every spring is stretched, each batch begins with it. */
static const double strain = 1e-4;

static bool scene(struct gb_model *model, const struct spheres *spheres,
                  struct gb_error *err)
{
    static const char *const assignment[] = {
        "contact.normal=hertz",      "contact.mu=0.2",
        "material.poisson=0.25",     "numerics.relaxer=fire",
        "numerics.precision=single", "numerics.threads=1",
    };
    struct gb_params params;
    gb_params_init(&params);
    params.count = spheres->row->len;
    for (size_t k = 0; k < G_N_ELEMENTS(assignment); k++) {
        if (!gb_params_assign(&params, assignment[k], err)) {
            return false;
        }
    }
    if (!gb_model_init(model, &params, err)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        model->edges[k] = spheres->high[k] - spheres->low[k];
    }
    return true;
}

static bool settle(struct gb_world **world, const struct gb_model *model,
                   const struct spheres *spheres, struct gb_error *err)
{
    struct gb_cell cell;
    double *x = gb_alloc_array(3 * (size_t)model->count, sizeof *x, err);
    gb_cell_init(&cell, 3, model->edges);
    for (int64_t i = 0; x && i < model->count; i++) {
        const struct sphere *sphere = &g_array_index(spheres->row, struct sphere, i);
        for (int k = 0; k < 3; k++) {
            x[3 * i + k] = sphere->x[k] - spheres->low[k];
        }
        gb_cell_wrap(&cell, x + 3 * i);
    }
    const bool done =
        x && gb_hilbert_sort(model, x, err) && gb_world_create(world, model, x, err);
    gb_alloc_free(x);
    return done;
}

static double virial(const struct gb_world *world)
{
    double sum[3][3];
    gb_world_virial(world, sum);
    return (sum[0][0] + sum[1][1] + sum[2][2]) / 3.0;
}

static bool time_steps(struct gb_world *world, struct gb_relax *relax, int batches,
                       struct gb_error *err)
{
    static const double factor[3] = {1.0, 1.0, 1.0 - strain};
    struct gb_contact_counts counts;
    double *batch = g_new(double, (gsize)batches);
    gb_relax_start(relax, world);
    bool good = gb_relax_evaluate(relax, world, err);
    if (good) {
        gb_observe_contacts(world, &counts, NULL, 0, NULL);
        printf("coordination %.6f\nvirial %.8g\n", counts.coordination, virial(world));
    }
    for (int b = -1; b < batches && good; b++) { /* the first one warms up */
        gb_world_strain(world, factor);
        gb_relax_start(relax, world);
        good = gb_relax_evaluate(relax, world, err);
        const double start = gb_clock_process_s();
        for (int k = 0; k < STEPS && good; k++) {
            relax->method->move(relax, world);
            good = gb_relax_evaluate(relax, world, err);
        }
        batch[b < 0 ? 0 : b] = (gb_clock_process_s() - start) / STEPS;
    }
    if (good) {
        gsl_sort(batch, 1, (size_t)batches);
        printf("step %.5f us per sphere\n",
               1e6 * gsl_stats_median_from_sorted_data(batch, 1, (size_t)batches) /
                   (double)gb_world_bodies(world).count);
    }
    g_free(batch);
    return good;
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_model model;
    struct gb_world *world = NULL;
    struct gb_relax *relax = NULL;
    struct spheres spheres;
    const int batches = argc > 2 ? atoi(argv[2]) : 15;
    g_set_prgname("time_packing");
    if (argc < 2 || batches < 1) {
        fputs("usage: time_packing FILE [BATCHES]\n", stderr);
        return 2;
    }
    bool done = spheres_read(argv[1], &spheres);
    if (done) {
        done = (scene(&model, &spheres, &err) && settle(&world, &model, &spheres, &err) &&
                gb_relax_create(&relax, &model, &err) &&
                time_steps(world, relax, batches, &err)) ||
               spheres_fail(err.text, argv[1]);
    }
    gb_relax_destroy(relax);
    gb_world_destroy(world);
    g_array_free(spheres.row, TRUE);
    return done ? 0 : 2;
}
