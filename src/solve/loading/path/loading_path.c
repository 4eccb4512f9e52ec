/* The mode `quasistatic` under a loading path (loading.path): legs in the order of
 * solve/loading/path/leg_run.h, each strain step relaxed to equilibrium, held stresses
 * corrected before it is recorded. */
#include <math.h>
#include <stdio.h>

#include "pack/cell/world.h"
#include "scene/tolerances.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"
#include "solve/loading/path/leg_run.h"
#include "solve/loading/strain_step.h"

struct path_loading {
    struct gb_loading base;
    struct gb_strain_step step;
    struct gb_leg_run legs;
    int misses; /* steps in a row whose held stresses were missed */
};

static struct path_loading *own(struct gb_loading *loading)
{
    return (struct path_loading *)(void *)loading;
}

static const struct path_loading *view(const struct gb_loading *loading)
{
    return (const struct path_loading *)(const void *)loading;
}

static void begin(struct path_loading *run)
{
    gb_leg_run_init(&run->legs, run->base.model);
    gb_strain_step_begin_first(&run->step, run->base.world);
}

static bool build(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    if (!gb_strain_step_init(&own(loading)->step, loading->model, err) ||
        !gb_loading_cell_grow(loading, cancelled, data, err)) {
        return false;
    }
    begin(own(loading));
    return true;
}

static bool build_from(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    if (!gb_strain_step_init(&own(loading)->step, loading->model, err) ||
        !gb_loading_cell_load(loading, record, err)) {
        return false;
    }
    begin(own(loading));
    return true;
}

static void finish(struct gb_loading *loading)
{
    gb_strain_step_finish(&own(loading)->step);
}

static double largest(const double strain[GB_PATH_COMPONENTS])
{
    double most = 0.0;
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        most = fmax(most, fabs(strain[k]));
    }
    return most;
}

/* The strain step, in as many parts as its length asks for. */
static void strain(struct path_loading *run)
{
    const struct gb_model *model = run->base.model;
    const double share = largest(run->legs.increment) / model->strain_step;
    const int parts = (int)fmax(1.0, ceil(model->numerics.parts * share - 1e-9));
    double part[GB_PATH_COMPONENTS];
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        part[k] = run->legs.increment[k] / parts;
    }
    const struct gb_deformation deformation = gb_leg_run_deformation(part);
    gb_strain_step_begin(&run->step, &deformation, parts);
    run->base.strain_due = false;
}

/* Half the step from the last good state on. */
static enum gb_step_outcome halve(struct path_loading *run)
{
    gb_leg_run_halve(&run->legs, run->base.model);
    run->base.strain_due = true;
    return GB_STEP_MORE;
}

/* The held stresses of this step cannot be had: a shorter step, and after several of them
 * the end, or strain goes on alone. */
static enum gb_step_outcome miss(struct path_loading *run, struct gb_event_queue *events,
                                 struct gb_error *err)
{
    const struct gb_model *model = run->base.model;
    char text[GB_EVENT_TEXT];
    const bool collapsed = ++run->misses > GB_STRAIN_HALVINGS_MAX;
    gb_leg_run_held_missed(&run->legs, model, text, sizeof text);
    if (gb_strain_step_take_back(&run->step, "", events, err) == GB_STRAIN_STEP_STOPPED) {
        return GB_STEP_STOPPED;
    }
    if (!collapsed) {
        return halve(run);
    }
    if (!model->collapse_strains) {
        gb_error_set(err, GB_ERR_GUARD, "%s", text);
        return GB_STEP_STOPPED;
    }
    gb_event_queue_add(events, text);
    gb_event_queue_add(events, "the leg continues by strain (loading.on_collapse)");
    gb_leg_run_release(&run->legs);
    run->misses = 0;
    return halve(run);
}

static enum gb_step_outcome shorten(struct path_loading *run,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    if (gb_strain_step_take_back(&run->step, "", events, err) == GB_STRAIN_STEP_STOPPED) {
        return GB_STEP_STOPPED;
    }
    gb_leg_run_shorten(&run->legs, run->base.model);
    run->base.strain_due = true;
    return GB_STEP_MORE;
}

/* Equilibrium: held stresses are looked at, then the particles that moved far. */
static enum gb_step_outcome check(struct path_loading *run, struct gb_event_queue *events,
                                  struct gb_error *err)
{
    double stress[GB_PATH_COMPONENTS], correction[GB_PATH_COMPONENTS];
    gb_leg_run_stress(run->base.world, stress);
    switch (gb_leg_run_check(&run->legs, run->base.model, stress, correction)) {
    case GB_LEG_STEP_HELD:
        break;
    case GB_LEG_STEP_CORRECT: {
        const struct gb_deformation small = gb_leg_run_deformation(correction);
        gb_strain_step_correct(&run->step, &small);
        return GB_STEP_MORE;
    }
    case GB_LEG_STEP_BEYOND:
        return shorten(run, events, err);
    case GB_LEG_STEP_MISSED:
        return miss(run, events, err);
    }
    switch (gb_strain_step_check_jumps(&run->step, events, err)) {
    case GB_STRAIN_STEP_RETRY:
        return halve(run);
    case GB_STRAIN_STEP_STOPPED:
        return GB_STEP_STOPPED;
    default:
        run->misses = 0;
        return GB_STEP_POINT;
    }
}

static enum gb_step_outcome advance(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    struct path_loading *run = own(loading);
    if (loading->strain_due) {
        strain(run);
    }
    switch (gb_strain_step_advance(&run->step, max_evaluations, events, err)) {
    case GB_STRAIN_STEP_MORE:
        break;
    case GB_STRAIN_STEP_RELAXED:
        return check(run, events, err);
    case GB_STRAIN_STEP_RETRY:
        return halve(run);
    case GB_STRAIN_STEP_STOPPED:
        return GB_STEP_STOPPED;
    }
    return GB_STEP_MORE;
}

