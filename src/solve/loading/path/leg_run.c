/* A loading path under way: legs of prescribed strain, with some stresses held.
 *
 * Each leg strains the cell along a leading component until its end is reached: a stress, a
 * strain, a density or a number of points.  Other components may have to keep a stress; their
 * strain increments follow from tangents, so that no gain is needed.
 *   tangent   stress against strain: measured with affine strains, then learned from each step
 *   ends      the quantity that ends a leg, and how near counts as reached
 *   held      which stresses are held, and how far they are from their values
 *   goal      size of the next step; overshoot; goals that move away
 *   step      corrections of a step until the held stresses are there
 *   leg       calls the parts above in order */

#include "solve/loading/path/leg_run.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/portable.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "scene/path/path.h"
#include "scene/tolerances.h"

enum { N = GB_PATH_COMPONENTS };

/* ---- Tangent ---- */

static const int shear_row[3] = {0, 0, 1}, shear_column[3] = {1, 2, 2};

struct gb_deformation gb_leg_run_deformation(const double strain[N])
{
    struct gb_deformation deformation = {{{0.0}}};
    for (int k = 0; k < 3; k++) {
        deformation.f[k][k] = gb_portable_exp(-strain[k]);
        deformation.f[shear_row[k]][shear_column[k]] = strain[3 + k];
    }
    return deformation;
}

void gb_leg_run_stress(const struct gb_world *world, double stress[N])
{
    double pressure[3][3];
    gb_world_pressure(world, pressure);
    for (int k = 0; k < 3; k++) {
        const int row = shear_row[k], column = shear_column[k];
        stress[k] = pressure[k][k];
        stress[3 + k] = -0.5 * (pressure[row][column] + pressure[column][row]);
    }
}

/* One column, from the strained packing. */
static bool measure_column(struct gb_strain_tangent *tangent, int column,
                           const double before[N], struct gb_world *world,
                           struct gb_error *err)
{
    double strain[N] = {0.0}, stress[N];
    strain[column] = GB_TANGENT_STRAIN;
    const struct gb_deformation small = gb_leg_run_deformation(strain);
    gb_world_deform(world, &small);
    if (!gb_world_evaluate(world, err)) {
        return false;
    }
    gb_leg_run_stress(world, stress);
    for (int row = 0; row < N; row++) {
        tangent->k[row][column] = (stress[row] - before[row]) / GB_TANGENT_STRAIN;
    }
    return true;
}

bool gb_leg_run_measure(struct gb_strain_tangent *tangent, struct gb_world *world,
                        struct gb_world_copy **good, struct gb_error *err)
{
    const struct gb_model *model = gb_world_model(world);
    double before[N];
    memset(tangent, 0, sizeof *tangent);
    gb_leg_run_stress(world, before);
    if (!gb_world_copy_save(world, good, err)) {
        return false;
    }
    for (int column = 0; column < N; column++) {
        tangent->k[column][column] = 1.0; /* stays where the component does not exist */
        if (gb_path_has_component(model->dimension, column) &&
            (column < 3 || model->sheared) &&
            (!measure_column(tangent, column, before, world, err) ||
             !gb_world_copy_restore(world, *good, err))) {
            return false;
        }
    }
    return true;
}

/* Learns from one increment: afterwards k strain = stress holds for it (Broyden's rank-one
 * update, Math. Comput. 19, 577 (1965)). */
static void strain_tangent_learn(struct gb_strain_tangent *tangent,
                                 const double strain[N], const double stress[N])
{
    double square = 0.0, missing[N];
    for (int row = 0; row < N; row++) {
        square += strain[row] * strain[row];
        missing[row] = stress[row];
        for (int column = 0; column < N; column++) {
            missing[row] -= tangent->k[row][column] * strain[column];
        }
    }
    for (int row = 0; row < N && square > 0.0; row++) {
        for (int column = 0; column < N; column++) {
            tangent->k[row][column] += missing[row] * strain[column] / square;
        }
    }
}

