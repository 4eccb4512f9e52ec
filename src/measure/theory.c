#include "measure/theory.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

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
