/* FIRE from a prediction: after a strain step each particle is moved by its nonaffine
 * displacement of the last step, in proportion to the strain.  In a compression most of
 * the nonaffine motion repeats; the relaxation finds the rest.
 *
 * The prediction is made before the first evaluation, so that it reaches the contacts
 * together with the strain, as one increment.  The start is near equilibrium, so larger
 * steps and stronger mixing of the velocity with the force are faster than in plain FIRE. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/mat.h"
#include "base/portable.h"
#include "base/record.h"
#include "base/team.h"
#include "pack/kernel/simd.h"
#include "pack/list/blocks.h"
#include "scene/tolerances.h"
#include "solve/relax/relax_fire.h"

const struct gb_relax_fire_tuning gb_relax_predict_tuning = {
    .step_first = 1.2,
    .step_most = 1.3,
    .shrink = 0.7,
    .mixing_first = 0.3,
    .mixing_decay = 0.95,
    .delay = 2,
};

enum { POSITION = 2, ROTATION = 3 }; /* vectors beside the velocities */

struct predict {
    struct gb_relax_fire_state fire;
    struct gb_cell cell; /* at the start of the last relaxation; edges 0: there is none */
    double strain[3];    /* logarithmic, of the strain step before it */
    double shear[3];     /* engineering shear of that step, in scenes that shear */
};

/* The requested strain: its ratio to the last one, and its norm. */
struct request {
    double ratio, size;
};

static double strain_along(const struct predict *state, const struct gb_cell *cell, int k)
{
    const double edge = state->cell.edge[k];
    return edge > 0.0 ? gb_portable_log(cell->edge[k] / edge) : 0.0;
}

static struct request request_since(struct predict *state, const struct gb_cell *cell)
{
    double along = 0.0, square = 0.0, size2 = 0.0;
    for (int k = 0; k < 6; k++) {
        double *last = k < 3 ? &state->strain[k] : &state->shear[k - 3];
        const double now = k < 3 ? strain_along(state, cell, k)
                                 : cell->shear[k - 3] - state->cell.shear[k - 3];
        along += now * *last;
        square += *last * *last;
        size2 += now * now;
        *last = now;
    }
    state->cell = *cell;
    const double ratio = square > 0.0 ? along / square : 0.0;
    return (struct request){
        ratio > 0.0 && ratio <= GB_PREDICT_STRAIN_RATIO_MAX ? ratio : 0.0, sqrt(size2)};
}

/* Vectors of some particles, in columns. */
enum { SOME = 64 };
typedef double columns[3][SOME];

/* Scales nonaffine displacements or rotations by the ratio of the strains, each at most to
 * GB_PREDICT_RATIO_MAX times the strain. */
GB_SIMD_LOOP void predict_vectors(columns motion, int n, struct request request)
{
    const double most = GB_PREDICT_RATIO_MAX * request.size, ratio = request.ratio;
    double *restrict x = motion[0], *restrict y = motion[1], *restrict z = motion[2];
#pragma omp simd
    for (int k = 0; k < n; k++) {
        const double length = ratio * sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]);
        const double factor = length > most ? most / length * ratio : ratio;
        x[k] *= factor;
        y[k] *= factor;
        z[k] *= factor;
    }
}

/* Rotations of the particles from begin on in the last relaxation; then the initial values for the
 * next. */
GB_SIMD_LOOP void load_rotations(const struct gb_relax *relax, int64_t begin, int n,
                                 columns rotation)
{
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < 3; c++) {
            const int64_t at = 3 * (begin + k) + c;
            rotation[c][k] = relax->rotation_sum ? (double)relax->rotation_sum[at]
                                                 : relax->vector[ROTATION][at];
        }
    }
}

GB_SIMD_LOOP void save_rotations(struct gb_relax *relax, int64_t begin, int n,
                                 columns rotation)
{
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < 3; c++) {
            const int64_t at = 3 * (begin + k) + c;
            if (relax->rotation_sum) {
                relax->rotation_sum[at] = (float)rotation[c][k];
            } else {
                relax->vector[ROTATION][at] = rotation[c][k];
            }
        }
    }
}

/* Motion of particles beside that of the cell since the last start; positions are kept relative
 * to the edges: the difference has neither the affine motion nor, less whole edges, the wrapping
 * into the cell. */
GB_SIMD_LOOP void displacements_of(const double edge[3], const double *position,
                                   double *scaled_position, int n, columns displacement)
{
    for (int c = 0; c < 3; c++) {
        double *restrict moved = displacement[c], now[SOME], before[SOME];
        for (int k = 0; k < n; k++) {
            now[k] = position[3 * k + c];
            before[k] = scaled_position[3 * k + c];
        }
#pragma omp simd
        for (int k = 0; k < n; k++) {
            now[k] /= edge[c];
            const double went = now[k] - before[k];
            moved[k] = edge[c] * (went - gb_cell_whole(went));
        }
        for (int k = 0; k < n; k++) {
            scaled_position[3 * k + c] = now[k];
        }
    }
}

/* The same in a cell with tilts: before, its edge vectors at the last start. */
static void displacement_tilted(const struct gb_cell *cell, const struct gb_cell *before,
                                const double position[3], double scaled_position[3],
                                double displacement[3])
{
    const struct gb_deformation motion = gb_cell_motion(before, cell);
    double matrix[3][3], then[3], affine[3];
    gb_cell_matrix(before, matrix);
    gb_mat_apply((const double(*)[3])matrix, scaled_position, then);
    gb_mat_apply(motion.f, then, affine);
    for (int c = 0; c < 3; c++) {
        displacement[c] = position[c] - affine[c];
    }
    gb_cell_nearest(cell, displacement);
    gb_cell_fraction(cell, position, scaled_position);
}

