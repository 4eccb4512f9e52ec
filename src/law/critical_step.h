#ifndef GB_LAW_CRITICAL_STEP_H
#define GB_LAW_CRITICAL_STEP_H

/* Longest stable time step of central differences and velocity Verlet for a mode of
 * circular frequency omega with the damping ratio xi:
 *     (2/omega) (sqrt(1 + xi^2) - xi).
 * Source: P3 (28); O'Sullivan and Bray, Eng. Comput. 21, 278 (2004), without damping. */

/* The step of the formula; INFINITY for frequencies that are not above 0. */
double gb_critical_step(double frequency, double damping_ratio);

#endif
