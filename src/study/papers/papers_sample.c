#include "study/papers/papers_sample.h"

#include <glib.h>

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

bool gb_papers_sample_read(struct gb_papers_data *data, const struct gb_papers_plan *plan,
                           struct gb_error *err)
{
    bool good = true;
    *data = (struct gb_papers_data){0};
    for (size_t e = 0; good && e < gb_papers_experiments_count(); e++) {
        good = !plan->selected[e] || read_experiment(&data->experiment[e], e, plan, err);
    }
    return good;
}

void gb_papers_sample_finish(struct gb_papers_data *data)
{
    for (size_t e = 0; e < GB_PAPERS_EXPERIMENTS_MOST; e++) {
        gb_runset_finish(&data->experiment[e].set);
        g_free(data->experiment[e].point);
        g_free(data->experiment[e].cell);
    }
    *data = (struct gb_papers_data){0};
}

bool gb_papers_sample_lacks(const struct gb_papers_view *view, size_t experiment,
                            size_t i)
{
    return view->experiment == experiment &&
           view->cell == view->data->experiment[experiment].cell[i];
}

size_t gb_papers_sample_point(const struct gb_papers_view *view, size_t experiment,
                              size_t point, struct gb_runset *set)
{
    const struct gb_papers_cells *cells = &view->data->experiment[experiment];
    *set = (struct gb_runset){.run = g_new(struct gb_runset_run, cells->set.count + 1),
                              .groups = 1};
    for (size_t i = 0; i < cells->set.count; i++) {
        if (cells->point[i] == point && !gb_papers_sample_lacks(view, experiment, i)) {
            set->run[set->count] = cells->set.run[i];
            set->run[set->count++].group = 0;
        }
    }
    return set->count;
}
