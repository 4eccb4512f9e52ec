/* Times forces and motion of the spheres of a LAMMPS data file (atom_style sphere), as
 * peer_time.lmp does: Hertz, Mindlin with history, Coulomb, damping, one core.
 * Usage: time_spheres FILE [BATCHES]
 * Prints coordination, virial, and the median processor time of a step per sphere. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <glib.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "measure/survey.h"
#include "solve/leap.h"

enum { STEPS = 100 };

static bool fail(const char *what, const char *where)
{
    fprintf(stderr, "time_spheres: %s: %s\n", where, what);
    return false;
}

/* Place, speed and spin of a sphere, in the order of the file's places. */
struct sphere {
    double x[3], v[3], w[3];
};

/* The rows of both sections carry the number of their sphere; all diameters have to be 1.
 */
static bool read_spheres(const char *path, GArray *spheres)
{
    char *text = NULL;
    if (!g_file_get_contents(path, &text, NULL, NULL)) {
        return fail("cannot be read", path);
    }
    GHashTable *place_of = g_hash_table_new(g_direct_hash, g_direct_equal);
    char **lines = g_strsplit(text, "\n", -1);
    bool atoms = false, good = true;
    for (char **line = lines; *line && good; line++) {
        double n, a[6];
        if (g_str_has_prefix(*line, "Atoms") || g_str_has_prefix(*line, "Velocities")) {
            atoms = **line == 'A';
        } else if (sscanf(*line, "%lf %lf %lf %lf %lf %lf %lf", &n, a, a + 1, a + 2,
                          a + 3, a + 4, a + 5) == 7) {
            void *key = GINT_TO_POINTER((int)n);
            if (atoms) { /* type, diameter, density, place */
                const struct sphere sphere = {.x = {a[3], a[4], a[5]}};
                good = a[1] == 1.0 || fail("accepted: diameters of 1", path);
                g_hash_table_insert(place_of, key, GINT_TO_POINTER((int)spheres->len));
                g_array_append_val(spheres, sphere);
            } else if (g_hash_table_contains(place_of, key)) {
                const int i = GPOINTER_TO_INT(g_hash_table_lookup(place_of, key));
                memcpy(g_array_index(spheres, struct sphere, i).v, a, sizeof a);
            }
        }
    }
    g_hash_table_destroy(place_of);
    g_strfreev(lines);
    g_free(text);
    return good && (spheres->len > 0 || fail("holds no spheres", path));
}

/* Far from the walls of a wide die. */
static bool settle(struct gb_bed **bed, const GArray *spheres, struct gb_error *err)
{
    const struct sphere *sphere = &g_array_index(spheres, struct sphere, 0);
    const int64_t count = spheres->len;
    const struct gb_elastic elastic = {1.0, 0.25};
    struct gb_bed_law law = {.mu = 0.2, .damping = 0.1};
    double *radius = g_new(double, count), far = 0.0, low = 0.0;
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
        memcpy((*bed)->place[i], sphere[i].x, sizeof sphere->x);
        memcpy((*bed)->speed[i], sphere[i].v, sizeof sphere->v);
        memcpy((*bed)->spin[i], sphere[i].w, sizeof sphere->w);
        (*bed)->place[i][2] += 10.0 - low;
    }
    g_free(radius);
    return done;
}

/* Sum of force times distance over the contacts, divided by the dimension. */
static double virial(const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t s = 0; s < bed->pairs.count; s++) {
        if (bed->pairs.contacts.normal[s] > 0.0) {
            double unit[3], force[3];
            gb_survey_force(bed, s, unit, force);
            const double *a = bed->place[bed->pairs.first[s]];
            const double *b = bed->place[bed->pairs.other[s]];
            for (int k = 0; k < 3; k++) {
                sum += force[k] * (a[k] - b[k]) / 3.0;
            }
        }
    }
    return sum;
}

static bool time_steps(struct gb_bed *bed, int batches, struct gb_error *err)
{
    struct gb_leap leap;
    struct gb_contact_counts counts;
    double *batch = g_new(double, batches);
    gb_leap_init(&leap, 0.5, 1e-3);
    bool good = gb_bed_evaluate(bed, 0.0, 0.0, err);
    if (good) {
        gb_survey_contacts(bed, &counts, NULL, 0, NULL);
        printf("coordination %.6f\nvirial %.8g\n", counts.coordination, virial(bed));
    }
    for (int b = -1; b < batches && good; b++) { /* the first one warms up */
        const clock_t start = clock();
        for (int k = 0; k < STEPS && good; k++) {
            good = gb_leap_step(&leap, bed, err);
        }
        batch[b < 0 ? 0 : b] = (double)(clock() - start) / CLOCKS_PER_SEC / STEPS;
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
    GArray *spheres = g_array_new(FALSE, FALSE, sizeof(struct sphere));
    const int batches = argc > 2 ? atoi(argv[2]) : 15;
    if (argc < 2 || batches < 1) {
        fputs("usage: time_spheres FILE [BATCHES]\n", stderr);
        return 2;
    }
    bool done = read_spheres(argv[1], spheres);
    if (done) {
        done = (settle(&bed, spheres, &err) && time_steps(bed, batches, &err)) ||
               fail(err.text, argv[1]);
    }
    gb_bed_destroy(bed);
    g_array_free(spheres, TRUE);
    return done ? 0 : 2;
}
