#include "figures/figures_state.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "figures/figures_label.h"
#include "figures/states.h"
#include "measure/fit/average.h"
#include "measure/structure.h"
#include "scene/loading_kind.h"

/* Far distances are drawn larger where there are that many diameters. */
static const double inset_from = 4.0, inset_to = 9.0, inset_least = 6.0;
static const double bin_width = 0.025; /* of g(r), d */
enum { ANGLES = 18, BINS = 24, FARTHEST = 400, LAW = 241 };

/* Rows of one curve per run become means per group. */
static void mean_rows(struct gb_series *series, const struct gb_runset *set,
                      const double *rows, const double *x, const char *name)
{
    double *kept = g_new(double, set->count * series->rows + 1);
    for (size_t g = 0; g < set->groups; g++) {
        size_t filled = 0;
        for (size_t i = 0; i < set->count; i++) {
            if (set->run[i].group == g) {
                memcpy(kept + filled * series->rows, rows + i * series->rows,
                       series->rows * sizeof *kept);
                filled++;
            }
        }
        double *mean = gb_series_column(series, "%s_%zu", name, g + 1);
        double *error = gb_series_column(series, "se_%zu", g + 1);
        char *label = gb_figures_label(set, g, NULL);
        gb_average_rows(kept, filled, series->rows, false, mean, error);
        gb_series_draw(series, x, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
    }
    g_free(kept);
}

/* Every state of the set, or none and an error. */
static struct gb_state **read_all(const struct gb_figures_input *input,
                                  struct gb_error *err)
{
    struct gb_state **states = g_new0(struct gb_state *, input->set->count + 1);
    for (size_t i = 0; i < input->set->count; i++) {
        if (!gb_states_read(&states[i], input->set->run[i].directory, input->at, err)) {
            for (size_t k = 0; k < i; k++) {
                gb_state_destroy(states[k]);
            }
            g_free(states);
            return NULL;
        }
    }
    return states;
}

static void free_all(struct gb_state **states, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        gb_state_destroy(states[i]);
    }
    g_free(states);
}

/* The points of the states, into the caption. */
static void say_points(struct gb_series *series, const struct gb_state *const *states,
                       size_t count)
{
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        const double value[2] = {states[i]->point.density, 1e-6 * states[i]->point.p_pa};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], value[k]);
            high[k] = fmax(high[k], value[k]);
        }
    }
    gb_series_say(series, "Density %.3g", low[0]);
    if (high[0] > low[0] * 1.002) {
        gb_series_say(series, "to %.3g", high[0]);
    }
    if (isfinite(low[1]) && high[1] > 1.0) {
        gb_series_say(series, "at %.4g", low[1]);
        if (high[1] > low[1] * 1.01) {
            gb_series_say(series, "to %.4g", high[1]);
        }
        gb_series_say(series, "MPa");
    }
    g_string_append_c(series->caption, '.');
}

/* Half of the shortest periodic edge of all. */
static double reach_of(struct gb_state **states, size_t count)
{
    double reach = FARTHEST * bin_width;
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            if (states[i]->dimension == 3 || k != 1) {
                reach = fmin(reach, 0.5 * states[i]->cell[k]);
            }
        }
    }
    return reach;
}

