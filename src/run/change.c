#include "run/change.h"

#include <string.h>

#include "measure/observe.h"
#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "scene/changes.h"

bool gb_change_order(struct gb_experiment *experiment, struct gb_error *err)
{
    double tensor[3][3];
    if (experiment->motion != NULL || experiment->over || experiment->load.branch > 0 ||
        !gb_changes_due(&experiment->params, experiment->step - 1)) {
        return true;
    }
    gb_observe_pressure(experiment->world, tensor);
    const double pressure[3] = {tensor[0][0], tensor[1][1], tensor[2][2]};
    const double density = gb_observe_density(experiment->world);
    switch (
        gb_quasistatic_next(&experiment->load, pressure, density, experiment->factor)) {
    case GB_QUASISTATIC_UNLOAD:
        return gb_world_copy_save(experiment->world, &experiment->branch, err);
    case GB_QUASISTATIC_END:
        experiment->strain_due = false;
        experiment->over = true;
        break;
    case GB_QUASISTATIC_STRAIN:
    case GB_QUASISTATIC_RESTORE:
        break;
    }
    return true;
}

static bool same_terms(const struct gb_model *a, const struct gb_model *b)
{
    return a->terms.attraction == b->terms.attraction &&
           a->terms.bridges == b->terms.bridges &&
           a->terms.friction == b->terms.friction && a->cohesionless == b->cohesionless;
}

/* Everything that the next one has becomes the experiment's.  The world points to the
 * model inside of next: it stays as a husk behind the experiment. */
static void move_in(struct gb_experiment *experiment, struct gb_experiment *next)
{
    struct gb_experiment before = *experiment;
    *experiment = *next;
    experiment->point = before.point;
    experiment->events_first = before.events_first;
    experiment->events_count = before.events_count;
    memcpy(experiment->event, before.event, sizeof before.event);
    next->world = before.world;
    next->good = before.good;
    next->branch = before.branch;
    next->relax = before.relax;
    next->motion = before.motion;
    next->husk = NULL;
    gb_world_destroy(next->world);
    gb_world_copy_destroy(next->good);
    gb_world_copy_destroy(next->branch);
    gb_relax_destroy(next->relax);
    gb_dynamic_destroy(next->motion);
    next->world = NULL;
    next->good = next->branch = NULL;
    next->relax = NULL;
    next->motion = NULL;
    gb_experiment_destroy(before.husk);
    experiment->husk = next;
}

static bool check(const struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_params effective;
    struct gb_model model;
    gb_changes_effective(&experiment->params, experiment->step - 1, &effective);
    if (experiment->load.branch > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.changes: step %lld lies on an unloading branch",
                            (long long)experiment->step - 1);
    }
    if (!gb_model_init(&model, &effective, err)) {
        return false;
    }
    return same_terms(&model, &experiment->model) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "loading.changes: attraction, bridges and friction are there "
                        "from the start or not at all");
}

bool gb_change_apply(struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_experiment *next = NULL;
    struct gb_record record = {0};
    if (experiment->over || !gb_changes_due(&experiment->params, experiment->step - 1)) {
        return true;
    }
    const bool good = check(experiment, err) &&
                      gb_checkpoint_take(experiment, &record, err) &&
                      gb_experiment_resume(&next, &experiment->params, &record, err);
    gb_record_finish(&record);
    if (good) {
        move_in(experiment, next);
    }
    return good;
}
