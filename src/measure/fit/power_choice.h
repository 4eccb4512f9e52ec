#ifndef GB_MEASURE_FIT_POWER_CHOICE_H
#define GB_MEASURE_FIT_POWER_CHOICE_H

#include "measure/fit/power.h"

/* Which of several given exponents the pressures prefer: P2 has 1/4 in (9), the authors'
 * later work 1/8. */
struct gb_power_choice {
    double exponent; /* in */
    struct gb_power_rate rate;
    /* AICc less the least of all: the exponents have the same number of parameters, so
     * that it is the difference of chi2, and without errors of the points n ln of the
     * ratio of the sums of squares. */
    double delta;
    double weight; /* Akaike weight, exp(-delta/2) over the sum of all */
};

/* Fits k_v and p_stat of every density for the exponent of each choice; that of law is
 * not used.  Points of one run at several densities are not independent: the differences
 * are then exaggerated.  Source: Burnham & Anderson, Model Selection, 2002, 2.9.
 * Errors: as of gb_power_rate; GB_ERR_INPUT without errors of the points where one
 * exponent fits them exactly. */
bool gb_power_choice_fit(struct gb_power_choice *choices, size_t exponents,
                         const struct gb_power_law *law,
                         const struct gb_power_point *points, size_t count,
                         struct gb_error *err);

#endif
