/* Figures of kept states: radial distribution, coordination, forces by direction, sizes. */
#include <math.h>

#include "base/number.h"
#include "figures/figures.h"
#include "figures/series.h"
#include "figures/states.h"
#include "io/state_forces.h"
#include "measure/structure.h"
#include "scene/loading_kind.h"

/* Distances of the insets of P1 Fig. 4 and 7, where g(r) reaches min_reach; d. */
static const double inset_from = 4.0;
static const double inset_to = 9.0;
static const double min_reach = 6.0;

static const double bin_width = 0.025; /* d */
static const double max_reach = 10.0;  /* d */

/* Start of the distances that set the y axis, d: beyond the peak of contacts. */
static const double beyond_contact_peak = 1.15;

/* Half of the least height of all cells, d. */
static double find_reach(const struct gb_states_set *states)
{
    double reach = max_reach;
    for (size_t i = 0; i < states->count; i++) {
        const struct gb_cell cell = gb_state_cell(states->state[i]);
        reach = fmin(reach, 0.5 * gb_cell_shortest(&cell));
    }
    return reach;
}

static bool compute_rows(double *rows, const struct gb_states_set *states, int bins,
                         struct gb_error *err)
{
    bool good = true;
    for (size_t i = 0; i < states->count && good; i++) {
        const struct gb_state *state = states->state[i];
        const struct gb_cell cell = gb_state_cell(state);
        good = gb_structure_rdf(&cell, state->count, state->position, bins * bin_width,
                                bins, rows + i * (size_t)bins, err);
    }
    return good;
}

static void set_ranges(struct gb_series *series, const double *rows, size_t runs,
                       const double *r)
{
    double max = 1.0;
    for (size_t i = 0; i < runs * series->rows; i++) {
        max = r[i % series->rows] > beyond_contact_peak ? fmax(max, rows[i]) : max;
    }
    series->x.low = 0.0;
    series->y.low = 0.0;
    series->y.high = 1.35 * max;
    const double reach = (double)series->rows * bin_width;
    if (reach >= min_reach) {
        series->inset[0] = inset_from;
        series->inset[1] = fmin(reach, inset_to);
    }
}

static bool fill_rdf(struct gb_series *series, const struct gb_runset *set,
                     const struct gb_states_set *states, struct gb_error *err)
{
    const int bins = (int)floor(find_reach(states) / bin_width);
    if (bins < 1) {
        return gb_error_set(err, GB_ERR_INPUT, "rdf: the cell is too small");
    }
    gb_series_init(series, (size_t)bins);
    double *rows = g_new(double, set->count * series->rows);
    double *r = gb_series_column(series, "r");
    for (size_t k = 0; k < series->rows; k++) {
        r[k] = ((double)k + 0.5) * bin_width;
    }
    const bool good = compute_rows(rows, states, bins, err);
    if (good) {
        gb_series_note_groups(series, set);
        gb_states_set_means(series, set, rows, r, "g");
        gb_states_set_caption(series, states);
        set_ranges(series, rows, set->count, r);
    }
    g_free(rows);
    return good;
}

/* g(r), P1 (14). */
static bool compute_rdf(struct gb_series *series, const struct gb_figures_input *input,
                        struct gb_error *err)
{
    struct gb_states_set states;
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    const bool good = !gb_loading_kind_of(&input->set->run[0].params)->periodic_cell
                          ? gb_error_set(err, GB_ERR_INPUT,
                                         "rdf: a die has walls; expected periodic cells")
                          : fill_rdf(series, input->set, &states, err);
    gb_states_set_finish(&states);
    return good;
}

/* 0, 1, ... contacts; the last one holds those with more, too. */
enum { CONTACTS = 16 };

/* Numbers of contacts whose share P1 gives, section V: 0.5 and 0.3 %, and none. */
static const int published[] = {10, 12};

