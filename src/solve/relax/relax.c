#include "solve/relax/relax.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "greenbody/params.h"
#include "pack/f32/integrate_f32.h"
#include "scene/normal_law.h"
#include "scene/tolerances.h"

/* Where a relaxation ends, by numerics.tolerance_scale:
 *
 * contact       gb_world_residual, the rms force or torque over the mean contact force or
 *               f_a(d), whichever is larger; where contacts carry less than their
 *               attraction the tolerance falls (struct gb_relaxer, light)
 * attraction    rms force or torque over f_a(d)
 * displacement  largest displacement of P1 (15) over d - r_eq: that of the centre under
 *               the largest force, or of the surface under the largest torque, with the
 *               longest stable step k = 1/K of (15), K the stiffness around the most
 *               strongly held particle
 *
 * The last two are the same for every relaxer and load. */

/* Scratch of the rule.  relax->scale is given. */
static bool stopping_rule_init(struct gb_relax *relax, const struct gb_model *model,
                               struct gb_error *err)
{
    if (relax->scale != GB_TOLERANCE_DISPLACEMENT) {
        return true;
    }
    relax->sum = gb_alloc_array((size_t)model->count, sizeof *relax->sum, err);
    return relax->sum != NULL;
}

/* Residual in mean contact forces at which a relaxation is done.  Under light loads it is
 * relative to the attraction, which does not bound the error of the pressure. */
static double allowed(const struct gb_relax *relax, const struct gb_world *world)
{
    const struct gb_tally *tally = gb_world_tally(world);
    const double carried = tally->normal_sum / (fmax(1.0, (double)tally->contacts) *
                                                gb_world_model(world)->force_floor);
    const double share = GB_PREDICT_TOLERANCE_SLOPE * carried;
    return relax->tolerance * fmin(1.0, fmax(relax->method->light, share));
}

/* Displacement over d - r_eq. */
static double displacement(const struct gb_relax *relax, const struct gb_world *world)
{
    double force, torque;
    gb_world_largest(world, &force, &torque);
    const double rotation = 0.5 * torque / GB_RELAX_INERTIA;
    return fmax(force, rotation) / (relax->stiffness * gb_world_model(world)->h_eq);
}

/* At least that of one pair at r_eq: a packing may have no contact. */
static void renew_stiffness(struct gb_relax *relax, const struct gb_world *world)
{
    const struct gb_model *model = gb_world_model(world);
    relax->stiffness = fmax(gb_relax_steepest_stiffest(world, relax->sum),
                            gb_normal_law_stiffness(model, model->h_eq));
}

/* The stiffness is that of GB_STEEPEST_STIFFNESS_MOVES evaluations at most before, as in
 * (15), and that of this evaluation where the relaxation ends. */
static bool still(struct gb_relax *relax, const struct gb_world *world)
{
    const bool due = relax->evaluations % GB_STEEPEST_STIFFNESS_MOVES == 1;
    if (due) {
        renew_stiffness(relax, world);
    }
    relax->residual = displacement(relax, world);
    if (relax->residual <= relax->tolerance && !due) {
        renew_stiffness(relax, world);
        relax->residual = displacement(relax, world);
    }
    return relax->residual <= relax->tolerance;
}

/* Right after an evaluation: sets relax->residual, true at or below the tolerance. */
static bool stopping_rule_met(struct gb_relax *relax, struct gb_world *world)
{
    relax->allowed = relax->tolerance;
    switch (relax->scale) {
    case GB_TOLERANCE_ATTRACTION:
        relax->residual = gb_world_imbalance(world) / gb_world_model(world)->adhesion;
        return relax->residual <= relax->tolerance;
    case GB_TOLERANCE_DISPLACEMENT:
        return still(relax, world);
    default:
        relax->residual = gb_world_residual(world);
        relax->allowed = allowed(relax, world);
        return relax->residual <= relax->allowed;
    }
}

static const struct gb_relaxer *const table[] = {&gb_relax_predict, &gb_relax_fire,
                                                 &gb_relax_steepest, NULL};

const struct gb_relaxer *const *gb_relax_table(void)
{
    return table;
}

const struct gb_relaxer *gb_relax_find(const char *name)
{
    for (int i = 0; table[i]; i++) {
        if (strcmp(table[i]->name, name) == 0) {
            return table[i];
        }
    }
    return NULL;
}

static bool unknown_relaxer(const char *name, struct gb_error *err)
{
    char names[160] = "";
    for (int i = 0; table[i]; i++) {
        strncat(names, i ? ", " : "", sizeof names - strlen(names) - 1);
        strncat(names, table[i]->name, sizeof names - strlen(names) - 1);
    }
    return gb_error_set(err, GB_ERR_INPUT, "numerics.relaxer = %s: expected %s, auto",
                        name, names);
}

/* The vectors of the method.  An f32 state has its own velocities; rotations are then
 * added up in single precision, too. */
