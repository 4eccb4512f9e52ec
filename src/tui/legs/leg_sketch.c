#include "tui/legs/leg_sketch.h"

#include <math.h>
#include <string.h>

#include "scene/path/path.h"

/* Reversals of a cycle that are drawn. */
enum { REVERSALS = 4, HALVINGS = 60, DOUBLINGS = 60 };

struct state {
    double stress[GB_PATH_COMPONENTS]; /* of the sign of struct gb_path, Pa */
    int dimension;
};

static double mean(const struct state *state)
{
    const double *s = state->stress;
    return state->dimension == 3 ? (s[0] + s[1] + s[2]) / 3.0 : 0.5 * (s[0] + s[2]);
}

static double deviatoric(const struct state *state)
{
    const double *s = state->stress;
    if (state->dimension == 2) {
        return hypot(s[0] - s[2], 2.0 * s[4]);
    }
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    return sqrt(0.5 * (xy * xy + yz * yz + zx * zx) +
                3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

static bool led(const struct gb_leg *leg, int k)
{
    return leg->component[k].control == GB_LEG_STRAIN && leg->component[k].value != 0.0;
}

/* All axes are strained alike and nothing else moves. */
static bool isotropic(const struct gb_leg *leg, int dimension)
{
    for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
        if (gb_path_has_component(dimension, k) &&
            (leg->component[k].control != GB_LEG_STRAIN ||
             leg->component[k].value != (k < 3 ? 1.0 : 0.0))) {
            return false;
        }
    }
    return true;
}

/* Stresses of a leg from their values at its beginning, when that of the leading component
 * is t. */
static void set_stresses(const struct gb_leg *leg, const struct state *from, double t,
                         struct state *to)
{
    const bool even = isotropic(leg, from->dimension);
    for (int k = 0; k < GB_PATH_COMPONENTS && leg->leading >= 0; k++) {
        const bool still = k >= 3 && from->stress[k] == 0.0 && !led(leg, k);
        to->stress[k] = k == leg->leading || (even && led(leg, k)) ? t
                        : still                                    ? 0.0
                                                                   : (double)NAN;
    }
    /* twice: a share may be one of a component that comes later */
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < GB_PATH_COMPONENTS; k++) {
            const struct gb_leg_component *c = &leg->component[k];
            const double before = from->stress[k];
            const double other = c->of >= 0 ? from->stress[c->of] : (double)NAN;
            if (c->control == GB_LEG_STRESS) {
                to->stress[k] = isfinite(c->value) ? c->value : before;
            } else if (c->control == GB_LEG_RATIO) {
                const double ratio = isfinite(c->value)              ? c->value
                                     : before == 0.0 && other == 0.0 ? (double)NAN
                                                                     : before / other;
                to->stress[k] =
                    to->stress[c->of] == 0.0 ? 0.0 : ratio * to->stress[c->of];
            } else if (c->control == GB_LEG_FOLLOW) {
                to->stress[k] = before + c->value * (to->stress[c->of] - other);
            }
        }
    }
}

static double end_value(const struct gb_leg *leg, const struct gb_leg_end *end,
                        const struct state *state)
{
    double sum = 0.0;
    int count = 0;
    switch (end->kind) {
    case GB_LEG_END_PRESSURE:
        for (int k = 0; k < 3; k++) {
            sum += led(leg, k) ? state->stress[k] : 0.0;
            count += led(leg, k);
        }
        return count > 0 ? sum / count : (double)NAN;
    case GB_LEG_END_STRESS:
        return state->stress[end->of];
    case GB_LEG_END_MEAN:
        return mean(state);
    case GB_LEG_END_Q:
        return deviatoric(state);
    case GB_LEG_END_RATIO:
        return deviatoric(state) / mean(state);
    default:
        return (double)NAN;
    }
}

static double value_at(const struct gb_leg *leg, const struct gb_leg_end *end,
                       const struct state *from, double t)
{
    struct state there = *from;
    set_stresses(leg, from, t, &there);
    return end_value(leg, end, &there);
}

