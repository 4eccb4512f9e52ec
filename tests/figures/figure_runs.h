#ifndef GB_TESTS_FIGURE_RUNS_H
#define GB_TESTS_FIGURE_RUNS_H

/* Run directories of every kind in the folder of figure_folder.h, with numbers that the tests
 * of figures know. */

/* All of them: a1, a2, b1 (quasi-static), fast, slow (dynamic), die, cycle1, cycle2, legs,
 * chart, card, yield, strength, strength-density, moduli, plane, nothing, empty. */
void figure_runs_write(void);

/* A quasi-static run with a state; its curve has p = 100 (rho - 0.4)^2 GPa + `offset` MPa, a
 * lateral ratio of 0.5, unloading back to 0, and then the rows `more`. */
void figure_runs_quasistatic(const char *directory, int seed, const char *diameter,
                             double offset);
void figure_runs_curve(const char *directory, double offset, const char *more);

#endif
