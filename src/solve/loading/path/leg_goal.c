#include "solve/loading/path/leg_goal.h"

#include <math.h>
#include <stdio.h>

#include "base/portable.h"
#include "scene/tolerances.h"
#include "solve/loading/path/leg_end.h"
#include "solve/loading/path/leg_held.h"

enum { N = GB_PATH_COMPONENTS };

static double value_of(const struct gb_leg_run *run, const struct gb_model *model, int e,
                       double density)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    return gb_leg_end_value(leg, &leg->end[e], run->stress, run->strain, density,
                            run->steps, model->dimension);
}

/* The way to the ends begins here. */
void gb_leg_goal_begin(struct gb_leg_run *run, const struct gb_model *model,
                       double density)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    for (int e = 0; e < leg->end_count; e++) {
        run->from[e] = run->value[e] = value_of(run, model, e, density);
        run->sense[e] = gb_leg_end_target(&leg->end[e]) >= run->value[e] ? 1.0 : -1.0;
        run->slope[e] = 0.0;
    }
    const int first = run->reversals % 2;
    run->best = run->sense[first] * run->value[first];
    run->best_at = 0.0;
}

/* Values and slopes of the ends at an accepted state. */
void gb_leg_goal_follow(struct gb_leg_run *run, const struct gb_model *model,
                        double density)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    for (int e = 0; e < leg->end_count; e++) {
        const double value = value_of(run, model, e, density);
        const double moved = leg->leading >= 0 ? run->increment[leg->leading] : 0.0;
        run->slope[e] = moved != 0.0 ? (value - run->value[e]) / moved : 0.0;
        run->value[e] = value;
    }
}

/* Direction of the leading strain. */
static double direction(const struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    const bool unsigned_end =
        leg->end[e].kind == GB_LEG_END_Q || leg->end[e].kind == GB_LEG_END_RATIO;
    return unsigned_end && leg->extension ? -run->sense[e] : run->sense[e];
}

/* Leading strain of the next step: shortened to end at an end. */
double gb_leg_goal_next_lead(const struct gb_leg_run *run, const struct gb_leg *leg,
                             int e, int ends)
{
    const double sign = direction(run, leg, e);
    double advance = run->step;
    for (int i = 0; i < ends; i++) {
        const int k = ends > 1 ? i : e;
        const double rest = gb_leg_end_target(&leg->end[k]) - run->value[k];
        const double slope = leg->end[k].kind == GB_LEG_END_STRAIN ? 1.0 : run->slope[k];
        const double needed = slope != 0.0 ? sign * rest / slope : INFINITY;
        const double least = leg->end[k].kind == GB_LEG_END_STRAIN
                                 ? 0.0
                                 : GB_UNLOADING_SHARE_MIN * run->step;
        if (needed > 0.0) {
            advance = fmin(advance, fmax(needed, least));
        }
    }
    return sign * advance;
}

static bool reached(const struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    const double rest = gb_leg_end_target(&leg->end[e]) - run->value[e];
    return run->sense[e] * rest <= gb_leg_end_tolerance(&leg->end[e], run->largest);
}

bool gb_leg_goal_reached(const struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    if (leg->cycles > 0) {
        return reached(run, leg, e);
    }
    for (int k = 0; k < leg->end_count; k++) {
        if (reached(run, leg, k)) {
            return true;
        }
    }
    return false;
}

/* Beyond the end by less than this is no miss. */
static double allowed_excess(const struct gb_leg_end *end, double largest)
{
    switch (end->kind) {
    case GB_LEG_END_STEPS:
        return INFINITY;
    case GB_LEG_END_STRAIN:
        return GB_PATH_BEYOND * GB_PATH_END_SHARE * fabs(end->value);
    case GB_LEG_END_DENSITY: /* a difference of logarithms */
        return GB_PATH_BEYOND * GB_PATH_END_SHARE;
    default:
        return GB_PATH_BEYOND * gb_leg_end_tolerance(end, largest);
    }
}

static bool exceeds(const struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    const double past = run->sense[e] * (run->value[e] - gb_leg_end_target(&leg->end[e]));
    return past > allowed_excess(&leg->end[e], run->largest);
}

void gb_leg_goal_note_excess(struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    const int first = leg->cycles > 0 ? e : 0;
    const int last = leg->cycles > 0 ? e : leg->end_count - 1;
    for (int k = first; k <= last; k++) {
        if (!exceeds(run, leg, k)) {
            continue;
        }
        if (run->exceeded == 0) {
            run->exceeded_leg = run->leg;
            run->exceeded_end = k;
            run->exceeded_value = run->value[k];
        }
        run->exceeded++;
        return;
    }
}

