#include "pack/cell/contacts.h"

#include <string.h>

#include "base/alloc.h"

enum { PLANES_3D = 11, PLANES_2D = 5 };

/* Numbers the arrays: the history first, then branch vectors and the last stiffnesses of
 * viscous scenes. */
static void number_planes(struct gb_contacts *contacts, int vector, int spring)
{
    int plane = 0;
    contacts->deepest = plane++;
    for (int k = 0; k < spring; k++) {
        contacts->shear[k] = plane++;
        contacts->roll[k] = plane++;
    }
    contacts->pivot = vector == 3 ? plane++ : -1;
    for (int k = 0; k < vector; k++) {
        contacts->branch[k] = plane++;
    }
    contacts->last_normal = plane++;
    contacts->last_shear = plane++;
    contacts->last_roll = plane++;
    contacts->last_pivot = plane++;
}

bool gb_contacts_init(struct gb_contacts *contacts, struct gb_contacts_shape shape,
                      int64_t capacity, struct gb_error *err)
{
    const bool solid = shape.dimension == 3, viscous = shape.viscous;
    const int base = solid ? PLANES_3D : PLANES_2D, last = viscous ? (solid ? 4 : 3) : 0;
    const size_t room = (size_t)(capacity + 15) / 16 * 16; /* whole vectors */
    /* a viscous scene keeps all: its copies are restored in the middle of a motion */
    *contacts =
        (struct gb_contacts){.capacity = capacity,
                             .planes = base + last,
                             .kept = viscous ? base + last : base - (solid ? 3 : 2),
                             .real = shape.real};
    for (int p = 0; p < contacts->planes; p++) {
        contacts->plane[p] = gb_alloc_array(room, gb_real_size(shape.real), err);
        if (!contacts->plane[p]) {
            gb_contacts_finish(contacts);
            return false;
        }
    }
    number_planes(contacts, solid ? 3 : 2, solid ? 3 : 1);
    return true;
}

void gb_contacts_finish(struct gb_contacts *contacts)
{
    for (int p = 0; p < contacts->planes; p++) {
        gb_alloc_free(contacts->plane[p]);
    }
    *contacts = (struct gb_contacts){0};
}

void gb_contacts_clear(struct gb_contacts *contacts, int64_t slot)
{
    for (int p = 0; p < contacts->planes; p++) {
        gb_contacts_put(contacts, p, slot, 0.0);
    }
    gb_contacts_put(contacts, contacts->deepest, slot, -1.0);
}
