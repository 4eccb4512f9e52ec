#include <math.h>

#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "figures/packings/die_profile.h"
#include "figures/packings/state_set.h"

/* A profile along one coordinate of a die, as a share of its extent. */
struct profile {
    const char *figure, *coordinate, *quantity;
    int bins;
    bool (*fill)(const struct gb_state *state, int bins, double *value);
    const char *missing; /* what a state lacks when fill fails */
};

static bool fill_axial(const struct gb_state *state, int bins, double *value)
{
    gb_die_profile_density(state, 1, bins, value);
    return true;
}

static bool fill_radial(const struct gb_state *state, int bins, double *value)
{
    gb_die_profile_density(state, bins, 1, value);
    return true;
}

static bool fill_rows(double *rows, const struct gb_state_set *states,
                      const struct profile *profile, struct gb_error *err)
{
    for (size_t i = 0; i < states->count; i++) {
        if (!gb_die_profile_check(states->state[i], profile->figure, err)) {
            return false;
        }
        if (!profile->fill(states->state[i], profile->bins,
                           rows + i * (size_t)profile->bins)) {
            return gb_error_set(err, GB_ERR_INPUT, "%s: %s", profile->figure,
                                profile->missing);
        }
    }
    return true;
}

static bool draw(struct gb_series *series, const struct gb_figures_input *input,
                 const struct profile *profile, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_state_set states;
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    gb_series_init(series, (size_t)profile->bins);
    double *rows = g_new(double, set->count * series->rows);
    double *x = gb_series_column(series, "%s", profile->coordinate);
    for (int k = 0; k < profile->bins; k++) {
        x[k] = (k + 0.5) / profile->bins;
    }
    const bool good = fill_rows(rows, &states, profile, err);
    if (good) {
        gb_figures_label_note(series, set);
        gb_state_set_means(series, set, rows, x, profile->quantity);
        gb_state_set_caption(series, &states);
        series->x.low = 0.0;
        series->x.high = 1.0;
    }
    g_free(rows);
    gb_state_set_finish(&states);
    return good;
}

bool gb_figures_die_profile_wall(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    static const struct profile profile = {
        "die-wall",
        "z",
        "wall_MPa",
        12,
        gb_die_profile_wall,
        "the state has no contacts with walls; accepted states in the die, of version "
        "0.2.0 on"};
    return draw(series, input, &profile, err);
}

bool gb_figures_die_profile_axial(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    static const struct profile profile = {"die-axial", "z",        "density",
                                           16,          fill_axial, ""};
    return draw(series, input, &profile, err);
}

bool gb_figures_die_profile_radial(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    static const struct profile profile = {"die-radial", "r",         "density",
                                           16,           fill_radial, ""};
    return draw(series, input, &profile, err);
}
