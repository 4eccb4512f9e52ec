#include "study/strength/strength_cell.h"

#include <math.h>
#include <stdio.h>

#include "scene/path/path.h"
#include "study/compact/cells.h"
#include "study/compact/compact.h"
#include "study/compact/study_text.h"
#include "study/strength/strength_options.h"

/* A cell at work. */
struct cell {
    struct gb_strength_options options;
    struct gb_keep_point mark;
    const struct gb_pool_callbacks *callbacks;
    struct gb_compact top, free;
    GString *rows;
};

/* A test under way. */
struct breaking {
    struct cell *cell;
    enum gb_strength_test test;
    double peak;
};

/* Bridged pairs of a point, per particle and half. */
static double bridges(const struct gb_point *point)
{
    return point->bridged * point->coordination;
}

static double stress_of(enum gb_strength_test test, const struct gb_point *point)
{
    const double pressure = test == GB_STRENGTH_SHEAR ? point->shear_pa[1] : point->pz_pa;
    return gb_strength_options_tests[test].sense * pressure;
}

static double strain_of(enum gb_strength_test test, const struct cell *cell,
                        const struct gb_point *point)
{
    const int k = gb_strength_options_tests[test].component;
    const double strain = point->strain[k] - cell->free.point.strain[k];
    return test == GB_STRENGTH_TENSION ? -strain : strain;
}

static void add_row(struct breaking *breaking, const struct gb_point *point)
{
    const struct cell *cell = breaking->cell;
    const double all = bridges(&cell->free.point);
    const double number[] = {breaking->test, strain_of(breaking->test, cell, point),
                             stress_of(breaking->test, point), cell->free.point.density,
                             all > 0.0 ? 1.0 - bridges(point) / all : (double)NAN};
    gb_study_text_numbers(cell->rows, number, G_N_ELEMENTS(number));
}

/* Beyond the peak when the stress has fallen enough. */
static bool take(void *data, const struct gb_point *point)
{
    struct breaking *breaking = data;
    const double stress = stress_of(breaking->test, point);
    if (point->leg >= 2.0) { /* behind the test */
        return false;
    }
    add_row(breaking, point);
    breaking->peak = fmax(breaking->peak, stress);
    return !(breaking->peak > 0.0 &&
             stress < breaking->cell->options.fall * breaking->peak &&
             strain_of(breaking->test, breaking->cell, point) >
                 10.0 * breaking->cell->options.step);
}

static bool break_one(struct cell *cell, enum gb_strength_test test, struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    struct gb_error why = {0};
    struct breaking breaking = {cell, test, 0.0};
    const struct gb_compact_walk walk = {take, &breaking, cell->callbacks};
    add_row(&breaking, &cell->free.point);
    snprintf(leg, sizeof leg, gb_strength_options_tests[test].leg,
             100.0 * cell->options.strain_most);
    return gb_compact_follow(&cell->free, leg, cell->options.step, &walk, NULL, &why) !=
               GB_COMPACT_FAILED ||
           gb_error_set(err, why.code, "%s", why.text);
}

static bool measure(struct cell *cell, const struct gb_params *params, const char *path,
                    struct gb_error *err)
{
    cell->top.sheared = true;
    if (!gb_compact_press(&cell->top, params, &cell->mark, cell->callbacks, err)) {
        return false;
    }
    cell->top.tolerance = cell->options.tolerance;
    if (!gb_compact_unload(&cell->top, 0.0, cell->callbacks, &cell->free, err)) {
        return false;
    }
    g_string_append(cell->rows, "test,strain,stress_Pa,density,broken\n");
    for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
        if (!break_one(cell, (enum gb_strength_test)t, err)) {
            return false;
        }
    }
    return gb_cells_answer(path, ".csv", cell->rows, err);
}

bool gb_strength_cell_work(const struct gb_params *params, const char *path,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    GKeyFile *question = NULL;
    if (!gb_cells_question(&question, path, err)) {
        return false;
    }
    struct cell cell = {.callbacks = callbacks, .rows = g_string_new(NULL)};
    gb_strength_options_read(&cell.options, &cell.mark, question);
    g_key_file_free(question);
    const bool good = measure(&cell, params, path, err);
    gb_compact_finish(&cell.free);
    gb_compact_finish(&cell.top);
    g_string_free(cell.rows, TRUE);
    return good;
}
