#include "study/yield/yield_study.h"

#include <math.h>
#include <string.h>

#include "base/table.h"
#include "scene/seed.h"
#include "study/compact/compact.h"
#include "study/yield/yield_cell.h"

/* The answers of one compact: points by offset, cell and direction. */
struct answers {
    struct gb_yield_point *point;
    double *top_p, *top_q;
    int cells, directions;
};

static void answers_init(struct answers *answers, const struct gb_yield_options *options)
{
    const int cells = options->replicas, directions = options->directions;
    const int count = GB_YIELD_OFFSETS * cells * directions;
    answers->cells = cells;
    answers->directions = directions;
    answers->point = g_new0(struct gb_yield_point, (gsize)count);
    answers->top_p = g_new(double, (gsize)cells);
    answers->top_q = g_new(double, (gsize)cells);
    for (int i = 0; i < count; i++) {
        answers->point[i].p_pa = answers->point[i].density = (double)NAN;
    }
    for (int c = 0; c < cells; c++) {
        answers->top_p[c] = answers->top_q[c] = (double)NAN;
    }
}

static void answers_finish(struct answers *answers)
{
    g_free(answers->point);
    g_free(answers->top_p);
    g_free(answers->top_q);
}

static struct gb_yield_point *answers_at(const struct answers *answers, int offset,
                                         int cell, int direction)
{
    return &answers->point[(offset * answers->cells + cell) * answers->directions +
                           direction];
}

enum { COLUMNS = 9 };

