#ifndef GB_FIGURES_RUNS_RATE_POINTS_H
#define GB_FIGURES_RUNS_RATE_POINTS_H

#include "figures/figures.h"
#include "measure/fit/power.h"

/* Mean pressures of groups of runs that differ in their rate, at given densities, and the
 * law P2 (9) through them. */

/* k_v of P2 (9) as printed, MPa s^(1/4). */
extern const double gb_rate_points_printed_k_v;

struct gb_rate_points {
    struct gb_power_point *point;  /* rates in 1/s, pressures in MPa; by density */
    struct gb_power_point *fitted; /* the same; error 0 in all unless all have one */
    double *runs;                  /* with a value, of each point */
    size_t count;
    struct gb_power_law law; /* of P2 (9), from the initial density of the runs */
};

/* Points at the densities of the input, or at those of the figure rate: where each run
 * first reaches them.  A rate with one run has the standard deviation of the others at its
 * density as its error, none where no rate has two.  figure names it in messages.  Errors: GB_ERR_INPUT (runs that are not
 * dynamic, that differ in more than the rate, or that reach none of the densities). */
bool gb_rate_points_find(struct gb_rate_points *points,
                         const struct gb_figures_input *input, const char *figure,
                         struct gb_error *err);
void gb_rate_points_finish(struct gb_rate_points *points); /* zeroed is fine */

/* Whether each of count points has a standard error: fits are then weighted by them. */
bool gb_rate_points_have_errors(const struct gb_power_point *points, size_t count);

/* P2 (9) over all densities: k_v with the printed exponent, and the exponent free, as
 * comment lines.  Weighted by the errors where all points have one.  Returns false, with the reason as a comment line, where the points determine no k_v. */
bool gb_rate_points_fit(struct gb_power_rate *rate, const struct gb_rate_points *points,
                        struct gb_series *series);

/* k_v v^(1/4) (rho - rho0)^3, MPa. */
double gb_rate_points_excess(const struct gb_power_law *law, double k_v, double rate,
                             double density);

#endif
