#include "solve/relax/guard.h"

#include <stdio.h>

#include "scene/tolerances.h"

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
                 "%lld evaluations and a restart, tolerance %.2e; accepted",
                 relax->residual, relax->best, (long long)relax->evaluations,
                 relax->allowed);
        return GB_GUARD_ACCEPT;
    }
    snprintf(text, size,
             "not fully relaxed: residual %.2e after %lld evaluations, tolerance %.2e",
             relax->residual, (long long)relax->evaluations, relax->allowed);
    return GB_GUARD_ACCEPT;
}

enum gb_guard_action gb_guard_judge(struct gb_guard *guard, enum gb_relax_outcome outcome,
                                    const struct gb_relax *relax, char *text, size_t size,
                                    struct gb_error *err)
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

enum gb_guard_action gb_guard_nonaffine(struct gb_guard *guard,
                                        const struct gb_nonaffine *nonaffine, char *text,
                                        size_t size)
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
            "packing, not the step; accepted",
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
