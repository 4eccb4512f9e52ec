#ifndef GB_MEASURE_COMPACTION_FITS_H
#define GB_MEASURE_COMPACTION_FITS_H

#include "measure/equations.h"
#include "measure/fit.h"

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
bool gb_compaction_fits_equation_fit(struct gb_equation_fit *fit,
                                     const struct gb_equation *equation,
                                     const struct gb_equations_points *points,
                                     struct gb_error *err);

/* rho of the fit. */
double gb_compaction_fits_at(const struct gb_equation_fit *fit, double pressure);

/* The straightest stretch of a Heckel plot, y = ln(1/(1 - rho)) against P: of all runs of
 * consecutive points, at least a sixth of all and at least five, the longest one (in
 * pressure) whose scatter about its line is not significantly larger than its scatter from
 * point to point (F test at 95 %; weights by the errors of rho).  Where the plot is bent
 * everywhere: the stretch of which a line leaves the least share of the variance.  Points
 * at one pressure count as one, at their mean: a repeated point changes nothing. */
struct gb_compaction_fits_heckel_stretch {
    size_t first, count;
    bool straight;        /* by the F test */
    double determination; /* adjusted R^2 of the stretch */
};

/* Points in ascending order of P, densities below 1, five or more of them.  All of them
 * are the stretch where they are at fewer than five pressures.  Errors: GB_ERR_MEMORY. */
bool gb_compaction_fits_heckel_stretch(struct gb_compaction_fits_heckel_stretch *stretch,
                                       const struct gb_equations_points *points,
                                       struct gb_error *err);

/* All equations of compaction fitted to the same points. */

enum { GB_COMPACTION_FITS = 9 };

struct gb_compaction_fit {
    const struct gb_equation *equation;
    bool fitted;                /* else: refusal says why not */
    struct gb_equation_fit all; /* to all points: aicc, rms and the curve */
    struct gb_error refusal;
    double delta; /* AICc less the least of all equations */
};

struct gb_compaction_fits {
    struct gb_compaction_fit fit[GB_COMPACTION_FITS]; /* by AICc, those refused last */
    size_t count, fitted;
    /* Heckel's equation on the straightest stretch, with 1/K: mean yield pressure, MPa.
     * Equation NULL: refused. */
    struct gb_equation_fit heckel;
    struct gb_compaction_fits_heckel_stretch stretch;
    struct gb_fit_value yield;
};

enum gb_compaction_intervals {
    GB_COMPACTION_LINEAR, /* quick: from the covariance */
    GB_COMPACTION_PROFILE /* profile likelihood where the former is poor, jackknife */
};

/* only: one equation; NULL: all.  An equation that is refused or does not settle is no
 * error: its row says why.  Errors: GB_ERR_MEMORY. */
bool gb_compaction_fits(struct gb_compaction_fits *fits,
                        const struct gb_equations_points *points,
                        const struct gb_equation *only,
                        enum gb_compaction_intervals intervals, struct gb_error *err);

/* The fit of an equation whose parameters are reported: Heckel's on its stretch, the
 * others to all points. */
const struct gb_equation_fit *
gb_compaction_fits_reported(const struct gb_compaction_fits *fits, size_t index);

/* A parameter as reported: those of the fit, and the yield pressure of Heckel. */
struct gb_compaction_value {
    const char *name, *unit;
    struct gb_fit_value value;
};

/* Number of reported parameters of a fitted row, and parameter k of them. */
size_t gb_compaction_fits_values(const struct gb_compaction_fits *fits, size_t index);
struct gb_compaction_value gb_compaction_fits_value(const struct gb_compaction_fits *fits,
                                                    size_t index, size_t k);

#endif