/* Element of the matrix of the conditions. */
static double element(const struct gb_strain_tangent *tangent,
                      const struct gb_stress_condition *condition, int column)
{
    const double based =
        condition->share != 0.0 ? tangent->k[condition->base][column] : 0.0;
    return tangent->k[condition->of][column] - condition->share * based;
}

/* False: singular. */
static bool solve_linear(double *matrix, double *right, double *solution, size_t count)
{
    gsl_matrix_view a = gsl_matrix_view_array(matrix, count, count);
    gsl_vector_view b = gsl_vector_view_array(right, count);
    gsl_vector_view x = gsl_vector_view_array(solution, count);
    bool finite = gsl_linalg_HH_solve(&a.matrix, &b.vector, &x.vector) == GSL_SUCCESS;
    for (size_t i = 0; i < count; i++) {
        finite = finite && isfinite(solution[i]);
    }
    return finite;
}

/* Fills the strains of the components named by the conditions, the other ones given, so
 * that all conditions hold; at most GB_PATH_COMPONENTS.  False: the tangent is singular;
 * strain is untouched then. */
static bool strain_tangent_solve(const struct gb_strain_tangent *tangent,
                                 const struct gb_stress_condition *condition, int count,
                                 double strain[N])
{
    double matrix[N * N], right[N], solution[N], given[N];
    if (count == 0) {
        return true;
    }
    memcpy(given, strain, sizeof given);
    for (int i = 0; i < count; i++) {
        given[condition[i].of] = 0.0;
    }
    for (int i = 0; i < count; i++) {
        right[i] = condition[i].change;
        for (int column = 0; column < N; column++) {
            right[i] -= element(tangent, &condition[i], column) * given[column];
        }
        for (int j = 0; j < count; j++) {
            matrix[i * count + j] = element(tangent, &condition[i], condition[j].of);
        }
    }
    if (!solve_linear(matrix, right, solution, (size_t)count)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        strain[condition[i].of] = solution[i];
    }
    return true;
}

/* ---- Ends of a leg ---- */

/* p = tr/3 and q = sqrt(3/2 s:s); in 2D tr/2 and the difference of the principal
 * stresses. */
static double leg_end_mean(const double stress[6], int dimension)
{
    return dimension == 3 ? (stress[0] + stress[1] + stress[2]) / 3.0
                          : 0.5 * (stress[0] + stress[2]);
}

static double leg_end_q(const double stress[6], int dimension)
{
    if (dimension == 2) {
        return gb_portable_hypot(stress[0] - stress[2], 2.0 * stress[4]);
    }
    const double xy = stress[0] - stress[1], yz = stress[1] - stress[2],
                 zx = stress[2] - stress[0];
    const double shear =
        stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
    return sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3.0 * shear);
}

/* A stress, not a strain, a density or a number of points. */
static bool is_stress(const struct gb_leg_end *end)
{
    return end->kind >= GB_LEG_END_PRESSURE;
}

/* Mean over the axes that strain leads. */
static double led_pressure(const struct gb_leg *leg, const double stress[6])
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const bool led =
            leg->component[k].control == GB_LEG_STRAIN && leg->component[k].value != 0.0;
        sum += led ? stress[k] : 0.0;
        count += led;
    }
    return count > 0 ? sum / count : 0.0;
}

/* The quantity of an end: its present value, comparable with end_target.  strain:
 * since the leg began; steps: its recorded points. */
static double end_value(const struct gb_leg *leg, const struct gb_leg_end *end,
                        const double stress[6], const double strain[6], double density,
                        int steps, int dimension)
{
    const double p = leg_end_mean(stress, dimension);
    switch (end->kind) {
    case GB_LEG_END_STEPS:
        return steps;
    case GB_LEG_END_STRAIN:
        return strain[leg->leading];
    case GB_LEG_END_DENSITY:
        return gb_portable_log(density);
    case GB_LEG_END_PRESSURE:
        return led_pressure(leg, stress);
    case GB_LEG_END_STRESS:
        return stress[end->of];
    case GB_LEG_END_MEAN:
        return p;
    case GB_LEG_END_Q:
        return leg_end_q(stress, dimension);
    case GB_LEG_END_RATIO:
        return p != 0.0 ? leg_end_q(stress, dimension) / p : 0.0;
    }
    return 0.0;
}

