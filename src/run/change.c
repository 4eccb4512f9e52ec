#include "run/change.h"

#include "run/checkpoint.h"
#include "run/experiment_private.h"
#include "scene/field/changes.h"

bool gb_change_order(struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_loading *loading = experiment->loading;
    if (experiment->over || loading->mode->decide_again == NULL ||
        !gb_changes_due(&experiment->params, experiment->step - 1)) {
        return true;
    }
    const enum gb_step_outcome next = loading->mode->decide_again(loading, err);
    experiment->over = next == GB_STEP_DONE;
    return next != GB_STEP_STOPPED;
}

static bool same_terms(const struct gb_model *a, const struct gb_model *b)
{
    return a->terms.attraction == b->terms.attraction &&
           a->terms.bridges == b->terms.bridges &&
           a->terms.friction == b->terms.friction && a->cohesionless == b->cohesionless;
}

/* The contacts of the packing carry what the next model needs. */
static bool fits(const struct gb_model *now, const struct gb_model *next,
                 struct gb_error *err)
{
    if (!same_terms(now, next)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.changes: attraction, bridges and friction are there "
                            "from the start or not at all");
    }
    if (now->numerics.single != next->numerics.single) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            next->sheared
                ? "loading.path: legs that shear need double precision, but the run "
                  "began "
                  "in single: must be a path without shear, or a run with "
                  "numerics.precision = double"
                : "loading.path: the run is in double precision: must be a path with "
                  "shear, or a run with numerics.precision = double");
    }
    return true;
}

/* Model, loading and what is left to do become those of the next experiment, which takes
 * the former ones with it. */
static void take_over(struct gb_experiment *experiment, struct gb_experiment *next)
{
    struct gb_model *model = experiment->model;
    struct gb_loading *loading = experiment->loading;
    experiment->model = next->model;
    experiment->loading = next->loading;
    experiment->loading->params = &experiment->params;
    experiment->elastic_start = next->elastic_start;
    experiment->step = next->step;
    experiment->over = next->over;
    experiment->shown = next->shown;
    next->model = model;
    next->loading = loading;
}

static bool check(const struct gb_experiment *experiment, struct gb_error *err)
{
    struct gb_params effective;
    struct gb_model model;
    const struct gb_loading *loading = experiment->loading;
    gb_changes_effective(&experiment->params, experiment->step - 1, &effective);
    if (loading->mode->report(loading).unloading > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.changes: step %lld lies on an unloading branch",
                            (long long)experiment->step - 1);
    }
    return gb_model_init(&model, &effective, err) && fits(experiment->model, &model, err);
}

bool gb_change_allowed(const struct gb_params *params, const struct gb_params *changed,
                       int64_t step, struct gb_error *err)
{
    struct gb_params before, after;
    struct gb_model now, next;
    gb_changes_effective(params, step, &before);
    gb_changes_effective(changed, step, &after);
    return gb_model_init(&now, &before, err) && gb_model_init(&next, &after, err) &&
           fits(&now, &next, err);
}

bool gb_change_check_all(const struct gb_params *params, const struct gb_model *model,
                         struct gb_error *err)
{
    struct gb_params effective;
    struct gb_model next;
    for (int64_t step = gb_changes_next(params, -1); step >= 0;
         step = gb_changes_next(params, step)) {
        gb_changes_effective(params, step, &effective);
        if (!gb_model_init(&next, &effective, err) || !fits(model, &next, err)) {
            return false;
        }
    }
    return true;
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
        take_over(experiment, next);
        gb_experiment_destroy(next);
    }
    return good;
}