/* The leading stress is the pressure that strain raises. */
static bool one_pressure(const struct gb_leg *leg, const struct state *from)
{
    return isotropic(leg, from->dimension) ||
           led(leg, 0) + led(leg, 1) + led(leg, 2) == 1;
}

/* The leading stress at which an end is reached, on the side of the stress at the
 * beginning to which the leg goes; NaN: it does not follow. */
static double solve(const struct gb_leg *leg, const struct gb_leg_end *end,
                    const struct state *from)
{
    const double begun = leg->leading >= 0 ? from->stress[leg->leading] : (double)NAN;
    const double t0 = isfinite(begun) ? begun : 0.0;
    const bool direct = (end->kind == GB_LEG_END_STRESS && end->of == leg->leading) ||
                        (end->kind == GB_LEG_END_PRESSURE && one_pressure(leg, from));
    const double rise = end->value - value_at(leg, end, from, t0);
    const bool unsigned_end = end->kind >= GB_LEG_END_Q;
    if (direct) {
        return end->value;
    }
    if (leg->leading < 0 || !isfinite(rise)) {
        return (double)NAN;
    }
    const double side = unsigned_end ? leg->extension ? -1.0 : 1.0
                        : rise < 0.0 ? -1.0
                                     : 1.0;
    double near = 0.0, far = side * fmax(fabs(t0), 1e3) * 1e-3;
    for (int i = 0; i < DOUBLINGS; i++) {
        const double rest = end->value - value_at(leg, end, from, t0 + far);
        if (rest == 0.0 || rest * rise < 0.0) {
            break;
        }
        near = far;
        far *= 2.0;
    }
    for (int i = 0; i < HALVINGS; i++) {
        const double half = 0.5 * (near + far);
        const double rest = end->value - value_at(leg, end, from, t0 + half);
        *(rest * rise > 0.0 ? &near : &far) = half;
    }
    const double missed = end->value - value_at(leg, end, from, t0 + far);
    return fabs(missed) <= 1e-6 * fabs(rise) ? t0 + far : (double)NAN;
}

static void add(struct gb_leg_plan *plan, int leg, const struct state *state,
                double strain)
{
    if (plan->count < GB_LEG_PLAN_STATES) {
        plan->state[plan->count++] =
            (struct gb_leg_plan_state){leg, mean(state), fabs(deviatoric(state)), strain};
    }
}

/* The end that follows from the text, the first where none does. */
static const struct gb_leg_end *choose_end(const struct gb_leg *leg,
                                           const struct state *from, double *t)
{
    for (int e = 0; e < leg->end_count; e++) {
        *t = solve(leg, &leg->end[e], from);
        if (isfinite(*t)) {
            return &leg->end[e];
        }
    }
    return &leg->end[0];
}

static double strain_of(const struct gb_leg_end *end)
{
    return end->kind == GB_LEG_END_STRAIN ? end->value : (double)NAN;
}

static void follow(struct gb_leg_plan *plan, const struct gb_leg *leg, int number,
                   struct state *state)
{
    const struct state from = *state;
    const int reversals = leg->cycles > REVERSALS / 2 ? REVERSALS : 2 * leg->cycles;
    double t = (double)NAN;
    for (int reversal = 0; reversal < reversals; reversal++) {
        const struct gb_leg_end *end = &leg->end[reversal % 2];
        set_stresses(leg, &from, solve(leg, end, &from), state);
        add(plan, number, state, strain_of(end));
    }
    if (reversals == 0) {
        const struct gb_leg_end *end = choose_end(leg, &from, &t);
        const double strain = leg->end_count == 1 ? strain_of(end)
                              : leg->end[1].kind == GB_LEG_END_STRAIN
                                  ? strain_of(&leg->end[1])
                                  : strain_of(&leg->end[0]);
        set_stresses(leg, &from, t, state);
        add(plan, number, state, strain);
    }
}

void gb_leg_sketch_plan(struct gb_leg_plan *plan, const struct gb_path *path,
                        int dimension)
{
    struct state state = {.dimension = dimension};
    plan->count = 0;
    add(plan, 0, &state, 0.0);
    for (int l = 0; l < path->count; l++) {
        follow(plan, &path->leg[l], l + 1, &state);
    }
}