bool gb_figures_state_rdf(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_state **states = read_all(input, err);
    if (states == NULL) {
        return false;
    }
    if (!gb_loading_kind_of(&set->run[0].params)->periodic_cell) {
        free_all(states, set->count);
        return gb_error_set(err, GB_ERR_INPUT,
                            "rdf: a die has walls; accepted periodic cells");
    }
    const int bins = (int)floor(reach_of(states, set->count) / bin_width);
    gb_series_init(series, (size_t)MAX(bins, 1));
    double *rows = g_new(double, set->count * series->rows);
    bool good = bins > 0 || gb_error_set(err, GB_ERR_INPUT, "rdf: the cell is too small");
    for (size_t i = 0; i < set->count && good; i++) {
        struct gb_cell cell;
        gb_cell_init(&cell, states[i]->dimension, states[i]->cell);
        good = gb_structure_rdf(&cell, states[i]->count, states[i]->position,
                                bins * bin_width, bins, rows + i * series->rows, err);
    }
    double *r = gb_series_column(series, "r");
    for (size_t k = 0; k < series->rows; k++) {
        r[k] = ((double)k + 0.5) * bin_width;
    }
    if (good) {
        gb_figures_label_note(series, set);
        gb_series_axes(series, "r", "distance <i>r</i> / <i>d</i>", "g",
                       "radial distribution function <i>g</i>(<i>r</i>)");
        mean_rows(series, set, rows, r, "g");
        say_points(series, (const struct gb_state *const *)states, set->count);
        double most = 1.0; /* beyond the peak of touching particles */
        for (size_t i = 0; i < set->count * series->rows; i++) {
            most = r[i % series->rows] > 1.15 ? fmax(most, rows[i]) : most;
        }
        series->x.low = 0.0;
        series->y.low = 0.0;
        series->y.high = 1.35 * most;
        const double last = bins * bin_width; /* of insets in P1 Fig. 4 and 7 */
        if (last >= inset_least) {
            series->inset[0] = inset_from;
            series->inset[1] = fmin(last, inset_to);
        }
    }
    g_free(rows);
    free_all(states, set->count);
    return good;
}

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
static void force_row(const struct gb_state *state, double *mean)
{
    double sum[ANGLES] = {0};
    int64_t count[ANGLES] = {0};
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    struct gb_cell cell;
    gb_cell_init(&cell, state->dimension, state->cell);
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

bool gb_figures_state_force(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_state **states = read_all(input, err);
    if (states == NULL) {
        return false;
    }
    gb_series_init(series, ANGLES);
    double *rows = g_new(double, set->count * series->rows);
    double *angle = gb_series_column(series, "angle_deg");
    for (int k = 0; k < ANGLES; k++) {
        angle[k] = 90.0 * (k + 0.5) / ANGLES;
    }
    for (size_t i = 0; i < set->count; i++) {
        force_row(states[i], rows + i * series->rows);
    }
    gb_figures_label_note(series, set);
    gb_series_axes(series, "angle_deg", "angle of the contact to <i>z</i> (degrees)",
                   "force_nN", "mean normal force <i>f<sub>n</sub></i> (nN)");
    mean_rows(series, set, rows, angle, "force_nN");
    say_points(series, (const struct gb_state *const *)states, set->count);
    series->x.low = 0.0;
    series->x.high = 90.0;
    g_free(rows);
    free_all(states, set->count);
    return true;
}

/* Mean and deviation of the logarithm of the diameters of all states, m; false when those
 * of the first state are one size. */
static bool log_moments(struct gb_state **states, size_t count, double *mean,
                        double *deviation, double range[2])
{
    double sum = 0.0;
    double square = 0.0;
    double number = 0.0;
    range[0] = INFINITY;
    range[1] = 0.0;
    for (size_t i = 0; i < count; i++) {
        for (int64_t k = 0; k < states[i]->count; k++) {
            const double d = 2.0 * states[i]->radius[k] * states[i]->metre_per_length;
            sum += log(d);
            square += log(d) * log(d);
            number += 1.0;
            range[0] = fmin(range[0], d);
            range[1] = fmax(range[1], d);
        }
    }
    *mean = sum / number;
    *deviation = sqrt(fmax(square / number - *mean * *mean, 0.0));
    for (int64_t k = 1; k < states[0]->count; k++) {
        if (fabs(states[0]->radius[k] - states[0]->radius[0]) > 1e-9) {
            return true;
        }
    }
    return false;
}

/* Nanometres or micrometres, whichever suits. */
static const char *length_unit(double metre, double *per_metre)
{
    *per_metre = metre < 0.5e-6 ? 1e9 : 1e6;
    return metre < 0.5e-6 ? "nm" : "\xce\xbcm";
}

/* Histogram of all states by number (power 0) or volume (power 3), as a density of
 * probability per unit of length; edges in the unit. */
static void fill_histogram(struct gb_state **states, size_t count, double per_metre,
                           const double range[2], int power, double *edge, double *share)
{
    const double low = range[0] * per_metre;
    const double width = (range[1] * per_metre - low) / BINS;
    double whole = 0.0;
    for (int k = 0; k <= BINS; k++) {
        edge[k] = low + k * width;
        share[k] = 0.0;
    }
    for (size_t i = 0; i < count; i++) {
        for (int64_t k = 0; k < states[i]->count; k++) {
            const double d =
                2.0 * states[i]->radius[k] * states[i]->metre_per_length * per_metre;
            const int bin = (int)fmin(fmax((d - low) / width, 0.0), BINS - 1);
            const double weight = power == 0 ? 1.0 : d * d * d;
            share[bin] += weight;
            whole += weight;
        }
    }
    for (int k = 0; k < BINS; k++) {
        share[k] /= whole * width;
    }
}

/* Density of a log-normal law; weighted by volume its mean of ln d moves by 3 s^2. */
static double log_normal(double d, double mean, double deviation, int power)
{
    const double u = (log(d) - mean - power * deviation * deviation) / deviation;
    return exp(-0.5 * u * u) / (d * deviation * sqrt(2.0 * M_PI));
}

static bool draw_sizes(struct gb_series *series, const struct gb_figures_input *input,
                       int power, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    double mean = 0.0;
    double deviation = 0.0;
    double range[2];
    double per_metre = 0.0;
    struct gb_state **states = read_all(input, err);
    if (states == NULL) {
        return false;
    }
    if (!log_moments(states, set->count, &mean, &deviation, range)) {
        free_all(states, set->count);
        return gb_error_set(err, GB_ERR_INPUT,
                            "sizes: all particles have one diameter; accepted runs with "
                            "a distribution of sizes");
    }
    const char *unit = length_unit(exp(mean), &per_metre);
    mean += log(per_metre);
    gb_series_init(series, LAW);
    double *edge = gb_series_column(series, "diameter_%s", per_metre > 5e6 ? "nm" : "um");
    double *share = gb_series_column(series, "share");
    double *place = gb_series_column(series, "law_diameter");
    double *law = gb_series_column(series, "log_normal");
    fill_histogram(states, set->count, per_metre, range, power, edge, share);
    for (int k = 0; k < LAW; k++) {
        place[k] = edge[0] + (edge[BINS] - edge[0]) * k / (LAW - 1);
        law[k] = log_normal(place[k], mean, deviation, power);
    }
    static const char *const shares[2][2] = {
        {"share of the number (1/\xce\xbcm)", "share of the volume (1/\xce\xbcm)"},
        {"share of the number (1/nm)", "share of the volume (1/nm)"}};
    const bool nano = per_metre > 5e6;
    gb_series_axes(series, nano ? "diameter_nm" : "diameter_um",
                   nano ? "particle diameter <i>d</i> (nm)"
                        : "particle diameter <i>d</i> (\xce\xbcm)",
                   "share", shares[nano][power != 0]);
    gb_series_draw(series, edge, share, NULL, GB_FIGURE_STEPS, 0, "particles");
    gb_series_draw(series, place, law, NULL, GB_FIGURE_LINE, 1, "log-normal law");
    gb_series_note(series, "log-normal: mean of ln d %.6g (d in %s), deviation %.6g",
                   mean, per_metre > 5e6 ? "nm" : "um", deviation);
    gb_series_say(series,
                  "%" G_GINT64_FORMAT " particles; median of the law %.3g %s, "
                  "<i>\xcf\x83</i> = %.3g.",
                  states[0]->count, exp(mean), unit, deviation);
    free_all(states, set->count);
    return true;
}

bool gb_figures_state_sizes(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    return draw_sizes(series, input, 0, err);
}

bool gb_figures_state_volumes(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    return draw_sizes(series, input, 3, err);
}