/* The leg presses the packing together at given strains: any pressure is reached. */
static bool densifies(const struct gb_leg *leg, double sign)
{
    double volume = 0.0;
    for (int k = 0; k < 3; k++) {
        if (leg->component[k].control != GB_LEG_STRAIN) {
            return false;
        }
        volume += sign * leg->component[k].value;
    }
    return volume > 0.0;
}

static const char *end_name(const struct gb_leg_end *end)
{
    static const char *const names[] = {
        [GB_LEG_END_STEPS] = "points",    [GB_LEG_END_STRAIN] = "strain",
        [GB_LEG_END_DENSITY] = "density", [GB_LEG_END_PRESSURE] = "pressure",
        [GB_LEG_END_MEAN] = "p",          [GB_LEG_END_Q] = "q",
        [GB_LEG_END_RATIO] = "q/p",
    };
    return end->kind == GB_LEG_END_STRESS ? gb_path_component_name(end->of)
                                          : names[end->kind];
}

void gb_leg_goal_excess(const struct gb_leg_run *run, const struct gb_model *model,
                        char *text, size_t size)
{
    const struct gb_leg *leg = &model->path.leg[run->exceeded_leg];
    const struct gb_leg_end *end = &leg->end[run->exceeded_end];
    double value = run->exceeded_value;
    const char *unit = "";
    if (end->kind == GB_LEG_END_DENSITY) {
        value = gb_portable_exp(value);
    } else if (end->kind == GB_LEG_END_STRAIN) {
        value *= 100.0;
        unit = " %";
    } else if (gb_leg_end_is_stress(end) && end->kind != GB_LEG_END_RATIO) {
        value *= 1e-6 * model->pascal_per_stress;
        unit = " MPa";
    }
    snprintf(text, size, "exceeded: leg %d (%s) ends at %s = %.4g%s",
             (int)run->exceeded_leg + 1, leg->text, end_name(end), value, unit);
}

/* The stress that ends the leg has not risen over a long strain: it never will.  Legs with
 * a second end that always comes go on to that one. */
bool gb_leg_goal_out_of_reach(struct gb_leg_run *run, const struct gb_model *model, int e,
                              char *text, size_t size)
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    const double now = run->sense[e] * run->value[e];
    const double at = leg->leading >= 0 ? fabs(run->strain[leg->leading]) : 0.0;
    const bool other =
        leg->cycles == 0 && leg->end_count > 1 &&
        (!gb_leg_end_is_stress(&leg->end[0]) || !gb_leg_end_is_stress(&leg->end[1]));
    if (now > run->best || !gb_leg_end_is_stress(&leg->end[e])) {
        run->best = now;
        run->best_at = at;
    }
    if (other || densifies(leg, direction(run, leg, e)) ||
        fabs(at - run->best_at) <= GB_PATH_PLATEAU_STRAIN) {
        return false;
    }
    const bool ratio = leg->end[e].kind == GB_LEG_END_RATIO;
    const double unit = ratio ? 1.0 : 1e-6 * model->pascal_per_stress;
    snprintf(text, size,
             "leg %d (%s): %s does not reach %.4g%s: at most %.4g%s, at a strain of %.3g "
             "%%; now %.4g at %.3g %%",
             run->leg + 1, leg->text, end_name(&leg->end[e]), leg->end[e].value * unit,
             ratio ? "" : " MPa", run->sense[e] * run->best * unit, ratio ? "" : " MPa",
             100.0 * run->best_at, run->value[e] * unit, 100.0 * at);
    return true;
}

/* The step went past a stress that ends the leg; run->shorter: how far it may go. */
bool gb_leg_goal_beyond(struct gb_leg_run *run, const struct gb_model *model,
                        const double stress[N])
{
    const struct gb_leg *leg = gb_leg_held_leg(run, model);
    const int first = leg->cycles > 0 ? run->reversals % 2 : 0;
    const int last = leg->cycles > 0 ? first : leg->end_count - 1;
    run->shorter = 1.0;
    for (int e = first; e <= last && !run->approaching; e++) {
        const struct gb_leg_end *end = &leg->end[e];
        if (!gb_leg_end_is_stress(end)) {
            continue;
        }
        const double value = gb_leg_end_value(leg, end, stress, run->strain, 1.0,
                                              run->steps, model->dimension);
        const double rest = gb_leg_end_target(end) - run->value[e];
        const double past = run->sense[e] * (value - gb_leg_end_target(end));
        if (past > GB_PATH_BEYOND * gb_leg_end_tolerance(end, run->largest)) {
            run->shorter = fmin(run->shorter, rest / (value - run->value[e]));
        }
    }
    return run->shorter < 1.0 && run->shortened < GB_PATH_SHORTENINGS_MAX;
}
