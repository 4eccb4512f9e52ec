#ifndef GB_MEASURE_FIT_COMPACTION_EQUATION_ITERATE_H
#define GB_MEASURE_FIT_COMPACTION_EQUATION_ITERATE_H

#include "measure/fit/compaction/equations.h"

/* Levenberg-Marquardt iteration (GSL) over the parameters of an equation in coordinates
 * of the fit: the logarithm of positive parameters, the others as they are. */

enum { GB_EQUATION_ITERATE_ALL = -1 };

struct gb_equation_iterate {
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
bool gb_equation_iterate(struct gb_equation_iterate *iterate, struct gb_error *err);

/* Parameter k as a coordinate, and back. */
double gb_equation_iterate_coordinate(const struct gb_equation *equation, size_t k,
                                      double x);
double gb_equation_iterate_value(const struct gb_equation *equation, size_t k,
                                 double coordinate);

#endif
