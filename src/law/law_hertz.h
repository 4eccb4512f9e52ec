#ifndef GB_LAW_LAW_HERTZ_H
#define GB_LAW_LAW_HERTZ_H

/* Elastic contact of two spheres of any radii and materials: Hertz along the normal,
 * Mindlin-Deresiewicz without micro-slip in shear.  Any consistent system of units: h
 * and radii are lengths, moduli are stresses.  Forces are positive in compression and h
 * > 0 is an overlap; P3 prints both with the opposite sign.  Source: P3 eqs. (1)-(14). */

/* One material: Young's modulus E and Poisson's ratio nu. */
struct gb_elastic {
    double young, poisson;
};

struct gb_law_hertz {
    double modulus; /* E*, (3) */
    double shear;   /* G*, (13) */
};

/* Sets E* and G* of two materials, which may be the same; moduli above 0.  For a wall,
 * pass the material of the particle twice.  Source: P3 (3), (13). */
void gb_law_hertz_init(struct gb_law_hertz *law, const struct gb_elastic *i,
                       const struct gb_elastic *j);

/* R* of two radii, (4).  A wall has radius INFINITY; R* is then exactly the other
 * radius. */
double gb_law_hertz_radius(double ri, double rj);

/* F(h) at effective radius R*; 0 for h <= 0.  Source: P3 (2). */
double gb_law_hertz_force(const struct gb_law_hertz *law, double radius, double h);
/* k_n = dF/dh, stress times length; 0 for h <= 0.  Source: P3 (9). */
double gb_law_hertz_stiffness(const struct gb_law_hertz *law, double radius, double h);
/* Integral of the force from 0 to h; 0 for h <= 0. */
double gb_law_hertz_energy(const struct gb_law_hertz *law, double radius, double h);
/* Overlap h at which the force has this value; 0 for force <= 0.  Inverse of (2). */
double gb_law_hertz_overlap(const struct gb_law_hertz *law, double radius, double force);
/* k_t(h), stress times length; 0 for h <= 0.  Source: P3 (12). */
double gb_law_hertz_shear_stiffness(const struct gb_law_hertz *law, double radius,
                                    double h);

/* Force F_Y at which the material with the lower yield stress `yield` starts to flow
 * below the contact.  The greatest pressure is then 1.61 yield (von Mises, nu = 0.3).
 * For two equal spheres this is (30); gb_law_hertz_overlap gives the overlap. */
double gb_law_hertz_yield_force(const struct gb_law_hertz *law, double radius,
                                double yield);

/* Damping coefficient c_n = xi C_cr, (7), (8): the fraction xi of critical damping.
 * `stiffness` is the tangent stiffness of the active branch.  The reduced mass is m_i
 * m_j/(m_i + m_j), or the mass of the particle at a wall. */
double gb_law_hertz_damping(double stiffness, double reduced_mass, double xi);

/* F_n of (1) at approach speed v = dh/dt: elastic force plus dashpot, (6).  Never below
 * 0, because a dry contact does not pull. */
double gb_law_hertz_damped_force(double elastic, double damping, double approach);

/* Limits the damping of a contact to what central differences integrate stably: c
 * omega^2 step/k is at most a third.  Dashpots use the velocity of half a step earlier,
 * and those of several contacts of a particle add up.  Damping that the step resolves
 * does not change.
 *
 * square   omega^2 of the fastest mode that may contain the contact; k/m* for a lone pair
 */
double gb_law_hertz_damping_borne(double damping, double stiffness, double square,
                                  double step);
#define GB_LAW_HERTZ_BORNE (1.0 / 3.0)

/* Critical time step of one particle on a spring, (24), (28), (29): 2/omega (sqrt(1 +
 * xi^2) - xi) with omega^2 = stiffness/mass; INFINITY without a spring.  P3 uses the
 * stiffest contact of the particle and leaves the rest to its safety factor (26): a
 * pair vibrates at sqrt 2 times this omega. */
double gb_law_hertz_critical_step(double stiffness, double mass, double xi);

#endif
