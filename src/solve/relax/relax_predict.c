/* FIRE from a prediction: after a strain step the particles are moved on as they moved
 * beside the affine motion in the last one, in proportion to the strain.  Most of a
 * compression is that repetition; what relaxation has to find is the rest.
 *
 * The prediction is made before the first evaluation, so that it reaches the contacts
 * together with the strain, as one increment.  Starting near the answer, larger steps and
 * a stronger pull of the velocity towards the force pay than for plain FIRE. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/record.h"
#include "base/vec.h"
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

/* A strain step this much longer than the last one is another story, and so is one the
 * other way: nothing is foretold. */
static const double share_most = 2.0;

enum { PLACE = 2, TURNED = 3 }; /* vectors beside the velocities */

struct predict {
    struct gb_relax_fire_state fire;
    double edge[3];   /* of the cell when the relaxation under way or done began */
    double strain[3]; /* logarithmic, that it answers */
};

/* Strain since the relaxation before, and how much of the last answer it asks for. */
struct asked {
    double share, size;
};

static struct asked ask(struct predict *state, const double edge[3])
{
    double along = 0.0, square = 0.0, size2 = 0.0;
    for (int k = 0; k < 3; k++) {
        const double now = state->edge[k] > 0.0 ? log(edge[k] / state->edge[k]) : 0.0;
        along += now * state->strain[k];
        square += state->strain[k] * state->strain[k];
        size2 += now * now;
        state->strain[k] = now;
        state->edge[k] = edge[k];
    }
    const double share = square > 0.0 ? along / square : 0.0;
    return (struct asked){share > 0.0 && share <= share_most ? share : 0.0, sqrt(size2)};
}

/* What is foretold of a way or a turn. */
static void foretold(double way[3], struct asked asked)
{
    const double length = asked.share * gb_vec_length(way);
    const double most = GB_PREDICT_RATIO_MAX * asked.size;
    const double factor = length > most ? most / length * asked.share : asked.share;
    for (int c = 0; c < 3; c++) {
        way[c] *= factor;
    }
}

/* The turn of particle i in the last relaxation, and what the next one begins with. */
static void recall_turn(const struct gb_relax *relax, int64_t i, double turned[3])
{
    for (int c = 0; c < 3; c++) {
        turned[c] = relax->turned ? (double)relax->turned[3 * i + c]
                                  : relax->vector[TURNED][3 * i + c];
    }
}

static void keep_turn(struct gb_relax *relax, int64_t i, const double turned[3])
{
    for (int c = 0; c < 3; c++) {
        if (relax->turned) {
            relax->turned[3 * i + c] = (float)turned[c];
        } else {
            relax->vector[TURNED][3 * i + c] = turned[c];
        }
    }
}

/* Places are remembered as shares of the edges: free of the affine motion, and of whole
 * edges where a particle was put back into the cell. */
static void foretell(struct gb_relax *relax, struct gb_world *world, struct asked asked)
{
    const struct gb_bodies b = gb_world_movable(world);
    const double *edge = gb_world_cell(world)->edge;
#pragma omp parallel for num_threads(gb_world_threads(world))                            \
    schedule(static) if (gb_world_threads(world) > 1)
    for (int64_t i = 0; i < b.count; i++) {
        double *place = relax->vector[PLACE] + 3 * i;
        double turned[3];
        double *position = b.position + 3 * i;
        double way[3];
        for (int c = 0; c < 3; c++) {
            const double now = position[c] / edge[c];
            const double went = now - place[c];
            way[c] = edge[c] * (went - gb_cell_whole(went));
            place[c] = now;
        }
        recall_turn(relax, i, turned);
        foretold(way, asked);
        foretold(turned, asked);
        keep_turn(relax, i, turned);
        gb_vec_add(position, 1.0, way);
        gb_vec_add(b.rotation + 3 * i, 1.0, turned);
    }
}

static void start(struct gb_relax *relax, struct gb_world *world)
{
    struct predict *state = relax->state;
    gb_relax_fire_rest(relax, &state->fire, &gb_relax_predict_tuning, world);
    foretell(relax, world, ask(state, gb_world_cell(world)->edge));
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
        {"relax/edge", GB_RECORD_DOUBLE, 3, offsetof(struct predict, edge), "d"},
        {"relax/strain", GB_RECORD_DOUBLE, 3, offsetof(struct predict, strain), "1"},
    };
    return gb_record_members(record, members, sizeof members / sizeof members[0],
                             relax->state, err) &&
           gb_record_array(record, "relax/place", GB_RECORD_DOUBLE, count, 3, "1",
                           relax->vector[PLACE], err) &&
           (relax->turned ? gb_record_f32(record, "relax/turned", count, 3, "rad",
                                              relax->turned, err)
                          : gb_record_array(record, "relax/turned", GB_RECORD_DOUBLE,
                                            count, 3, "rad", relax->vector[TURNED], err));
}

const struct gb_relaxer gb_relax_predict = {
    .name = "predict",
    .doc = "fire from a prediction: on as in the last strain step, then relaxed",
    .state_size = sizeof(struct predict),
    .vectors = 4,
    .moving = true,
    .turned = TURNED,
    .light = GB_PREDICT_TOLERANCE_FRACTION_MIN,
    .start = start,
    .move = move,
    .record = record,
};
