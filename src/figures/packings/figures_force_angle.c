#include "figures/figures_compute.h"

#include <math.h>

#include "base/vec.h"
#include "figures/figures_label.h"
#include "figures/packings/state_set.h"
#include "measure/structure.h"

/* Bins of the angle. */
enum { ANGLES = 18 };

/* Angle of a contact's axis to z, degrees, 0 to 90. */
static double angle_to_z(const struct gb_cell *cell, const struct gb_state *state,
                         int64_t pair)
{
    const double *a = &state->position[3 * state->pair[2 * pair]];
    const double *b = &state->position[3 * state->pair[2 * pair + 1]];
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    gb_cell_nearest(cell, r);
    return acos(fmin(fabs(r[2]) / gb_vec_length(r), 1.0)) * 180.0 / M_PI;
}

/* Mean normal force in bins of the angle, nN. */
static void mean_forces(const struct gb_state *state, double *mean)
{
    double sum[ANGLES] = {0};
    int64_t count[ANGLES] = {0};
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    const struct gb_cell cell = gb_state_cell(state);
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int bin =
            (int)fmin(angle_to_z(&cell, state, k) * ANGLES / 90.0, ANGLES - 1);
        sum[bin] += state->pair_normal[k];
        count[bin]++;
    }
    for (int k = 0; k < ANGLES; k++) {
        mean[k] = count[k] > 0 ? 1e9 * newton * sum[k] / (double)count[k] : NAN;
    }
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
        mean_forces(states.state[i], rows + i * series->rows);
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
