#include "study/papers/papers.h"

#include <string.h>

#include <glib.h>

/* Ids and names of experiments begin with the paper: "P1-". */
static bool is_of_paper(const char *name, const char *id)
{
    const size_t length = strcspn(id, "-");
    return strncmp(name, id, length) == 0 && name[length] == '-';
}

bool gb_papers_selected_paper(const char *id, const struct gb_papers_plan *plan)
{
    const struct gb_papers_experiment *table = gb_papers_experiments_table();
    for (size_t e = 0; table[e].name != NULL; e++) {
        if (plan->selected[e] && is_of_paper(table[e].name, id)) {
            return true;
        }
    }
    return false;
}

bool gb_papers_selected(const struct gb_papers_comparison *comparison,
                        const struct gb_papers_plan *plan)
{
    const char *experiment = comparison->experiment[0];
    return experiment != NULL ? plan->selected[gb_papers_experiments_index(experiment)]
                              : gb_papers_selected_paper(comparison->id, plan);
}

/* Particles of a cell over those of the full experiment, which are the paper's. */
static double size_of(const struct gb_papers_comparison *comparison,
                      const struct gb_papers_data *data)
{
    struct gb_params full;
    if (comparison->experiment[0] == NULL) {
        return 1.0;
    }
    const size_t index = gb_papers_experiments_index(comparison->experiment[0]);
    const struct gb_runset *set = &data->experiment[index].set;
    return set->count > 0 &&
                   gb_papers_experiments_params(&gb_papers_experiments_table()[index],
                                                GB_PAPERS_SIZES, 0, &full, NULL)
               ? (double)set->run[0].params.count / (double)full.count
               : 1.0;
}

static bool evaluate(struct gb_papers_result *result,
                     const struct gb_papers_comparison *comparison,
                     const struct gb_papers_numbers *numbers,
                     const struct gb_papers_data *data, struct gb_error *err)
{
    *result = (struct gb_papers_result){
        .printed = gb_papers_printed_find(numbers, comparison->id),
        .comparison = comparison};
    if (result->printed == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: %s is missing", numbers->path,
                            comparison->id);
    }
    result->here.exact = comparison->experiment[0] == NULL;
    result->here.cells = gb_papers_comparisons_value(
        comparison, data, &result->here.value, &result->here.error);
    result->here.size = size_of(comparison, data);
    result->verdict = gb_papers_verdict_of(result->printed, &result->here);
    return true;
}

bool gb_papers_evaluate(struct gb_papers_results *results,
                        const struct gb_papers_numbers *numbers,
                        const struct gb_papers_plan *plan, struct gb_error *err)
{
    const struct gb_papers_comparison *table = gb_papers_comparisons_table();
    struct gb_papers_data data;
    size_t rows = 0;
    while (table[rows].id != NULL) {
        rows++;
    }
    *results =
        (struct gb_papers_results){.result = g_new0(struct gb_papers_result, rows + 1)};
    bool good = gb_papers_sample_read(&data, plan, err);
    for (size_t k = 0; k < rows && good; k++) {
        if (gb_papers_selected(&table[k], plan)) {
            good = evaluate(&results->result[results->count], &table[k], numbers, &data,
                            err);
            results->count += good;
        }
    }
    gb_papers_sample_finish(&data);
    return good;
}

void gb_papers_finish(struct gb_papers_results *results)
{
    g_free(results->result);
    *results = (struct gb_papers_results){0};
}
