#include "figures/figures_compute.h"

#include <math.h>

#include "figures/figures_label.h"
#include "figures/packings/state_set.h"
#include "io/state/state_forces.h"

enum { ANGLES = GB_STATE_FORCES_ANGLES };

#define FORCE_AXIS "mean normal force <i>f<sub>n</sub></i> "

/* Units of forces in ascending order, and the force from which each is taken: nN for the
 * thousands of P1 Fig. 14. */
static const struct unit {
    double nn, from_nn;
    const char *column, *axis;
} units[] = {
    {1e-3, 0.0, "force_pN", FORCE_AXIS "(pN)"},
    {1.0, 0.1, "force_nN", FORCE_AXIS "(nN)"},
    {1e3, 1e4, "force_uN", FORCE_AXIS "(\xc2\xb5N)"},
    {1e6, 1e6, "force_mN", FORCE_AXIS "(mN)"},
    {1e9, 1e9, "force_N", FORCE_AXIS "(N)"},
};

/* The unit of the largest of `count` forces in nN. */
static const struct unit *fitting_unit(const double *force, size_t count)
{
    double largest = 0.0;
    size_t k = G_N_ELEMENTS(units) - 1;
    for (size_t i = 0; i < count; i++) {
        largest = isfinite(force[i]) ? fmax(largest, fabs(force[i])) : largest;
    }
    while (k > 0 && largest < units[k].from_nn) {
        k--;
    }
    return &units[largest > 0.0 ? k : 1];
}

/* P1 Fig. 14. */
bool gb_figures_force_angle(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_state_set states;
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    gb_series_init(series, ANGLES);
    double *rows = g_new(double, set->count * series->rows);
    double *angle = gb_series_column(series, "angle_deg");
    for (int k = 0; k < ANGLES; k++) {
        angle[k] = 90.0 * (k + 0.5) / ANGLES;
    }
    for (size_t i = 0; i < set->count; i++) {
        gb_state_forces_by_angle(states.state[i], rows + i * series->rows);
    }
    const size_t count = set->count * series->rows;
    const struct unit *unit = fitting_unit(rows, count);
    for (size_t i = 0; i < count; i++) {
        rows[i] /= unit->nn;
    }
    gb_figures_label_note(series, set);
    gb_state_set_means(series, set, rows, angle, unit->column);
    series->y.name = unit->column;
    series->y.label = unit->axis;
    gb_state_set_caption(series, &states);
    series->x.low = 0.0;
    series->x.high = 90.0;
    g_free(rows);
    gb_state_set_finish(&states);
    return true;
}