static double end_target(const struct gb_leg_end *end)
{
    return end->kind == GB_LEG_END_DENSITY ? gb_portable_log(end->value) : end->value;
}

/* How near to its target an end counts as reached; largest: stress of the leg. */
static double end_tolerance(const struct gb_leg_end *end, double largest)
{
    switch (end->kind) {
    case GB_LEG_END_STEPS:
    case GB_LEG_END_STRAIN:
    case GB_LEG_END_DENSITY:
        return GB_PATH_STRAIN_TOLERANCE;
    case GB_LEG_END_RATIO:
        return GB_PATH_END_SHARE * end->value;
    default:
        return fmax(GB_PATH_END_SHARE * fabs(end->value), GB_PATH_END_SCALE * largest);
    }
}

/* ---- Held stresses ---- */

/* The leg under way. */
static const struct gb_leg *leg_of(const struct gb_leg_run *run,
                                   const struct gb_model *model)
{
    return &model->path.leg[run->leg];
}

/* Is the stress of component k held? */
/* The stress of this component is held. */
static bool leg_held_component(const struct gb_leg_run *run, const struct gb_model *model,
                               int k)
{
    return gb_path_has_component(model->dimension, k) &&
           leg_of(run, model)->component[k].control != GB_LEG_STRAIN &&
           (run->released >> k & 1) == 0;
}

/* What a held stress should be, beside these stresses. */
/* What a held stress should be, beside the present stresses. */
static double leg_held_wanted(const struct gb_leg_run *run, const struct gb_leg *leg,
                              int k, const double stress[N])
{
    const struct gb_leg_component *component = &leg->component[k];
    switch (component->control) {
    case GB_LEG_RATIO:
        return run->target[k] * stress[component->of];
    case GB_LEG_FOLLOW:
        return run->start[k] +
               run->target[k] * (stress[component->of] - run->start[component->of]);
    default:
        return run->target[k];
    }
}

static double held_tolerance(const struct gb_leg_run *run, double want)
{
    return fmax(GB_PATH_STRESS_SHARE * fabs(want), GB_PATH_STRESS_SCALE * run->largest);
}

static void leg_held_note_largest(struct gb_leg_run *run, const double stress[N])
{
    for (int k = 0; k < N; k++) {
        run->largest = fmax(run->largest, fabs(stress[k]));
    }
}

/* Largest difference of a held stress from what it should be, over its tolerance. */
static double distance(const struct gb_leg_run *run, const struct gb_model *model,
                       const double stress[N])
{
    const struct gb_leg *leg = leg_of(run, model);
    double most = 0.0;
    for (int k = 0; k < N; k++) {
        if (leg_held_component(run, model, k)) {
            const double want = leg_held_wanted(run, leg, k, stress);
            most = fmax(most, fabs(want - stress[k]) / held_tolerance(run, want));
        }
    }
    return most;
}

/* Conditions on the held stresses: from these stresses a share of the way to the wanted
 * ones.  Returns their number. */
static int conditions(const struct gb_leg_run *run, const struct gb_model *model,
                      const double stress[N], double share,
                      struct gb_stress_condition condition[N])
{
    const struct gb_leg *leg = leg_of(run, model);
    int count = 0;
    for (int k = 0; k < N; k++) {
        if (leg_held_component(run, model, k)) {
            const bool ratio = leg->component[k].control != GB_LEG_STRESS;
            condition[count++] = (struct gb_stress_condition){
                .of = k,
                .base = ratio ? leg->component[k].of : k,
                .share = ratio ? run->target[k] : 0.0,
                .change = share * (leg_held_wanted(run, leg, k, stress) - stress[k]),
            };
        }
    }
    return count;
}

