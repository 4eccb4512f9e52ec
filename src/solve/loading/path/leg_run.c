#include "solve/loading/path/leg_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/tolerances.h"
#include "solve/loading/path/leg_end.h"
#include "solve/loading/path/leg_goal.h"
#include "solve/loading/path/leg_held.h"
#include "solve/loading/path/leg_step.h"

enum { N = GB_PATH_COMPONENTS };

/* FNV-1a over the texts of the legs: another path, another number. */
static int64_t identity(const struct gb_path *path)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (int l = 0; l < path->count; l++) {
        for (const char *c = path->leg[l].text; *c != '\0'; c++) {
            hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
        }
        hash = (hash ^ ';') * 0x100000001b3u;
    }
    return (int64_t)(hash >> 1);
}

void gb_leg_run_init(struct gb_leg_run *run, const struct gb_model *model)
{
    *run = (struct gb_leg_run){.step_most = model->strain_step,
                               .step = model->strain_step,
                               .identity = identity(&model->path)};
}

/* Records of earlier versions have none. */
static bool record_exceeded(struct gb_leg_run *run, struct gb_record *record,
                            struct gb_error *err)
{
#define AT(member) offsetof(struct gb_leg_run, member)
    static const struct gb_record_member members[] = {
        {"path/exceeded", GB_RECORD_INT32, 1, AT(exceeded), "1"},
        {"path/exceeded_leg", GB_RECORD_INT32, 1, AT(exceeded_leg), "1"},
        {"path/exceeded_end", GB_RECORD_INT32, 1, AT(exceeded_end), "1"},
        {"path/exceeded_value", GB_RECORD_DOUBLE, 1, AT(exceeded_value), "E or 1"},
    };
#undef AT
    return (record->loading && !gb_record_find(record, "path/exceeded")) ||
           gb_record_members(record, members, sizeof members / sizeof members[0], run,
                             err);
}

static bool names_an_end(const struct gb_leg_run *run, const struct gb_path *path)
{
    return run->exceeded_leg >= 0 && run->exceeded_leg < path->count &&
           run->exceeded_end >= 0 &&
           run->exceeded_end < path->leg[run->exceeded_leg].end_count;
}

bool gb_leg_run_record(struct gb_leg_run *run, const struct gb_model *model,
                       struct gb_record *record, struct gb_error *err)
{
#define AT(member) offsetof(struct gb_leg_run, member)
    static const struct gb_record_member members[] = {
        {"path/identity", GB_RECORD_INT64, 1, AT(identity), "1"},
        {"path/leg", GB_RECORD_INT32, 1, AT(leg), "1"},
        {"path/begun", GB_RECORD_INT32, 1, AT(begun), "1"},
        {"path/steps", GB_RECORD_INT32, 1, AT(steps), "1"},
        {"path/reversals", GB_RECORD_INT32, 1, AT(reversals), "1"},
        {"path/released", GB_RECORD_INT32, 1, AT(released), "1"},
        {"path/approaching", GB_RECORD_BOOL, 1, AT(approaching), "1"},
        {"path/last_approach", GB_RECORD_BOOL, 1, AT(last_approach), "1"},
        {"path/step", GB_RECORD_DOUBLE, 1, AT(step), "1"},
        {"path/start", GB_RECORD_DOUBLE, N, AT(start), "E"},
        {"path/target", GB_RECORD_DOUBLE, N, AT(target), "E or 1"},
        {"path/strain", GB_RECORD_DOUBLE, N, AT(strain), "1"},
        {"path/increment", GB_RECORD_DOUBLE, N, AT(increment), "1"},
        {"path/stress", GB_RECORD_DOUBLE, N, AT(stress), "E"},
        {"path/largest", GB_RECORD_DOUBLE, 1, AT(largest), "E"},
        {"path/sense", GB_RECORD_DOUBLE, 2, AT(sense), "1"},
        {"path/value", GB_RECORD_DOUBLE, 2, AT(value), "E or 1"},
        {"path/nearest", GB_RECORD_DOUBLE, 1, AT(nearest), "1"},
        {"path/nearest_at", GB_RECORD_INT32, 1, AT(nearest_at), "1"},
        {"path/from", GB_RECORD_DOUBLE, 2, AT(from), "E or 1"},
        {"path/slope", GB_RECORD_DOUBLE, 2, AT(slope), "E or 1"},
        {"path/best", GB_RECORD_DOUBLE, 1, AT(best), "E or 1"},
        {"path/best_at", GB_RECORD_DOUBLE, 1, AT(best_at), "1"},
        {"path/affine", GB_RECORD_DOUBLE, N * N, AT(affine), "E"},
        {"path/tangent", GB_RECORD_DOUBLE, N * N, AT(tangent), "E"},
        {"path/small", GB_RECORD_DOUBLE, N * N, AT(small), "E"},
    };
#undef AT
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], run,
                           err)) {
        return false;
    }
    if (!record_exceeded(run, record, err)) {
        return false;
    }
    if (run->identity != identity(&model->path)) {
        gb_leg_run_init(run, model); /* another path: from its first leg on */
    }
    if (run->exceeded > 0 && !names_an_end(run, &model->path)) {
        return gb_error_set(err, GB_ERR_INPUT, "path/exceeded_leg: is out of range");
    }
    if (run->leg < 0 || run->leg > model->path.count || !(run->step > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "path/leg: is out of range");
    }
    return true;
}

