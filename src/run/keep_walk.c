#include "run/keep_walk.h"

#include <math.h>

#include "run/record/kept_states.h"

/* Force evaluations between two questions whether to stop. */
enum { SLICE = 200 };

/* Points that a run has reached so far. */
struct progress {
    const struct gb_params *params;
    const struct gb_keep_points *points;
    double p_pa, density; /* highest while loading */
    int reached;
    bool visited; /* the state as it is */
};

/* The points of the list that the last recorded point is the first beyond, as bits. */
static unsigned find_due(struct progress *progress, const struct gb_point *point)
{
    unsigned due = 0;
    if (!gb_kept_states_loads(point)) {
        return 0;
    }
    for (int k = 0; k < progress->points->count; k++) {
        const struct gb_keep_point *at = &progress->points->point[k];
        const double before = at->by_density ? progress->density : progress->p_pa;
        const double now = at->by_density ? point->density : point->p_pa;
        if (gb_keep_points_reached(at, progress->params, before, now)) {
            due |= 1U << k;
            progress->reached++;
        }
    }
    progress->p_pa = fmax(progress->p_pa, point->p_pa);
    progress->density = fmax(progress->density, point->density);
    return due;
}

static bool press(struct gb_experiment *experiment, struct progress *progress,
                  const struct gb_keep_walk *walk, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    for (;;) {
        const enum gb_step_outcome outcome =
            gb_experiment_advance(experiment, SLICE, err);
        while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        }
        if (walk->cancelled && walk->cancelled(walk->cancel_data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
        if (outcome == GB_STEP_POINT) {
            const unsigned due = find_due(progress, gb_experiment_point(experiment));
            progress->visited = due != 0;
            if (due != 0 && !walk->visit(walk->data, experiment, due, err)) {
                return false;
            }
        }
        if (outcome == GB_STEP_STOPPED) {
            struct gb_error ignored;
            (void)(progress->visited ||
                   walk->visit(walk->data, experiment, GB_KEEP_WALK_STOPPED, &ignored));
            return false;
        }
        if (outcome == GB_STEP_DONE) {
            const unsigned visited = progress->visited ? GB_KEEP_WALK_VISITED : 0U;
            return walk->visit(walk->data, experiment, GB_KEEP_WALK_END | visited, err);
        }
    }
}

bool gb_keep_walk_run(const struct gb_params *params, const struct gb_keep_walk *walk,
                      int *missed, struct gb_error *err)
{
    struct gb_experiment *experiment = NULL;
    struct progress progress = {params, walk->points, -INFINITY, -INFINITY, 0, false};
    if (!gb_experiment_create(&experiment, params, walk->cancelled, walk->cancel_data,
                              err)) {
        return false;
    }
    const bool placed =
        params->structure != GB_STRUCTURE_GROWN && walk->points->count == 0;
    const bool done = placed ? walk->visit(walk->data, experiment, GB_KEEP_WALK_END, err)
                             : press(experiment, &progress, walk, err);
    *missed = walk->points->count - progress.reached;
    gb_experiment_destroy(experiment);
    return done;
}