char *gb_leg_run_held_missed(const struct gb_leg_run *run, const struct gb_model *model,
                             char *buffer, size_t size)
{
    const struct gb_leg *leg = leg_of(run, model);
    const double mpa = 1e-6 * model->pascal_per_stress;
    size_t used = (size_t)snprintf(buffer, size, "leg %d (%s): no equilibrium with",
                                   run->leg + 1, leg->text);
    for (int k = 0; k < N && used < size; k++) {
        if (leg_held_component(run, model, k)) {
            used += (size_t)snprintf(buffer + used, size - used, " %s = %.4g MPa",
                                     gb_path_component_name(k),
                                     mpa * leg_held_wanted(run, leg, k, run->stress));
        }
    }
    if (used < size && leg->leading >= 0) {
        snprintf(buffer + used, size - used, " beyond a strain of %.3g %%: collapse",
                 100.0 * run->strain[leg->leading]);
    }
    return buffer;
}

/* ---- Goal: steps toward the ends of a leg ---- */

static double value_of(const struct gb_leg_run *run, const struct gb_model *model, int e,
                       double density)
{
    const struct gb_leg *leg = leg_of(run, model);
    return end_value(leg, &leg->end[e], run->stress, run->strain, density, run->steps,
                     model->dimension);
}

/* The way to the ends begins at this density and the present stress. */
/* The way to the ends begins here. */
static void leg_goal_begin(struct gb_leg_run *run, const struct gb_model *model,
                           double density)
{
    const struct gb_leg *leg = leg_of(run, model);
    for (int e = 0; e < leg->end_count; e++) {
        run->from[e] = run->value[e] = value_of(run, model, e, density);
        run->sense[e] = end_target(&leg->end[e]) >= run->value[e] ? 1.0 : -1.0;
        run->slope[e] = 0.0;
    }
    const int first = run->reversals % 2;
    run->best = run->sense[first] * run->value[first];
    run->best_at = 0.0;
}

/* Values and slopes at an accepted state. */
/* Values and slopes of the ends at an accepted state. */
static void leg_goal_follow(struct gb_leg_run *run, const struct gb_model *model,
                            double density)
{
    const struct gb_leg *leg = leg_of(run, model);
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

/* Leading strain of the next step: shortened to end at an end.  e: the end ahead. */
/* Leading strain of the next step: shortened to end at an end. */
static double leg_goal_next_lead(const struct gb_leg_run *run, const struct gb_leg *leg,
                                 int e, int ends)
{
    const double sign = direction(run, leg, e);
    double advance = run->step;
    for (int i = 0; i < ends; i++) {
        const int k = ends > 1 ? i : e;
        const double rest = end_target(&leg->end[k]) - run->value[k];
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
    const double rest = end_target(&leg->end[e]) - run->value[e];
    return run->sense[e] * rest <= end_tolerance(&leg->end[e], run->largest);
}

/* One of the ends is reached; of a cycle, end e. */
static bool leg_goal_reached(const struct gb_leg_run *run, const struct gb_leg *leg,
                             int e)
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
        return GB_PATH_BEYOND * end_tolerance(end, largest);
    }
}

static bool exceeds(const struct gb_leg_run *run, const struct gb_leg *leg, int e)
{
    const double past = run->sense[e] * (run->value[e] - end_target(&leg->end[e]));
    return past > allowed_excess(&leg->end[e], run->largest);
}

/* The leg, or half of a cycle, ends here: notes an end that is exceeded by more than
 * GB_PATH_BEYOND tolerances. */
static void leg_goal_note_excess(struct gb_leg_run *run, const struct gb_leg *leg, int e)
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

/* "exceeded: leg 2 (isotropic to 1 MPa) ends at pressure = 25 MPa", of the first that was
 * noted. */
static void leg_goal_excess(const struct gb_leg_run *run, const struct gb_model *model,
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
    } else if (is_stress(end) && end->kind != GB_LEG_END_RATIO) {
        value *= 1e-6 * model->pascal_per_stress;
        unit = " MPa";
    }
    snprintf(text, size, "exceeded: leg %d (%s) ends at %s = %.4g%s",
             (int)run->exceeded_leg + 1, leg->text, end_name(end), value, unit);
}

