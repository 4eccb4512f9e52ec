#include "runner/view_sampling.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "io/state_forces.h"
#include "measure/structure.h"
#include "pack/cell/cell.h"
#include "scene/loading_kind.h"

/* Largest distance of g(r), in diameters.  P1 finds no order beyond it. */
static const double rdf_reach = 5.0;

/* Fraction of the array to plan for, because the front may be denser than the mean. */
static const double filling = 0.9;

/* Least depth of the slab behind the front (d); a thinner slab would seem full of
 * holes. */
static const double depth_least = 2.5;

/* Chooses the visible part of the cell: its whole front, as deep as the array allows,
 * or a corner of the front for a very large cell. 2D: the same in the plane. */
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

/* Describes the walls.  While powder falls from the funnel, the box keeps its initial
 * size, so that the picture does not change its scale. */
static void describe_die(const struct gb_state *state, struct gb_view_start *start,
                         struct gb_view_sample *sample)
{
    const bool funnel = state->funnel_height > 0.0;
    const bool ends = isfinite(state->die_top);
    sample->die = (struct gb_view_die){
        .shown = true,
        .radius = state->die_radius,
        .top = funnel                         ? state->funnel_height
               : ends && state->die_top > 0.0 ? state->die_top
                                              : sample->window[2],
        .gone = ends && state->die_top <= 0.0,
        .funnel = funnel,
        .outlet = state->funnel_outlet,
        .funnel_slope = state->funnel_slope,
        .punch = isfinite(state->punch_height),
        .punch_height = isfinite(state->punch_height) ? state->punch_height : 0.0,
    };
    if (funnel) {
        start->half_width = fmax(start->half_width, 0.5 * sample->window[0]);
        start->height = fmax(start->height, sample->window[2]);
        sample->window[0] = 2.0 * start->half_width;
        sample->window[2] = start->height;
    }
}

/* Displacement of a particle since the start; in a cell without the affine motion. */
static double displacement(const struct gb_state *state, const struct gb_cell *cell,
                           const struct gb_view_start *start, int64_t i)
{
    const double *now = state->position + 3 * i, *then = start->position + 3 * i;
    const double *edge = start->cell.edge;
    double moved[3];
    if (start->count != state->count) {
        return 0.0;
    }
    if (gb_cell_tilted(cell) || gb_cell_tilted(&start->cell)) {
        const struct gb_deformation motion = gb_cell_motion(&start->cell, cell);
        gb_mat_apply(motion.f, then, moved);
        for (int c = 0; c < 3; c++) {
            moved[c] = now[c] - moved[c];
        }
        gb_cell_nearest(cell, moved);
        return gb_vec_length(moved);
    }
    for (int c = 0; c < 3; c++) {
        const double scale = state->die_radius > 0.0 ? 1.0 : cell->edge[c] / edge[c];
        const double middle =
            state->die_radius > 0.0 && c < 2 ? 0.5 * (cell->edge[c] - edge[c]) : 0.0;
        moved[c] = now[c] - middle - scale * then[c];
    }
    if (!(state->die_radius > 0.0)) {
        gb_cell_nearest(cell, moved);
    }
    return gb_vec_length(moved);
}

/* Moves a particle to its image in the upright box spanned by the edges.  The box
 * contains one image of every particle for any tilt. */
static void put_upright(const struct gb_cell *cell, double x[3])
{
    double matrix[3][3];
    gb_cell_matrix(cell, matrix);
    for (int k = 2; k >= 0; k--) {
        const double whole = cell->periodic[k] ? floor(x[k] / cell->edge[k]) : 0.0;
        for (int c = 0; c <= k; c++) {
            x[c] -= whole * matrix[c][k];
        }
    }
}

/* Copies the particles of the window.  A periodic cell is cut at y = 0.  A die is cut
 * through its middle, unless all of its particles fit. */
