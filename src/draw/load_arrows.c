#include "draw/load_arrows.h"

#include <math.h>
#include <string.h>

#include "base/mat.h"
#include "draw/die_walls.h"
#include "pack/cell/cell.h"

/* Length of an arrow and its distance from the face, means of the edges in the picture. */
static const double length = 0.2, gap = 0.035;

/* From a point of a face, out of it along an axis: the tip, and the tail beyond. */
static void point_at(const struct gb_scene *scene, const double face[3], int axis,
                     double size, float arrow[6])
{
    for (int end = 0; end < 2; end++) {
        double point[3], eye[3];
        memcpy(point, face, sizeof point);
        point[axis] += size * (end == 0 ? gap + length : gap);
        gb_view_eye(&scene->view, point, eye);
        for (int k = 0; k < 3; k++) {
            arrow[3 * end + k] = (float)eye[k];
        }
    }
}

/* Middle of the upper face of an axis; in a die the top of its punch. */
static void find_face(const struct gb_state *state, const double box[3], int axis,
                      double face[3])
{
    double fraction[3] = {0.5, state->dimension == 2 ? 0.0 : 0.5, 0.5};
    double matrix[3][3];
    struct gb_cell cell = gb_state_cell(state);
    memcpy(cell.edge, box, sizeof cell.edge);
    fraction[axis] = 1.0;
    gb_cell_matrix(&cell, matrix);
    gb_mat_apply((const double(*)[3])matrix, fraction, face);
    if (state->die_radius > 0.0) {
        face[2] = gb_die_walls_punch_top(state->die_radius, box[2]);
    }
}

/* Whether an axis is pressed alone, or with one other of three. */
static bool is_pressed(const struct gb_state *state, int axis)
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        count += state->pressed[k] > 0.0 && (k != 1 || state->dimension == 3);
    }
    return state->pressed[axis] > 0.0 && count < state->dimension &&
           (axis != 1 || state->dimension == 3);
}

void gb_load_arrows_set(struct gb_scene *scene, const struct gb_state *state,
                        const struct gb_viewpoint *viewpoint)
{
    const bool fixed = viewpoint->extent[0] > 0.0;
    const bool shown = !(state->die_radius > 0.0) || isfinite(state->punch_height);
    const double *box = fixed ? viewpoint->extent : state->cell;
    const double size = sqrt(box[0] * box[2]);
    scene->arrows = scene->frame_arrows = 0;
    for (int axis = 0; axis < 3; axis++) {
        double face[3];
        if (!is_pressed(state, axis)) {
            continue;
        }
        if (shown) {
            find_face(state, state->cell, axis, face);
            point_at(scene, face, axis, size, scene->arrow[scene->arrows++]);
        }
        if (shown || fixed) {
            find_face(state, box, axis, face);
            point_at(scene, face, axis, size, scene->frame_arrow[scene->frame_arrows++]);
        }
    }
}
