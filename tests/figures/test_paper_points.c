/* Printed numbers over figures, and the figures of greenbody papers. */
#include <math.h>
#include <string.h>

#include <glib.h>

#include "common/tree.h"
#include "figures/papers_figures.h"

/* Every number that is drawn has a figure of runs with both axes, and a label. */
static void test_numbers(void)
{
    struct gb_papers_numbers numbers;
    struct gb_error err = {0};
    size_t drawn = 0;
    g_assert_true(gb_papers_printed_read(&numbers, NULL, &err));
    for (size_t k = 0; k < numbers.count; k++) {
        const struct gb_papers_printed *printed = &numbers.row[k];
        if (*printed->figure != '\0') {
            const struct gb_figures_row *row = gb_figures_find(printed->figure);
            g_test_message("%s", printed->id);
            g_assert_nonnull(row);
            g_assert_cmpint(row->takes, ==, GB_FIGURES_RUNS);
            g_assert_true(row->x.name != NULL && row->y.name != NULL);
            g_assert_cmpstr(printed->series, !=, "");
            drawn++;
        }
    }
    g_assert_cmpuint(drawn, >, 15);
    gb_papers_printed_finish(&numbers);
}

/* Numbers that a figure of one run of an experiment gets. */
static size_t add(struct gb_series *series, const char *figure, const char *experiment,
                  size_t point, const char *change)
{
    struct gb_runset_run run = {.group = 0};
    const struct gb_runset set = {.run = &run, .count = 1, .groups = 1};
    const struct gb_figures_row *row = gb_figures_find(figure);
    struct gb_error err = {0};
    size_t drawn = 0;
    g_assert_true(gb_papers_plan_params(
        &gb_papers_plan_table()[gb_papers_plan_index(experiment)],
        GB_PAPERS_FAST, point, &run.params, &err));
    g_assert_true(change == NULL || gb_params_assign(&run.params, change, &err));
    gb_series_init(series, 1);
    gb_figures_axes(row, series);
    g_assert_true(gb_papers_figures_add(series, row, &set, &drawn, &err));
    return drawn;
}

static const double *column(const struct gb_series *series, const char *name)
{
    for (guint k = 0; k < series->names->len; k++) {
        if (strcmp(g_ptr_array_index(series->names, k), name) == 0) {
            return g_ptr_array_index(series->columns, k);
        }
    }
    g_error("no column %s", name);
}

/* 0.496 of 38 nm, for the small cells of --fast, too; not for another friction. */
static void test_scene(void)
{
    struct gb_series series = {0};
    g_assert_cmpuint(add(&series, "densification", "P1-fig5", 3, NULL), ==, 1);
    g_assert_cmpfloat(column(&series, "data_1_density")[0], ==, 0.496);
    g_assert_cmpfloat(column(&series, "data_1_p_MPa")[0], ==, 100.0);
    g_assert_cmpfloat_with_epsilon(column(&series, "data_1_density_error")[0],
                                   0.001 / sqrt(12.0), 1e-15);
    g_assert_true(isnan(column(&series, "data_1_p_MPa_error")[0]));
    gb_series_finish(&series);
    g_assert_cmpuint(add(&series, "densification", "P1-fig5", 3, "contact.mu=0.3"), ==,
                     0);
    gb_series_finish(&series);
    g_assert_cmpuint(add(&series, "densification", "P1-fig5", 1, NULL), ==, 0);
    gb_series_finish(&series);
    g_assert_cmpuint(add(&series, "lateral", "P1-fig5", 3, NULL), ==, 0);
    gb_series_finish(&series);
}

/* Laws are drawn; without runs every other figure says so.  Its command names a figure that
 * there is. */
static void test_figures(void)
{
    const struct gb_papers_options options = {.size = GB_PAPERS_FULL};
    struct gb_papers_plan plan;
    struct gb_papers_figure *figures = NULL;
    struct gb_error err = {0};
    size_t count = 0;
    char *directory = g_dir_make_tmp("papers-XXXXXX", NULL);
    g_assert_true(gb_papers_plan_init(&plan, &options, directory, &err));
    g_assert_true(gb_papers_figures_draw(&plan, &figures, &count, &err));
    g_assert_cmpuint(count, >, 10);
    for (size_t k = 0; k < count; k++) {
        char **words = g_strsplit(figures[k].command, " ", -1);
        g_assert_cmpstr(words[2], ==, "--figure"); /* no directory: there is no run */
        const struct gb_figures_row *row = gb_figures_find(words[3]);
        g_assert_nonnull(row);
        const bool law = row->takes == GB_FIGURES_SCENE;
        g_assert_true((figures[k].file != NULL) == law);
        g_assert_cmpstr(figures[k].why, ==, law ? "" : "no run is done");
        g_strfreev(words);
    }
    gb_papers_figures_finish(figures, count);
    gb_papers_plan_finish(&plan);
    remove_tree(directory);
    g_free(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/paper-points/numbers", test_numbers);
    g_test_add_func("/paper-points/scene", test_scene);
    g_test_add_func("/paper-points/figures", test_figures);
    return g_test_run();
}
