#include "many/die_summary.h"

#include <math.h>
#include <string.h>

#include "measure/average.h"
#include "scene/loading_kind.h"

/* Last value of a column on a branch. */
static double last(const struct gb_table *table, const char *branch, const char *column)
{
    const double *values = gb_table_column(table, column, NULL);
    for (size_t k = gb_table_rows(table); values != NULL && k > 0; k--) {
        if (strcmp(gb_table_word(table, k - 1), branch) == 0) {
            return values[k - 1];
        }
    }
    return (double)NAN;
}

static double largest(const struct gb_table *table, const char *branch,
                      const char *column)
{
    const double *values = gb_table_column(table, column, NULL);
    double most = (double)NAN;
    for (size_t k = 0; values != NULL && k < gb_table_rows(table); k++) {
        if (strcmp(gb_table_word(table, k), branch) == 0) {
            most = fmax(most, values[k]);
        }
    }
    return most;
}

static double density_pressed(const struct gb_table *table)
{
    return last(table, "load", "density");
}

static double density_ejected(const struct gb_table *table)
{
    return last(table, "ejected", "density");
}

static double floor_over_punch(const struct gb_table *table)
{
    return last(table, "load", "floor_over_punch");
}

/* Mean wall pressure over the thirds of the height. */
static double wall(const struct gb_table *table, const char *branch)
{
    return (last(table, branch, "wall_low_MPa") + last(table, branch, "wall_middle_MPa") +
            last(table, branch, "wall_high_MPa")) /
           3.0;
}

/* Radial pressure over the mean of the pressures on punch and floor. */
static double lateral_ratio(const struct gb_table *table)
{
    const double axial =
        0.5 * (last(table, "load", "p_MPa") + last(table, "load", "floor_MPa"));
    return wall(table, "load") / axial;
}

static double residual_radial(const struct gb_table *table)
{
    return wall(table, "in-die");
}

static double ejection_force(const struct gb_table *table)
{
    return largest(table, "eject", "wall_friction_mN");
}

static double axial_in_die(const struct gb_table *table)
{
    return last(table, "in-die", "axial_springback_percent");
}

static double axial(const struct gb_table *table)
{
    return last(table, "ejected", "axial_springback_percent");
}

static double radial(const struct gb_table *table)
{
    return last(table, "ejected", "radial_springback_percent");
}

static double work_returned(const struct gb_table *table)
{
    const double peak = last(table, "load", "punch_work_J");
    return 100.0 * (1.0 - last(table, "in-die", "punch_work_J") / peak);
}

static double welded(const struct gb_table *table)
{
    return last(table, "ejected", "welded");
}

static const struct gb_die_summary_row rows[] = {
    {"density_pressed", "relative density under the full pressure", density_pressed},
    {"density_ejected", "relative density of the ejected compact", density_ejected},
    {"floor_over_punch", "ratio of forces under the full pressure", floor_over_punch},
    {"radial_over_axial", "wall pressure over the mean of punch and floor",
     lateral_ratio},
    {"residual_radial_MPa", "mean wall pressure at rest with the punch off",
     residual_radial},
    {"ejection_mN", "largest force of ejection", ejection_force},
    {"axial_in_die_percent", "axial springback at rest in the die", axial_in_die},
    {"axial_percent", "axial springback after ejection", axial},
    {"radial_percent", "radial springback after ejection", radial},
    {"work_returned_percent", "work given back to the punch", work_returned},
    {"welded", "share of the cold welds that holds", welded},
    {0},
};

const struct gb_die_summary_row *gb_die_summary_table(void)
{
    return rows;
}

size_t gb_die_summary_mean(const struct gb_die_summary_row *row,
                           const struct gb_runset *set, size_t group, double *mean,
                           double *error)
{
    double *values = g_new(double, set->count + 1);
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            values[count++] = row->value(set->run[i].table);
        }
    }
    const size_t used = gb_average_values(values, count, mean, error);
    g_free(values);
    return used;
}

bool gb_die_summary_check(const struct gb_runset *set, struct gb_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        if (run->table == NULL ||
            gb_loading_kind_of(&run->params)->columns != GB_COLUMNS_DIE ||
            run->params.die_cycle != GB_DIE_CYCLE_FULL) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: no full die cycle; expected runs with "
                                "scene.kind = die and die.cycle = full",
                                run->directory);
        }
        if (isnan(axial(run->table))) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.300s: its compact is not ejected yet", run->directory);
        }
    }
    return true;
}