/* Values that the leg takes from the state at which it begins. */
static void fix_targets(struct gb_leg_run *run, const struct gb_leg *leg,
                        const double stress[N])
{
    for (int k = 0; k < N; k++) {
        const struct gb_leg_component *component = &leg->component[k];
        run->target[k] = component->value;
        if (component->control != GB_LEG_STRAIN && isnan(component->value)) {
            const double base = component->control == GB_LEG_RATIO && component->of >= 0
                                    ? stress[component->of]
                                    : 1.0;
            run->target[k] = base != 0.0 ? stress[k] / base : 0.0;
        }
        if (component->control == GB_LEG_STRESS) {
            run->largest = fmax(run->largest, fabs(run->target[k]));
        }
    }
    for (int e = 0; e < leg->end_count; e++) {
        const bool stress_end =
            gb_leg_end_is_stress(&leg->end[e]) && leg->end[e].kind != GB_LEG_END_RATIO;
        run->largest =
            fmax(run->largest,
                 stress_end ? GB_PATH_LARGEST_SHARE * fabs(leg->end[e].value) : 0.0);
    }
}

/* First steps are short: the tangent is not known yet in this direction. */
static void restart_tangents(struct gb_leg_run *run)
{
    run->tangent = run->small = run->affine;
    run->step = run->step_most / GB_PATH_FIRST_STEP_PARTS;
}

void gb_leg_run_begin(struct gb_leg_run *run, const struct gb_model *model,
                      const struct gb_strain_tangent *affine, const double stress[N],
                      double density)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    run->begun = run->leg + 1;
    run->steps = run->reversals = run->released = 0;
    run->last_approach = false;
    run->affine = *affine;
    run->largest = 0.0;
    memset(run->strain, 0, sizeof run->strain);
    memcpy(run->stress, stress, sizeof run->stress);
    memcpy(run->start, stress, sizeof run->start);
    gb_leg_held_note_largest(run, stress);
    fix_targets(run, leg, stress);
    run->nearest = gb_leg_held_distance(run, model, stress);
    run->nearest_at = 0;
    run->approaching = run->nearest > 1.0;
    restart_tangents(run);
    gb_leg_goal_begin(run, model, density);
}

static enum gb_leg_run_order next_leg(struct gb_leg_run *run)
{
    run->leg++;
    return GB_LEG_RUN_NEXT_LEG;
}

/* The other half of a cycle; false when this was the last one. */
static bool reverse(struct gb_leg_run *run, const struct gb_model *model, double density)
{
    run->reversals++;
    if (run->reversals >= 2 * gb_leg_held_leg(run, model)->cycles) {
        return false;
    }
    restart_tangents(run);
    gb_leg_goal_begin(run, model, density);
    return true;
}

