#include "figures/figures_compute.h"

#include <math.h>

#include "figures/figures_label.h"
#include "figures/runs/density_at_pressure.h"

static const double default_mpa = 100.0; /* densities are compared there in P1 */

/* First group of the same scene but for the diameter, and for how far and how finely it is
 * loaded. */
static size_t family_of(const struct gb_runset *set, size_t group)
{
    static const char *const may_differ[] = {
        "particles.diameter", "loading.until",  "loading.unload_from", "loading.step",
        "loading.record",     "structure.base", "numerics.",           NULL};
    for (size_t g = 0; g < group; g++) {
        if (gb_runset_difference(set, g, group, may_differ) == NULL) {
            return g;
        }
    }
    return group;
}

/* Order by family, then by diameter: no row of another family interrupts a line. */
static bool comes_before(const struct gb_runset *set, size_t a, size_t b)
{
    const size_t first = family_of(set, a);
    const size_t second = family_of(set, b);
    return first != second ? first < second
                           : gb_runset_first(set, a)->params.diameter_m <
                                 gb_runset_first(set, b)->params.diameter_m;
}

static void sort_groups(size_t *order, const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        size_t at = g;
        while (at > 0 && comes_before(set, g, order[at - 1])) {
            order[at] = order[at - 1];
            at--;
        }
        order[at] = g;
    }
}

/* Columns of the figure; row k is group order[k]. */
struct rows {
    size_t *order;
    double *diameter, *density, *error;
};

/* Difference of the density of a family to that of its smallest diameter, % of theoretical
 * density. */
static void draw_family(struct gb_series *series, const struct gb_runset *set,
                        const struct rows *rows, size_t family, int style)
{
    size_t smallest = set->groups;
    double *value = gb_series_column(series, "difference_%d_points", style + 1);
    double *error = gb_series_column(series, "se_%d_points", style + 1);
    for (size_t k = 0; k < set->groups; k++) {
        if (family_of(set, rows->order[k]) != family) {
            continue;
        }
        smallest = smallest == set->groups ? k : smallest;
        value[k] = 100.0 * (rows->density[k] - rows->density[smallest]);
        error[k] =
            k == smallest ? NAN : 100.0 * hypot(rows->error[k], rows->error[smallest]);
    }
    char *label = gb_figures_label(set, family, "particles.diameter");
    gb_series_draw(series, rows->diameter, value, error, GB_FIGURE_BOTH, style, label);
    g_free(label);
}

static bool one_diameter(const struct gb_runset *set)
{
    for (size_t g = 1; g < set->groups; g++) {
        if (gb_runset_first(set, g)->params.diameter_m !=
            gb_runset_first(set, 0)->params.diameter_m) {
            return false;
        }
    }
    return true;
}

static bool fill(struct gb_series *series, const struct gb_runset *set,
                 const struct rows *rows, double pressure_mpa, struct gb_error *err)
{
    bool good = true;
    for (size_t k = 0; k < set->groups && good; k++) {
        rows->diameter[k] = 1e9 * gb_runset_first(set, rows->order[k])->params.diameter_m;
        good = gb_density_at_pressure(set, rows->order[k], pressure_mpa,
                                      &rows->density[k], &rows->error[k], err) > 0;
    }
    int style = 0;
    for (size_t g = 0; g < set->groups && good; g++) {
        if (family_of(set, g) == g) {
            draw_family(series, set, rows, g, style++);
        }
    }
    return good;
}

/* P1 Fig. 6. */
bool gb_figures_size_effect(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    const double mpa = input->pressure_pa > 0.0 ? input->pressure_pa / 1e6 : default_mpa;
    if (one_diameter(set)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "size-effect: all runs have one diameter; accepted runs of "
                            "several");
    }
    gb_series_init(series, set->groups);
    gb_figures_label_note(series, set);
    struct rows rows = {.order = g_new(size_t, set->groups)};
    rows.diameter = gb_series_column(series, "diameter_nm");
    rows.density = gb_series_column(series, "density");
    rows.error = gb_series_column(series, "se");
    sort_groups(rows.order, set);
    const bool good = fill(series, set, &rows, mpa, err);
    g_free(rows.order);
    gb_series_note(series, "density where loading first reaches %g MPa", mpa);
    gb_series_caption(
        series, "At %g MPa, relative to the smallest diameter of each series.", mpa);
    return good;
}
