#include "io/point_columns.h"

#include <math.h>

struct column {
    const char *name;
    size_t offset;
    double factor;
};

#define AT(member) offsetof(struct gb_point, member)
static const struct column table[GB_POINT_ALL_COLUMNS] = {
    {"pxy_MPa", AT(shear_pa[0]), 1e6},
    {"pxz_MPa", AT(shear_pa[1]), 1e6},
    {"pyz_MPa", AT(shear_pa[2]), 1e6},
    {"q_MPa", AT(q_pa), 1e6},
    {"asymmetry", AT(asymmetry), 1.0},
    {"exx", AT(strain[0]), 1.0},
    {"eyy", AT(strain[1]), 1.0},
    {"ezz", AT(strain[2]), 1.0},
    {"gxy", AT(strain[3]), 1.0},
    {"gxz", AT(strain[4]), 1.0},
    {"gyz", AT(strain[5]), 1.0},
    {"fxx", AT(fabric[0]), 1.0},
    {"fyy", AT(fabric[1]), 1.0},
    {"fzz", AT(fabric[2]), 1.0},
    {"fxy", AT(fabric[3]), 1.0},
    {"fxz", AT(fabric[4]), 1.0},
    {"fyz", AT(fabric[5]), 1.0},
    {"anisotropy", AT(anisotropy[0]), 1.0},
    {"anisotropy_bridged", AT(anisotropy[1]), 1.0},
    {"anisotropy_tension", AT(anisotropy[2]), 1.0},
    {"anisotropy_force", AT(anisotropy[3]), 1.0},
    {"leg", AT(leg), 1.0},
    {"floor_MPa", AT(floor_pa), 1e6},
    {"wall_MPa", AT(wall_pa), 1e6},
    {"wall_low_MPa", AT(wall_third_pa[0]), 1e6},
    {"wall_middle_MPa", AT(wall_third_pa[1]), 1e6},
    {"wall_high_MPa", AT(wall_third_pa[2]), 1e6},
    {"wall_friction_mN", AT(wall_friction_n), 1e-3},
    {"punch_work_J", AT(punch_work), 1.0},
    {"axial_springback_percent", AT(axial_springback), 1e-2},
    {"radial_springback_percent", AT(radial_springback), 1e-2},
    {"welded", AT(welded), 1.0},
    {"unrelaxed", AT(unrelaxed), 1.0},
};
#undef AT

const char *gb_point_columns_name(size_t k)
{
    return table[k].name;
}

double gb_point_columns_factor(size_t k)
{
    return table[k].factor;
}

double *gb_point_columns_member(struct gb_point *point, size_t k)
{
    return (double *)(void *)((char *)point + table[k].offset);
}

static bool exchange(struct gb_point *point, size_t first, int count, const char *name,
                     struct gb_record *record, struct gb_error *err)
{
    double value[GB_POINT_ALL_COLUMNS];
    const bool missing = first > 0 && record->loading && !gb_record_find(record, name);
    for (int k = 0; k < count; k++) {
        /* the sign of 0/0 is the compiler's choice: a missing value has no sign */
        const double member = *gb_point_columns_member(point, first + (size_t)k);
        value[k] = missing || isnan(member) ? (double)NAN : member;
    }
    const bool done = missing || gb_record_array(record, name, GB_RECORD_DOUBLE, 1, count,
                                                 "SI", value, err);
    for (int k = 0; k < count; k++) {
        *gb_point_columns_member(point, first + (size_t)k) = value[k];
    }
    return done;
}

bool gb_point_columns_record(struct gb_point *point, const char *name,
                             struct gb_record *record, struct gb_error *err)
{
    return exchange(point, 0, GB_POINT_COLUMNS, name, record, err);
}

bool gb_point_columns_record_die(struct gb_point *point, const char *name,
                                 struct gb_record *record, struct gb_error *err)
{
    return exchange(point, GB_POINT_COLUMNS, GB_POINT_DIE_COLUMNS, name, record, err);
}

bool gb_point_columns_record_step(struct gb_point *point, const char *name,
                                  struct gb_record *record, struct gb_error *err)
{
    return exchange(point, GB_POINT_DIE_END, GB_POINT_STEP_COLUMNS, name, record, err);
}

double gb_point_columns_value(const struct gb_point *point, size_t k)
{
    return *(const double *)(const void *)((const char *)point + table[k].offset) /
           table[k].factor;
}