/* False: held stresses have not come nearer to their values for a long time. */
static bool comes_nearer(struct gb_leg_run *run, const struct gb_model *model, char *text,
                         size_t size)
{
    const double now = gb_leg_held_distance(run, model, run->stress);
    run->nearest_at++;
    if (now < run->nearest) {
        run->nearest = now;
        run->nearest_at = 0;
    }
    if (run->nearest_at <= GB_PATH_APPROACH_STEPS) {
        return true;
    }
    gb_leg_held_missed(run, model, text, size);
    return false;
}

enum gb_leg_run_order gb_leg_run_next(struct gb_leg_run *run,
                                      const struct gb_model *model, double density,
                                      char *text, size_t size)
{
    text[0] = '\0';
    if (run->leg >= model->path.count) {
        return GB_LEG_RUN_END;
    }
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    run->corrections = run->shortened = 0;
    if (run->approaching) {
        gb_leg_step_approach(run, model);
        return comes_nearer(run, model, text, size) ? GB_LEG_RUN_STRAIN
                                                    : GB_LEG_RUN_COLLAPSE;
    }
    if (run->steps > 0) {
        gb_leg_goal_follow(run, model, density);
    }
    const bool reached = gb_leg_goal_reached(run, leg, run->reversals % 2);
    if (reached) {
        gb_leg_goal_note_excess(run, leg, run->reversals % 2);
    }
    if (reached && (leg->cycles == 0 || !reverse(run, model, density))) {
        return next_leg(run);
    }
    const int e = leg->cycles > 0 ? run->reversals % 2 : 0;
    if (run->steps > 0 && gb_leg_goal_out_of_reach(run, model, e, text, size)) {
        return GB_LEG_RUN_COLLAPSE;
    }
    const int ends = leg->cycles > 0 ? 1 : leg->end_count;
    gb_leg_step_solve(run, model,
                      leg->leading >= 0 ? gb_leg_goal_next_lead(run, leg, e, ends) : 0.0,
                      1.0, run->increment);
    return GB_LEG_RUN_STRAIN;
}

void gb_leg_run_accept(struct gb_leg_run *run, const struct gb_model *model,
                       const double stress[N], double density)
{
    double change[N];
    for (int k = 0; k < N; k++) {
        change[k] = stress[k] - run->stress[k];
        run->stress[k] = stress[k];
        run->strain[k] += run->increment[k];
    }
    gb_leg_held_note_largest(run, stress);
    gb_strain_tangent_learn(&run->tangent, run->increment, change);
    run->step = fmin(2.0 * run->step, run->step_most);
    if (!run->approaching) {
        run->steps++;
    } else if (run->last_approach) {
        run->approaching = false;
        memset(run->strain, 0, sizeof run->strain);
        run->step = run->step_most / GB_PATH_FIRST_STEP_PARTS;
        gb_leg_goal_begin(run, model, density);
    }
}

void gb_leg_run_release(struct gb_leg_run *run)
{
    run->released = (1 << N) - 1;
    run->approaching = false;
    run->step = run->step_most;
}

void gb_leg_run_skip(struct gb_leg_run *run)
{
    run->leg++;
}

int gb_leg_run_number(const struct gb_leg_run *run)
{
    return run->approaching ? 0 : run->begun;
}

bool gb_leg_run_missed(const struct gb_leg_run *run, const struct gb_model *model,
                       char *text, size_t size)
{
    char more[48] = "";
    if (run->exceeded == 0) {
        return false;
    }
    if (run->exceeded > 1) {
        snprintf(more, sizeof more, "; %d more", (int)run->exceeded - 1);
    }
    gb_leg_goal_excess(run, model, text, size);
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s", more);
    return true;
}

double gb_leg_run_progress(const struct gb_leg_run *run, const struct gb_model *model)
{
    const int count = model->path.count;
    if (run->leg >= count || run->begun <= run->leg) {
        return (double)run->leg / count;
    }
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    const int e = leg->cycles > 0 ? run->reversals % 2 : 0;
    const double span = gb_leg_end_target(&leg->end[e]) - run->from[e];
    const double done = span != 0.0 ? (run->value[e] - run->from[e]) / span : 1.0;
    const double share = fmin(1.0, fmax(0.0, done));
    return (run->leg +
            (leg->cycles > 0 ? (run->reversals + share) / (2.0 * leg->cycles) : share)) /
           count;
}
