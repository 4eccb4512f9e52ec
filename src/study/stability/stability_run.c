#include "study/stability/stability_run.h"

#include <math.h>
#include <string.h>

#include "run/keep_walk.h"
#include "scene/loading_kind.h"

static const double default_pa[GB_STABILITY_RUN_POINTS] = {1e6, 10e6, 100e6};

struct walk {
    const struct gb_params *params;
    const struct gb_stability_sink *sink;
    int rows;
    char why[160]; /* of the last state that was left out */
};

static bool is_in_use(const struct gb_stability_row *row,
                      const struct gb_experiment *experiment)
{
    const struct gb_model *model = gb_experiment_model(experiment);
    return gb_loading_kind_at(model->kind)->follows_time ||
           strcmp(row->method, model->numerics.relaxer) == 0;
}

/* One that has no equilibrium near is told and left out. */
static bool leave_out(struct walk *walk, double p_pa, const struct gb_error *err)
{
    g_strlcpy(walk->why, err->text, sizeof walk->why);
    walk->sink->skipped(walk->sink->data, p_pa, walk->why);
    return true;
}

static bool visit(void *data, const struct gb_experiment *experiment, unsigned what,
                  struct gb_error *err)
{
    struct walk *walk = data;
    const struct gb_point *point = gb_experiment_point(experiment);
    int first = 0;
    if (what & GB_KEEP_WALK_VISITED) {
        return true;
    }
    const int count = gb_stability_methods(walk->params, &first);
    for (int k = first; k < first + count; k++) {
        struct gb_stability_row row;
        struct gb_error own = {0};
        if (!gb_stability_measure_world(k, gb_experiment_world(experiment), &row, &own)) {
            return own.code == GB_ERR_INPUT || own.code == GB_ERR_GUARD ||
                           own.code == GB_ERR_NOT_CONVERGED
                       ? leave_out(walk, point->p_pa, &own)
                       : gb_error_set(err, own.code, "%s", own.text);
        }
        row.density = point->density;
        row.p_pa = point->p_pa;
        row.in_use = is_in_use(&row, experiment);
        walk->rows++;
        if (!walk->sink->row(walk->sink->data, &row, err)) {
            return false;
        }
        if (walk->sink->cancelled && walk->sink->cancelled(walk->sink->data)) {
            return gb_error_set(err, GB_ERR_CANCELLED, "stopped on request");
        }
    }
    return true;
}

bool gb_stability_run(const struct gb_params *params, const struct gb_keep_points *points,
                      const struct gb_stability_sink *sink, int *missed,
                      struct gb_error *err)
{
    struct gb_params pressed = *params;
    struct gb_keep_points usual = {.count = G_N_ELEMENTS(default_pa)};
    struct walk walk = {.params = params, .sink = sink};
    for (size_t k = 0; k < G_N_ELEMENTS(default_pa); k++) {
        usual.point[k].value = default_pa[k];
    }
    pressed.unload_count = 0;
    pressed.hold_s = 0.0;
    const struct gb_keep_walk keep = {points ? points : &usual, visit, &walk,
                                      sink->cancelled, sink->data};
    if (!gb_loading_kind_check_cell(params, "stability", err) ||
        !gb_keep_walk_run(&pressed, &keep, missed, err)) {
        return false;
    }
    return walk.rows > 0 ||
           gb_error_set(err, GB_ERR_INPUT, "no state could be measured: %s", walk.why);
}

bool gb_stability_run_stable(const struct gb_stability_row *row)
{
    return row->used <= row->measured;
}

GString *gb_stability_run_csv(const char *comment)
{
    GString *csv = g_string_new(comment);
    g_string_append(csv,
                    "# longest stable steps in sqrt(m/(E d)), of steepest in 1/(E d); "
                    "ratio: measured / theory; used: what the run takes; margin: "
                    "measured / used\n"
                    "method,p_MPa,density,damping,theory,measured,ratio,used,margin,"
                    "stable,in_use\n");
    return csv;
}

void gb_stability_run_add(GString *csv, const struct gb_stability_row *row)
{
    const double number[] = {1e-6 * row->p_pa, row->density,
                             row->damping,     row->theory,
                             row->measured,    row->measured / row->theory,
                             row->used,        row->measured / row->used};
    g_string_append(csv, row->method);
    for (size_t i = 0; i < G_N_ELEMENTS(number); i++) {
        g_string_append_printf(csv, ",%.8g", number[i]);
    }
    g_string_append_printf(csv, ",%d,%d\n", gb_stability_run_stable(row), row->in_use);
}
