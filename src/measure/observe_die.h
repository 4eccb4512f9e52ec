#ifndef GB_MEASURE_OBSERVE_DIE_H
#define GB_MEASURE_OBSERVE_DIE_H

#include <stdint.h>

#include "measure/observe.h"
#include "pack/die/bed.h"

/* Measures of a bed in a die right after an evaluation; reduced units. */

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
