#ifndef GB_SCENE_CONTACT_PAIR_H
#define GB_SCENE_CONTACT_PAIR_H

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "law/law_storakers.h"

/* Two bodies in contact by the law of Hertz or Storakers: sizes, materials and
 * constants frozen from the keys, in SI units.  Source: P3 section 4. */
struct gb_contact_pair {
    struct gb_law_storakers law; /* law.hertz: the elastic part */
    double radius;               /* R*, m */
    double diameter;             /* of the smaller body, m */
    double mass[2];              /* kg; INFINITY: a wall */
    double yield_pa;             /* of the weaker body */
    double damping;              /* xi */
    double mu;
};

/* Errors: GB_ERR_INPUT for two walls, and for a yield stress above Young's modulus. */
bool gb_contact_pair_init(struct gb_contact_pair *pair, const struct gb_params *params,
                          struct gb_error *err);

/* Critical time step (27)-(29), s, of the lighter body on a spring of this stiffness. */
double gb_contact_pair_critical_step(const struct gb_contact_pair *pair,
                                     double stiffness);

#endif
