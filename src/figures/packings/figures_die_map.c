#include <math.h>
#include <string.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "figures/packings/die_profile.h"
#include "figures/packings/state_set.h"

/* Share of the cells beyond either end of the colours. */
static const double extreme_share = 0.02;

enum { RINGS = 10, BANDS = 16, CELLS = RINGS * BANDS };

/* Mean over the states, on the extent of the first. */
static bool mean_map(const struct gb_state_set *states, double *mean,
                     struct gb_error *err)
{
    double density[CELLS];
    memset(mean, 0, CELLS * sizeof *mean);
    for (size_t i = 0; i < states->count; i++) {
        if (!gb_die_profile_check(states->state[i], "die-map", err)) {
            return false;
        }
        gb_die_profile_density(states->state[i], RINGS, BANDS, density);
        for (int k = 0; k < CELLS; k++) {
            mean[k] += density[k] / (double)states->count;
        }
    }
    return true;
}

/* One row per cell: its middle and its density. */
static void set_columns(struct gb_series *series, const double *x, const double *y,
                        const double *density)
{
    double *r = gb_series_column(series, "r_um");
    double *z = gb_series_column(series, "z_um");
    double *value = gb_series_column(series, "density");
    for (int k = 0; k < CELLS; k++) {
        const int i = k / BANDS, j = k % BANDS;
        r[k] = 0.5 * (x[i] + x[i + 1]);
        z[k] = 0.5 * (y[j] + y[j + 1]);
        value[k] = density[k];
    }
}

/* Range of the colours: all cells but the extreme ones, which are small rings about the
 * axis. */
static void set_colours(struct gb_figure_map *map, const double *density)
{
    double sorted[CELLS];
    memcpy(sorted, density, sizeof sorted);
    gsl_sort(sorted, 1, CELLS);
    map->low = gsl_stats_quantile_from_sorted_data(sorted, 1, CELLS, extreme_share);
    map->high =
        gsl_stats_quantile_from_sorted_data(sorted, 1, CELLS, 1.0 - extreme_share);
}

static void set_map(struct gb_series *series, const struct gb_state *state,
                    const double *density)
{
    double x[RINGS + 1], y[BANDS + 1];
    const double um = 1e6 * state->metre_per_length;
    struct gb_figure_map map = {.columns = RINGS,
                                .rows = BANDS,
                                .x = x,
                                .y = y,
                                .value = density,
                                .label = "relative density <i>\xcf\x81</i>"};
    for (int i = 0; i <= RINGS; i++) {
        x[i] = um * state->die_radius * i / RINGS;
    }
    for (int j = 0; j <= BANDS; j++) {
        y[j] = um * state->cell[2] * j / BANDS;
    }
    set_colours(&map, density);
    map.high = map.high > map.low ? map.high : map.low + 1.0;
    set_columns(series, x, y, density);
    gb_series_map(series, &map);
    series->x.low = series->y.low = 0.0;
    series->x.high = x[RINGS];
    series->y.high = y[BANDS];
}

/* One map of the mean over all beds, which are of one group. */
bool gb_figures_die_map(struct gb_series *series, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    struct gb_state_set states;
    double mean[CELLS];
    if (input->set->groups > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die-map: one map shows one scene; accepted runs that differ "
                            "by their seed only");
    }
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    const bool good = mean_map(&states, mean, err);
    if (good) {
        gb_series_init(series, CELLS);
        gb_figures_label_groups(series, input->set);
        set_map(series, states.state[0], mean);
        gb_state_set_caption(series, &states);
        gb_series_caption(series, "%zu bed%s; %d rings, %d bands.", states.count,
                          states.count > 1 ? "s, mean" : "", RINGS, BANDS);
    }
    gb_state_set_finish(&states);
    return good;
}
