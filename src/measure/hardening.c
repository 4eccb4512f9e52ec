#include "measure/hardening.h"

#include <gsl/gsl_integration.h>
#include <math.h>

#include "base/alloc.h"
#include "greenbody/params.h"

/* Of the integral for the shear; far below the scatter of any curve. */
static const double integral_error = 1e-10;
static const double shear_error = 1e-9;
static const double density_error = 1e-12;

double gb_hardening_phi(double density)
{
    return pow(density, 5.0 / 3.0);
}

double gb_hardening_psi(double density)
{
    const double theta = 1.0 - density;
    return 2.0 / 3.0 * (density + theta * theta / 2.0) / theta *
           gb_hardening_phi(density);
}

/* c of the deviator: its share in the strain rate of a geometry. */
static double deviator_share(int geometry)
{
    switch (geometry) {
    case GB_GEOMETRY_UNIAXIAL:
        return 2.0 / 3.0;
    case GB_GEOMETRY_BIAXIAL:
        return 1.0 / 6.0;
    default:
        return 0.0;
    }
}

double gb_hardening_resistance(int geometry, double density)
{
    return sqrt(gb_hardening_psi(density) +
                deviator_share(geometry) * gb_hardening_phi(density));
}

struct path {
    int geometry;
};

static double shear_rate(double density, void *data)
{
    const struct path *path = data;
    return gb_hardening_resistance(path->geometry, density) / pow(density, 1.5);
}

double gb_hardening_shear(int geometry, double from, double to)
{
    struct path path = {geometry};
    gsl_function function = {shear_rate, &path};
    double shear = NAN;
    double error = 0.0;
    size_t evaluations = 0;
    if (from == to) {
        return 0.0; /* where a relative error has no meaning */
    }
    /* smooth between 0 and 1; NaN where Gauss-Kronrod of 87 points misses the
     * tolerance */
    return gsl_integration_qng(&function, from, to, 0.0, integral_error, &shear, &error,
                               &evaluations) == 0
               ? shear
               : (double)NAN;
}

/* Densities in order and inside (0, 1). */
static bool check(const double *density, size_t count, struct gb_error *err)
{
    for (size_t i = 0; i < count; i++) {
        if (!(density[i] > 0.0 && density[i] < 1.0) ||
            (i > 0 && !(density[i] > density[i - 1]))) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "point %zu of the compaction curve: density %g: must be "
                                "between 0 and 1 and ascending",
                                i + 1, density[i]);
        }
    }
    return true;
}

bool gb_hardening_init(struct gb_hardening *law, int geometry, const double *density,
                       const double *pressure_pa, size_t count, struct gb_error *err)
{
    *law = (struct gb_hardening){0};
    if (!check(density, count, err)) {
        return false;
    }
    law->shear = gb_alloc_array(count + 1, sizeof *law->shear, err);
    law->yield_pa =
        law->shear ? gb_alloc_array(count + 1, sizeof *law->yield_pa, err) : NULL;
    if (law->yield_pa == NULL) {
        gb_hardening_finish(law);
        return false;
    }
    double shear = 0.0;
    law->start = count > 0 ? density[0] : (double)NAN;
    for (size_t i = 0; i < count; i++) {
        shear += i > 0 ? gb_hardening_shear(geometry, density[i - 1], density[i]) : 0.0;
        if (pressure_pa[i] > 0.0) {
            law->shear[law->count] = shear;
            law->yield_pa[law->count++] =
                pressure_pa[i] /
                (gb_hardening_resistance(geometry, density[i]) * sqrt(density[i]));
        }
    }
    if (law->count < 2) {
        gb_hardening_finish(law);
        return gb_error_set(
            err, GB_ERR_INPUT,
            "hardening law: must have at least two points with a pressure "
            "above 0");
    }
    return true;
}

void gb_hardening_finish(struct gb_hardening *law)
{
    gb_alloc_free(law->shear);
    gb_alloc_free(law->yield_pa);
    *law = (struct gb_hardening){0};
}

/* tau_0(gamma_0), NaN outside the range of the law. */
static double yield_at(const struct gb_hardening *law, double shear)
{
    size_t low = 0;
    size_t high = law->count - 1;
    /* margin for the rounding of the summed shear at both ends */
    const double margin = shear_error * law->shear[high];
    if (!(shear >= law->shear[low] - margin && shear <= law->shear[high] + margin)) {
        return (double)NAN;
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (law->shear[middle] <= shear) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double share = (shear - law->shear[low]) / (law->shear[high] - law->shear[low]);
    return law->yield_pa[low] + share * (law->yield_pa[high] - law->yield_pa[low]);
}

double gb_hardening_pressure(const struct gb_hardening *law, int geometry, double density)
{
    if (!(density >= law->start && density < 1.0)) {
        return (double)NAN;
    }
    const double shear = gb_hardening_shear(geometry, law->start, density);
    return gb_hardening_resistance(geometry, density) * sqrt(density) *
           yield_at(law, shear);
}

double gb_hardening_density_max(const struct gb_hardening *law, int geometry)
{
    const double most = law->shear[law->count - 1];
    double low = law->start;
    double high = 1.0 - density_error;
    while (high - low > density_error) { /* the shear grows with density */
        const double middle = low + (high - low) / 2.0;
        if (gb_hardening_shear(geometry, law->start, middle) <= most) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}
