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
    const struct gb_strength_options *options;
    const struct gb_pool_callbacks *callbacks;
    struct gb_compact top, free;
    struct gb_strength_broken *broken; /* of each test */
    GString *rows;                     /* NULL: not wanted */
};

struct gb_strength_broken gb_strength_cell_unbroken(void)
{
    return (struct gb_strength_broken){NAN, -INFINITY, NAN, NAN, NAN};
}

void gb_strength_cell_break(struct gb_strength_broken *test, double strain,
                            double stress_pa, double density, double broken)
{
    if (stress_pa > test->strength) {
        *test = (struct gb_strength_broken){density, stress_pa, strain, broken, broken};
    }
    test->at_end = broken;
}

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
    gb_strength_cell_break(&cell->broken[breaking->test], number[1], number[2], number[3],
                           number[4]);
    if (cell->rows != NULL) {
        gb_study_text_numbers(cell->rows, number, G_N_ELEMENTS(number));
    }
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
             stress < breaking->cell->options->fall * breaking->peak &&
             strain_of(breaking->test, breaking->cell, point) >
                 10.0 * breaking->cell->options->step);
}

static bool break_one(struct cell *cell, enum gb_strength_test test, struct gb_error *err)
{
    char leg[GB_LEG_TEXT];
    struct gb_error why = {0};
    struct breaking breaking = {cell, test, 0.0};
    const struct gb_compact_walk walk = {take, &breaking, cell->callbacks};
    add_row(&breaking, &cell->free.point);
    snprintf(leg, sizeof leg, gb_strength_options_tests[test].leg,
             100.0 * cell->options->strain_most);
    return gb_compact_follow(&cell->free, leg, cell->options->step, &walk, NULL, &why) !=
               GB_COMPACT_FAILED ||
           gb_error_set(err, why.code, "%s", why.text);
}

bool gb_strength_cell_measure(struct gb_strength_broken test[GB_STRENGTH_TESTS],
                              const struct gb_params *params,
                              const struct gb_keep_point *mark,
                              const struct gb_strength_options *options, GString *rows,
                              const struct gb_pool_callbacks *callbacks,
                              struct gb_error *err)
{
    struct cell cell = {
        .options = options, .callbacks = callbacks, .broken = test, .rows = rows};
    cell.top.sheared = true;
    bool good = gb_compact_press(&cell.top, params, mark, callbacks, err);
    cell.top.tolerance = options->tolerance;
    good = good && gb_compact_unload(&cell.top, 0.0, callbacks, &cell.free, err);
    if (rows != NULL) {
        g_string_append(rows, "test,strain,stress_Pa,density,broken\n");
    }
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        test[t] = gb_strength_cell_unbroken();
        good = break_one(&cell, (enum gb_strength_test)t, err);
    }
    gb_compact_finish(&cell.free);
    gb_compact_finish(&cell.top);
    return good;
}

bool gb_strength_cell_work(const struct gb_params *params, const char *path,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    GKeyFile *question = NULL;
    struct gb_strength_options options;
    struct gb_keep_point mark;
    struct gb_strength_broken test[GB_STRENGTH_TESTS];
    struct gb_lock lock;
    if (!gb_cells_question(&question, &lock, path, err)) {
        return false;
    }
    gb_strength_options_read(&options, &mark, question);
    g_key_file_free(question);
    GString *rows = g_string_new(NULL);
    const bool good =
        gb_strength_cell_measure(test, params, &mark, &options, rows, callbacks, err) &&
        gb_cells_answer(path, ".csv", rows, err);
    g_string_free(rows, TRUE);
    gb_lock_release(&lock);
    return good;
}
