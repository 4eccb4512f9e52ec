/* Times forces and motion of the spheres of a LAMMPS data file (atom_style sphere), as
 * peer_time.lmp does: Hertz, Mindlin with history, Coulomb, damping, one core.
 * Usage: time_spheres FILE [BATCHES]
 * Prints coordination, virial, and the median processor time of a step per sphere. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "base/clock.h"
#include "base/vec.h"
#include "measure/observe.h"
#include "pack/die/bed_list.h"
#include "solve/loading/die/die_state.h"
#include "spheres.h"

enum { STEPS = 100 };

/* Far from the walls of a wide die. */
static bool settle(struct gb_bed **bed, const GArray *spheres, struct gb_error *err)
{
    const struct sphere *sphere = &g_array_index(spheres, struct sphere, 0);
    const int64_t count = spheres->len;
    const struct gb_elastic elastic = {1.0, 0.25};
    struct gb_bed_law law = {.mu = 0.2, .damping = 0.1};
    double *radius = g_new(double, (gsize)count), far = 0.0, low = 0.0;
    gb_law_hertz_init(&law.normal.hertz, &elastic, &elastic);
    law.shear = 4.0 * law.normal.hertz.shear / law.normal.hertz.modulus;
    for (int64_t i = 0; i < count; i++) {
        radius[i] = 0.5;
        far = fmax(far, hypot(sphere[i].x[0], sphere[i].x[1]));
        low = fmin(low, sphere[i].x[2]);
    }
    const struct gb_die die = {.radius = far + 10.0};
    const bool done = gb_bed_create(bed, count, radius, &die, &law, 1.0, err);
    for (int64_t i = 0; done && i < count; i++) {
        memcpy((*bed)->position[i], sphere[i].x, sizeof sphere->x);
        memcpy((*bed)->velocity[i], sphere[i].v, sizeof sphere->v);
        gb_vec_add((*bed)->roll[i], radius[i], sphere[i].w);
        (*bed)->position[i][2] += 10.0 - low;
    }
    g_free(radius);
    return done && gb_bed_list_renumber(*bed, err); /* LAMMPS sorts them as well */
}

/* Sum of force times distance over the contacts, divided by the dimension. */
static double virial(const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t s = 0; s < bed->pairs.count; s++) {
        if (bed->pairs.contacts.normal[s] > 0.0) {
            double unit[3], force[3];
            gb_observe_die_force(bed, s, unit, force);
            const double *a = bed->position[bed->pairs.first[s]];
            const double *b = bed->position[bed->pairs.other[s]];
            for (int k = 0; k < 3; k++) {
                sum += force[k] * (a[k] - b[k]) / 3.0;
            }
        }
    }
    return sum;
}

static bool time_steps(struct gb_bed *bed, int batches, struct gb_error *err)
{
    struct gb_leapfrog leapfrog;
    struct gb_contact_counts counts;
    double *batch = g_new(double, (gsize)batches);
    gb_die_state_leapfrog_init(&leapfrog, 0.5, 1e-3);
    bool good = gb_bed_evaluate(bed, 0.0, 0.0, err);
    if (good) {
        gb_observe_die_contacts(bed, &counts, NULL, 0, NULL);
        printf("coordination %.6f\nvirial %.8g\n", counts.coordination, virial(bed));
    }
    for (int b = -1; b < batches && good; b++) { /* the first one warms up */
        const double start = gb_clock_process_s();
        for (int k = 0; k < STEPS && good; k++) {
            good = gb_die_state_leapfrog_step(&leapfrog, bed, err);
        }
        batch[b < 0 ? 0 : b] = (gb_clock_process_s() - start) / STEPS;
    }
    if (good) {
        gsl_sort(batch, 1, (size_t)batches);
        printf("step %.5f us per sphere\n",
               1e6 * gsl_stats_median_from_sorted_data(batch, 1, (size_t)batches) /
                   (double)bed->count);
    }
    g_free(batch);
    return good;
}

int main(int argc, char **argv)
{
    struct gb_error err = {0};
    struct gb_bed *bed = NULL;
    struct spheres spheres;
    const int batches = argc > 2 ? atoi(argv[2]) : 15;
    g_set_prgname("time_spheres");
    if (argc < 2 || batches < 1) {
        fputs("usage: time_spheres FILE [BATCHES]\n", stderr);
        return 2;
    }
    bool done = spheres_read(argv[1], &spheres);
    if (done) {
        done = (settle(&bed, spheres.row, &err) && time_steps(bed, batches, &err)) ||
               spheres_fail(err.text, argv[1]);
    }
    gb_bed_destroy(bed);
    g_array_free(spheres.row, TRUE);
    return done ? 0 : 2;
}
