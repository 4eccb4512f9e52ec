#include "runner/view_sample.h"

#include <math.h>
#include <string.h>

#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "scene/loading_kind.h"

/* Largest distance of g(r), diameters: P1 finds no order beyond. */
static const double rdf_reach = 5.0;

/* Share of the array that is planned for, because the front may be denser than the mean. */
static const double filling = 0.9;

/* A slab behind the front less deep than this would look full of holes. */
static const double depth_least = 2.5;

/* The part of the cell that is shown: all of its front, as deep as fits; of a very large
 * cell a corner of the front.  2D: the same in the plane. */
static void choose_window(const struct gb_state *state, double window[3])
{
    const double *edge = state->cell;
    const double part = fmin(1.0, filling * GB_VIEW_SAMPLE_POINTS / (double)state->count);
    memcpy(window, edge, 3 * sizeof *window);
    double share = part;
    if (state->dimension == 3) {
        window[1] = fmin(edge[1], fmax(depth_least, part * edge[1]));
        share = fmin(1.0, part * edge[1] / window[1]);
    }
    window[0] = sqrt(share) * edge[0];
    window[2] = sqrt(share) * edge[2];
}

/* Particles of the window.  A die is cut through its middle, a periodic cell at y = 0. */
static void copy_front(const struct gb_state *state, bool die,
                       struct gb_view_sample *sample)
{
    const double cut = die ? 0.5 * state->cell[1] : 0.0;
    for (int64_t i = 0; i < state->count && sample->count < GB_VIEW_SAMPLE_POINTS; i++) {
        const double *at = state->position + 3 * i;
        const double position[3] = {at[0], at[1] - cut, at[2]};
        bool inside = position[1] >= 0.0;
        for (int c = 0; c < 3; c++) {
            inside = inside && position[c] <= sample->window[c];
        }
        if (inside) {
            const int k = sample->count++;
            for (int c = 0; c < 3; c++) {
                sample->position[k][c] = (float)position[c];
            }
            sample->radius[k] = (float)state->radius[i];
        }
    }
}

/* g(r), in periodic cells only: layers at walls would distort it. */
static void measure_distances(const struct gb_state *state, struct gb_view_sample *sample)
{
    const struct gb_cell cell = gb_state_cell(state);
    const double reach = fmin(rdf_reach, 0.499 * gb_cell_shortest(&cell));
    if (gb_structure_rdf(&cell, state->count, state->position, reach, GB_VIEW_SAMPLE_RDF,
                         sample->rdf, NULL)) {
        sample->rdf_reach = reach;
    }
}

void gb_view_sample_take(const struct gb_experiment *experiment,
                         struct gb_view_sample *sample)
{
    struct gb_state *state = NULL;
    const bool die = !gb_loading_kind_of(gb_experiment_params(experiment))->periodic_cell;
    sample->valid = false;
    if (!gb_experiment_state(experiment, &state, NULL)) {
        return;
    }
    sample->dimension = state->dimension;
    sample->density = state->point.density;
    sample->count = 0;
    sample->rdf_reach = 0.0;
    memcpy(sample->edge, state->cell, sizeof sample->edge);
    choose_window(state, sample->window);
    copy_front(state, die, sample);
    if (!die) {
        measure_distances(state, sample);
    }
    gb_state_destroy(state);
    sample->valid = true;
}
