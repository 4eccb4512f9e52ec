/* What is computed to compare with the papers: experiments, their runs, and the runs read
 * back. */
#include "study/papers_plan.h"
#include "base/listing.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "io/preset.h"
#include "many/ensemble.h"
#include "many/param_sweep.h"
#include "run/cost.h"
#include "scene/loading_kind.h"

/* The simulations that the printed numbers of the papers need: a preset with changes, an
 * axis, and how many cells at each of its values. */

/* --- experiments ---------------------------------------------------------------------- */

#define SMALL_CELL "particles.count=1000", "structure.base=auto"
#define SHORT_HOLD "loading.relax=2 ns", "loading.hold=10 ns"

static const struct gb_papers_experiment experiments[] = {
    {"P1-fig5", "four powders with bridges, P1 Figs. 5, 6, 8", "p1-set2-9.7nm",
     .change = {"output.snapshots_at=1 GPa"},
     .axis = "particles.diameter=9.7;16;21;38 nm",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig6", "four powders by friction alone, P1 Fig. 6", "p1-nobridge-9.7nm",
     .change = {"loading.until=105 MPa", "loading.unload_from=100 MPa"},
     .axis = "particles.diameter=9.7;16;21;38 nm",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig12", "three geometries of loading, P1 Figs. 11 to 14", "p1-set1-uniaxial",
     .axis = "loading.geometry=uniaxial;biaxial;isotropic",
     .extent = {{.cells = 10}, {.cells = 16, .change = {SMALL_CELL}}}},
    {"P1-fig3", "structure of 600 discs on 30 d, P1 Fig. 3", "p1-fig3",
     .change = {"structure.seed=1", "loading.until=density=0.53", "loading.unload_from="},
     .extent = {{.cells = 100}, {.cells = 20}}},
    {"P2-v1", "discs at 6.8e8 1/s, P2 Figs. 2 to 4, Table 1", "p2-v1",
     .extent = {{.cells = 30}, {.cells = 16, .change = {SHORT_HOLD}}}},
    {"P2-v2", "discs at 6.8e7 1/s", "p2-v2",
     .extent = {{.cells = 30}, {.cells = 16, .change = {SHORT_HOLD}}}},
    {"P2-v3", "discs at 6.8e6 1/s", "p2-v3",
     .extent = {{.cells = 16}, {.cells = 6, .change = {SHORT_HOLD}}}},
    {"P2-v4", "discs at 6.8e5 1/s", "p2-v4", .extent = {{.cells = 4}, {.cells = 0}}},
    {"P2-v5", "discs at 6.8e4 1/s", "p2-v5", .extent = {{.cells = 1}, {.cells = 0}}},
    {"P2-full", "the same with both options that P2's text leaves open", "p2-v1",
     .change = {"contact.bridge_radius=current", "contact.relative_motion=full"},
     .axis = "loading.rate=6.8e8;6.8e7;6.8e6 1/s",
     .extent = {{.cells = 10}, {.cells = 0}}},
    {"P3-hertz", "frictionless Hertz in P3's die, P3 Figs. 16 to 18", "p3-hertz-mu0",
     .extent = {{.cells = 3}, {.cells = 3, .change = {"numerics.fidelity=fast"}}}},
    {"P3-storakers", "frictionless Storakers, P3 Figs. 17, 18", "p3-storakers-m0.2-mu0",
     .axis = "material.hardening=0;0.1;0.2", .extent = {{.cells = 3}, {.cells = 0}}},
    {"P3-friction", "Hertz with friction, P3 Fig. 19", "p3-hertz-mu0.01",
     .axis = "contact.mu=0.01;0.02;0.05", .extent = {{.cells = 3}, {.cells = 0}}},
    {"P3-storakers-friction", "Storakers with friction, P3 Fig. 20",
     "p3-storakers-m0.2-mu0.01", .axis = "contact.mu=0.01;0.02;0.05",
     .extent = {{.cells = 3}, {.cells = 0}}},
    {0},
};

const struct gb_papers_experiment *gb_papers_plan_table(void)
{
    return experiments;
}

size_t gb_papers_plan_count(void)
{
    return G_N_ELEMENTS(experiments) - 1;
}

