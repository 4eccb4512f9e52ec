#include "figures/papers/paper_points.h"

#include <string.h>

#include "base/table.h"
#include "figures/plotting.h"
#include "many/key_difference.h"
#include "study/papers/papers_comparisons.h"
#include "study/papers/papers.h"

/* Keys that change how well a scene is computed and how much of it. */
static const char *const accepted[] = {"particles.count",     "structure.base",
                                       "loading.until",       "loading.unload_from",
                                       "loading.step",        "loading.record",
                                       "loading.hold",        "loading.relax",
                                       "loading.record_time", "loading.record_pressure",
                                       "numerics.",           NULL};

/* The figures whose lines are groups of runs with a number of their own each: the mark has
 * the colour of the line. */
static const char *const coloured[] = {"densification", "unloading"};

/* The group of runs with the scene of a comparison; -1: the set holds none. */
static int find_scene(const struct gb_papers_comparison *comparison,
                      const struct gb_runset *set)
{
    struct gb_params params;
    int found = -1;
    if (comparison->experiment[0] == NULL ||
        !gb_papers_plan_params(
            &gb_papers_plan_table()[gb_papers_plan_index(
                comparison->experiment[0])],
            GB_PAPERS_SIZES, comparison->point, &params, NULL)) {
        return -1;
    }
    for (size_t i = 0; i < set->count && found < 0; i++) {
        if (gb_key_difference_find(&params, &set->run[i].params, accepted) == NULL) {
            found = (int)set->run[i].group;
        }
    }
    return found;
}

/* The group that a printed number belongs to in a figure; -1: it is not of it. */
static int find_group(const struct gb_papers_printed *printed, const char *figure,
                      const struct gb_runset *set)
{
    int found = -1;
    if (strcmp(printed->figure, figure) == 0) {
        const struct gb_papers_comparison *row = gb_papers_comparisons_table();
        for (; row->id != NULL && found < 0; row++) {
            found = strcmp(row->id, printed->id) == 0 ? find_scene(row, set) : -1;
        }
    }
    return found;
}

/* A table with the axes of the figure, as measured points have. */
struct points {
    double *column[4]; /* x, y and their errors */
    const char **word;
    int *line;
    int *group;
    size_t count;
};

static void collect(struct points *points, const struct gb_papers_numbers *numbers,
                    const char *figure, const struct gb_runset *set)
{
    for (size_t c = 0; c < G_N_ELEMENTS(points->column); c++) {
        points->column[c] = g_new(double, numbers->count + 1);
    }
    points->word = g_new(const char *, numbers->count + 1);
    points->line = g_new(int, numbers->count + 1);
    points->group = g_new(int, numbers->count + 1);
    for (size_t k = 0; k < numbers->count; k++) {
        const struct gb_papers_printed *printed = &numbers->row[k];
        const int group = find_group(printed, figure, set);
        if (group >= 0) {
            const double row[] = {printed->x, printed->y, printed->x_error,
                                  printed->y_error};
            for (size_t c = 0; c < G_N_ELEMENTS(row); c++) {
                points->column[c][points->count] = row[c];
            }
            points->word[points->count] = printed->series;
            points->group[points->count] = group;
            points->line[points->count++] = printed->line;
        }
    }
}

static void finish(struct points *points)
{
    for (size_t c = 0; c < G_N_ELEMENTS(points->column); c++) {
        g_free(points->column[c]);
    }
    g_free(points->word);
    g_free(points->line);
    g_free(points->group);
}

/* The curves from `first` on, one for each word in the order of the rows. */
static void colour(struct gb_series *series, guint first, const struct points *points)
{
    for (size_t k = 0; k < points->count; k++) {
        bool seen = false;
        for (size_t i = 0; i < k && !seen; i++) {
            seen = strcmp(points->word[i], points->word[k]) == 0;
        }
        if (!seen && first < series->curves->len) {
            struct gb_series_curve *curve =
                &g_array_index(series->curves, struct gb_series_curve, first++);
            curve->style = points->group[k];
            curve->open = true;
        }
    }
}

static bool is_coloured(const char *figure)
{
    bool found = false;
    for (size_t k = 0; k < G_N_ELEMENTS(coloured); k++) {
        found = found || strcmp(coloured[k], figure) == 0;
    }
    return found;
}

static bool draw(struct gb_series *series, const struct gb_figures_row *figure,
                 const struct points *points, const char *path, struct gb_error *err)
{
    struct gb_table *table = NULL;
    char *x_error = g_strdup_printf("%s_error", figure->x.name);
    char *y_error = g_strdup_printf("%s_error", figure->y.name);
    const char *const names[] = {figure->x.name, figure->y.name, x_error, y_error,
                                 "series"};
    const double *const values[] = {points->column[0], points->column[1],
                                    points->column[2], points->column[3], NULL};
    const struct gb_table_content content = {.path = path,
                                             .name = names,
                                             .columns = G_N_ELEMENTS(names),
                                             .rows = points->count,
                                             .value = values,
                                             .word = points->word,
                                             .line = points->line};
    const guint first = series->curves->len;
    const bool good =
        gb_table_build(&table, &content, err) && gb_plotting_data(series, table, err);
    if (good && is_coloured(figure->name)) {
        colour(series, first, points);
    }
    gb_table_destroy(table);
    g_free(x_error);
    g_free(y_error);
    return good;
}

bool gb_paper_points_add(struct gb_series *series, const struct gb_figures_row *figure,
                         const struct gb_runset *set, size_t *drawn, struct gb_error *err)
{
    struct gb_papers_numbers numbers;
    struct points points = {0};
    bool good = gb_papers_printed_read(&numbers, NULL, err);
    if (good && figure->x.name != NULL && figure->y.name != NULL) {
        collect(&points, &numbers, figure->name, set);
        good = points.count == 0 ||
               draw(series, figure, &points, "the printed numbers, papers.csv", err);
    }
    if (drawn != NULL) {
        *drawn = points.count;
    }
    finish(&points);
    gb_papers_printed_finish(&numbers);
    return good;
}
