#include "solve/moduli/moduli.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/portable.h"
#include "pack/cell/world.h"
#include "scene/tolerances.h"
#include "solve/moduli/probe.h"

enum { COMPONENTS = 6, ITERATIONS_MAX = 6000, HALVES = 2 };

static const int row_of[COMPONENTS] = {0, 1, 2, 1, 0, 0};
static const int column_of[COMPONENTS] = {0, 1, 2, 2, 2, 1};

static bool exists(int dimension, int k)
{
    return dimension == 3 || (row_of[k] != 1 && column_of[k] != 1);
}

void gb_moduli_strain(int k, double size, double strain[3][3])
{
    memset(strain, 0, 9 * sizeof **strain);
    strain[row_of[k]][column_of[k]] += 0.5 * size;
    strain[column_of[k]][row_of[k]] += 0.5 * size;
}

static double component(const double tensor[3][3], int k)
{
    return 0.5 * (tensor[row_of[k]][column_of[k]] + tensor[column_of[k]][row_of[k]]);
}

static double vector_norm(const double *vector, int64_t count)
{
    double sum = 0.0;
    for (int64_t k = 0; k < count; k++) {
        sum += vector[k] * vector[k];
    }
    return sqrt(sum);
}

/* Linear response of the particles to a unit strain, and of the stress.  sigma = -S/V:
 * its change is that of S over V, less the growth of V. */
static void respond(struct gb_tangent *tangent, const double pressure[3][3],
                    double volume, int k, double *force, double *motion, double c[6][6])
{
    const int64_t numbers = 6 * tangent->count;
    double strain[3][3], change[3][3];
    gb_moduli_strain(k, 1.0, strain);
    const double whole = gb_probe_affine(tangent, (const double(*)[3])strain, force);
    const double norm = vector_norm(force, numbers), noise = GB_TANGENT_NOISE * whole;
    memset(motion, 0, (size_t)numbers * sizeof *motion);
    if (norm > noise) {
        gb_probe_solve(tangent, force, fmax(GB_TANGENT_SHARE, noise / norm),
                       ITERATIONS_MAX, motion);
    }
    gb_probe_virial(tangent, (const double(*)[3])strain, motion, change);
    for (int m = 0; m < COMPONENTS; m++) {
        c[m][k] = -component((const double(*)[3])change, m) / volume +
                  (k < 3 ? component(pressure, m) : 0.0);
    }
}

/* Column k of C by central differences at a strain; slope: motion per strain, the first
 * guess of both sides. */
static bool probe_column(struct gb_probe *probe, int k, double size, const double *slope,
                         double c[6][6], struct gb_error *err)
{
    const size_t bytes = 6 * (size_t)probe->model.count * sizeof(double);
    double strain[3][3], pressure[2][3][3];
    for (int side = 0; side < 2; side++) {
        const double signed_size = side == 0 ? size : -size;
        gb_moduli_strain(k, signed_size, strain);
        memcpy(probe->motion, slope, bytes);
        if (!gb_probe_strain(probe, (const double(*)[3])strain, signed_size,
                             GB_PROBE_SHARE, pressure[side], err)) {
            return false;
        }
    }
    for (int m = 0; m < COMPONENTS; m++) {
        c[m][k] = (component((const double(*)[3])pressure[1], m) -
                   component((const double(*)[3])pressure[0], m)) /
                  (2.0 * size);
    }
    return true;
}

/* Largest difference of two matrices over the largest element. */
static double difference(const double a[6][6], const double b[6][6])
{
    double most = 0.0, apart = 0.0;
    for (int k = 0; k < 36; k++) {
        most = fmax(most, fabs(a[k / 6][k % 6]));
        apart = fmax(apart, fabs(a[k / 6][k % 6] - b[k / 6][k % 6]));
    }
    return most > 0.0 ? apart / most : 0.0;
}

/* C at a strain and at half of it.  slope: six vectors. */
static bool probe_sizes(struct gb_probe *probe, double size, double *const slope[6],
                        double c[HALVES][6][6], struct gb_error *err)
{
    memset(c, 0, HALVES * 36 * sizeof ***c);
    for (int half = 0; half < HALVES; half++) {
        for (int k = 0; k < COMPONENTS; k++) {
            if (slope[k] && !probe_column(probe, k, half ? 0.5 * size : size, slope[k],
                                          c[half], err)) {
                return false;
            }
        }
    }
    return true;
}

/* The largest strain at which two sizes agree, or the one where they agree best.  The
 * error that is left falls with the strain: C is extrapolated to strain 0. */
