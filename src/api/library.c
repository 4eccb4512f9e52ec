#include "greenbody/greenbody.h"

#include <glib.h>

const char *gb_library_version(void)
{
    return GB_VERSION;
}

struct member {
    const char *name;
    size_t offset, count;
    char type;
};

#define NUMBERS(name, type)                                                              \
    {                                                                                    \
#name, offsetof(struct gb_point, name), 1, type                                  \
    }
#define ARRAY(name)                                                                      \
    {                                                                                    \
#name, offsetof(struct gb_point, name),                                          \
            sizeof(((struct gb_point *)0)->name) / sizeof(double), 'd'                   \
    }
static const struct member members[] = {
    NUMBERS(branch, 'i'),
    NUMBERS(branch_from_pa, 'd'),
    NUMBERS(step, 'q'),
    NUMBERS(density, 'd'),
    NUMBERS(px_pa, 'd'),
    NUMBERS(py_pa, 'd'),
    NUMBERS(pz_pa, 'd'),
    NUMBERS(p_pa, 'd'),
    NUMBERS(coordination, 'd'),
    NUMBERS(bridged, 'd'),
    NUMBERS(rattlers, 'd'),
    NUMBERS(residual, 'd'),
    NUMBERS(iterations, 'q'),
    NUMBERS(evaluations, 'q'),
    NUMBERS(seconds, 'd'),
    NUMBERS(time_s, 'd'),
    NUMBERS(kinetic, 'd'),
    NUMBERS(work, 'd'),
    NUMBERS(elastic, 'd'),
    NUMBERS(dissipated, 'd'),
    NUMBERS(energy_residual, 'd'),
    NUMBERS(central, 'd'),
    NUMBERS(height_m, 'd'),
    NUMBERS(height_change, 'd'),
    NUMBERS(target_pa, 'd'),
    NUMBERS(floor_over_punch, 'd'),
    NUMBERS(floor_pa, 'd'),
    NUMBERS(wall_pa, 'd'),
    ARRAY(wall_third_pa),
    NUMBERS(wall_friction_n, 'd'),
    NUMBERS(punch_work, 'd'),
    NUMBERS(axial_springback, 'd'),
    NUMBERS(radial_springback, 'd'),
    NUMBERS(welded, 'd'),
    ARRAY(shear_pa),
    NUMBERS(q_pa, 'd'),
    NUMBERS(asymmetry, 'd'),
    ARRAY(strain),
    ARRAY(fabric),
    ARRAY(anisotropy),
    NUMBERS(leg, 'd'),
    NUMBERS(unrelaxed, 'd'),
};
#undef NUMBERS
#undef ARRAY

bool gb_library_point_member(size_t index, const char **name, size_t *offset,
                             size_t *count, char *type)
{
    if (index >= G_N_ELEMENTS(members)) {
        return false;
    }
    const struct member *member = &members[index];
    if (name) {
        *name = member->name;
    }
    if (offset) {
        *offset = member->offset;
    }
    if (count) {
        *count = member->count;
    }
    if (type) {
        *type = member->type;
    }
    return true;
}
