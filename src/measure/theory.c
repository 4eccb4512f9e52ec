/* Theories of compaction: regular packings of P2, and the hardening porous body of P1. */
#include "measure/theory.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/alloc.h"
#include "greenbody/params.h"
#include "greenbody/status.h"

/* Bracket of the density: below it no pair of the asymptote touches (h = 0 at 0.815),
 * above it the pressure exceeds E. */
static const double density_least = 0.8;
static const double density_most = 1.6;

enum { ITERATIONS = 200 };

struct target {
    const struct gb_model *model;
    double stress; /* E */
};

double gb_theory_regular_density(double k)
{
    return M_PI / k / tan(M_PI / k);
}

double gb_theory_coordination(double density)
{
    return 2.3 + 3.0 * density * density;
}

double gb_theory_overlap(double density)
{
    const double regular = gb_theory_regular_density(gb_theory_coordination(density));
    return 1.0 - sqrt(regular / density);
}

/* (7) in E, going on below h = 0 with the adhesion alone so that a root finder passes. */
static double stress(const struct gb_model *model, double density)
{
    const double h = gb_theory_overlap(density);
    const double force = gb_law_rod_force(&model->rod, h) - model->adhesion;
    return density * gb_theory_coordination(density) / M_PI * force * (1.0 - h);
}

double gb_theory_pressure(const struct gb_model *model, double density)
{
    if (!(density > 0.0) || !(gb_theory_overlap(density) > 0.0)) {
        return (double)NAN;
    }
    return model->pascal_per_stress * stress(model, density);
}

static double excess(double density, void *data)
{
    const struct target *target = data;
    return stress(target->model, density) - target->stress;
}

bool gb_theory_density(const struct gb_model *model, double pressure_pa, double *density,
                       struct gb_error *err)
{
    struct target target = {model, pressure_pa / model->pascal_per_stress};
    double low = density_least;
    double high = density_most;
    if (!(pressure_pa >= 0.0) || !(excess(low, &target) <= 0.0) ||
        !(excess(high, &target) > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%g Pa: the asymptote has no density for this pressure",
                            pressure_pa);
    }
    gsl_function function = {excess, &target};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (solver == NULL) {
        return gb_error_set(err, GB_ERR_MEMORY, "out of memory for a root finder");
    }
    gsl_root_fsolver_set(solver, &function, low, high);
    int status = GSL_CONTINUE;
    for (int i = 0; i < ITERATIONS && status == GSL_CONTINUE; i++) {
        gsl_root_fsolver_iterate(solver);
        low = gsl_root_fsolver_x_lower(solver);
        high = gsl_root_fsolver_x_upper(solver);
        status = gsl_root_test_interval(low, high, 0.0, 1e-14);
    }
    *density = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return status == GSL_SUCCESS ||
           gb_error_set(err, GB_ERR_NOT_CONVERGED,
                        "the density of the asymptote at %g Pa was not found",
                        pressure_pa);
}

/* Continuum theory of a plastically hardening porous body, P1 (18)-(23).  A curve of
 * pressing in one geometry gives the hardening law of the solid phase, yield strength
 * against accumulated shear; the law gives the curves of all geometries.  Porosity is
 * theta = 1 - density. */

/* Of the integral for the shear; far below the scatter of any curve. */
static const double integral_error = 1e-10;
static const double shear_error = 1e-9;
static const double density_error = 1e-12;

double gb_theory_hardening_phi(double density)
{
    return pow(density, 5.0 / 3.0);
}

double gb_theory_hardening_psi(double density)
{
    const double theta = 1.0 - density;
    return 2.0 / 3.0 * (density + theta * theta / 2.0) / theta *
           gb_theory_hardening_phi(density);
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

double gb_theory_hardening_resistance(int geometry, double density)
{
    return sqrt(gb_theory_hardening_psi(density) +
                deviator_share(geometry) * gb_theory_hardening_phi(density));
}

struct path {
    int geometry;
};

static double shear_rate(double density, void *data)
{
    const struct path *path = data;
    return gb_theory_hardening_resistance(path->geometry, density) / pow(density, 1.5);
}

double gb_theory_hardening_shear(int geometry, double from, double to)
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

bool gb_theory_hardening_init(struct gb_hardening *law, int geometry,
                              const double *density, const double *pressure_pa,
                              size_t count, struct gb_error *err)
{
    *law = (struct gb_hardening){0};
    if (!check(density, count, err)) {
        return false;
    }
    law->shear = gb_alloc_array(count + 1, sizeof *law->shear, err);
    law->yield_pa =
        law->shear ? gb_alloc_array(count + 1, sizeof *law->yield_pa, err) : NULL;
    if (law->yield_pa == NULL) {
        gb_theory_hardening_finish(law);
        return false;
    }
    double shear = 0.0;
    law->start = count > 0 ? density[0] : (double)NAN;
    for (size_t i = 0; i < count; i++) {
        shear +=
            i > 0 ? gb_theory_hardening_shear(geometry, density[i - 1], density[i]) : 0.0;
        if (pressure_pa[i] > 0.0) {
            law->shear[law->count] = shear;
            law->yield_pa[law->count++] =
                pressure_pa[i] /
                (gb_theory_hardening_resistance(geometry, density[i]) * sqrt(density[i]));
        }
    }
    if (law->count < 2) {
        gb_theory_hardening_finish(law);
        return gb_error_set(
            err, GB_ERR_INPUT,
            "hardening law: must have at least two points with a pressure "
            "above 0");
    }
    return true;
}

void gb_theory_hardening_finish(struct gb_hardening *law)
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

double gb_theory_hardening_pressure(const struct gb_hardening *law, int geometry,
                                    double density)
{
    if (!(density >= law->start && density < 1.0)) {
        return (double)NAN;
    }
    const double shear = gb_theory_hardening_shear(geometry, law->start, density);
    return gb_theory_hardening_resistance(geometry, density) * sqrt(density) *
           yield_at(law, shear);
}

double gb_theory_hardening_density_max(const struct gb_hardening *law, int geometry)
{
    const double most = law->shear[law->count - 1];
    double low = law->start;
    double high = 1.0 - density_error;
    while (high - low > density_error) { /* the shear grows with density */
        const double middle = low + (high - low) / 2.0;
        if (gb_theory_hardening_shear(geometry, law->start, middle) <= most) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}
