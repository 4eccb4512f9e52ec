#include <math.h>

#include "figures/figures_compute.h"
#include "figures/packings/state_set.h"

/* Bins of the histogram and points of the law. */
enum { BINS = 24, LAW_POINTS = 241 };

/* Weight of a particle: its diameter to this power. */
enum weight { BY_NUMBER = 0, BY_VOLUME = 3 };

/* Unit of diameters in a figure, and the densities by number (q0) and volume (q3). */
struct unit {
    double per_metre;
    const char *name, *column, *diameter_axis, *q0_axis, *q3_axis;
};

static const struct unit nanometre = {
    1e9,
    "nm",
    "nm",
    "particle diameter <i>d</i> (nm)",
    "number density <i>q</i><sub>0</sub> (1/nm)",
    "volume density <i>q</i><sub>3</sub> (1/nm)",
};
static const struct unit micrometre = {
    1e6,
    "\xce\xbcm",
    "um",
    "particle diameter <i>d</i> (\xce\xbcm)",
    "number density <i>q</i><sub>0</sub> (1/\xce\xbcm)",
    "volume density <i>q</i><sub>3</sub> (1/\xce\xbcm)",
};

/* Moments of ln d, d in m, and the range of d. */
struct moments {
    double mean, deviation, min, max;
};

static double diameter_m(const struct gb_state *state, int64_t particle)
{
    return 2.0 * state->radius[particle] * state->metre_per_length;
}

static struct moments find_moments(const struct gb_state_set *states)
{
    struct moments found = {.min = INFINITY};
    double sum = 0.0;
    double square = 0.0;
    double number = 0.0;
    for (size_t i = 0; i < states->count; i++) {
        for (int64_t k = 0; k < states->state[i]->count; k++) {
            const double d = diameter_m(states->state[i], k);
            sum += log(d);
            square += log(d) * log(d);
            number += 1.0;
            found.min = fmin(found.min, d);
            found.max = fmax(found.max, d);
        }
    }
    found.mean = sum / number;
    found.deviation = sqrt(fmax(square / number - found.mean * found.mean, 0.0));
    return found;
}

static bool is_monodisperse(const struct gb_state *state)
{
    for (int64_t k = 1; k < state->count; k++) {
        if (fabs(state->radius[k] - state->radius[0]) > 1e-9) {
            return false;
        }
    }
    return true;
}

/* Probability density of the diameter over all states; edges in the unit. */
static void fill_histogram(const struct gb_state_set *states, const struct unit *unit,
                           const struct moments *moments, enum weight weight,
                           double *edge, double *density)
{
    const double low = moments->min * unit->per_metre;
    const double width = (moments->max * unit->per_metre - low) / BINS;
    double total = 0.0;
    for (int k = 0; k <= BINS; k++) {
        edge[k] = low + k * width;
        density[k] = 0.0;
    }
    for (size_t i = 0; i < states->count; i++) {
        for (int64_t k = 0; k < states->state[i]->count; k++) {
            const double d = diameter_m(states->state[i], k) * unit->per_metre;
            const int bin = (int)fmin(fmax((d - low) / width, 0.0), BINS - 1);
            const double w = weight == BY_NUMBER ? 1.0 : d * d * d;
            density[bin] += w;
            total += w;
        }
    }
    for (int k = 0; k < BINS; k++) {
        density[k] /= total * width;
    }
}

/* Log-normal density; weighted by volume the mean of ln d moves by 3 s^2. */
static double log_normal(double d, double mean, double deviation, enum weight weight)
{
    const double u = (log(d) - mean - (int)weight * deviation * deviation) / deviation;
    return exp(-0.5 * u * u) / (d * deviation * sqrt(2.0 * M_PI));
}

static void fill(struct gb_series *series, const struct gb_state_set *states,
                 const struct moments *moments, enum weight weight)
{
    const struct unit *unit = exp(moments->mean) < 0.5e-6 ? &nanometre : &micrometre;
    const double mean = moments->mean + log(unit->per_metre);
    gb_series_init(series, LAW_POINTS);
    double *edge = gb_series_column(series, "diameter_%s", unit->column);
    double *density = gb_series_column(series, "share");
    double *diameter = gb_series_column(series, "law_diameter");
    double *law = gb_series_column(series, "log_normal");
    fill_histogram(states, unit, moments, weight, edge, density);
    for (int k = 0; k < LAW_POINTS; k++) {
        diameter[k] = edge[0] + (edge[BINS] - edge[0]) * k / (LAW_POINTS - 1);
        law[k] = log_normal(diameter[k], mean, moments->deviation, weight);
    }
    gb_series_axes(series, g_ptr_array_index(series->names, 0), unit->diameter_axis,
                   "share", weight == BY_NUMBER ? unit->q0_axis : unit->q3_axis);
    gb_series_draw(series, edge, density, NULL, GB_FIGURE_STEPS, 0, "particles");
    gb_series_draw(series, diameter, law, NULL, GB_FIGURE_LINE, 1, "log-normal law");
    gb_series_note(series, "log-normal: mean of ln d %.6g (d in %s), deviation %.6g",
                   mean, unit->column, moments->deviation);
    gb_series_caption(series,
                      "%" G_GINT64_FORMAT " particles; median of the law %.3g %s, "
                      "<i>\xcf\x83</i> = %.3g.",
                      states->state[0]->count, exp(mean), unit->name, moments->deviation);
}

static bool draw(struct gb_series *series, const struct gb_figures_input *input,
                 enum weight weight, struct gb_error *err)
{
    struct gb_state_set states;
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    const bool good =
        !is_monodisperse(states.state[0]) ||
        gb_error_set(err, GB_ERR_INPUT,
                     "sizes: all particles have one diameter; accepted runs with a "
                     "distribution of sizes");
    if (good) {
        const struct moments moments = find_moments(&states);
        fill(series, &states, &moments, weight);
    }
    gb_state_set_finish(&states);
    return good;
}

/* q0 and the log-normal law, P1 (17), of the same moments of ln d. */
bool gb_figures_sizes(struct gb_series *series, const struct gb_figures_input *input,
                      struct gb_error *err)
{
    return draw(series, input, BY_NUMBER, err);
}

bool gb_figures_sizes_volume(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    return draw(series, input, BY_VOLUME, err);
}