static bool find_columns(const struct gb_table *table, const double *column[COLUMNS],
                         struct gb_error *err)
{
    static const char *const names[COLUMNS] = {"direction", "offset",      "density",
                                               "top_p_Pa",  "top_q_Pa",    "p_Pa",
                                               "q_Pa",      "flow_volume", "flow_shear"};
    for (int k = 0; k < COLUMNS; k++) {
        column[k] = gb_table_column(table, names[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    return true;
}

static bool read_rows(struct answers *answers, int cell, const struct gb_table *table,
                      const struct gb_yield_options *options, struct gb_error *err)
{
    const double *column[COLUMNS];
    if (!find_columns(table, column, err)) {
        return false;
    }
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const int direction = (int)column[0][i], offset = (int)column[1][i];
        if (direction < 0 || direction >= answers->directions || offset < 0 ||
            offset >= GB_YIELD_OFFSETS) {
            return gb_error_set(err, GB_ERR_INPUT, "%s:%d: no such direction or offset",
                                gb_table_path(table), gb_table_line(table, i));
        }
        answers->top_p[cell] = column[3][i];
        answers->top_q[cell] = column[4][i];
        *answers_at(answers, offset, cell, direction) = (struct gb_yield_point){
            column[2][i], column[5][i], column[6][i],
            column[7][i], column[8][i], (double)NAN,
            (double)NAN,  cell + 1,     gb_yield_options_direction(options, direction)};
    }
    return true;
}

static bool read_cell(struct answers *answers, int cell, const struct gb_cells *cells,
                      const struct gb_cells_item *item,
                      const struct gb_yield_options *options, struct gb_error *err)
{
    char *file = g_strconcat(item->name, ".csv", NULL);
    char *path = g_build_filename(cells->directory, file, NULL);
    struct gb_table *table = NULL;
    const bool good = gb_table_read(&table, path, NULL, err) &&
                      read_rows(answers, cell, table, options, err);
    gb_table_destroy(table);
    g_free(path);
    g_free(file);
    return good;
}

static void keep_points(struct gb_yield_study *study, const struct answers *answers)
{
    for (int c = 0; c < answers->cells; c++) {
        for (int d = 0; d < answers->directions; d++) {
            const struct gb_yield_point *point =
                answers_at(answers, GB_YIELD_OFFSET_CHOSEN, c, d);
            if (isfinite(point->p_pa)) {
                g_array_append_vals(study->point, point, 1);
            }
        }
    }
}

static bool measure_surfaces(struct gb_yield_study *study, const struct answers *answers,
                             const struct gb_keep_point *mark, struct gb_error *err)
{
    for (int o = 0; o < GB_YIELD_OFFSETS; o++) {
        struct gb_yield_surface *surface = g_new0(struct gb_yield_surface, 1);
        const struct gb_yield_surface_data data = {answers_at(answers, o, 0, 0),
                                                   answers->top_p, answers->top_q,
                                                   answers->cells, answers->directions};
        surface->mark = *mark;
        surface->offset = study->options.offset * gb_yield_options_offset[o];
        g_ptr_array_add(study->surface, surface);
        if (!gb_yield_surface_measure(surface, &data, err)) {
            return false;
        }
    }
    keep_points(study, answers);
    return true;
}

/* The cells of one mark follow each other in the list. */
static bool conclude_mark(struct gb_yield_study *study, const struct gb_cells *cells,
                          int mark, struct gb_error *err)
{
    struct answers answers;
    size_t there = 0;
    bool good = true;
    answers_init(&answers, &study->options);
    for (int c = 0; c < answers.cells && good; c++) {
        const struct gb_cells_item *item = g_ptr_array_index(
            cells->list, (guint)(c * study->options.marks.count + mark));
        if (item->done) {
            there++;
            good = read_cell(&answers, c, cells, item, &study->options, err);
        }
    }
    good = good && (there > 0 || gb_cells_check(cells, err)) &&
           measure_surfaces(study, &answers, &study->options.marks.point[mark], err);
    answers_finish(&answers);
    return good;
}

static void count_failed(struct gb_yield_study *study, const struct gb_cells *cells)
{
    for (guint i = 0; i < cells->list->len; i++) {
        const struct gb_cells_item *item = g_ptr_array_index(cells->list, i);
        study->failed += !item->done;
    }
    gb_cells_check(cells, &study->why);
}

static bool conclude(struct gb_yield_study *study, const struct gb_cells *cells,
                     struct gb_error *err)
{
    for (int m = 0; m < study->options.marks.count; m++) {
        if (!conclude_mark(study, cells, m, err)) {
            return false;
        }
    }
    count_failed(study, cells);
    return true;
}

/* Cell by cell, so that all marks have as many when the command is stopped. */
static void add_cells(struct gb_cells *cells, const struct gb_params *params,
                      const struct gb_yield_options *options)
{
    struct gb_params own = *params;
    own.threads = 1;
    for (int c = 0; c < options->replicas; c++) {
        own.seed = params->seed + (uint64_t)c;
        for (int m = 0; m < options->marks.count; m++) {
            GString *text = g_string_new("study=yield\n");
            gb_yield_options_write(options, &options->marks.point[m], text);
            gb_cells_add(cells, &own, gb_cells_name(&options->marks.point[m], c),
                         text->str);
            g_string_free(text, TRUE);
        }
    }
}

bool gb_yield_study_run(struct gb_yield_study *study, const struct gb_params *preset,
                        const struct gb_yield_options *options, const char *directory,
                        int jobs, const struct gb_cells_callbacks *callbacks,
                        struct gb_error *err)
{
    struct gb_cells cells = {0};
    struct gb_params params;
    *study = (struct gb_yield_study){
        .options = *options,
        .surface = g_ptr_array_new_with_free_func(g_free),
        .point = g_array_new(FALSE, FALSE, sizeof(struct gb_yield_point)),
    };
    if (!gb_yield_options_check(options, err) ||
        !gb_seed_check_cells(preset, (size_t)options->replicas, err) ||
        !gb_compact_params(&params, preset, err) ||
        !gb_cells_init(&cells, directory, err)) {
        gb_cells_finish(&cells);
        return false;
    }
    add_cells(&cells, &params, options);
    const bool good = gb_cells_work(&cells, jobs, gb_yield_cell_work, callbacks, err) &&
                      conclude(study, &cells, err);
    gb_cells_finish(&cells);
    return good;
}

void gb_yield_study_finish(struct gb_yield_study *study)
{
    if (study->surface != NULL) {
        g_ptr_array_unref(study->surface);
        g_array_unref(study->point);
    }
    memset(study, 0, sizeof *study);
}

const struct gb_yield_surface *gb_yield_study_surface(const struct gb_yield_study *study,
                                                      int mark, int offset)
{
    return g_ptr_array_index(study->surface, (guint)(mark * GB_YIELD_OFFSETS + offset));
}