/* The stress that ends the leg has not risen over a long strain: it never will.  text (size
 * bytes) says so.  Legs with a second end that always comes go on to that one. */
/* The stress that ends the leg has not risen over a long strain: it never will.  Legs with
 * a second end that always comes go on to that one. */
static bool leg_goal_out_of_reach(struct gb_leg_run *run, const struct gb_model *model,
                                  int e, char *text, size_t size)
{
    const struct gb_leg *leg = leg_of(run, model);
    const double now = run->sense[e] * run->value[e];
    const double at = leg->leading >= 0 ? fabs(run->strain[leg->leading]) : 0.0;
    const bool other = leg->cycles == 0 && leg->end_count > 1 &&
                       (!is_stress(&leg->end[0]) || !is_stress(&leg->end[1]));
    if (now > run->best || !is_stress(&leg->end[e])) {
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
static bool goes_beyond(struct gb_leg_run *run, const struct gb_model *model,
                        const double stress[N])
{
    const struct gb_leg *leg = leg_of(run, model);
    const int first = leg->cycles > 0 ? run->reversals % 2 : 0;
    const int last = leg->cycles > 0 ? first : leg->end_count - 1;
    run->shorter = 1.0;
    for (int e = first; e <= last && !run->approaching; e++) {
        const struct gb_leg_end *end = &leg->end[e];
        if (!is_stress(end)) {
            continue;
        }
        const double value =
            end_value(leg, end, stress, run->strain, 1.0, run->steps, model->dimension);
        const double rest = end_target(end) - run->value[e];
        const double past = run->sense[e] * (value - end_target(end));
        if (past > GB_PATH_BEYOND * end_tolerance(end, run->largest)) {
            run->shorter = fmin(run->shorter, rest / (value - run->value[e]));
        }
    }
    return run->shorter < 1.0 && run->shortened < GB_PATH_SHORTENINGS_MAX;
}

/* ---- Step: the next strain, and its corrections ---- */

/* Largest magnitude of six strains. */
static double leg_step_largest(const double strain[N])
{
    double most = 0.0;
    for (int k = 0; k < N; k++) {
        most = fmax(most, fabs(strain[k]));
    }
    return most;
}

/* Strains of one step in which the leading component advances by `lead`, and held stresses
 * by a share of what they are away from their values. */
/* Strains of one step in which the leading component advances by `lead`; the affine
 * tangent takes over where the learned one gives no sensible answer. */
static void leg_step_solve(struct gb_leg_run *run, const struct gb_model *model,
                           double lead, double share, double strain[N])
{
    const struct gb_leg *leg = leg_of(run, model);
    const struct gb_strain_tangent *tangents[] = {&run->tangent, &run->affine};
    struct gb_stress_condition condition[N];
    const int count = conditions(run, model, run->stress, share, condition);
    const double limit = GB_PATH_STRAIN_RATIO_MAX * run->step;
    for (int t = 0; t < 2; t++) {
        for (int k = 0; k < N; k++) {
            strain[k] = leg->component[k].control == GB_LEG_STRAIN
                            ? lead * leg->component[k].value
                            : 0.0;
        }
        if (strain_tangent_solve(tangents[t], condition, count, strain) &&
            leg_step_largest(strain) <= limit) {
            return;
        }
    }
    const double most = leg_step_largest(strain);
    for (int k = 0; k < N && most > limit; k++) {
        strain[k] *= limit / most;
    }
}

/* Fills run->increment: held stresses go towards their values, as far as a step of strain
 * leads. */
/* Held stresses on the way to their values: as far as a step of strain leads. */
static void leg_step_approach(struct gb_leg_run *run, const struct gb_model *model)
{
    double strain[N];
    leg_step_solve(run, model, 0.0, 1.0, strain);
    const double most = leg_step_largest(strain);
    run->last_approach = most <= run->step;
    if (!run->last_approach) {
        leg_step_solve(run, model, 0.0, run->step / most, strain);
    }
    memcpy(run->increment, strain, sizeof strain);
}

/* Held stresses are where they should be; those on the way need not be. */
static bool all_held(const struct gb_leg_run *run, const struct gb_model *model,
                     const double stress[N])
{
    return (run->approaching && !run->last_approach) ||
           distance(run, model, stress) <= 1.0;
}

/* The tangent of small strains learns from the last correction. */
static void learn_small(struct gb_leg_run *run, const double stress[N])
{
    double change[N];
    if (run->corrections == 0 ||
        leg_step_largest(run->corrected) < GB_PATH_LEARN_STRAIN_MIN) {
        return;
    }
    for (int k = 0; k < N; k++) {
        change[k] = stress[k] - run->before[k];
    }
    strain_tangent_learn(&run->small, run->corrected, change);
}

/* Strain that brings the held stresses to their values; false: none in sight. */
static bool find_correction(struct gb_leg_run *run, const struct gb_model *model,
                            const double stress[N], double correction[N])
{
    struct gb_stress_condition condition[N];
    const int count = conditions(run, model, stress, 1.0, condition);
    for (int attempt = 0; attempt < 2; attempt++) {
        memset(correction, 0, N * sizeof *correction);
        if (strain_tangent_solve(&run->small, condition, count, correction) &&
            leg_step_largest(correction) <=
                fmax(run->step_most, GB_PATH_CORRECTION_STRAIN)) {
            return true;
        }
        run->small = run->affine;
    }
    return false;
}

enum gb_leg_step_outcome gb_leg_run_check(struct gb_leg_run *run,
                                          const struct gb_model *model,
                                          const double stress[N], double correction[N])
{
    if (run->leg >= model->path.count || run->begun == 0) {
        return GB_LEG_STEP_HELD;
    }
    if (all_held(run, model, stress)) {
        return goes_beyond(run, model, stress) ? GB_LEG_STEP_BEYOND : GB_LEG_STEP_HELD;
    }
    learn_small(run, stress);
    if (run->corrections++ >= GB_PATH_CORRECTIONS_MAX ||
        !find_correction(run, model, stress, correction)) {
        return GB_LEG_STEP_MISSED;
    }
    for (int k = 0; k < N; k++) {
        run->increment[k] += correction[k];
        run->corrected[k] = correction[k];
        run->before[k] = stress[k];
    }
    return GB_LEG_STEP_CORRECT;
}

void gb_leg_run_shorten(struct gb_leg_run *run, const struct gb_model *model)
{
    const int leading = leg_of(run, model)->leading;
    const double share = fmax(run->shorter, GB_UNLOADING_SHARE_MIN);
    run->shortened++;
    run->corrections = 0;
    leg_step_solve(run, model, share * run->increment[leading], 1.0, run->increment);
}

/* Without its corrections the halved step is found anew. */
void gb_leg_run_halve(struct gb_leg_run *run, const struct gb_model *model)
{
    const struct gb_leg *leg = leg_of(run, model);
    double lead = leg->leading >= 0 ? 0.5 * run->increment[leg->leading] : 0.0;
    run->step *= 0.5;
    run->corrections = 0;
    run->small = run->affine;
    if (run->approaching) {
        leg_step_approach(run, model);
    } else {
        leg_step_solve(run, model, lead, 1.0, run->increment);
    }
}

/* ---- Leg after leg ---- */

/* FNV-1a over the texts of the legs: another path, another number. */
static int64_t identity(const struct gb_path *path)
{
    uint64_t hash = GB_RECORD_FNV;
    for (int l = 0; l < path->count; l++) {
        hash = gb_record_fnv(hash, path->leg[l].text, strlen(path->leg[l].text));
        hash = gb_record_fnv(hash, ";", 1);
    }
    return (int64_t)(hash >> 1);
}

void gb_leg_run_init(struct gb_leg_run *run, const struct gb_model *model)
{
    *run = (struct gb_leg_run){.step_most = model->strain_step,
                               .step = model->strain_step,
                               .identity = identity(&model->path)};
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
        {"path/exceeded", GB_RECORD_INT32, 1, AT(exceeded), "1"},
        {"path/exceeded_leg", GB_RECORD_INT32, 1, AT(exceeded_leg), "1"},
        {"path/exceeded_end", GB_RECORD_INT32, 1, AT(exceeded_end), "1"},
        {"path/exceeded_value", GB_RECORD_DOUBLE, 1, AT(exceeded_value), "E or 1"},
    };
#undef AT
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], run,
                           err)) {
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
            is_stress(&leg->end[e]) && leg->end[e].kind != GB_LEG_END_RATIO;
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
    const struct gb_leg *leg = leg_of(run, model);
    run->begun = run->leg + 1;
    run->steps = run->reversals = run->released = 0;
    run->last_approach = false;
    run->affine = *affine;
    run->largest = 0.0;
    memset(run->strain, 0, sizeof run->strain);
    memcpy(run->stress, stress, sizeof run->stress);
    memcpy(run->start, stress, sizeof run->start);
    leg_held_note_largest(run, stress);
    fix_targets(run, leg, stress);
    run->nearest = distance(run, model, stress);
    run->nearest_at = 0;
    run->approaching = run->nearest > 1.0;
    restart_tangents(run);
    leg_goal_begin(run, model, density);
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
    if (run->reversals >= 2 * leg_of(run, model)->cycles) {
        return false;
    }
    restart_tangents(run);
    leg_goal_begin(run, model, density);
    return true;
}

