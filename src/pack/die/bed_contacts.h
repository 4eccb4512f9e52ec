#ifndef GB_PACK_DIE_BED_CONTACTS_H
#define GB_PACK_DIE_BED_CONTACTS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "law/law_storakers.h"

/* Contact law of a bed: Hertz-Mindlin-Deresiewicz or Storakers, P3 (1)-(22),
 * the same law between particles and against walls, with its own friction there. */
struct gb_bed_law {
    bool storakers;
    struct gb_law_storakers normal; /* its Hertz part alone unless storakers */
    double shear;                   /* k_t over k_n */
    double damping;                 /* xi, share of critical */
    double mu, mu_wall;
};

/* Contacts that touch or nearly do, structure of arrays: constants of the two radii,
 * history, and the normal force of the last evaluation. */
struct gb_bed_contacts {
    int64_t room;
    double *slab;
    double *hertz;        /* (4/3) E* sqrt R*: force over h^1.5 */
    double *damping;      /* 2 xi sqrt m*: dashpot over the root of the stiffness */
    double *inverse_mass; /* one over the reduced mass m* */
    double *transition;   /* overlap at which Storakers' law becomes plastic */
    double *deepest, *permanent; /* h_max, and h0 where unloading ends; Storakers only */
    double *shear[3];            /* force on the first; across the normal of last time */
    double *normal;              /* f_n of the last evaluation; -1: not touching */
};

enum { GB_BED_HISTORY = 5 }; /* arrays that are history, deepest to shear */

bool gb_bed_contacts_init(struct gb_bed_contacts *contacts, int64_t room,
                          struct gb_error *err);
void gb_bed_contacts_finish(struct gb_bed_contacts *contacts);

/* Radius of a contact that is loaded to this overlap, at effective radius R*: Hertz'
 * a^2 = R* h or gb_law_storakers_contact. */
double gb_bed_contacts_radius(const struct gb_bed_law *law, double star, double overlap);

/* Constants of slot for a pair of radii and masses (INFINITY: a wall), no history. */
void gb_bed_contacts_set(struct gb_bed_contacts *contacts, int64_t slot,
                         const struct gb_bed_law *law, const double radius[2],
                         const double mass[2]);

#endif
