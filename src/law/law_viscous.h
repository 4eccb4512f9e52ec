#ifndef GB_LAW_LAW_VISCOUS_H
#define GB_LAW_LAW_VISCOUS_H

/* Viscous force that accompanies every elastic force between particles: f_visc = A
 * df_e/dt.  Source: P2 eq. (3). */

/* A in s: eta (1 - nu^2) (1 - 2 nu) / (3 E nu^2), without bulk viscosity; eta in Pa s,
 * E in Pa. 0 for eta = 0; infinite as nu -> 0, where the formula has no meaning. */
double gb_law_viscous_time(double viscosity_pa_s, double young_pa, double poisson);

#endif