static bool choose_strain(struct gb_moduli *moduli, struct gb_probe *probe,
                          double *const slope[6], struct gb_error *err)
{
    double c[HALVES][6][6];
    moduli->agreement = INFINITY;
    for (double size = GB_PROBE_STRAIN; size > 0.5 * GB_PROBE_STRAIN_MIN; size *= 0.1) {
        if (!probe_sizes(probe, size, slope, c, err)) {
            return false;
        }
        const double apart =
            difference((const double(*)[6])c[0], (const double(*)[6])c[1]);
        if (apart < moduli->agreement) {
            moduli->agreement = apart;
            moduli->strain = size;
            for (int k = 0; k < 36; k++) {
                moduli->c[k / 6][k % 6] = 2.0 * c[1][k / 6][k % 6] - c[0][k / 6][k % 6];
            }
        }
        if (apart <= GB_PROBE_AGREEMENT) {
            break;
        }
    }
    return true;
}

/* Strain at which the secant along component k has lost 5 %, each strain from the state
 * after the last one; INFINITY if not below GB_PROBE_RANGE_MAX. */
static bool march(struct gb_probe *probe, int k, double size, double modulus,
                  double *range, struct gb_error *err)
{
    const double start = component((const double(*)[3])probe->pressure, k);
    double strain[3][3], pressure[3][3];
    double reached = 0.0, before = modulus;
    memset(probe->motion, 0, 6 * (size_t)probe->model.count * sizeof(double));
    *range = INFINITY;
    for (double next = fabs(size); next <= GB_PROBE_RANGE_MAX; next *= GB_PROBE_GROWTH) {
        const double signed_step = size > 0.0 ? next - reached : reached - next;
        gb_moduli_strain(k, signed_step / (1.0 + (k < 3 ? signed_step : 0.0)), strain);
        if (!gb_probe_strain(probe, (const double(*)[3])strain, reached > 0.0, 1e-3,
                             pressure, err) ||
            !gb_probe_advance(probe, err)) {
            return false;
        }
        const double change = start - component((const double(*)[3])pressure, k);
        const double secant = change / (size > 0.0 ? next : -next);
        const double limit = (1.0 - GB_PROBE_LOSS) * modulus;
        if (secant < limit) {
            const double share = (before - limit) / (before - secant);
            *range =
                reached > 0.0 ? reached * gb_portable_pow(next / reached, share) : next;
            return true;
        }
        before = secant;
        reached = next;
    }
    return true;
}

/* Of compression along z and of shear in the plane x-z, the smaller one. */
static bool measure_range(struct gb_moduli *moduli, struct gb_probe *probe,
                          struct gb_error *err)
{
    static const int along[] = {2, 4};
    struct gb_world_copy *start = NULL;
    double range = INFINITY;
    bool done = gb_probe_save(probe, &start, err);
    for (int n = 0; n < 2 && done; n++) {
        const int k = along[n];
        double own = INFINITY;
        done = (n == 0 || gb_probe_return(probe, start, err)) &&
               (!(moduli->c[k][k] > 0.0) ||
                march(probe, k, k < 3 ? -moduli->strain : moduli->strain, moduli->c[k][k],
                      &own, err));
        range = fmin(range, own);
    }
    gb_world_copy_destroy(start);
    moduli->range_open = !isfinite(range);
    moduli->elastic_range = fmin(range, GB_PROBE_RANGE_MAX);
    return done;
}

static bool measure(struct gb_moduli *moduli, struct gb_probe *probe, double *slope[6],
                    const struct gb_moduli_options *options, struct gb_error *err)
{
    const size_t numbers = 6 * (size_t)probe->model.count;
    const double volume = gb_cell_volume(gb_world_cell(probe->world));
    double linear[6][6];
    for (int k = 0; k < COMPONENTS; k++) {
        if (!exists(probe->model.dimension, k)) {
            continue;
        }
        slope[k] = gb_alloc_array(numbers, sizeof(double), err);
        if (!slope[k]) {
            return false;
        }
        respond(probe->tangent, (const double(*)[3])probe->pressure, volume, k,
                probe->force, slope[k], linear);
    }
    memcpy(moduli->pressure, probe->pressure, sizeof moduli->pressure);
    moduli->density = gb_world_density(probe->world);
    moduli->residual = probe->residual;
    return choose_strain(moduli, probe, slope, err) &&
           (!options->range || measure_range(moduli, probe, err));
}

bool gb_moduli_measure(struct gb_moduli *moduli, const struct gb_world *world,
                       const struct gb_moduli_options *options, struct gb_error *err)
{
    struct gb_probe *probe = NULL;
    double *slope[6] = {NULL};
    *moduli = (struct gb_moduli){.elastic_range = (double)NAN};
    bool done = gb_probe_create(&probe, world, options->cancelled, options->data, err);
    done = done && measure(moduli, probe, slope, options, err);
    if (done) {
        moduli->moved_rms = probe->moved_rms;
        moduli->moved_most = probe->moved_most;
        moduli->evaluations = gb_world_evaluations(probe->world);
        moduli->iterations = probe->iterations;
        moduli->fallbacks = probe->fallbacks;
    }
    for (int k = 0; k < COMPONENTS; k++) {
        gb_alloc_free(slope[k]);
    }
    gb_probe_destroy(probe);
    return done;
}
