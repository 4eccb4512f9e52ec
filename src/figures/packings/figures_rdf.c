#include <math.h>

#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "figures/packings/state_set.h"
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
static double find_reach(const struct gb_state_set *states)
{
    double reach = max_reach;
    for (size_t i = 0; i < states->count; i++) {
        const struct gb_cell cell = gb_state_cell(states->state[i]);
        reach = fmin(reach, 0.5 * gb_cell_shortest(&cell));
    }
    return reach;
}

static bool compute_rows(double *rows, const struct gb_state_set *states, int bins,
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

static bool fill(struct gb_series *series, const struct gb_runset *set,
                 const struct gb_state_set *states, struct gb_error *err)
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
        gb_figures_label_note(series, set);
        gb_state_set_means(series, set, rows, r, "g");
        gb_state_set_caption(series, states);
        set_ranges(series, rows, set->count, r);
    }
    g_free(rows);
    return good;
}

/* g(r), P1 (14). */
bool gb_figures_rdf(struct gb_series *series, const struct gb_figures_input *input,
                    struct gb_error *err)
{
    struct gb_state_set states;
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    const bool good = !gb_loading_kind_of(&input->set->run[0].params)->periodic_cell
                          ? gb_error_set(err, GB_ERR_INPUT,
                                         "rdf: a die has walls; accepted periodic cells")
                          : fill(series, input->set, &states, err);
    gb_state_set_finish(&states);
    return good;
}
