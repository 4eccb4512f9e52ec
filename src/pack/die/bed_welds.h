#ifndef GB_PACK_DIE_BED_WELDS_H
#define GB_PACK_DIE_BED_WELDS_H

#include "base/record.h"
#include "pack/die/bed.h"

/* Cold welds between the spheres of a compact: necks that form where contacts touch under
 * the full pressure of the punch, and that hold the compact together without the die.
 *
 * A weld keeps the radius a of the contact under that pressure.  Along its axis it carries
 * tension alone: the contact's own law holds until its force is zero (at distance
 * `length`), and beyond the neck is a flat punch, k = 2 E* a, so that the force goes through
 * zero without a step.  It breaks for good where the tension exceeds strength pi a^2.
 * Across it the neck is Mindlin's spring k_t = 8 G* a, free of stress when it forms, that
 * yields at strength/sqrt 3 (von Mises) times pi a^2, whatever the normal force, as the
 * shear spring of P1 (5) at its cap.  Dashpots of the share xi of the critical damping.
 * No moments: the neck of a few per cent of a sphere bends easily.  Contacts do not gain
 * strength later.  Source: the parallel bond of D. O. Potyondy, P. A. Cundall, Int. J. Rock
 * Mech. Min. Sci. 41, 1329 (2004), with the stiffness of the contact instead of a bar. */
struct gb_bed_welds {
    int64_t count;  /* unbroken */
    int64_t formed; /* at the start */
    int64_t room;
    int32_t *first, *other; /* sorted as a list of contacts */
    double *slab;
    double *length, *radius; /* distance of the centres without tension; a */
    double *force[3];        /* across the weld, on the first */
    double strength;         /* tensile, E */
};

/* Welds every touching contact between particles, right after an evaluation; strength
 * above 0.  Welds that exist are replaced.  Errors: GB_ERR_MEMORY. */
bool gb_bed_welds_form(struct gb_bed *bed, double strength, struct gb_error *err);
void gb_bed_welds_destroy(struct gb_bed_welds *welds); /* NULL is fine */

/* Adds forces and torques of all welds, removes broken ones, and adds their stiffness to
 * the tally. */
void gb_bed_welds_sweep(struct gb_bed *bed, double step);

/* Share of the welds that has not broken; NaN without any. */
double gb_bed_welds_share(const struct gb_bed *bed);

/* Elastic energy in all welds, E d^3. */
double gb_bed_welds_energy(const struct gb_bed *bed);

/* *to becomes a copy of from, which may be NULL; its memory is used again. */
bool gb_bed_welds_copy(struct gb_bed_welds **to, const struct gb_bed_welds *from,
                       struct gb_error *err);

/* Welds of a bed into a record, or back; a record without them has none. */
bool gb_bed_welds_record(struct gb_bed *bed, struct gb_record *record,
                         struct gb_error *err);

#endif
