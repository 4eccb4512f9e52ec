#ifndef GB_MEASURE_OBSERVE_H
#define GB_MEASURE_OBSERVE_H

#include <stdint.h>

#include "pack/cell/world.h"
#include "pack/die/bed.h"
#include "pack/kernel/fabric_sums.h"

/* Mean of the normal components. */
double gb_observe_mean(const double tensor[3][3], int dimension);

/* sqrt(3/2 s:s), s the deviator of the symmetric part; 2D: sqrt(2 s:s), the difference of
 * the principal values.  As q of a triaxial test. */
double gb_observe_deviatoric(const double tensor[3][3], int dimension);

/* Norm of the antisymmetric part over the mean; NaN where the mean is 0. */
double gb_observe_asymmetry(const double tensor[3][3], int dimension);

/* Largest eigenvalue of the deviator of the symmetric part, in closed form. */
double gb_observe_largest_deviator(const double tensor[3][3], int dimension);

/* Fabric tensors F_ij = <n_i n_j> of a world right after an evaluation, n the unit vector
 * along a contact (r < d).  NaN where there is no such contact. */
struct gb_fabric {
    double all[6]; /* of all contacts: xx, yy, zz, xy, xz, yz */
    /* By enum gb_fabric_of: 3/2 of the largest eigenvalue of the deviator, 2D: twice; from
     * 0 (isotropic) to 1 (all contacts parallel). */
    double anisotropy[GB_FABRIC_KINDS];
};

/* Fabric, and in the same pass the pressure tensor of gb_observe_pressure (E). */
void gb_observe_fabric(const struct gb_world *world, double pressure[3][3],
                       struct gb_fabric *fabric);

/* Measures of a world right after an evaluation; reduced units. */

/* rho = N (pi/6) d^3 / V; 2D: (pi/4) N d^2 / A. */
double gb_observe_density(const struct gb_world *world);

/* P_ij = (1/V) sum over pairs of f_i r_j, f the whole force on the first particle, r from
 * the second to it: minus the stress tensor of P1 (16).  E. */
void gb_observe_pressure(const struct gb_world *world, double pressure[3][3]);

/* Recoverable energy of contacts and attraction along their present branches: rod
 * law or line of the bridge, springs, dispersion (0 beyond the cutoff).  E d^3. */
double gb_observe_elastic(const struct gb_world *world);

struct gb_contact_counts {
    int64_t contacts; /* pairs with r < d */
    int64_t bridged;
    int64_t rattlers;    /* particles with fewer than two contacts */
    double coordination; /* 2 contacts / N */
};

/* share: of particles with 0, 1, ..., bins-1 (or more) contacts; NULL is fine.
 * each: contacts of every particle (count values); NULL is fine. */
void gb_observe_contacts(const struct gb_world *world, struct gb_contact_counts *counts,
                         double *share, int bins, int32_t *each);

/* Mean f_n of contacts (r < d) in bins of the angle between contact axis and z, 0..90
 * degrees; NaN in empty bins.  P1 Fig. 14. */
void gb_observe_rose(const struct gb_world *world, int bins, double *mean);

/* Solid over the cylinder from the floor up to a height, P3 5. */
double gb_observe_die_density(const struct gb_bed *bed, double height);

/* Solid within a ball in the middle of the powder, over the ball; NaN where the powder is
 * lower than the ball is wide.  P3 5. */
double gb_observe_die_central(const struct gb_bed *bed, double height, double radius);

/* As gb_observe_contacts, of contacts between particles; a particle on a wall is no
 * rattler when it touches one other particle. */
void gb_observe_die_contacts(const struct gb_bed *bed, struct gb_contact_counts *counts,
                             double *share, int bins, int32_t *each);

/* Height of the powder below the funnel: of the highest particle there that touches
 * another one or a wall; 0 without one. */
double gb_observe_die_filled(const struct gb_bed *bed);

/* As gb_observe_rose, of contacts between particles. */
void gb_observe_die_rose(const struct gb_bed *bed, int bins, double *mean);

/* Mean radial pressure on the wall in bands of equal height from the floor up to `height`,
 * from the normal forces of the last evaluation; NaN where height is not above 0.  During
 * an ejection the contacts with the rim of the bore count too.
 *
 * pressure   bands values, E */
void gb_observe_die_wall(const struct gb_bed *bed, double height, int bands,
                         double *pressure);

/* Unit vector of pair `slot`, from its second particle to the first, and the whole force
 * on the first.  The pair touches. */
void gb_observe_die_force(const struct gb_bed *bed, int64_t slot, double unit[3],
                          double force[3]);

#endif
