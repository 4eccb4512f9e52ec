#include "io/point_columns.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define MEMBER_AT(name) .member = #name, .offset = offsetof(struct gb_point, name)
#define BRANCH(name)    MEMBER_AT(name), .count = 1, .type = 'i', .scenes = GB_POINT_ALL
#define WHOLE(name)     MEMBER_AT(name), .count = 1, .type = 'q', .scenes = GB_POINT_ALL
#define NUMBERS(name, of)                                                                \
    MEMBER_AT(name), .count = sizeof(((struct gb_point *)0)->name) / sizeof(double),     \
                     .type = 'd', .scenes = GB_POINT_##of
#define COLUMNS(names, unit_in_si) .columns = names, .si = unit_in_si
#define KEPT(name, unit_of_item, of)                                                     \
    .item = name, .unit = unit_of_item, .kept = GB_POINT_##of
/* Successive rows with one item name share the item. */
#define TOGETHER(name, of) KEPT(name, "SI", of)
#define STATE(name)        .state = name

static const struct gb_point_column table[] = {
    {BRANCH(branch), COLUMNS("branch", 1.0), KEPT("branch", "1", ALL)},
    {NUMBERS(branch_from_pa, ALL), KEPT("branch_from", "Pa", ALL),
     STATE("branch_from_pa")},
    {WHOLE(step), COLUMNS("step", 1.0), KEPT("step", "1", ALL), STATE("step"),
     .status = "step"},
    {NUMBERS(density, ALL), COLUMNS("density", 1.0), KEPT("density", "1", ALL),
     STATE("density"), .finite = true, .status = "density"},
    {NUMBERS(px_pa, ALL), COLUMNS("px_MPa", 1e6), KEPT("px", "Pa", ALL), STATE("px_pa"),
     .finite = true},
    {NUMBERS(py_pa, ALL), COLUMNS("py_MPa", 1e6), KEPT("py", "Pa", ALL), STATE("py_pa"),
     .finite = true},
    {NUMBERS(pz_pa, ALL), COLUMNS("pz_MPa", 1e6), KEPT("pz", "Pa", ALL), STATE("pz_pa"),
     .finite = true},
    {NUMBERS(p_pa, ALL), COLUMNS("p_MPa", 1e6), KEPT("p", "Pa", ALL), STATE("p_pa"),
     .finite = true, .status = "pressure_MPa"},
    {NUMBERS(coordination, ALL), COLUMNS("coordination", 1.0),
     KEPT("coordination", "1", ALL), STATE("coordination"), .finite = true,
     .status = "coordination"},
    {NUMBERS(bridged, ALL), COLUMNS("bridged", 1.0), KEPT("bridged", "1", ALL),
     STATE("bridged")},
    {NUMBERS(rattlers, ALL), COLUMNS("rattlers", 1.0), KEPT("rattlers", "1", ALL),
     STATE("rattlers")},
    {NUMBERS(residual, ALL), COLUMNS("residual", 1.0), KEPT("residual", "1", ALL),
     STATE("residual")},
    {WHOLE(iterations), COLUMNS("iterations", 1.0), KEPT("iterations", "1", ALL),
     STATE("iterations")},
    {WHOLE(evaluations), COLUMNS("evaluations", 1.0), KEPT("evaluations", "1", ALL),
     STATE("evaluations")},
    {NUMBERS(seconds, ALL), COLUMNS("seconds", 1.0), .decimals = 3, STATE("seconds"),
     .finite = true},

    {NUMBERS(time_s, TIMED), COLUMNS("time_ns", 1e-9), .times = 1e9,
     KEPT("time", "s", ALL)},
    {NUMBERS(kinetic, MOVING), COLUMNS("kinetic", 1.0), KEPT("kinetic", "J", ALL)},
    {NUMBERS(work, MOVING), COLUMNS("work", 1.0), KEPT("work", "J", ALL)},
    {NUMBERS(elastic, MOVING), COLUMNS("elastic", 1.0), KEPT("elastic", "J", ALL)},
    {NUMBERS(dissipated, MOVING), COLUMNS("dissipated", 1.0),
     KEPT("dissipated", "J", ALL)},
    {NUMBERS(energy_residual, MOVING), COLUMNS("energy_residual", 1.0),
     KEPT("energy_residual", "1", ALL)},

    {NUMBERS(central, DIE), COLUMNS("central_density", 1.0), KEPT("central", "1", ALL)},
    {NUMBERS(height_m, DIE), COLUMNS("height_um", 1e-6), .times = 1e6,
     KEPT("height", "m", ALL)},
    {NUMBERS(height_change, DIE), COLUMNS("height_change", 1.0),
     KEPT("height_change", "1", ALL)},
    {NUMBERS(target_pa, DIE), COLUMNS("wanted_MPa", 1e6), .times = 1e-6,
     KEPT("wanted", "Pa", ALL)},
    {NUMBERS(floor_over_punch, DIE), COLUMNS("floor_over_punch", 1.0),
     KEPT("floor_over_punch", "1", ALL)},
    {NUMBERS(floor_pa, DIE), COLUMNS("floor_MPa", 1e6), TOGETHER("die", DIE)},
    {NUMBERS(wall_pa, DIE), COLUMNS("wall_MPa", 1e6), TOGETHER("die", DIE)},
    {NUMBERS(wall_third_pa, DIE),
     COLUMNS("wall_low_MPa,wall_middle_MPa,wall_high_MPa", 1e6), TOGETHER("die", DIE)},
    {NUMBERS(wall_friction_n, DIE), COLUMNS("wall_friction_mN", 1e-3),
     TOGETHER("die", DIE)},
    {NUMBERS(punch_work, DIE), COLUMNS("punch_work_J", 1.0), TOGETHER("die", DIE)},
    {NUMBERS(axial_springback, DIE), COLUMNS("axial_springback_percent", 1e-2),
     TOGETHER("die", DIE)},
    {NUMBERS(radial_springback, DIE), COLUMNS("radial_springback_percent", 1e-2),
     TOGETHER("die", DIE)},
    {NUMBERS(welded, DIE), COLUMNS("welded", 1.0), TOGETHER("die", DIE)},

    {NUMBERS(shear_pa, CELL), COLUMNS("pxy_MPa,pxz_MPa,pyz_MPa", 1e6),
     TOGETHER("tensors", ALL), STATE("shear_stress_pa")},
    {NUMBERS(q_pa, CELL), COLUMNS("q_MPa", 1e6), TOGETHER("tensors", ALL)},
    {NUMBERS(asymmetry, CELL), COLUMNS("asymmetry", 1.0), TOGETHER("tensors", ALL)},
    {NUMBERS(strain, CELL), COLUMNS("exx,eyy,ezz,gxy,gxz,gyz", 1.0),
     TOGETHER("tensors", ALL), STATE("strain")},
    {NUMBERS(fabric, CELL), COLUMNS("fxx,fyy,fzz,fxy,fxz,fyz", 1.0),
     TOGETHER("tensors", ALL), STATE("fabric")},
    {NUMBERS(anisotropy, CELL),
     COLUMNS("anisotropy,anisotropy_bridged,anisotropy_tension,anisotropy_force", 1.0),
     TOGETHER("tensors", ALL)},
    {NUMBERS(leg, CELL), COLUMNS("leg", 1.0), TOGETHER("tensors", ALL)},
    {NUMBERS(unrelaxed, STILL), COLUMNS("unrelaxed", 1.0), TOGETHER("unrelaxed", STILL)},
};

