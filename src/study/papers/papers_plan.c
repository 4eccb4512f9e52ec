#include "study/papers/papers_plan.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "run/cost.h"
#include "scene/loading_kind.h"

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
    const struct gb_papers_experiment *table = gb_papers_experiments_table();
    for (size_t k = 0; words != NULL && words[k] != NULL; k++) {
        char *const one[] = {words[k], NULL};
        bool found = false;
        GString *names = g_string_new(NULL);
        for (size_t e = 0; table[e].name != NULL; e++) {
            found = found || begins(table[e].name, one);
            g_string_append_printf(names, "%s%s", e > 0 ? ", " : "", table[e].name);
        }
        if (!found) {
            gb_error_set(err, GB_ERR_INPUT,
                         "--only %.60s: accepted P1, P2, P3 and %.300s, separated by "
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
    const struct gb_papers_experiment *row = &gb_papers_experiments_table()[experiment];
    const struct gb_papers_options *options = list->options;
    const int cells =
        options->cells > 0 ? options->cells : row->extent[options->size].cells;
    struct gb_params params;
    if (!gb_papers_experiments_params(row, options->size, point, &params, err) ||
        !change_count(&params, options->count, err) || !gb_params_check(&params, err)) {
        return false;
    }
    params.threads = 1; /* the cores are shared by the runs */
    char *name = gb_axes_name(axes, point);
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
    bool good = gb_papers_experiments_axes(&gb_papers_experiments_table()[experiment],
                                           &axes, err);
    for (size_t point = 0; good && point < gb_axes_points(&axes); point++) {
        good = add_point(list, experiment, &axes, point, err);
    }
    gb_axes_finish(&axes);
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
    for (size_t e = 0; good && e < gb_papers_experiments_count(); e++) {
        plan->selected[e] =
            begins(gb_papers_experiments_table()[e].name, list->options->only);
        good = !plan->selected[e] || add_experiment(list, e, err);
    }
    plan->count = list->run->len;
    if (good && plan->count == 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "no cells: this size leaves out the experiments of --only; "
                            "accepted with --cells");
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

char *gb_papers_plan_directory(const struct gb_papers_plan *plan, size_t experiment)
{
    return g_build_filename(plan->directory,
                            gb_papers_experiments_table()[experiment].name, NULL);
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
    GString *text = g_string_new("experiment,directory,seed,state,why\n");
    for (size_t k = 0; k < plan->count; k++) {
        const struct gb_ensemble_run *run = &plan->ensemble.run[k];
        const bool failed = run->ended && run->error.code != GB_OK;
        char *why = g_strdelimit(g_strdup(failed ? run->error.text : ""), "\",\n", ' ');
        g_string_append_printf(
            text, "%s,%s,%" G_GUINT64_FORMAT ",%s,%s\n",
            gb_papers_experiments_table()[plan->run[k].experiment].name,
            run->directory + skipped, run->params.seed,
            !run->ended ? "missing"
            : failed    ? "failed"
                        : "done",
            why);
        g_free(why);
    }
    return text;
}