struct prediction {
    struct gb_relax *relax;
    struct gb_bodies b;
    const struct gb_cell *cell, *before;
    struct request request;
};

GB_SIMD_LOOP void add_vectors(double *to, int n, columns motion)
{
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < 3; c++) {
            to[3 * k + c] += motion[c][k];
        }
    }
}

/* Adds the predicted motions to those of the particles. */
GB_SIMD_LOOP void predict_particles(const struct prediction *p, int64_t begin, int n,
                                    columns displacement)
{
    columns rotation;
    load_rotations(p->relax, begin, n, rotation);
    predict_vectors(displacement, n, p->request);
    predict_vectors(rotation, n, p->request);
    save_rotations(p->relax, begin, n, rotation);
    add_vectors(p->b.position + 3 * begin, n, displacement);
    add_vectors(p->b.rotation + 3 * begin, n, rotation);
}

static int some(int64_t begin, int64_t end)
{
    return end - begin < SOME ? (int)(end - begin) : SOME;
}

GB_SIMD_LOOP void predict_scaled_loop(void *data, int64_t begin, int64_t end)
{
    const struct prediction *p = data;
    for (int64_t i = begin; i < end; i += SOME) {
        columns displacement;
        const int n = some(i, end);
        displacements_of(p->cell->edge, p->b.position + 3 * i,
                         p->relax->vector[POSITION] + 3 * i, n, displacement);
        predict_particles(p, i, n, displacement);
    }
}
GB_SIMD_WIDTHS(predict_scaled, (void *data, int64_t begin, int64_t end),
               (data, begin, end))

static void predict_tilted(void *data, int64_t begin, int64_t end)
{
    const struct prediction *p = data;
    for (int64_t i = begin; i < end; i += SOME) {
        columns displacement;
        const int n = some(i, end);
        for (int k = 0; k < n; k++) {
            double moved[3];
            displacement_tilted(p->cell, p->before, p->b.position + 3 * (i + k),
                                p->relax->vector[POSITION] + 3 * (i + k), moved);
            for (int c = 0; c < 3; c++) {
                displacement[c][k] = moved[c];
            }
        }
        predict_particles(p, i, n, displacement);
    }
}

/* before: the cell at the last start. */
static void predict_motion(struct gb_relax *relax, struct gb_world *world,
                           const struct gb_cell *before, struct request request)
{
    struct prediction prediction = {relax, gb_world_movable(world), gb_world_cell(world),
                                    before, request};
    const bool tilted = gb_world_model(world)->sheared && before->edge[0] > 0.0;
    gb_team_run_ranges(gb_world_team(world), prediction.b.count, GB_BLOCKS_GRAIN,
                       tilted ? predict_tilted : predict_scaled, &prediction);
}

static void start(struct gb_relax *relax, struct gb_world *world)
{
    struct predict *state = relax->state;
    const struct gb_cell before = state->cell;
    gb_relax_fire_rest(relax, &state->fire, &gb_relax_predict_tuning, world);
    predict_motion(relax, world, &before, request_since(state, gb_world_cell(world)));
}

static void rest(struct gb_relax *relax, struct gb_world *world)
{
    struct predict *state = relax->state;
    gb_relax_fire_rest(relax, &state->fire, &gb_relax_predict_tuning, world);
}

static void move(struct gb_relax *relax, struct gb_world *world)
{
    struct predict *state = relax->state;
    gb_relax_fire_move(relax, &state->fire, &gb_relax_predict_tuning, world);
}

static bool record(struct gb_relax *relax, int64_t count, struct gb_record *record,
                   struct gb_error *err)
{
    static const struct gb_record_member members[] = {
        {"relax/edge", GB_RECORD_DOUBLE, 3, offsetof(struct predict, cell.edge), "d"},
        {"relax/strain", GB_RECORD_DOUBLE, 3, offsetof(struct predict, strain), "1"},
        {"relax/tilt", GB_RECORD_DOUBLE, 3, offsetof(struct predict, cell.tilt), "d"},
        {"relax/sheared", GB_RECORD_DOUBLE, 3, offsetof(struct predict, cell.shear), "1"},
        {"relax/shear", GB_RECORD_DOUBLE, 3, offsetof(struct predict, shear), "1"},
    };
    /* a scene that shears only from here on has none in its record */
    const bool tilts =
        relax->sheared &&
        (!record->loading || gb_record_find(record, "relax/sheared") != NULL);
    const size_t used = tilts ? sizeof members / sizeof members[0] : 2;
    return gb_record_members(record, members, used, relax->state, err) &&
           gb_record_array(record, "relax/place", GB_RECORD_DOUBLE, count, 3, "1",
                           relax->vector[POSITION], err) &&
           (relax->rotation_sum
                ? gb_record_f32(record, "relax/turned", count, 3, "rad",
                                relax->rotation_sum, err)
                : gb_record_array(record, "relax/turned", GB_RECORD_DOUBLE, count, 3,
                                  "rad", relax->vector[ROTATION], err));
}

const struct gb_relaxer gb_relax_predict = {
    .name = "predict",
    .doc = "fire from a prediction: on as in the last strain step, then relaxed",
    .state_size = sizeof(struct predict),
    .vectors = 4,
    .moving = true,
    .rotation_sum = ROTATION,
    .light = GB_PREDICT_TOLERANCE_FRACTION_MIN,
    .start = start,
    .move = move,
    .rest = rest,
    .record = record,
};