size_t gb_papers_plan_index(const char *name)
{
    size_t k = 0;
    while (experiments[k].name != NULL && strcmp(experiments[k].name, name) != 0) {
        k++;
    }
    return k;
}

static bool apply(struct gb_params *params, const char *const change[GB_PAPERS_CHANGES],
                  struct gb_error *err)
{
    for (int k = 0; k < GB_PAPERS_CHANGES && change[k] != NULL; k++) {
        if (!gb_params_assign(params, change[k], err)) {
            return false;
        }
    }
    return true;
}

bool gb_papers_plan_axes(const struct gb_papers_experiment *experiment,
                         struct gb_axes *axes, struct gb_error *err)
{
    *axes = (struct gb_axes){0};
    return experiment->axis == NULL ||
           gb_param_sweep_add_axis(axes, experiment->axis, err);
}

bool gb_papers_plan_params(const struct gb_papers_experiment *experiment,
                           enum gb_papers_size size, size_t point,
                           struct gb_params *params, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_axes axes = {0};
    bool good = gb_preset_load(&preset, experiment->preset, err);
    if (good) {
        *params = *gb_preset_params(preset);
        good = apply(params, experiment->change, err) &&
               (size == GB_PAPERS_SIZES ||
                apply(params, experiment->extent[size].change, err)) &&
               gb_papers_plan_axes(experiment, &axes, err) &&
               gb_param_sweep_apply(&axes, point, params, err);
    }
    gb_param_sweep_axes_finish(&axes);
    gb_preset_destroy(preset);
    return good;
}

/* --- runs ----------------------------------------------------------------------------- */

/* P3's bed: filling and pressing took 50 s of one core, by docs/die.md. */
static const double die_s = 50.0;

static bool begins(const char *name, char *const *words)
{
    bool found = words == NULL;
    for (size_t k = 0; words != NULL && words[k] != NULL; k++) {
        found = found || (*words[k] != '\0' && g_str_has_prefix(name, words[k]));
    }
    return found;
}

static bool check_words(char *const *words, struct gb_error *err)
{
    for (size_t k = 0; words != NULL && words[k] != NULL; k++) {
        char *const one[] = {words[k], NULL};
        bool found = false;
        GString *names = g_string_new(NULL);
        for (size_t e = 0; experiments[e].name != NULL; e++) {
            found = found || begins(experiments[e].name, one);
            g_string_append_printf(names, "%s%s", e > 0 ? ", " : "", experiments[e].name);
        }
        if (!found) {
            gb_error_set(err, GB_ERR_INPUT,
                         "--only %.60s: expected P1, P2, P3 and %.300s, separated by "
                         "commas",
                         words[k], names->str);
        }
        g_string_free(names, TRUE);
        if (!found) {
            return false;
        }
    }
    return true;
}

/* The changes of the options: smaller cells keep the shape of their preset's. */
static bool change_count(struct gb_params *params, int count, struct gb_error *err)
{
    if (count == 0 || gb_loading_kind_of(params)->columns == GB_COLUMNS_DIE) {
        return true;
    }
    char *assignment = g_strdup_printf("particles.count=%d", count);
    const bool good = gb_params_assign(params, assignment, err) &&
                      gb_params_assign(params, "structure.base=auto", err);
    g_free(assignment);
    return good;
}

/* A list of runs that grows. */
struct list {
    const struct gb_papers_options *options;
    const char *directory;
    GArray *run;       /* struct gb_papers_run */
    GArray *params;    /* struct gb_params */
    GPtrArray *folder; /* char *, g_free */
};