static void copy_front(const struct gb_state *state, const struct gb_view_start *start,
                       const double *stress, struct gb_view_sample *sample)
{
    const double cut = sample->die.shown ? 0.5 * state->cell[1] : 0.0;
    const double shift =
        sample->die.shown ? 0.5 * (sample->window[0] - state->cell[0]) : 0.0;
    const struct gb_cell cell = gb_state_cell(state);
    const bool tilted = gb_cell_tilted(&cell);
    sample->whole = sample->die.shown && state->count <= GB_VIEW_SAMPLE_POINTS;
    for (int64_t i = 0; i < state->count && sample->count < GB_VIEW_SAMPLE_POINTS; i++) {
        const double *at = state->position + 3 * i;
        double position[3] = {at[0] + shift, at[1] - cut, at[2]};
        if (tilted) {
            put_upright(&cell, position);
        }
        bool inside = position[1] >= 0.0;
        for (int c = 0; c < 3; c++) {
            inside = inside && position[c] <= sample->window[c];
        }
        if (inside || sample->whole) {
            const int k = sample->count++;
            for (int c = 0; c < 3; c++) {
                sample->position[k][c] = (float)position[c];
            }
            sample->radius[k] = (float)state->radius[i];
            sample->value[GB_VIEW_VALUE_CONTACTS][k] = (float)state->contacts[i];
            sample->value[GB_VIEW_VALUE_PRESSURE][k] =
                stress != NULL ? (float)(1e-6 * stress[i]) : NAN;
            sample->value[GB_VIEW_VALUE_DISPLACEMENT][k] =
                (float)displacement(state, &cell, start, i);
        }
    }
}

/* Measures g(r), in periodic cells only: layers at walls would distort it. */
static void measure_distances(const struct gb_state *state, struct gb_view_sample *sample)
{
    const struct gb_cell cell = gb_state_cell(state);
    const double reach = fmin(rdf_reach, 0.499 * gb_cell_shortest(&cell));
    if (gb_structure_rdf(&cell, state->count, state->position, reach, GB_VIEW_SAMPLE_RDF,
                         sample->rdf, NULL)) {
        sample->rdf_reach = reach;
    }
}

void gb_view_sampling_finish(struct gb_view_start *start)
{
    gb_alloc_free(start->position);
    *start = (struct gb_view_start){.count = 0};
}

/* Notes the positions at the first sample and again when pressing has begun. */
static void note_start(const struct gb_state *state, bool pressed,
                       struct gb_view_start *start)
{
    const size_t bytes = 3 * (size_t)state->count * sizeof *start->position;
    if (start->count == state->count && start->pressed == pressed) {
        return;
    }
    if (start->position == NULL) {
        start->position =
            gb_alloc_array((size_t)state->count, 3 * sizeof *start->position, NULL);
    }
    if (start->position != NULL) {
        memcpy(start->position, state->position, bytes);
        start->cell = gb_state_cell(state);
        start->count = state->count;
        start->pressed = pressed;
    }
}

void gb_view_sampling_take_state(const struct gb_state *state, bool pressed,
                                 struct gb_view_start *start,
                                 struct gb_view_sample *sample)
{
    const bool in_die = state->die_radius > 0.0;
    sample->dimension = state->dimension;
    sample->density = state->point.density;
    sample->count = 0;
    sample->rdf_reach = 0.0;
    sample->die.shown = false;
    memcpy(sample->edge, state->cell, sizeof sample->edge);
    choose_window(state, sample->window);
    if (in_die) {
        memcpy(sample->window, state->cell, sizeof sample->window);
        describe_die(state, start, sample);
    }
    note_start(state, pressed, start);
    struct gb_state_gaps gaps = {0};
    double *stress = gb_state_forces_gaps_init(&gaps, state, NULL)
                         ? gb_alloc_array((size_t)state->count, sizeof *stress, NULL)
                         : NULL;
    if (stress != NULL) {
        gb_state_forces_stress_mean(state, &gaps, stress);
    }
    gb_state_forces_gaps_finish(&gaps);
    copy_front(state, start, stress, sample);
    gb_alloc_free(stress);
    if (!in_die) {
        measure_distances(state, sample);
    }
    sample->valid = true;
}

void gb_view_sampling_take(const struct gb_experiment *experiment,
                           struct gb_view_start *start, struct gb_view_sample *sample)
{
    struct gb_state *state = NULL;
    sample->valid = false;
    if (gb_experiment_state(experiment, &state, NULL)) {
        const bool pressed = gb_experiment_bed(experiment) == NULL ||
                             gb_experiment_point(experiment)->height_m > 0.0;
        gb_view_sampling_take_state(state, pressed, start, sample);
        gb_state_destroy(state);
    }
}
