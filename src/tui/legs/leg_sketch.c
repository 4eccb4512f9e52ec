#include "tui/legs/leg_sketch.h"

#include <math.h>

#include "tui/legs/leg_plan.h"

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
    gb_leg_plan_make(&plan, path, dimension);
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
