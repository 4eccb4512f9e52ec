#ifndef GB_MEASURE_FIT_COMPACTION_EQUATION_STARTS_H
#define GB_MEASURE_FIT_COMPACTION_EQUATION_STARTS_H

#include "measure/fit/compaction/equations.h"

/* Start values of the iterations, for the rows of equations.c: linear regressions in the
 * form of the source, over a grid of what is not linear.  x: the parameters, behind them
 * D0 as given. */

typedef void gb_equation_starts_function(const struct gb_equations_points *points,
                                         double *x);

gb_equation_starts_function gb_equation_starts_heckel;
gb_equation_starts_function gb_equation_starts_kawakita;
gb_equation_starts_function gb_equation_starts_cooper_eaton;
gb_equation_starts_function gb_equation_starts_walker;
gb_equation_starts_function gb_equation_starts_balshin;
gb_equation_starts_function gb_equation_starts_adams;
gb_equation_starts_function gb_equation_starts_shapiro;
gb_equation_starts_function gb_equation_starts_panelli;
gb_equation_starts_function gb_equation_starts_secondi;

/* Weight of point i: 1/error^2, or 1. */
double gb_equation_starts_weight(const struct gb_equations_points *points, size_t i);

/* Weighted sum of squared residuals of rho; infinite where the parameters give no
 * density. */
double gb_equation_starts_squares(const struct gb_equations_points *points,
                                  double (*density)(const double *x, double pressure),
                                  const double *x);

#endif
