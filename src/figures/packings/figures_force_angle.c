#include "figures/figures_compute.h"

#include "figures/figures_label.h"
#include "figures/packings/state_set.h"
#include "io/state/state_forces.h"

enum { ANGLES = GB_STATE_FORCES_ANGLES };

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
    gb_figures_label_note(series, set);
    gb_state_set_means(series, set, rows, angle, "force_nN");
    gb_state_set_caption(series, &states);
    series->x.low = 0.0;
    series->x.high = 90.0;
    g_free(rows);
    gb_state_set_finish(&states);
    return true;
}
