#ifndef GB_SCENE_GAUSSIAN_H
#define GB_SCENE_GAUSSIAN_H

/* The standard normal law in long double, rounded: the same bits on every processor, which
 * GSL's functions, by their exp and log, do not have. */

/* Probability below z, and above it: without loss in the tail. */
double gb_gaussian_below(double z);
double gb_gaussian_above(double z);

/* z of which the probability below (above) is p, 0 <= p <= 1; infinite at the ends. */
double gb_gaussian_quantile_below(double p);
double gb_gaussian_quantile_above(double p);

#endif