static bool add_point(struct list *list, size_t experiment, const struct gb_axes *axes,
                      size_t point, struct gb_error *err)
{
    const struct gb_papers_experiment *row = &experiments[experiment];
    const struct gb_papers_options *options = list->options;
    const int cells =
        options->cells > 0 ? options->cells : row->extent[options->size].cells;
    struct gb_params params;
    if (!gb_papers_plan_params(row, options->size, point, &params, err) ||
        !change_count(&params, options->count, err) || !gb_params_check(&params, err)) {
        return false;
    }
    params.threads = 1; /* the cores are shared by the runs */
    char *name = gb_param_sweep_point_name(axes, point);
    for (int cell = 0; cell < cells; cell++) {
        const struct gb_papers_run run = {experiment, point, (size_t)cell};
        g_array_append_val(list->run, run);
        g_array_append_val(list->params, params);
        g_ptr_array_add(list->folder,
                        g_strdup_printf("%s/%s/%s_seed-%" G_GUINT64_FORMAT,
                                        list->directory, row->name, name, params.seed));
        params.seed++;
    }
    g_free(name);
    return true;
}

static bool add_experiment(struct list *list, size_t experiment, struct gb_error *err)
{
    struct gb_axes axes = {0};
    bool good = gb_papers_plan_axes(&experiments[experiment], &axes, err);
    for (size_t point = 0; good && point < gb_param_sweep_points(&axes); point++) {
        good = add_point(list, experiment, &axes, point, err);
    }
    gb_param_sweep_axes_finish(&axes);
    return good;
}

static double cost_s(const struct gb_params *params)
{
    const double seconds = gb_cost_assumed_s(params);
    return isnan(seconds) ? die_s : seconds;
}

static gint compare_costs(gconstpointer a, gconstpointer b, gpointer data)
{
    const double *cost = data;
    const size_t i = *(const size_t *)a, k = *(const size_t *)b;
    return cost[i] > cost[k] ? -1 : cost[i] < cost[k] ? 1 : (i > k) - (i < k);
}

/* Into the ensemble, the longest first, so that no worker waits for the last one. */
static void sort_into(struct gb_papers_plan *plan, struct list *list)
{
    size_t *order = g_new(size_t, plan->count + 1);
    double *cost = g_new(double, plan->count + 1);
    for (size_t k = 0; k < plan->count; k++) {
        order[k] = k;
        cost[k] = cost_s(&g_array_index(list->params, struct gb_params, k));
    }
    g_qsort_with_data(order, (gint)plan->count, sizeof *order, compare_costs, cost);
    plan->run = g_new(struct gb_papers_run, plan->count + 1);
    plan->cost = g_new(double, plan->count + 1);
    for (size_t k = 0; k < plan->count; k++) {
        struct gb_ensemble_run *run = &plan->ensemble.run[k];
        plan->run[k] = g_array_index(list->run, struct gb_papers_run, order[k]);
        run->params = g_array_index(list->params, struct gb_params, order[k]);
        run->directory = g_strdup(g_ptr_array_index(list->folder, order[k]));
        plan->cost[k] = cost[order[k]];
    }
    g_free(order);
    g_free(cost);
}

static bool fill(struct gb_papers_plan *plan, struct list *list, struct gb_error *err)
{
    bool good = true;
    for (size_t e = 0; good && e < gb_papers_plan_count(); e++) {
        plan->selected[e] = begins(experiments[e].name, list->options->only);
        good = !plan->selected[e] || add_experiment(list, e, err);
    }
    plan->count = list->run->len;
    if (good && plan->count == 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "no cells: this size leaves out the experiments of --only; "
                            "expected with --cells");
    }
    good = good && gb_ensemble_init(&plan->ensemble, plan->count, 1, err);
    if (good) {
        sort_into(plan, list);
    }
    return good;
}

bool gb_papers_plan_init(struct gb_papers_plan *plan,
                         const struct gb_papers_options *options, const char *directory,
                         struct gb_error *err)
{
    *plan = (struct gb_papers_plan){.directory = g_strdup(directory)};
    struct list list = {options, directory,
                        g_array_new(FALSE, FALSE, sizeof(struct gb_papers_run)),
                        g_array_new(FALSE, FALSE, sizeof(struct gb_params)),
                        g_ptr_array_new_with_free_func(g_free)};
    const bool good = check_words(options->only, err) && fill(plan, &list, err) &&
                      gb_ensemble_find_done(&plan->ensemble, err);
    g_array_free(list.run, TRUE);
    g_array_free(list.params, TRUE);
    g_ptr_array_unref(list.folder);
    return good;
}