/* False: held stresses have not come nearer to their values for a long time. */
static bool comes_nearer(struct gb_leg_run *run, const struct gb_model *model, char *text,
                         size_t size)
{
    const double now = distance(run, model, run->stress);
    run->nearest_at++;
    if (now < run->nearest) {
        run->nearest = now;
        run->nearest_at = 0;
    }
    if (run->nearest_at <= GB_PATH_APPROACH_STEPS) {
        return true;
    }
    gb_leg_run_held_missed(run, model, text, size);
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
    const struct gb_leg *leg = leg_of(run, model);
    run->corrections = run->shortened = 0;
    if (run->approaching) {
        leg_step_approach(run, model);
        return comes_nearer(run, model, text, size) ? GB_LEG_RUN_STRAIN
                                                    : GB_LEG_RUN_COLLAPSE;
    }
    if (run->steps > 0) {
        leg_goal_follow(run, model, density);
    }
    const bool reached = leg_goal_reached(run, leg, run->reversals % 2);
    if (reached) {
        leg_goal_note_excess(run, leg, run->reversals % 2);
    }
    if (reached && (leg->cycles == 0 || !reverse(run, model, density))) {
        return next_leg(run);
    }
    const int e = leg->cycles > 0 ? run->reversals % 2 : 0;
    if (run->steps > 0 && leg_goal_out_of_reach(run, model, e, text, size)) {
        return GB_LEG_RUN_COLLAPSE;
    }
    const int ends = leg->cycles > 0 ? 1 : leg->end_count;
    leg_step_solve(run, model,
                   leg->leading >= 0 ? leg_goal_next_lead(run, leg, e, ends) : 0.0, 1.0,
                   run->increment);
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
    leg_held_note_largest(run, stress);
    strain_tangent_learn(&run->tangent, run->increment, change);
    run->step = fmin(2.0 * run->step, run->step_most);
    if (!run->approaching) {
        run->steps++;
    } else if (run->last_approach) {
        run->approaching = false;
        memset(run->strain, 0, sizeof run->strain);
        run->step = run->step_most / GB_PATH_FIRST_STEP_PARTS;
        leg_goal_begin(run, model, density);
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
    leg_goal_excess(run, model, text, size);
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
    const struct gb_leg *leg = leg_of(run, model);
    const int e = leg->cycles > 0 ? run->reversals % 2 : 0;
    const double span = end_target(&leg->end[e]) - run->from[e];
    const double done = span != 0.0 ? (run->value[e] - run->from[e]) / span : 1.0;
    const double share = fmin(1.0, fmax(0.0, done));
    return (run->leg +
            (leg->cycles > 0 ? (run->reversals + share) / (2.0 * leg->cycles) : share)) /
           count;
}