enum { ROWS = sizeof table / sizeof table[0] };

const struct gb_point_column *gb_point_columns_at(size_t index)
{
    return index < ROWS ? &table[index] : NULL;
}

static size_t size_of(const struct gb_point_column *row)
{
    return row->count * (row->type == 'i' ? sizeof(int) : sizeof(double));
}

double gb_point_columns_value(const struct gb_point_column *row,
                              const struct gb_point *point, size_t k)
{
    const char *member = (const char *)point + row->offset;
    double value;
    int64_t whole;
    if (row->type == 'q') {
        memcpy(&whole, member, sizeof whole);
        return (double)whole;
    }
    memcpy(&value, member + k * sizeof value, sizeof value);
    return row->times != 0.0 ? row->times * value : value / row->si;
}

void gb_point_columns_set(const struct gb_point_column *row, struct gb_point *point,
                          size_t k, double value)
{
    char *member = (char *)point + row->offset;
    const double number = value * row->si;
    const int64_t whole = fabs(value) < 9e15 ? (int64_t)value : 0;
    if (row->type == 'q') {
        memcpy(member, &whole, sizeof whole);
    } else {
        memcpy(member + k * sizeof number, &number, sizeof number);
    }
}

static void put_nan(const struct gb_point_column *row, struct gb_point *point)
{
    for (size_t k = 0; k < row->count; k++) {
        gb_point_columns_set(row, point, k, (double)NAN);
    }
}

