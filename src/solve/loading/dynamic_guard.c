#include "solve/loading/dynamic_guard.h"

#include <stdio.h>
#include <string.h>

#include "scene/tolerances.h"

bool gb_dynamic_guard_save(struct gb_dynamic *motion, const struct gb_world *world,
                           struct gb_error *err)
{
    const size_t bytes = 3 * (size_t)motion->model->count * sizeof(double);
    memcpy(motion->good_velocity, motion->verlet.velocity, bytes);
    memcpy(motion->good_spin, motion->verlet.spin, bytes);
    motion->good_time = motion->time;
    motion->good_density = motion->density;
    motion->good_work = motion->verlet.work;
    motion->good_absorbed = motion->verlet.absorbed;
    motion->good_stage = motion->stage;
    return gb_world_copy_save(world, &motion->good, err);
}

/* Back to the last recorded point. */
static bool restore_good(struct gb_dynamic *motion, struct gb_world *world,
                         struct gb_error *err)
{
    const size_t bytes = 3 * (size_t)motion->model->count * sizeof(double);
    memcpy(motion->verlet.velocity, motion->good_velocity, bytes);
    memcpy(motion->verlet.spin, motion->good_spin, bytes);
    motion->time = motion->good_time;
    motion->density = motion->good_density;
    motion->verlet.work = motion->good_work;
    motion->verlet.absorbed = motion->good_absorbed;
    motion->stage = motion->good_stage;
    motion->left = 0;
    return gb_world_copy_restore(world, motion->good, err) &&
           gb_world_evaluate(world, err);
}

enum gb_step_outcome gb_dynamic_guard_halve(struct gb_dynamic *motion,
                                            struct gb_world *world, const char *why,
                                            char *text, size_t size, struct gb_error *err)
{
    motion->limit = 0.5 * motion->step;
    if (!restore_good(motion, world, err)) {
        return GB_STEP_STOPPED;
    }
    if (++motion->halvings > GB_STEP_HALVINGS_MAX) {
        gb_error_set(err, GB_ERR_GUARD, "%s, also with a time step of %.3g T", why,
                     motion->step);
        return GB_STEP_STOPPED;
    }
    snprintf(text, size, "guard: %s; time step halved to %.3g T", why, motion->limit);
    return GB_STEP_MORE;
}

/* Share of the contacts that slid since the last point. */
static double sliding_share(const struct gb_dynamic *motion)
{
    return motion->contacts > 0 ? (double)motion->sliding / (double)motion->contacts
                                : 0.0;
}

/* Half the step changed nothing: friction is the cause, and the step is restored. */
static void restore_step(struct gb_dynamic *motion, double share, char *text, size_t size)
{
    motion->sliding_most = 0.5 * (1.0 + share);
    motion->limit = motion->limit_before;
    motion->slid = 0.0;
    motion->halvings--;
    snprintf(text, size,
             "guard: %.0f %% of the contacts slide with half the time step as well; the "
             "step is not the cause and is taken as before",
             100.0 * share);
}

/* Friction caps hide an unstable step from the kinetic energy; the sliding contacts show
 * it.  Many contacts may also slide at any step: half the step decides. */
enum gb_step_outcome gb_dynamic_guard_judge(struct gb_dynamic *motion,
                                            struct gb_world *world, char *text,
                                            size_t size, struct gb_error *err)
{
    const double share = sliding_share(motion);
    if (motion->slid > 0.0 && share > GB_SLIDING_RATIO_UNCHANGED * motion->slid) {
        restore_step(motion, share, text, size);
        return GB_STEP_POINT;
    }
    if (share > motion->sliding_most) {
        char why[96];
        snprintf(why, sizeof why, "%.0f %% of the contacts slide", 100.0 * share);
        if (motion->slid == 0.0) {
            motion->limit_before = motion->limit;
        }
        motion->slid = share;
        return gb_dynamic_guard_halve(motion, world, why, text, size, err);
    }
    motion->slid = 0.0;
    return GB_STEP_POINT;
}