/* Share of particles with each number of contacts, %. */
static void share_contacts(const struct gb_state *state, double *share)
{
    int64_t count[CONTACTS] = {0};
    for (int64_t i = 0; i < state->count; i++) {
        count[MIN(state->contacts[i], CONTACTS - 1)]++;
    }
    for (int k = 0; k < CONTACTS; k++) {
        share[k] = 100.0 * (double)count[k] / (double)state->count;
    }
}

/* Groups whose share the caption gives. */
enum { CAPTION_GROUPS = 4 };

static void caption_share(struct gb_series *series, const struct gb_runset *set,
                          size_t group, GString *share)
{
    char *label = set->groups > 1 ? gb_series_group_label(set, group, NULL) : NULL;
    g_string_replace(share, "+-", "±", 0);
    gb_series_caption(series, "%d contacts%s%s: %s %%.", published[0],
                      label != NULL ? ", " : "", label != NULL ? label : "", share->str);
    g_free(label);
}

/* Columns of the means follow that of the number of contacts, two to a group. */
static void note_published(struct gb_series *series, const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        const double *error = g_ptr_array_index(series->columns, 2 + 2 * g);
        for (size_t k = 0; k < G_N_ELEMENTS(published); k++) {
            const int contacts = published[k];
            char number[GB_NUMBER_ERROR_MAX];
            GString *text = g_string_new(
                gb_number_error(mean[contacts], error[contacts], 1, " +- ", number));
            gb_series_note(series, "group %zu: %d contacts: %s %%", g + 1, contacts,
                           text->str);
            if (k == 0 && set->groups <= CAPTION_GROUPS) {
                caption_share(series, set, g, text);
            }
            g_string_free(text, TRUE);
        }
    }
}

static void join_points(struct gb_series *series)
{
    for (guint k = 0; k < series->curves->len; k++) {
        g_array_index(series->curves, struct gb_series_curve, k).kind = GB_FIGURE_BOTH;
    }
}

/* P1 section V, after Fig. 8. */
static bool compute_contacts(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_states_set states;
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    gb_series_init(series, CONTACTS);
    double *rows = g_new(double, set->count * series->rows);
    double *contacts = gb_series_column(series, "contacts");
    for (int k = 0; k < CONTACTS; k++) {
        contacts[k] = k;
    }
    for (size_t i = 0; i < set->count; i++) {
        share_contacts(states.state[i], rows + i * series->rows);
    }
    gb_series_note_groups(series, set);
    gb_states_set_means(series, set, rows, contacts, "share_percent");
    note_published(series, set);
    join_points(series);
    gb_states_set_caption(series, &states);
    series->x.low = series->y.low = 0.0;
    series->x.high = CONTACTS - 1;
    g_free(rows);
    gb_states_set_finish(&states);
    return true;
}

enum { ANGLES = GB_STATE_FORCES_ANGLES };

#define FORCE_AXIS "mean normal force <i>f<sub>n</sub></i> "

/* Units of forces in ascending order, and the force from which each is taken: nN for the
 * thousands of P1 Fig. 14. */
