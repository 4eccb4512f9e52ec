#include "pack/die/bed_contacts.h"

#include <math.h>

#include "base/alloc.h"

enum { PLANES = 10 };

bool gb_bed_contacts_init(struct gb_bed_contacts *contacts, int64_t room,
                          struct gb_error *err)
{
    const int64_t stride = (room + 7) / 8 * 8 + 8;
    double *slab = gb_alloc_array((size_t)(PLANES * stride), sizeof *slab, err);
    *contacts = (struct gb_bed_contacts){.slab = slab, .room = room};
    if (!slab) {
        return false;
    }
    double **const plane[PLANES] = {
        &contacts->hertz,      &contacts->damping,  &contacts->inverse_mass,
        &contacts->transition, &contacts->deepest,  &contacts->permanent,
        &contacts->shear[0],   &contacts->shear[1], &contacts->shear[2],
        &contacts->normal,
    };
    for (int p = 0; p < PLANES; p++) {
        *plane[p] = slab + p * stride;
    }
    return true;
}

void gb_bed_contacts_finish(struct gb_bed_contacts *contacts)
{
    gb_alloc_free(contacts->slab);
    *contacts = (struct gb_bed_contacts){0};
}

double gb_bed_contacts_radius(const struct gb_bed_law *law, double star, double overlap)
{
    return law->storakers ? gb_law_storakers_contact(&law->normal, star, overlap)
                          : sqrt(star * overlap);
}

void gb_bed_contacts_set(struct gb_bed_contacts *c, int64_t slot,
                         const struct gb_bed_law *law, const double radius[2],
                         const double mass[2])
{
    const double r = gb_law_hertz_radius(radius[0], radius[1]);
    const double reduced = gb_law_hertz_radius(mass[0], mass[1]); /* the same formula */
    c->hertz[slot] = 4.0 / 3.0 * law->normal.hertz.modulus * sqrt(r);
    c->damping[slot] = gb_law_hertz_damping(1.0, reduced, law->damping);
    c->inverse_mass[slot] = 1.0 / reduced;
    c->transition[slot] =
        law->storakers ? gb_law_storakers_transition(&law->normal, r) : HUGE_VAL;
    c->deepest[slot] = c->permanent[slot] = 0.0;
    c->shear[0][slot] = c->shear[1][slot] = c->shear[2][slot] = 0.0;
    c->normal[slot] = -1.0;
}
