#ifndef GB_MEASURE_FIT_COMPACTION_EQUATION_MODELS_H
#define GB_MEASURE_FIT_COMPACTION_EQUATION_MODELS_H

/* rho(P) of the equations of compaction and its derivatives, for the rows of equations.c:
 * x as listed there, D0 last where the equation has it; P in MPa. */

typedef double gb_equation_models_density(const double *x, double pressure);
typedef void gb_equation_models_slope(const double *x, double pressure, double *slope);

/* x = K, A */
gb_equation_models_density gb_equation_models_heckel;
gb_equation_models_slope gb_equation_models_heckel_slope;
/* x = a, b, D0 */
gb_equation_models_density gb_equation_models_kawakita;
gb_equation_models_slope gb_equation_models_kawakita_slope;
/* x = a1, a2, k1, k2, D0 */
gb_equation_models_density gb_equation_models_cooper_eaton;
gb_equation_models_slope gb_equation_models_cooper_eaton_slope;
/* x = K, c */
gb_equation_models_density gb_equation_models_walker;
gb_equation_models_slope gb_equation_models_walker_slope;
/* x = C1, C2 */
gb_equation_models_density gb_equation_models_balshin;
gb_equation_models_slope gb_equation_models_balshin_slope;
/* x = tau, alpha, D0 */
gb_equation_models_density gb_equation_models_adams;
gb_equation_models_slope gb_equation_models_adams_slope;
/* x = k, b, D0 */
gb_equation_models_density gb_equation_models_shapiro;
gb_equation_models_slope gb_equation_models_shapiro_slope;
/* x = A, B */
gb_equation_models_density gb_equation_models_panelli;
gb_equation_models_slope gb_equation_models_panelli_slope;
/* x = r_inf, K, n, D0 */
gb_equation_models_density gb_equation_models_secondi;
gb_equation_models_slope gb_equation_models_secondi_slope;

#endif