/* Room for the label of the x axis, over the range of the path. */
static const double label_share = 0.3;

/* Two states of a plan and where they lie in the sketch. */
struct line {
    double x[2], y[2];
};

int gb_leg_sketch_mark(int leg)
{
    return leg <= 9 ? '0' + leg : 'a' + (leg - 10) % 26;
}

/* Legs without known stresses interrupt the path: it goes on where it is known again. */
static bool stress_line(const struct gb_leg_plan *plan, int i, struct line *line)
{
    const struct gb_leg_plan_state *from = &plan->state[i - 1], *to = &plan->state[i];
    *line = (struct line){{1e-6 * from->p, 1e-6 * to->p}, {1e-6 * from->q, 1e-6 * to->q}};
    return isfinite(to->p) && isfinite(to->q) && isfinite(from->p) && isfinite(from->q);
}

/* Reversals of a leg side by side; a new leg begins at strain 0. */
static bool strain_line(const struct gb_leg_plan *plan, int i, struct line *line)
{
    const struct gb_leg_plan_state *from = &plan->state[i - 1], *to = &plan->state[i];
    const double begun = from->leg == to->leg ? from->strain : 0.0;
    *line = (struct line){{i - 1, i}, {100.0 * begun, 100.0 * to->strain}};
    return isfinite(to->strain) && isfinite(begun);
}

typedef bool line_of(const struct gb_leg_plan *plan, int i, struct line *line);

static int count_lines(const struct gb_leg_plan *plan, int leg, line_of *of)
{
    struct line line;
    int count = 0;
    for (int i = 1; i < plan->count; i++) {
        count += (leg == 0 || plan->state[i].leg == leg) && of(plan, i, &line);
    }
    return count;
}

static void extend(double ends[2], const double value[2])
{
    ends[0] = fmin(ends[0], fmin(value[0], value[1]));
    ends[1] = fmax(ends[1], fmax(value[0], value[1]));
}

static void draw_lines(const struct gb_leg_plan *plan, int focus, line_of *of,
                       const char *x_label, const char *y_label, struct gb_plot *plot)
{
    double x[2] = {0.0, 0.0}, y[2] = {0.0, 0.0};
    struct line line;
    for (int i = 1; i < plan->count; i++) {
        if (of(plan, i, &line)) {
            extend(x, line.x);
            extend(y, line.y);
        }
    }
    x[1] += label_share * (x[1] - x[0]);
    y[1] = y[0] == y[1] ? fmax(0.5 * x[1], 1.0) : y[1];
    gb_plot_axes(plot, x, y, GB_PLOT_LINEAR, x_label, y_label);
    for (int i = 1; i < plan->count; i++) {
        const int leg = plan->state[i].leg;
        if (of(plan, i, &line)) {
            gb_plot_line(plot, &(struct gb_plot_series){
                                   .x = line.x,
                                   .y = line.y,
                                   .count = 2,
                                   .ink = GB_PLOT_INK_SERIES + (leg == focus ? 0 : 1),
                                   .marker = gb_leg_sketch_mark(leg)});
        }
    }
}

void gb_leg_sketch_draw(const struct gb_path *path, int dimension, int focus,
                        struct gb_plot *plot)
{
    struct gb_leg_plan plan;
    gb_leg_sketch_plan(&plan, path, dimension);
    const bool strain = count_lines(&plan, focus, strain_line) > 0;
    if (count_lines(&plan, focus, stress_line) > 0) {
        draw_lines(&plan, focus, stress_line, "p, MPa", "q, MPa", plot);
    } else if (strain) {
        draw_lines(&plan, focus, strain_line, "legs", "strain, %", plot);
    } else {
        gb_plot_text(plot, 0, 0, GB_PLOT_INK_TEXT, "p and q of this leg follow");
        gb_plot_text(plot, 1, 0, GB_PLOT_INK_TEXT, "from the packing");
    }
}
