#include "solve/loading/strain_step.h"

#include <stdbool.h>
#include <stdio.h>

#include "greenbody/status.h"
#include "pack/cell/nonaffine.h"
#include "pack/cell/world.h"
#include "scene/tolerances.h"
#include "solve/relax/relax.h"

/* The relaxer ran out of evaluations: mostly a cycle between two states of a breaking
 * bridge, with a small residual.  A large one means that no equilibrium was near. */
static enum gb_guard_action judge_exhausted(const struct gb_relax *relax, char *text,
                                            size_t size, struct gb_error *err)
{
    if (relax->residual > GB_RESIDUAL_STOP * relax->tolerance) {
        gb_error_set(
            err, GB_ERR_NOT_CONVERGED,
            "no equilibrium after %lld evaluations: residual %.2e, tolerance %.2e",
            (long long)relax->evaluations, relax->residual, relax->allowed);
        return GB_GUARD_STOP;
    }
    if (relax->stalled) {
        snprintf(text, size,
                 "guard: the relaxation stalls: residual %.2e, at best %.2e, after "
                 "%lld evaluations and a restart, tolerance %.2e; kept as it is",
                 relax->residual, relax->best, (long long)relax->evaluations,
                 relax->allowed);
        return GB_GUARD_ACCEPT;
    }
    snprintf(text, size,
             "not fully relaxed: residual %.2e after %lld evaluations, tolerance %.2e",
             relax->residual, (long long)relax->evaluations, relax->allowed);
    return GB_GUARD_ACCEPT;
}

enum gb_guard_action gb_strain_step_judge(struct gb_guard *guard,
                                          enum gb_relax_outcome outcome,
                                          const struct gb_relax *relax, char *text,
                                          size_t size, struct gb_error *err)
{
    text[0] = '\0';
    if (outcome == GB_RELAX_EXHAUSTED) {
        guard->halvings = 0;
        return judge_exhausted(relax, text, size, err);
    }
    if (outcome != GB_RELAX_FAILED) {
        guard->halvings = 0;
        if (relax->restarts > 0) {
            snprintf(
                text, size,
                "guard: the relaxation stalled and was restarted: relaxed after %lld "
                "evaluations",
                (long long)relax->evaluations);
        }
        return GB_GUARD_ACCEPT;
    }
    if (err->code != GB_ERR_GUARD || guard->halvings >= GB_STRAIN_HALVINGS_MAX) {
        return GB_GUARD_STOP;
    }
    guard->halvings++;
    snprintf(text, size, "guard: %s; strain step halved (%d in a row)", err->text,
             guard->halvings);
    return GB_GUARD_RETRY;
}

enum gb_guard_action gb_strain_step_nonaffine(struct gb_guard *guard,
                                              const struct gb_nonaffine *nonaffine,
                                              char *text, size_t size)
{
    if (nonaffine->farthest <= GB_NONAFFINE_MAX) {
        guard->jumps = 0;
        return GB_GUARD_ACCEPT;
    }
    if (guard->jumps >= GB_NONAFFINE_HALVINGS_MAX) {
        guard->jumps = 0;
        snprintf(
            text, size,
            "particle %lld jumps by %.2g d, also in a quarter of the strain step: the "
            "packing, not the step; kept as it is",
            (long long)nonaffine->particle, nonaffine->farthest);
        return GB_GUARD_ACCEPT;
    }
    guard->jumps++;
    snprintf(
        text, size,
        "guard: particle %lld moves %.2g d in one strain step and may pass contacts by; "
        "strain step halved (%d in a row)",
        (long long)nonaffine->particle, nonaffine->farthest, guard->jumps);
    return GB_GUARD_RETRY;
}

bool gb_strain_step_init(struct gb_strain_step *step, const struct gb_model *model,
                         struct gb_error *err)
{
    step->model = model;
    return gb_relax_create(&step->relax, model, err);
}

void gb_strain_step_finish(struct gb_strain_step *step)
{
    gb_world_copy_destroy(step->good);
    gb_relax_destroy(step->relax);
}

void gb_strain_step_begin_first(struct gb_strain_step *step, struct gb_world *world)
{
    step->world = world;
    gb_relax_start(step->relax, world);
}

static void deform(struct gb_strain_step *step)
{
    gb_world_deform(step->world, &step->deformation);
    gb_relax_start(step->relax, step->world);
}

void gb_strain_step_begin(struct gb_strain_step *step,
                          const struct gb_deformation *deformation, int parts)
{
    step->deformation = *deformation;
    step->part = 1;
    step->parts = parts;
    deform(step);
}

