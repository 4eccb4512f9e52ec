#ifndef GB_MEASURE_EQUATIONS_H
#define GB_MEASURE_EQUATIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"

/* The table of equations of compaction.  Each gives the relative density as a function of
 * the pressure, so that all are fitted to the same errors and can be compared.  An
 * equation is a row of the table in equations.c: its density, the slope by its parameters,
 * and start values for a fit.
 *
 * Pressures P in MPa, rho relative density, D0 initial relative density, C = 1 - D0/rho. */

enum { GB_EQUATIONS_PARAMETERS = 5 }; /* most of one equation, D0 included */

/* Points (P, rho) in ascending order of P > 0; arrays are not owned. */
struct gb_equations_points {
    size_t count;
    const double *pressure, *density;
    const double *error; /* standard errors of rho, > 0; NULL: unknown and equal */
    double initial;      /* D0; NaN: unknown, fitted with the other parameters */
    const double *rows;  /* rho of each replica, `stride` apart; NULL: none */
    size_t replicas, stride;
};

struct gb_equations_parameter {
    const char *name, *unit; /* unit "1": a pure number */
    bool positive;           /* > 0 by its meaning: fitted as its logarithm */
};

/* Conditions on the densities. */
enum gb_equations_domain {
    GB_EQUATIONS_BELOW_ONE = 1,    /* rho < 1 */
    GB_EQUATIONS_ABOVE_INITIAL = 2 /* rho > D0; D0 is a parameter where it is unknown */
};

struct gb_equation {
    const char *name;   /* on the command line and in files */
    const char *title;  /* in figures */
    const char *form;   /* as printed in the source */
    const char *source; /* paper */
    unsigned domain;    /* bits of enum gb_equations_domain */
    size_t count;       /* of parameters, D0 left out */
    struct gb_equations_parameter parameter[GB_EQUATIONS_PARAMETERS];
    /* rho at P; x: the parameters, then D0 where the equation has it.  NaN where the
     * parameters give no density there. */
    double (*density)(const double *x, double pressure);
    /* Derivatives of rho by all of x, D0 included. */
    void (*slope)(const double *x, double pressure, double *slope);
    /* Start values of the parameters for a given D0 = x[count]. */
    void (*start)(const struct gb_equations_points *points, double *x);
};

size_t gb_equations_count(void);
const struct gb_equation *gb_equations_at(size_t index);
/* NULL: no such equation. */
const struct gb_equation *gb_equations_find(const char *name);

/* Whether D0 is one of its parameters for these points. */
bool gb_equations_fits_initial(const struct gb_equation *equation,
                               const struct gb_equations_points *points);
/* Fitted parameters. */
size_t gb_equations_size(const struct gb_equation *equation,
                         const struct gb_equations_points *points);
/* Parameter k, D0 after the others. */
const struct gb_equations_parameter *
gb_equations_parameter(const struct gb_equation *equation, size_t k);

/* Whether the equation is defined for the points, and they are enough: three more than
 * parameters, at as many pressures as parameters or more.  Errors: GB_ERR_INPUT with the
 * equation and the first point outside. */
bool gb_equations_check(const struct gb_equation *equation,
                        const struct gb_equations_points *points, struct gb_error *err);

/* Weight of point i: 1/error^2, or 1. */
double gb_equations_weight(const struct gb_equations_points *points, size_t i);

/* Weighted sum of squared residuals of rho; infinite where the parameters give no
 * density. */
double gb_equations_squares(const struct gb_equations_points *points,
                            double (*density)(const double *x, double pressure),
                            const double *x);

#endif