static bool take_vectors(struct gb_relax *relax, const struct gb_model *model,
                         struct gb_error *err)
{
    const struct gb_relaxer *method = relax->method;
    const size_t numbers = 3 * (size_t)model->count;
    const bool in_f32 = method->moving && gb_integrate_f32_applies(model);
    bool whole = true;
    for (int v = in_f32 ? 2 : 0; v < method->vectors && whole; v++) {
        if (in_f32 && v == method->rotation_sum) {
            relax->rotation_sum =
                gb_alloc_array(numbers, sizeof *relax->rotation_sum, err);
            whole = relax->rotation_sum != NULL;
        } else {
            relax->vector[v] = gb_alloc_array(numbers, sizeof(double), err);
            whole = relax->vector[v] != NULL;
        }
    }
    return whole;
}

bool gb_relax_create(struct gb_relax **out, const struct gb_model *model,
                     struct gb_error *err)
{
    const struct gb_relaxer *method = gb_relax_find(model->numerics.relaxer);
    if (!method) {
        return unknown_relaxer(model->numerics.relaxer, err);
    }
    struct gb_relax *relax = gb_alloc_array(1, sizeof *relax, err);
    if (!relax) {
        return false;
    }
    relax->method = method;
    relax->sheared = model->sheared;
    relax->tolerance = model->numerics.tolerance;
    relax->scale = model->numerics.tolerance_scale;
    relax->max_evaluations = model->numerics.max_evaluations;
    relax->state = gb_alloc_array(1, method->state_size, err);
    if (!relax->state || !take_vectors(relax, model, err) ||
        !stopping_rule_init(relax, model, err)) {
        gb_relax_destroy(relax);
        return false;
    }
    *out = relax;
    return true;
}

void gb_relax_destroy(struct gb_relax *relax)
{
    if (!relax) {
        return;
    }
    gb_alloc_free(relax->sum);
    gb_alloc_free(relax->state);
    gb_alloc_free(relax->rotation_sum);
    for (int v = 0; v < 4; v++) {
        gb_alloc_free(relax->vector[v]);
    }
    gb_alloc_free(relax);
}

static void reset(struct gb_relax *relax)
{
    relax->iterations = 0;
    relax->evaluations = 0;
    relax->best = INFINITY;
    relax->best_at = 0;
    relax->restarts = 0;
    relax->stalled = false;
    relax->stiffness = 0.0;
}

void gb_relax_start(struct gb_relax *relax, struct gb_world *world)
{
    reset(relax);
    relax->method->start(relax, world);
}

void gb_relax_proceed(struct gb_relax *relax, struct gb_world *world)
{
    reset(relax);
    if (relax->method->rest) {
        relax->method->rest(relax, world);
    } else {
        relax->method->start(relax, world);
    }
}

/* True when the residual has stopped falling after a restart, too.  The restart: particles
 * at rest, the method from its start. */
static bool stalls(struct gb_relax *relax, struct gb_world *world)
{
    if (relax->residual < (1.0 - GB_STALL_FRACTION) * relax->best) {
        relax->best = relax->residual;
        relax->best_at = relax->evaluations;
    }
    if (relax->evaluations - relax->best_at < GB_STALL_EVALUATIONS) {
        return false;
    }
    relax->stalled = relax->restarts > 0;
    if (!relax->stalled) {
        relax->restarts++;
        relax->best_at = relax->evaluations;
        relax->method->start(relax, world);
    }
    return relax->stalled;
}

bool gb_relax_evaluate(struct gb_relax *relax, struct gb_world *world,
                       struct gb_error *err)
{
    return relax->method->moving
               ? gb_world_evaluate_along(world, relax->vector[0], relax->vector[1], err)
               : gb_world_evaluate(world, err);
}

static enum gb_relax_outcome advance(struct gb_relax *relax, struct gb_world *world,
                                     int64_t max_evaluations, struct gb_error *err)
{
    for (int64_t slice = 0; slice < max_evaluations; slice++) {
        /* the move comes before the evaluation, except before the very first one */
        if (relax->evaluations > 0) {
            relax->method->move(relax, world);
            relax->iterations++;
        }
        if (!gb_relax_evaluate(relax, world, err)) {
            return GB_RELAX_FAILED;
        }
        relax->evaluations++;
        if (stopping_rule_met(relax, world)) {
            return GB_RELAX_DONE;
        }
        if (relax->evaluations >= relax->max_evaluations || stalls(relax, world)) {
            return GB_RELAX_EXHAUSTED;
        }
    }
    return GB_RELAX_MORE;
}

enum gb_relax_outcome gb_relax_advance(struct gb_relax *relax, struct gb_world *world,
                                       int64_t max_evaluations, struct gb_error *err)
{
    const enum gb_relax_outcome outcome = advance(relax, world, max_evaluations, err);
    gb_world_synchronise(world);
    return outcome;
}

bool gb_relax_record(struct gb_relax *relax, int64_t count, struct gb_record *record,
                     struct gb_error *err)
{
    return !relax->method->record || relax->method->record(relax, count, record, err);
}