static const struct unit {
    double nn, from_nn;
    const char *column, *axis;
} units[] = {
    {1e-3, 0.0, "force_pN", FORCE_AXIS "(pN)"}, {1.0, 0.1, "force_nN", FORCE_AXIS "(nN)"},
    {1e3, 1e4, "force_uN", FORCE_AXIS "(µN)"},  {1e6, 1e6, "force_mN", FORCE_AXIS "(mN)"},
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
static bool compute_force_angle(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_states_set states;
    if (!gb_states_set_read(&states, input, err)) {
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
    gb_series_note_groups(series, set);
    gb_states_set_means(series, set, rows, angle, unit->column);
    series->y.name = unit->column;
    series->y.label = unit->axis;
    gb_states_set_caption(series, &states);
    series->x.low = 0.0;
    series->x.high = 90.0;
    g_free(rows);
    gb_states_set_finish(&states);
    return true;
}

/* Bins of the histogram and points of the law. */
enum { BINS = 24, LAW_POINTS = 241 };

/* Weight of a particle: its diameter to this power. */
enum weight { BY_NUMBER = 0, BY_VOLUME = 3 };

/* Unit of diameters in a figure, and the densities by number (q0) and volume (q3). */
struct size_unit {
    double per_metre;
    const char *name, *column, *diameter_axis, *q0_axis, *q3_axis;
};

static const struct size_unit nanometre = {
    1e9,
    "nm",
    "nm",
    "particle diameter <i>d</i> (nm)",
    "number density <i>q</i><sub>0</sub> (1/nm)",
    "volume density <i>q</i><sub>3</sub> (1/nm)",
};
static const struct size_unit micrometre = {
    1e6,
    "μm",
    "um",
    "particle diameter <i>d</i> (μm)",
    "number density <i>q</i><sub>0</sub> (1/μm)",
    "volume density <i>q</i><sub>3</sub> (1/μm)",
};

/* Moments of ln d, d in m, and the range of d. */
struct moments {
    double mean, deviation, min, max;
};

static double diameter_m(const struct gb_state *state, int64_t particle)
{
    return 2.0 * state->radius[particle] * state->metre_per_length;
}

static struct moments find_moments(const struct gb_states_set *states)
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
static void fill_histogram(const struct gb_states_set *states,
                           const struct size_unit *unit, const struct moments *moments,
                           enum weight weight, double *edge, double *density)
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

static void fill_sizes(struct gb_series *series, const struct gb_states_set *states,
                       const struct moments *moments, enum weight weight)
{
    const struct size_unit *unit = exp(moments->mean) < 0.5e-6 ? &nanometre : &micrometre;
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
                      "<i>σ</i> = %.3g.",
                      states->state[0]->count, exp(mean), unit->name, moments->deviation);
}

static bool draw_sizes(struct gb_series *series, const struct gb_figures_input *input,
                       enum weight weight, struct gb_error *err)
{
    struct gb_states_set states;
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    const bool good =
        !is_monodisperse(states.state[0]) ||
        gb_error_set(err, GB_ERR_INPUT,
                     "sizes: all particles have one diameter; expected runs with a "
                     "distribution of sizes");
    if (good) {
        const struct moments moments = find_moments(&states);
        fill_sizes(series, &states, &moments, weight);
    }
    gb_states_set_finish(&states);
    return good;
}

/* q0 and the log-normal law, P1 (17), of the same moments of ln d. */
static bool compute_sizes(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    return draw_sizes(series, input, BY_NUMBER, err);
}

static bool compute_sizes_volume(struct gb_series *series,
                                 const struct gb_figures_input *input,
                                 struct gb_error *err)
{
    return draw_sizes(series, input, BY_VOLUME, err);
}

const struct gb_figures_row gb_figures_packings_rows[] = {
    {"rdf", "radial distribution function", "P1 Fig. 4, 7", GB_FIGURES_STATES,
     GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r", .label = "distance <i>r</i> / <i>d</i>"},
     .y = {.name = "g", .label = "radial distribution function <i>g</i>(<i>r</i>)"},
     .compute = compute_rdf},
    {"contacts", "fraction of particles with each coordination number", "P1 sec. V",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "contacts", .label = "coordination number"},
     .y = {.name = "share_percent", .label = "fraction of particles (%)"},
     .compute = compute_contacts},
    {"force-angle", "mean normal force against the contact angle to z", "P1 Fig. 14",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "angle_deg",
           .label = "angle between contact and <i>z</i> axis, <i>θ</i> (°)"},
     .compute = compute_force_angle},
    {"sizes", "particle sizes by number, with the log-normal law",
     "P1 Fig. 10, P3 Fig. 14", GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .compute = compute_sizes},
    {"sizes-volume", "particle sizes by volume, with the log-normal law", "P3 Fig. 14",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .compute = compute_sizes_volume},
    {0},
};