static void add_leg_event(const struct path_loading *run, struct gb_event_queue *events)
{
    const struct gb_path *path = &run->base.model->path;
    char text[GB_EVENT_TEXT];
    snprintf(text, sizeof text, "leg %d of %d: %s", run->legs.leg + 1, path->count,
             path->leg[run->legs.leg].text);
    gb_event_queue_add(events, text);
}

/* Measures the tangent and begins the leg under way. */
static bool begin_leg(struct path_loading *run, struct gb_event_queue *events,
                      struct gb_error *err)
{
    struct gb_world *world = run->base.world;
    struct gb_strain_tangent affine;
    double stress[GB_PATH_COMPONENTS];
    if (!gb_leg_run_measure(&affine, world, &run->step.good, err)) {
        return false;
    }
    gb_leg_run_stress(world, stress);
    gb_leg_run_begin(&run->legs, run->base.model, &affine, stress,
                     gb_world_density(world));
    if (events) {
        add_leg_event(run, events);
    }
    return true;
}

/* A stress that ends a leg is out of reach. */
static enum gb_step_outcome collapse(struct path_loading *run, const char *text,
                                     struct gb_event_queue *events, struct gb_error *err)
{
    if (!run->base.model->collapse_strains) {
        gb_error_set(err, GB_ERR_GUARD, "%s", text);
        return GB_STEP_STOPPED;
    }
    gb_event_queue_add(events, text);
    gb_leg_run_skip(&run->legs);
    return GB_STEP_MORE;
}

static enum gb_step_outcome save_good(struct path_loading *run, struct gb_error *err)
{
    run->base.strain_due = gb_strain_step_save(&run->step, err);
    return run->base.strain_due ? GB_STEP_MORE : GB_STEP_STOPPED;
}

/* The next step of the path after a recorded state. */
static enum gb_step_outcome
decide_next(struct path_loading *run, struct gb_event_queue *events, struct gb_error *err)
{
    const struct gb_model *model = run->base.model;
    char text[GB_EVENT_TEXT];
    for (;;) {
        const double density = gb_world_density(run->base.world);
        if (run->legs.leg < model->path.count && run->legs.begun <= run->legs.leg &&
            !begin_leg(run, events, err)) {
            return GB_STEP_STOPPED;
        }
        switch (gb_leg_run_next(&run->legs, model, density, text, sizeof text)) {
        case GB_LEG_RUN_NEXT_LEG:
            continue;
        case GB_LEG_RUN_END:
            return GB_STEP_DONE;
        case GB_LEG_RUN_COLLAPSE:
            if (collapse(run, text, events, err) == GB_STEP_STOPPED) {
                return GB_STEP_STOPPED;
            }
            continue;
        case GB_LEG_RUN_STRAIN:
            return save_good(run, err);
        }
    }
}

static enum gb_step_outcome after_point(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    struct path_loading *run = own(loading);
    double stress[GB_PATH_COMPONENTS];
    loading->restored = false;
    gb_strain_step_clear_spent(&run->step);
    if (run->legs.begun > 0) {
        gb_leg_run_stress(loading->world, stress);
        gb_leg_run_accept(&run->legs, loading->model, stress,
                          gb_world_density(loading->world));
    }
    return decide_next(run, events, err);
}

/* Under changed parameters the present leg begins anew; under another path, the first
 * one. */
static enum gb_step_outcome decide_again(struct gb_loading *loading, struct gb_error *err)
{
    struct path_loading *run = own(loading);
    struct gb_event_queue ignored = {.count = 0};
    run->legs.begun = 0;
    return decide_next(run, &ignored, err);
}

/* A record of a run without a path has no legs: the first one begins. */
static bool record_legs(struct path_loading *run, struct gb_record *record,
                        struct gb_error *err)
{
    if (record->loading && !gb_record_find(record, "path/leg")) {
        run->base.strain_due = false;
        return true;
    }
    return gb_leg_run_record(&run->legs, run->base.model, record, err);
}

static bool record_path(struct gb_loading *loading, struct gb_record *record,
                        struct gb_error *err)
{
    struct path_loading *run = own(loading);
    return record_legs(run, record, err) &&
           gb_relax_record(run->step.relax, loading->model->count, record, err) &&
           (!record->loading || !loading->strain_due ||
            gb_strain_step_save(&run->step, err));
}

static struct gb_loading_report report(const struct gb_loading *loading)
{
    const struct path_loading *run = view(loading);
    struct gb_loading_report report = gb_loading_empty_report();
    report.stage = run->legs.begun > 0 ? GB_LOADING_LOAD : GB_LOADING_RELAX;
    report.begun = run->legs.begun;
    report.leg = gb_leg_run_number(&run->legs);
    report.iterations = gb_strain_step_iterations(&run->step);
    report.evaluations = gb_strain_step_evaluations(&run->step);
    report.residual = gb_world_residual(loading->world);
    report.unrelaxed = run->step.unrelaxed;
    return report;
}

static double progress(const struct gb_loading *loading, double pressure, double density)
{
    (void)pressure;
    (void)density;
    return gb_leg_run_progress(&view(loading)->legs, loading->model);
}

static bool missed(const struct gb_loading *loading, char *text, size_t size)
{
    return gb_leg_run_missed(&view(loading)->legs, loading->model, text, size);
}

const struct gb_loading_mode gb_loading_path = {
    .size = sizeof(struct path_loading),
    .build = build,
    .build_from = build_from,
    .finish = finish,
    .advance = advance,
    .after_point = after_point,
    .decide_again = decide_again,
    .record = record_path,
    .report = report,
    .progress = progress,
    .missed = missed,
};