/* Adds the iterations and evaluations of this relaxation to those of the strain step. */
static void count_relaxation(struct gb_strain_step *step)
{
    step->spent_iterations += step->relax->iterations;
    step->spent_evaluations += step->relax->evaluations;
}

void gb_strain_step_correct(struct gb_strain_step *step,
                            const struct gb_deformation *deformation)
{
    count_relaxation(step);
    gb_world_deform(step->world, deformation);
    gb_relax_proceed(step->relax, step->world);
}

/* Begins the next part of the strain step; false when this was the last one. */
static bool begin_next_part(struct gb_strain_step *step)
{
    if (step->part == 0 || step->part >= step->parts) {
        return false;
    }
    count_relaxation(step);
    step->part++;
    deform(step);
    return true;
}

/* Back to the state before the strain step under way. */
static bool restore_good(struct gb_strain_step *step, struct gb_error *err)
{
    count_relaxation(step);
    step->relax->iterations = step->relax->evaluations = 0;
    return step->have_good && gb_world_copy_restore(step->world, step->good, err) &&
           gb_world_evaluate(step->world, err);
}

static enum gb_strain_step_outcome stop(struct gb_strain_step *step)
{
    struct gb_error ignored;
    restore_good(step, &ignored);
    return GB_STRAIN_STEP_STOPPED;
}

enum gb_strain_step_outcome gb_strain_step_take_back(struct gb_strain_step *step,
                                                     const char *text,
                                                     struct gb_event_queue *events,
                                                     struct gb_error *err)
{
    if (!restore_good(step, err)) {
        return stop(step);
    }
    gb_event_queue_add(events, text);
    return GB_STRAIN_STEP_RETRY;
}

enum gb_strain_step_outcome gb_strain_step_advance(struct gb_strain_step *step,
                                                   int64_t max_evaluations,
                                                   struct gb_event_queue *events,
                                                   struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_relax_outcome outcome =
        gb_relax_advance(step->relax, step->world, max_evaluations, err);
    if (outcome == GB_RELAX_MORE) {
        return GB_STRAIN_STEP_MORE;
    }
    switch (gb_strain_step_judge(&step->guard, outcome, step->relax, text, sizeof text,
                                 err)) {
    case GB_GUARD_ACCEPT:
        step->unrelaxed = outcome == GB_RELAX_EXHAUSTED;
        gb_event_queue_add(events, text);
        return begin_next_part(step) ? GB_STRAIN_STEP_MORE : GB_STRAIN_STEP_RELAXED;
    case GB_GUARD_RETRY:
        return gb_strain_step_take_back(step, text, events, err);
    case GB_GUARD_STOP:
        break;
    }
    return stop(step);
}

/* The first relaxation has no earlier state to compare with: it is accepted. */
enum gb_strain_step_outcome gb_strain_step_check_jumps(struct gb_strain_step *step,
                                                       struct gb_event_queue *events,
                                                       struct gb_error *err)
{
    char text[GB_EVENT_TEXT] = "";
    if (!step->have_good) {
        return GB_STRAIN_STEP_RELAXED;
    }
    const double density = gb_world_density(step->world);
    if (density > GB_DENSITY_MAX) {
        gb_error_set(err, GB_ERR_GUARD,
                     "relative density %.6g: the contact laws hold up to %g", density,
                     GB_DENSITY_MAX);
        return stop(step);
    }
    const struct gb_nonaffine motion = gb_nonaffine_since(step->world, step->good);
    if (gb_strain_step_nonaffine(&step->guard, &motion, text, sizeof text) ==
        GB_GUARD_RETRY) {
        return gb_strain_step_take_back(step, text, events, err);
    }
    gb_event_queue_add(events, text);
    return GB_STRAIN_STEP_RELAXED;
}

bool gb_strain_step_save(struct gb_strain_step *step, struct gb_error *err)
{
    step->have_good = gb_world_copy_save(step->world, &step->good, err);
    return step->have_good;
}

void gb_strain_step_clear_spent(struct gb_strain_step *step)
{
    step->spent_iterations = step->spent_evaluations = 0;
}

int64_t gb_strain_step_iterations(const struct gb_strain_step *step)
{
    return step->spent_iterations + step->relax->iterations;
}

int64_t gb_strain_step_evaluations(const struct gb_strain_step *step)
{
    return step->spent_evaluations + step->relax->evaluations;
}
