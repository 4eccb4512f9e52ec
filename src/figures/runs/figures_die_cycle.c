#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "figures/figures_compute.h"
#include "figures/figures_label.h"
#include "figures/packings/state_set.h"
#include "figures/runs/runs_check.h"
#include "many/die_summary.h"
#include "measure/fit/average.h"

enum { TRAVEL_POINTS = 101 };

static bool check(const struct gb_runset *set, const char *figure, struct gb_error *err)
{
    return gb_runs_check_die(set, figure, err) && gb_die_summary_check(set, err);
}

/* Rows of a run that the curve joins: all from loading to the rest in the die. */
static bool is_in_die(const char *branch)
{
    return strcmp(branch, "load") == 0 || strcmp(branch, "unload") == 0 ||
           strcmp(branch, "in-die") == 0;
}

static size_t longest(const struct gb_runset *set)
{
    size_t rows = 1;
    for (size_t i = 0; i < set->count; i++) {
        rows = MAX(rows, gb_table_rows(set->run[i].table));
    }
    return rows;
}

/* The first run of a group as a line with its label, the others thin; a marker at the
 * density of the ejected compact. */
static void draw_run(struct gb_series *series, const struct gb_runset *set, size_t run)
{
    const struct gb_table *table = set->run[run].table;
    const size_t group = set->run[run].group;
    const double *density = gb_table_column(table, "density", NULL);
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const bool first = gb_runset_first(set, group) == &set->run[run];
    double *x = gb_series_column(series, "density_%zu", run + 1);
    double *y = gb_series_column(series, "p_MPa_%zu", run + 1);
    double *ejected = gb_series_column(series, "density_ejected_%zu", run + 1);
    double *none = gb_series_column(series, "p_MPa_ejected_%zu", run + 1);
    size_t count = 0;
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        const char *branch = gb_table_word(table, k);
        if (is_in_die(branch)) {
            x[count] = density[k];
            y[count++] = pressure[k];
        } else if (strcmp(branch, "ejected") == 0) {
            ejected[0] = density[k];
            none[0] = 0.0;
        }
    }
    char *label = first ? gb_figures_label(set, group, NULL) : NULL;
    gb_series_draw(series, x, y, NULL, first ? GB_FIGURE_LINE : GB_FIGURE_FAINT,
                   (int)group, label);
    gb_series_draw(series, ejected, none, NULL, GB_FIGURE_POINTS, (int)group, NULL);
    g_free(label);
}

bool gb_figures_die_cycle(struct gb_series *series, const struct gb_figures_input *input,
                          struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!check(set, "die-cycle", err)) {
        return false;
    }
    gb_series_init(series, longest(set));
    gb_figures_label_groups(series, set);
    for (size_t i = 0; i < set->count; i++) {
        draw_run(series, set, i);
    }
    gb_series_caption(series,
                      "Loading, unloading and rest in the die of every bed; markers: "
                      "ejected compacts.");
    return true;
}

/* Travel of a run since ejection began, um, and the force at each point of it. */
static bool read_ejection(const struct gb_runset_run *run, double **travel,
                          double **force, size_t *count, struct gb_error *err)
{
    double *rest = NULL, *level = NULL;
    size_t rests = 0;
    if (!gb_runset_points(run, "eject", "time_ns", "wall_friction_mN", travel, force,
                          count, err)) {
        return false;
    }
    const bool good = gb_runset_points(run, "in-die", "time_ns", "wall_friction_mN",
                                       &rest, &level, &rests, err);
    for (size_t k = 0; good && k < *count; k++) {
        (*travel)[k] = 1e-3 * run->params.eject_m_s * ((*travel)[k] - rest[rests - 1]);
    }
    gb_alloc_free(rest);
    gb_alloc_free(level);
    return good;
}

/* Force of every run on a grid of travels that all of them reach. */
static bool sample_ejection(const struct gb_runset *set, double *grid, double *rows,
                            struct gb_error *err)
{
    double least = HUGE_VAL;
    bool good = true;
    for (int pass = 0; pass < 2 && good; pass++) {
        for (int k = 0; k < TRAVEL_POINTS; k++) {
            grid[k] = least * k / (TRAVEL_POINTS - 1);
        }
        for (size_t i = 0; i < set->count && good; i++) {
            double *x = NULL, *y = NULL;
            size_t count = 0;
            good = read_ejection(&set->run[i], &x, &y, &count, err);
            if (good && pass == 0) {
                least = fmin(least, x[count - 1]);
            } else if (good) {
                const struct gb_average_curve curve = {x, y, count};
                good = gb_average_resample(&curve, grid, TRAVEL_POINTS,
                                           rows + i * TRAVEL_POINTS, err);
            }
            gb_alloc_free(x);
            gb_alloc_free(y);
        }
    }
    return good;
}

bool gb_figures_die_cycle_ejection(struct gb_series *series,
                             const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!check(set, "die-ejection", err)) {
        return false;
    }
    double *rows = g_new(double, set->count *TRAVEL_POINTS);
    gb_series_init(series, TRAVEL_POINTS);
    double *grid = gb_series_column(series, "travel_um");
    const bool good = sample_ejection(set, grid, rows, err);
    if (good) {
        gb_figures_label_note(series, set);
        gb_state_set_means(series, set, rows, grid, "force_mN");
    }
    g_free(rows);
    return good;
}
