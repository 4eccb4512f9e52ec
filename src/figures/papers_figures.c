/* Numbers that the papers print, as marks in figures, and the figures of `greenbody papers`. */
#include "figures/papers_figures.h"

#include <string.h>

#include "base/table.h"
#include "figures/figures.h"
#include "figures/plotting.h"
#include "io/preset.h"
#include "many/runset.h"
#include "study/papers.h"
#include "study/papers_comparisons.h"

/* Keys that change how well a scene is computed and how much of it. */
static const char *const ignored[] = {"particles.count",     "structure.base",
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
            &gb_papers_plan_table()[gb_papers_plan_index(comparison->experiment[0])],
            GB_PAPERS_SIZES, comparison->point, &params, NULL)) {
        return -1;
    }
    for (size_t i = 0; i < set->count && found < 0; i++) {
        if (gb_runset_differing_key(&params, &set->run[i].params, ignored) == NULL) {
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

static bool paper_points_draw(struct gb_series *series,
                              const struct gb_figures_row *figure,
                              const struct points *points, const char *path,
                              struct gb_error *err)
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

bool gb_papers_figures_add(struct gb_series *series, const struct gb_figures_row *figure,
                           const struct gb_runset *set, size_t *drawn,
                           struct gb_error *err)
{
    struct gb_papers_numbers numbers;
    struct points points = {0};
    bool good = gb_papers_printed_read(&numbers, NULL, err);
    if (good && figure->x.name != NULL && figure->y.name != NULL) {
        collect(&points, &numbers, figure->name, set);
        good = points.count == 0 ||
               paper_points_draw(series, figure, &points,
                                 "the printed numbers, papers.csv", err);
    }
    if (drawn != NULL) {
        *drawn = points.count;
    }
    finish(&points);
    gb_papers_printed_finish(&numbers);
    return good;
}

enum { WIDTH = 1600, HEIGHT = 1200, EXPERIMENTS = 6 }; /* pixels */

#define RATES "P2-v1", "P2-v2", "P2-v3", "P2-v4", "P2-v5"

static const struct figure {
    const char *file, *title;
    const char
        *experiment[EXPERIMENTS]; /* those without runs are left out; none: a law */
    const char *figure;           /* a row of figures.c */
    const char *reference;        /* experiment that is subtracted; NULL: none */
    const char *at;               /* kept state; NULL: the last */
    bool one;                     /* shows the first run alone */
} table[] = {
    {"P1-fig1.png", "P1 Fig. 1", {NULL}, "contact", NULL, NULL, false},
    {"P1-fig2.png", "P1 Fig. 2", {NULL}, "bridge-strength", NULL, NULL, false},
    {"P1-fig5.png", "P1 Fig. 5", {"P1-fig5"}, "densification", NULL, NULL, false},
    {"P1-fig6.png",
     "P1 Fig. 6",
     {"P1-fig5", "P1-fig6"},
     "size-effect",
     NULL,
     NULL,
     false},
    {"P1-fig7.png", "P1 Fig. 7", {"P1-fig5"}, "rdf", NULL, "p=1 GPa", false},
    {"P1-fig8.png", "P1 Fig. 8", {"P1-fig5"}, "coordination", NULL, NULL, false},
    {"P1-contacts.png",
     "P1 section V, shares of contact numbers",
     {"P1-fig5"},
     "contacts",
     NULL,
     "p=1 GPa",
     false},
    {"P1-fig11.png", "P1 Figs. 11 and 12", {"P1-fig12"}, "unloading", NULL, NULL, false},
    {"P1-fig12.png", "P1 Fig. 12, theory", {"P1-fig12"}, "continuum", NULL, NULL, false},
    {"P1-fig13.png", "P1 Fig. 13", {"P1-fig12"}, "lateral", NULL, NULL, false},
    {"P1-fig14.png", "P1 Fig. 14", {"P1-fig12"}, "force-angle", NULL, NULL, false},
    {"P2-fig1.png", "P2 Fig. 1", {"P2-v3"}, "time", NULL, NULL, false},
    {"P2-fig2.png", "P2 Fig. 2", {RATES}, "densification", NULL, NULL, false},
    {"P2-fig3.png", "P2 Fig. 3", {RATES}, "difference", "P2-v3", NULL, false},
    {"P2-fig4.png", "P2 Fig. 4", {RATES}, "rate-difference", NULL, NULL, false},
    {"P2-table1.png", "P2 Table 1, times", {RATES}, "relaxation", NULL, NULL, false},
    {"P2-table1-p.png",
     "P2 Table 1, amplitudes",
     {RATES},
     "relaxation-amplitude",
     NULL,
     NULL,
     false},
    {"P2-eq4.png", "P2 (4)", {RATES}, "decay", NULL, NULL, false},
    {"P2-eq8.png", "P2 (8)", {RATES}, "coordination", NULL, NULL, false},
    {"P3-fig4.png",
     "P3 Fig. 4 and Table 1",
     {"P3-hertz"},
     "poured-density",
     NULL,
     NULL,
     false},
    {"P3-fig9.png", "P3 Fig. 9", {NULL}, "hollomon", NULL, NULL, false},
    {"P3-fig10.png", "P3 Fig. 10", {NULL}, "pair", NULL, NULL, false},
    {"P3-fig11.png", "P3 Fig. 11", {NULL}, "line", NULL, NULL, false},
    {"P3-fig12.png", "P3 Fig. 12", {NULL}, "critical-step", NULL, NULL, false},
    {"P3-fig15.png", "P3 Fig. 15", {"P3-hertz"}, "die-section", NULL, NULL, true},
    {"P3-fig17.png",
     "P3 Fig. 17",
     {"P3-hertz", "P3-storakers"},
     "die-height",
     NULL,
     NULL,
     false},
    {"P3-fig18.png",
     "P3 Fig. 18",
     {"P3-hertz", "P3-storakers"},
     "die-density",
     NULL,
     NULL,
     false},
    {"P3-fig19.png",
     "P3 Fig. 19",
     {"P3-hertz", "P3-friction"},
     "die-density",
     NULL,
     NULL,
     false},
    {"P3-fig20.png",
     "P3 Fig. 20",
     {"P3-storakers", "P3-storakers-friction"},
     "die-density",
     NULL,
     NULL,
     false},
};

/* Of an experiment without an axis. */
static const char first_run[] = "/scene_seed-1";

/* Directories of the runs of an experiment that are done. */
static guint list_runs(const struct gb_papers_plan *plan, const char *name,
                       GPtrArray *list)
{
    const size_t experiment = gb_papers_plan_index(name);
    const guint before = list->len;
    for (size_t k = 0; k < plan->count; k++) {
        const struct gb_ensemble_run *run = &plan->ensemble.run[k];
        if (plan->run[k].experiment == experiment && run->ended &&
            run->error.code == GB_OK) {
            g_ptr_array_add(list, run->directory);
        }
    }
    return list->len - before;
}

/* The runs of a figure; *reference: the first one that is subtracted. */
static GPtrArray *runs_of(const struct figure *row, const struct gb_papers_plan *plan,
                          size_t *reference, GString *names)
{
    GPtrArray *list = g_ptr_array_new();
    *reference = 0;
    for (int e = 0; e < EXPERIMENTS && row->experiment[e] != NULL; e++) {
        const guint first = list->len;
        if (list_runs(plan, row->experiment[e], list) > 0) {
            g_string_append_printf(names, " %s%s", row->experiment[e],
                                   row->one ? first_run : "");
        }
        if (row->reference != NULL && strcmp(row->reference, row->experiment[e]) == 0) {
            *reference = first;
        }
    }
    return list;
}

static bool is_selected(const struct figure *row, const struct gb_papers_plan *plan)
{
    return row->experiment[0] != NULL
               ? plan->selected[gb_papers_plan_index(row->experiment[0])]
               : gb_papers_selected_paper(row->file, plan);
}

/* The files; *printed: printed numbers on them; *cause: why there is no data. */
static bool write_files(const struct figure *row, const struct gb_papers_plan *plan,
                        const struct gb_figures_input *input, size_t *printed,
                        struct gb_error *cause, struct gb_error *err)
{
    const struct gb_figures_row *figure = gb_figures_find(row->figure);
    const struct gb_plotting_page page = {
        WIDTH, HEIGHT, figure->name, NULL, input->set, GB_PLOTTING_REPLACE, 0};
    struct gb_series series = {0};
    bool good = gb_figures_run(figure, &series, input, cause);
    if (good) {
        char *path = g_build_filename(plan->directory, row->file, NULL);
        good = (input->set == NULL ||
                gb_papers_figures_add(&series, figure, input->set, printed, err)) &&
               gb_plotting_write(&series, &page, path, err);
        g_free(path);
    }
    gb_series_finish(&series);
    return good;
}

static bool draw_runs(const struct figure *row, const struct gb_papers_plan *plan,
                      GString *names, size_t *printed, struct gb_error *cause,
                      struct gb_error *err)
{
    struct gb_runset set = {0};
    size_t reference = 0;
    GPtrArray *list = runs_of(row, plan, &reference, names);
    if (row->one && list->len > 1) {
        g_ptr_array_set_size(list, 1);
    }
    bool good =
        list->len > reference || gb_error_set(cause, GB_ERR_INPUT, "no run is done");
    good = good && gb_runset_read(&set, (char *const *)list->pdata, list->len, cause);
    if (good) {
        gb_figures_group(gb_figures_find(row->figure), &set);
        const struct gb_figures_input input = {
            .set = &set, .reference = set.run[reference].group, .at = row->at};
        good = write_files(row, plan, &input, printed, cause, err);
    }
    gb_runset_finish(&set);
    g_ptr_array_unref(list);
    return good;
}

static bool draw_law(const struct figure *row, const struct gb_papers_plan *plan,
                     struct gb_error *cause, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    bool good = gb_preset_load(&preset, gb_figures_find(row->figure)->preset, cause);
    if (good) {
        const struct gb_figures_input input = {.scene = gb_preset_params(preset)};
        good = write_files(row, plan, &input, NULL, cause, err);
    }
    gb_preset_destroy(preset);
    return good;
}

/* As typed in the directory of the page. */
static char *command_of(const struct figure *row, const char *names, size_t printed)
{
    GString *text = g_string_new("greenbody plot");
    g_string_append_printf(text, "%s --figure %s%s", names, row->figure,
                           printed > 0 ? " --paper" : "");
    if (row->reference != NULL) {
        g_string_append_printf(text, " --reference %s%s", row->reference, first_run);
    }
    if (row->at != NULL) {
        g_string_append_printf(text, " --at '%s'", row->at);
    }
    g_string_append_printf(text, " -o %s", row->file);
    return g_string_free(text, FALSE);
}

static bool draw(const struct figure *row, const struct gb_papers_plan *plan,
                 struct gb_papers_figure *out, struct gb_error *err)
{
    struct gb_error cause = {0};
    GString *names = g_string_new(NULL);
    size_t printed = 0;
    const bool drawn = row->experiment[0] == NULL
                           ? draw_law(row, plan, &cause, err)
                           : draw_runs(row, plan, names, &printed, &cause, err);
    out->title = row->title;
    out->file = drawn ? row->file : NULL;
    out->why = g_strdup(cause.text);
    out->command = command_of(row, names->str, printed);
    g_string_free(names, TRUE);
    return drawn || err->code == GB_OK;
}

bool gb_papers_figures_draw(const struct gb_papers_plan *plan,
                            struct gb_papers_figure **figures, size_t *count,
                            struct gb_error *err)
{
    struct gb_error failure = {0};
    bool good = true;
    *figures = g_new0(struct gb_papers_figure, G_N_ELEMENTS(table) + 1);
    *count = 0;
    for (size_t k = 0; k < G_N_ELEMENTS(table) && good; k++) {
        if (is_selected(&table[k], plan)) {
            good = draw(&table[k], plan, &(*figures)[(*count)++], &failure);
        }
    }
    return good || gb_error_set(err, failure.code, "%s", failure.text);
}

void gb_papers_figures_finish(struct gb_papers_figure *figures, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        g_free(figures[k].command);
        g_free(figures[k].why);
    }
    g_free(figures);
}
