/* The published numbers of P1 (suite slow): the experiments of `greenbody papers --fast`,
 * compared with accepted ranges. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/tree.h"
#include "many/pool.h"
#include "many/single_run.h"
#include "study/papers.h"

/* A comparison with the printed number +- accept; the name as in the table. */
static const struct target {
    const char *id, *label;
    double value, accept;
} targets[] = {
    {"P1-fig5-9.7nm", NULL, 0.387, 0.025},
    {"P1-fig5-38nm", NULL, 0.496, 0.025},
    {"P1-fig5-difference", NULL, 10.9, 2.0},
    {"P1-1GPa-loaded", NULL, 1.5, 1.0},
    {"P1-1GPa-unloaded", NULL, 0.0, 1.0},
    {"P1-loss", "9.7 nm", 0.65, 0.35},
    {"P1-loss", "16 nm", 0.65, 0.35},
    {"P1-loss", "21 nm", 0.65, 0.35},
    {"P1-loss", "38 nm", 0.65, 0.35},
    {"P1-fig6-nobridge", NULL, 9.4, 1.5},
    {"P1-fig8-9.7nm", NULL, 6.56, 0.2},
    {"P1-fig8-38nm", NULL, 6.41, 0.2},
    {"P1-fig8-unloaded-9.7nm", NULL, 6.26, 0.15},
    {"P1-fig8-unloaded-38nm", NULL, 5.41, 0.15},
    {"P1-fig11-100", NULL, 0.505, 0.03},
    {"P1-fig12-100", NULL, 0.0, 1.5},
    {"P1-fig12-200", NULL, 0.0, 1.0},
    {"P1-fig13-uniaxial", NULL, 0.5, 0.35},
    {"P1-fig13-biaxial", NULL, 0.6, 0.35},
    {"P1-fig14", "uniaxial", 0.5, 0.2},
};

static const struct gb_papers_result *find(const struct gb_papers_results *results,
                                           const struct target *target)
{
    for (size_t k = 0; k < results->count; k++) {
        const struct gb_papers_comparison *row = results->result[k].comparison;
        if (strcmp(row->id, target->id) == 0 &&
            g_strcmp0(row->label, target->label) == 0) {
            return &results->result[k];
        }
    }
    return NULL;
}

static void compute(struct gb_papers_plan *plan)
{
    const struct gb_ensemble_callbacks none = {.cancelled = NULL};
    struct gb_pool *pool = NULL;
    struct gb_error err = {0};
    if (!gb_pool_create(&pool, g_get_num_processors(), gb_single_run, &err) ||
        !gb_ensemble_work(&plan->ensemble, pool, &none, &err) ||
        !gb_ensemble_check(&plan->ensemble, plan->directory, &err)) {
        g_error("%s", err.text);
    }
    gb_pool_destroy(pool);
}

static void test_p1(void)
{
    static char p1[] = "P1";
    char *only[] = {p1, NULL};
    const struct gb_papers_options options = {.size = GB_PAPERS_FAST, .only = only};
    struct gb_papers_numbers numbers;
    struct gb_papers_plan plan;
    struct gb_papers_results results;
    struct gb_error err = {0};
    char *directory = g_dir_make_tmp("papers-XXXXXX", NULL);
    g_assert_true(gb_papers_printed_read(&numbers, GB_TEST_DATA "/papers.csv", &err));
    g_assert_true(gb_papers_plan_init(&plan, &options, directory, &err));
    compute(&plan);
    g_assert_true(gb_papers_evaluate(&results, &numbers, &plan, &err));
    for (size_t k = 0; k < G_N_ELEMENTS(targets); k++) {
        const struct target *target = &targets[k];
        const struct gb_papers_result *result = find(&results, target);
        g_assert_nonnull(result);
        g_test_message("%-24s %-9s %8.4f +- %.4f  target %g +- %g", target->id,
                       target->label != NULL ? target->label : "", result->here.value,
                       result->here.error, target->value, target->accept);
        g_assert_cmpuint(result->here.cells, ==, 16);
        if (!(fabs(result->here.value - target->value) <= target->accept)) {
            g_test_message("%s: outside", target->id);
            g_test_fail();
        }
    }
    gb_papers_finish(&results);
    gb_papers_plan_finish(&plan);
    gb_papers_printed_finish(&numbers);
    remove_tree(directory);
    g_free(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/papers/p1", test_p1);
    return g_test_run();
}