void gb_papers_plan_finish(struct gb_papers_plan *plan)
{
    gb_ensemble_finish(&plan->ensemble);
    g_free(plan->run);
    g_free(plan->cost);
    g_free(plan->directory);
    *plan = (struct gb_papers_plan){0};
}

double gb_papers_plan_remaining_s(const struct gb_papers_plan *plan, size_t *runs)
{
    double seconds = 0.0;
    *runs = 0;
    for (size_t k = 0; k < plan->count; k++) {
        if (!plan->ensemble.run[k].ended) {
            seconds += plan->cost[k];
            (*runs)++;
        }
    }
    return seconds;
}

GString *gb_papers_plan_runs(const struct gb_papers_plan *plan)
{
    const size_t skipped = strlen(plan->directory) + 1;
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "experiment,directory");
    gb_listing_columns(listing, "%.0f", "seed");
    gb_listing_columns(listing, "%s", "state,why");
    for (size_t k = 0; k < plan->count; k++) {
        const struct gb_ensemble_run *run = &plan->ensemble.run[k];
        const bool failed = run->ended && run->error.code != GB_OK;
        char *why = g_strdelimit(g_strdup(failed ? run->error.text : ""), "\",\n", ' ');
        gb_listing_text(listing, experiments[plan->run[k].experiment].name);
        gb_listing_text(listing, run->directory + skipped);
        gb_listing_whole(listing, run->params.seed);
        gb_listing_text(listing, !run->ended ? "missing" : failed ? "failed" : "done");
        gb_listing_text(listing, why);
        g_free(why);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

/* --- runs read back ------------------------------------------------------------------- */

static bool read_experiment(struct gb_papers_cells *cells, size_t experiment,
                            const struct gb_papers_plan *plan, struct gb_error *err)
{
    GPtrArray *list = g_ptr_array_new();
    cells->point = g_new(size_t, plan->count + 1);
    cells->cell = g_new(size_t, plan->count + 1);
    for (size_t k = 0; k < plan->count; k++) {
        const struct gb_ensemble_run *run = &plan->ensemble.run[k];
        if (plan->run[k].experiment == experiment && run->ended &&
            run->error.code == GB_OK) {
            cells->point[list->len] = plan->run[k].point;
            cells->cell[list->len] = plan->run[k].cell;
            cells->most = MAX(cells->most, plan->run[k].cell + 1);
            g_ptr_array_add(list, run->directory);
        }
    }
    const bool good =
        list->len == 0 ||
        gb_runset_read(&cells->set, (char *const *)list->pdata, list->len, err);
    g_ptr_array_unref(list);
    return good;
}

bool gb_papers_plan_read(struct gb_papers_data *data, const struct gb_papers_plan *plan,
                         struct gb_error *err)
{
    bool good = true;
    *data = (struct gb_papers_data){0};
    for (size_t e = 0; good && e < gb_papers_plan_count(); e++) {
        good = !plan->selected[e] || read_experiment(&data->experiment[e], e, plan, err);
    }
    return good;
}

void gb_papers_plan_data_finish(struct gb_papers_data *data)
{
    for (size_t e = 0; e < GB_PAPERS_EXPERIMENTS_MOST; e++) {
        gb_runset_finish(&data->experiment[e].set);
        g_free(data->experiment[e].point);
        g_free(data->experiment[e].cell);
    }
    *data = (struct gb_papers_data){0};
}

bool gb_papers_plan_lacks(const struct gb_papers_view *view, size_t experiment, size_t i)
{
    return view->experiment == experiment &&
           view->cell == view->data->experiment[experiment].cell[i];
}

size_t gb_papers_plan_point(const struct gb_papers_view *view, size_t experiment,
                            size_t point, struct gb_runset *set)
{
    const struct gb_papers_cells *cells = &view->data->experiment[experiment];
    *set = (struct gb_runset){.run = g_new(struct gb_runset_run, cells->set.count + 1),
                              .groups = 1};
    for (size_t i = 0; i < cells->set.count; i++) {
        if (cells->point[i] == point && !gb_papers_plan_lacks(view, experiment, i)) {
            set->run[set->count] = cells->set.run[i];
            set->run[set->count++].group = 0;
        }
    }
    return set->count;
}
