#ifndef GB_MEASURE_FIT_COMPACTION_EQUATION_FIT_H
#define GB_MEASURE_FIT_COMPACTION_EQUATION_FIT_H

#include "measure/fit/compaction/equations.h"
#include "measure/fit/fit.h"

enum { GB_EQUATION_ITERATE_ALL = -1 };

struct gb_equation_fit_iterate {
    const struct gb_equation *equation;
    const struct gb_equations_points *points;
    int fixed; /* a parameter that is held; GB_EQUATION_ITERATE_ALL: none */
    double *x; /* parameters, D0 last: start values, and the result */
    double squares;
    bool converged;
    int undetermined; /* a parameter that the points do not determine; ALL: none */
    double covariance[GB_EQUATIONS_PARAMETERS]; /* diagonal, of unit variance */
};

/* Errors: GB_ERR_MEMORY; an iteration that does not settle is no error. */
bool gb_equation_fit_iterate(struct gb_equation_fit_iterate *iterate,
                             struct gb_error *err);

/* Least squares of one equation in the relative density, weighted by 1/error^2. */
struct gb_equation_fit {
    const struct gb_equation *equation;
    size_t points, size;                                /* size: fitted parameters */
    double x[GB_EQUATIONS_PARAMETERS];                  /* D0 last, given or fitted */
    struct gb_fit_value value[GB_EQUATIONS_PARAMETERS]; /* the same with 95 % intervals */
    double squares;                                     /* weighted sum of squares */
    double rms;                                         /* of the residuals of rho */
    double correlation;                                 /* points per independent point */
    double variance; /* factor of the covariance: scatter and correlation */
    double quantile; /* of Student's t, two-sided 95 % */
    double aicc;     /* comparable between fits to the same points */
};

/* Fits from the start values of the equation and sets linear intervals (in the logarithm
 * for positive parameters): from the errors of the points, wider where the points scatter
 * more or are correlated; from the scatter without errors.
 *
 * AICc = n ln(S/n) + 2 k + 2 k (k + 1)/(n - k - 1), k parameters and the scatter:
 * C. M. Hurvich, C.-L. Tsai, Biometrika 76, 297 (1989).
 * Errors: those of gb_equations_check; GB_ERR_NOT_CONVERGED, GB_ERR_MEMORY. */
bool gb_equation_fit(struct gb_equation_fit *fit, const struct gb_equation *equation,
                     const struct gb_equations_points *points, struct gb_error *err);

/* Widens the intervals to those of the scatter of the replicas, by the jackknife over
 * them: the points of one replica are correlated along its curve.  Nothing with fewer
 * than three.  Errors: GB_ERR_MEMORY. */
bool gb_equation_fit_jackknife(struct gb_equation_fit *fit,
                               const struct gb_equations_points *points,
                               struct gb_error *err);

/* rho of the fit. */
double gb_equation_fit_at(const struct gb_equation_fit *fit, double pressure);

/* Replaces linear intervals by those of the profile likelihood where both differ: the sum
 * of squares, minimised over the other parameters, has risen by quantile^2 variance.  An
 * end that is never reached is infinite, or 0 for a positive parameter.
 * Errors: GB_ERR_MEMORY. */
bool gb_equation_fit_profile(struct gb_equation_fit *fit,
                             const struct gb_equations_points *points,
                             struct gb_error *err);

#endif
