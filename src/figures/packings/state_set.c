#include "figures/packings/state_set.h"

#include <math.h>
#include <string.h>

#include "figures/figures_label.h"
#include "figures/states.h"
#include "measure/fit/average.h"

bool gb_state_set_read(struct gb_state_set *states, const struct gb_figures_input *input,
                       struct gb_error *err)
{
    *states =
        (struct gb_state_set){.state = g_new0(struct gb_state *, input->set->count + 1)};
    for (size_t i = 0; i < input->set->count; i++) {
        if (!gb_states_read(&states->state[i], input->set->run[i].directory, input->at,
                            err)) {
            gb_state_set_finish(states);
            return false;
        }
        states->count++;
    }
    return true;
}

void gb_state_set_finish(struct gb_state_set *states)
{
    for (size_t i = 0; i < states->count; i++) {
        gb_state_destroy(states->state[i]);
    }
    g_free(states->state);
    *states = (struct gb_state_set){0};
}

void gb_state_set_means(struct gb_series *series, const struct gb_runset *set,
                        const double *rows, const double *x, const char *name)
{
    double *members = g_new(double, set->count * series->rows + 1);
    for (size_t g = 0; g < set->groups; g++) {
        size_t filled = 0;
        for (size_t i = 0; i < set->count; i++) {
            if (set->run[i].group == g) {
                memcpy(members + filled * series->rows, rows + i * series->rows,
                       series->rows * sizeof *members);
                filled++;
            }
        }
        double *mean = gb_series_column(series, "%s_%zu", name, g + 1);
        double *error = gb_series_column(series, "se_%zu", g + 1);
        char *label = gb_figures_label(set, g, NULL);
        gb_average_rows(members, filled, series->rows, GB_AVERAGE_PRESENT, mean, error);
        gb_series_draw(series, x, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
    }
    g_free(members);
}

void gb_state_set_caption(struct gb_series *series, const struct gb_state_set *states)
{
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < states->count; i++) {
        const struct gb_point *point = &states->state[i]->point;
        const double value[2] = {point->density, 1e-6 * point->p_pa};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], value[k]);
            high[k] = fmax(high[k], value[k]);
        }
    }
    gb_series_caption(series, "Relative density %.3g", low[0]);
    if (high[0] > low[0] * 1.002) {
        gb_series_caption(series, "to %.3g", high[0]);
    }
    if (isfinite(low[1]) && high[1] > 1.0) {
        gb_series_caption(series, "at %.4g", low[1]);
        if (high[1] > low[1] * 1.01) {
            gb_series_caption(series, "to %.4g", high[1]);
        }
        gb_series_caption(series, "MPa");
    }
    g_string_append_c(series->caption, '.');
}