void gb_point_columns_clear(struct gb_point *point)
{
    for (size_t r = 0; r < ROWS; r++) {
        if (table[r].scenes != GB_POINT_ALL) {
            put_nan(&table[r], point);
        }
    }
}

/* Number of rows that share the item of row `first`, and their total number of values. */
static size_t rows_of(size_t first, int *numbers)
{
    size_t end = first;
    *numbers = 0;
    while (end < ROWS && table[end].item != NULL &&
           strcmp(table[end].item, table[first].item) == 0) {
        *numbers += (int)table[end++].count;
    }
    return end;
}

static enum gb_record_type type_of(const struct gb_point_column *row)
{
    return row->type == 'd'   ? GB_RECORD_DOUBLE
           : row->type == 'q' ? GB_RECORD_INT64
                              : GB_RECORD_INT32;
}

bool gb_point_columns_save(const struct gb_point *point, const char *prefix,
                           enum gb_curve_columns scene, struct gb_record *record,
                           struct gb_error *err)
{
    size_t end = 0;
    for (size_t r = 0; r < ROWS; r = end) {
        const struct gb_point_column *row = &table[r];
        char name[GB_RECORD_NAME];
        int numbers = 0;
        end = r + 1;
        if (row->item == NULL || (row->kept >> scene & 1U) == 0) {
            continue;
        }
        end = rows_of(r, &numbers);
        snprintf(name, sizeof name, "%s/%s", prefix, row->item);
        struct gb_record_item *item =
            gb_record_add(record, name, type_of(row), 1, numbers, row->unit, err);
        if (item == NULL) {
            return false;
        }
        char *to = item->data;
        for (size_t k = r; k < end; k++) {
            memcpy(to, (const char *)point + table[k].offset, size_of(&table[k]));
            to += size_of(&table[k]);
        }
        /* missing values must not differ in sign: compilers may compute 0/0 as -NaN */
        for (int k = 0; row->type == 'd' && k < numbers; k++) {
            double *value = (double *)item->data + k;
            *value = isnan(*value) ? (double)NAN : *value;
        }
    }
    return true;
}

bool gb_point_columns_load(struct gb_point *point, const char *prefix,
                           enum gb_curve_columns scene, const struct gb_record *record,
                           struct gb_error *err)
{
    size_t end = 0;
    for (size_t r = 0; r < ROWS; r = end) {
        const struct gb_point_column *row = &table[r];
        char name[GB_RECORD_NAME];
        int numbers = 0;
        end = r + 1;
        if (row->item == NULL || (row->kept >> scene & 1U) == 0) {
            continue;
        }
        end = rows_of(r, &numbers);
        snprintf(name, sizeof name, "%s/%s", prefix, row->item);
        const struct gb_record_item *item = gb_record_find(record, name);
        if (item == NULL || item->type != type_of(row) || item->rows != 1 ||
            item->columns != numbers || item->f32) {
            return gb_error_set(err, GB_ERR_INPUT, "%s: is missing or of another shape",
                                name);
        }
        const char *from = item->data;
        for (size_t k = r; k < end && (row->scenes >> scene & 1U) != 0; k++) {
            memcpy((char *)point + table[k].offset, from, size_of(&table[k]));
            from += size_of(&table[k]);
        }
    }
    return true;
}
