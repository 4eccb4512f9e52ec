/* Strength of compacts: each cell is pressed, its stresses are taken away, and copies are
 * broken in tension, compression and shear.  Cells are measured by workers, into files of
 * their own (study/cells.h). */
#include "study/strength.h"

#include <glib.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/listing.h"
#include "base/table.h"
#include "many/pool.h"
#include "scene/field/keep_points.h"
#include "scene/path/path.h"
#include "scene/seed.h"
#include "study/cells.h"
#include "study/compact.h"
#include "study/study_text.h"

/* --- options -------------------------------------------------------------------------- */

enum { GB_STRENGTH_REPLICAS_MAX = 1000 };

const struct gb_strength_test_row gb_strength_tests[GB_STRENGTH_TESTS] = {
    [GB_STRENGTH_TENSION] = {"tension", "triaxial to -%g %% at x = y = 0 MPa", -1.0, 2},
    [GB_STRENGTH_COMPRESSION] = {"compression", "triaxial to %g %% at x = y = 0 MPa", 1.0,
                                 2},
    [GB_STRENGTH_SHEAR] = {"shear", "shear xz to %g %% at z = 0 MPa", -1.0, 4},
};

void gb_strength_options_init(struct gb_strength_options *options)
{
    *options = (struct gb_strength_options){
        .marks = {.count = 3, .point = {{false, 50e6}, {false, 100e6}, {false, 200e6}}},
        .replicas = 8,
        .step = 1e-3,
        .strain_most = 0.1,
        .fall = 0.6,
        .tolerance = 3e-3,
    };
}

/* Errors: GB_ERR_INPUT naming the option and what is expected. */
static bool strength_cell_check(const struct gb_strength_options *options,
                                struct gb_error *err)
{
    if (options->replicas < 1 || options->replicas > GB_STRENGTH_REPLICAS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be between 1 and %d",
                            options->replicas, GB_STRENGTH_REPLICAS_MAX);
    }
    return (options->marks.count > 0 && options->marks.every == 0) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--at: expected pressures and densities, as in '50 MPa; 100 MPa'");
}

/* Members that a worker needs. */
static const struct gb_cells_number numbers[] = {
    {"step", offsetof(struct gb_strength_options, step)},
    {"strain_most", offsetof(struct gb_strength_options, strain_most)},
    {"fall", offsetof(struct gb_strength_options, fall)},
    {"tolerance", offsetof(struct gb_strength_options, tolerance)},
};

/* For the question of a cell (study/cells.h) and back. */
static void strength_cell_write(const struct gb_strength_options *options,
                                const struct gb_keep_point *mark, GString *text)
{
    gb_cells_write(text, mark, options, numbers, G_N_ELEMENTS(numbers));
}

static void strength_options_read(struct gb_strength_options *options,
                                  struct gb_keep_point *mark, GKeyFile *question)
{
    gb_strength_options_init(options);
    gb_cells_read(question, mark, options, numbers, G_N_ELEMENTS(numbers));
}

/* --- one cell, in a worker ------------------------------------------------------------ */

/* A cell at work. */
struct cell {
    const struct gb_strength_options *options;
    const struct gb_pool_callbacks *callbacks;
    struct gb_compact top, free;
    struct gb_strength_broken *broken; /* of each test */
    struct gb_listing *rows;           /* NULL: not wanted */
};

/* A test without points, and one point more of it. */
static struct gb_strength_broken strength_cell_unbroken(void)
{
    return (struct gb_strength_broken){NAN, -INFINITY, NAN, NAN, NAN};
}

static void strength_cell_break(struct gb_strength_broken *test, double strain,
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
    return gb_strength_tests[test].sense * pressure;
}

static double strain_of(enum gb_strength_test test, const struct cell *cell,
                        const struct gb_point *point)
{
    const int k = gb_strength_tests[test].component;
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
    strength_cell_break(&cell->broken[breaking->test], number[1], number[2], number[3],
                        number[4]);
    if (cell->rows != NULL) {
        gb_listing_numbers(cell->rows, number, G_N_ELEMENTS(number));
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
    snprintf(leg, sizeof leg, gb_strength_tests[test].leg,
             100.0 * cell->options->strain_most);
    return gb_compact_follow(&cell->free, leg, cell->options->step, &walk, NULL, &why) !=
               GB_COMPACT_FAILED ||
           gb_error_set(err, why.code, "%s", why.text);
}

bool gb_strength_measure(struct gb_strength_broken test[GB_STRENGTH_TESTS],
                         const struct gb_params *params, const struct gb_keep_point *mark,
                         const struct gb_strength_options *options,
                         struct gb_listing *rows,
                         const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    struct cell cell = {
        .options = options, .callbacks = callbacks, .broken = test, .rows = rows};
    cell.top.sheared = true;
    bool good = gb_compact_press(&cell.top, params, mark, callbacks, err);
    cell.top.tolerance = options->tolerance;
    good = good && gb_compact_unload(&cell.top, 0.0, callbacks, &cell.free, err);
    if (rows != NULL) {
        gb_listing_columns(rows, "%.8g", "test,strain,stress_Pa,density,broken");
    }
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        test[t] = strength_cell_unbroken();
        good = break_one(&cell, (enum gb_strength_test)t, err);
    }
    gb_compact_finish(&cell.free);
    gb_compact_finish(&cell.top);
    return good;
}

/* One compact of one cell, as the work of a pool: pressed, all stresses taken away, and
 * broken in each test on a copy.
 *
 * path  of the cell without ending: PATH.ini is the question, PATH.csv receives a row per
 *       recorded point of each test: test, strain, stress in Pa, density of the compact,
 *       share of its bridges that are broken */
static bool strength_cell_work(const struct gb_params *params, const char *path,
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
    strength_options_read(&options, &mark, question);
    g_key_file_free(question);
    struct gb_listing *rows = gb_listing_new();
    const bool good =
        gb_strength_measure(test, params, &mark, &options, rows, callbacks, err) &&
        gb_cells_table(path, ".csv", rows, err);
    gb_listing_free(rows);
    gb_lock_release(&lock);
    return good;
}

/* --- all cells ------------------------------------------------------------------------ */

/* Peak of the curve of a test. */
static struct gb_strength_broken read_test(const struct gb_table *table, int test)
{
    const double *which = gb_table_column(table, "test", NULL);
    const double *strain = gb_table_column(table, "strain", NULL);
    const double *stress = gb_table_column(table, "stress_Pa", NULL);
    const double *density = gb_table_column(table, "density", NULL);
    const double *broken = gb_table_column(table, "broken", NULL);
    struct gb_strength_broken found = strength_cell_unbroken();
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        if (which[i] == test) {
            strength_cell_break(&found, strain[i], stress[i], density[i], broken[i]);
        }
    }
    return found;
}

static bool has_columns(const struct gb_table *table, struct gb_error *err)
{
    static const char *const names[] = {"test", "strain", "stress_Pa", "density",
                                        "broken"};
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        if (gb_table_column(table, names[k], err) == NULL) {
            return false;
        }
    }
    return true;
}

static double column_mean(const struct gb_strength_broken *broken, int cells,
                          size_t member, double *error)
{
    double value[GB_STRENGTH_REPLICAS_MAX], mean = NAN;
    for (int c = 0; c < cells; c++) {
        const char *at = (const char *)&broken[c] + member;
        value[c] = *(const double *)(const void *)at;
    }
    gb_average_values(value, (size_t)cells, &mean, error);
    return mean;
}

static void conclude_test(struct gb_strength_study *study,
                          const struct gb_keep_point *mark, int test,
                          const struct gb_strength_broken *broken, int cells)
{
    struct gb_error ignored = {0};
    double unused, strength[GB_STRENGTH_REPLICAS_MAX];
    struct gb_strength_result result = {
        .mark = *mark,
        .test = (enum gb_strength_test)test,
        .cells = cells,
        .weibull = {(double)NAN, (double)NAN, (double)NAN, (double)NAN}};
#define MEAN(member, error)                                                              \
    column_mean(broken, cells, offsetof(struct gb_strength_broken, member), error)
    result.density = MEAN(density, &unused);
    result.strength_pa = MEAN(strength, &result.strength_error_pa);
    result.strain = MEAN(strain, &result.strain_error);
    result.broken_at_peak = MEAN(at_peak, &result.broken_at_peak_error);
    result.broken_at_end = MEAN(at_end, &result.broken_at_end_error);
#undef MEAN
    for (int c = 0; c < cells; c++) {
        strength[c] = broken[c].strength;
    }
    gb_distribution_weibull(&result.weibull, strength, (size_t)cells, &ignored);
    g_array_append_val(study->result, result);
}

static void add_curves(struct gb_strength_study *study, const struct gb_keep_point *mark,
                       int cell, const struct gb_table *table)
{
    const double *column[] = {gb_table_column(table, "strain", NULL),
                              gb_table_column(table, "stress_Pa", NULL),
                              gb_table_column(table, "broken", NULL)};
    const double *test = gb_table_column(table, "test", NULL);
    for (size_t i = 0; i < gb_table_rows(table); i++) {
        const double number[] = {mark->by_density ? (double)NAN : 1e-6 * mark->value,
                                 mark->by_density ? mark->value : (double)NAN,
                                 cell + 1.0,
                                 100.0 * column[0][i],
                                 1e-6 * column[1][i],
                                 100.0 * column[2][i]};
        gb_listing_text(study->curves, gb_strength_tests[(int)test[i]].name);
        gb_listing_numbers(study->curves, number, G_N_ELEMENTS(number));
    }
}

static bool read_cell(struct gb_strength_study *study, const struct gb_cells *cells,
                      const struct gb_cells_item *item, const struct gb_keep_point *mark,
                      int cell, struct gb_strength_broken broken[GB_STRENGTH_TESTS],
                      struct gb_error *err)
{
    char *file = g_strconcat(item->name, ".csv", NULL);
    char *path = g_build_filename(cells->directory, file, NULL);
    struct gb_table *table = NULL;
    const bool good = gb_table_read(&table, path, NULL, err) && has_columns(table, err);
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        broken[t] = read_test(table, t);
    }
    if (good) {
        add_curves(study, mark, cell, table);
    }
    gb_table_destroy(table);
    g_free(path);
    g_free(file);
    return good;
}

/* Results of a mark, from the cells that have an answer. */
static bool conclude_mark(struct gb_strength_study *study, const struct gb_cells *cells,
                          int mark, struct gb_error *err)
{
    const int replicas = study->options.replicas;
    const struct gb_keep_point *at = &study->options.marks.point[mark];
    struct gb_strength_broken *broken =
        g_new(struct gb_strength_broken, GB_STRENGTH_TESTS * (gsize)replicas);
    struct gb_strength_broken found[GB_STRENGTH_TESTS];
    int there = 0;
    bool good = true;
    for (int c = 0; c < replicas && good; c++) {
        const struct gb_cells_item *item = g_ptr_array_index(
            cells->list, (guint)(c * study->options.marks.count + mark));
        if (item->done && (good = read_cell(study, cells, item, at, c, found, err))) {
            for (int t = 0; t < GB_STRENGTH_TESTS; t++) {
                broken[t * replicas + there] = found[t];
            }
            there++;
        }
    }
    good = good && (there > 0 || gb_cells_check(cells, err));
    for (int t = 0; t < GB_STRENGTH_TESTS && good; t++) {
        conclude_test(study, at, t, broken + t * replicas, there);
    }
    g_free(broken);
    return good;
}

static bool conclude(struct gb_strength_study *study, const struct gb_cells *cells,
                     struct gb_error *err)
{
    for (int m = 0; m < study->options.marks.count; m++) {
        if (!conclude_mark(study, cells, m, err)) {
            return false;
        }
    }
    for (guint i = 0; i < cells->list->len; i++) {
        const struct gb_cells_item *item = g_ptr_array_index(cells->list, i);
        study->failed += !item->done;
    }
    gb_cells_check(cells, &study->why);
    return true;
}

static void add_cells(struct gb_cells *cells, const struct gb_params *params,
                      const struct gb_strength_options *options)
{
    struct gb_params own = *params;
    own.threads = 1;
    own.on_collapse = GB_COLLAPSE_STOP;
    for (int c = 0; c < options->replicas; c++) {
        own.seed = params->seed + (uint64_t)c;
        for (int m = 0; m < options->marks.count; m++) {
            const struct gb_keep_point *mark = &options->marks.point[m];
            GString *text = g_string_new("study=strength\n");
            strength_cell_write(options, mark, text);
            gb_cells_add(cells, &own, gb_cells_name(mark, c), text->str);
            g_string_free(text, TRUE);
        }
    }
}

bool gb_strength_run(struct gb_strength_study *study, const struct gb_params *preset,
                     const struct gb_strength_options *options, const char *directory,
                     int jobs, const struct gb_cells_callbacks *callbacks,
                     struct gb_error *err)
{
    struct gb_cells cells = {0};
    struct gb_params params;
    *study = (struct gb_strength_study){
        .options = *options,
        .result = g_array_new(FALSE, FALSE, sizeof(struct gb_strength_result)),
        .curves = gb_listing_new()};
    gb_listing_columns(study->curves, "%s", "test");
    gb_listing_columns(study->curves, "%.8g",
                       "pressure_MPa,pressed_density,cell,strain_percent,stress_MPa,"
                       "broken_percent");
    if (!strength_cell_check(options, err) ||
        !gb_seed_check_cells(preset, (size_t)options->replicas, err) ||
        !gb_compact_params(&params, preset, err) ||
        !gb_cells_init(&cells, directory, err)) {
        gb_cells_finish(&cells);
        return false;
    }
    add_cells(&cells, &params, options);
    const bool good = gb_cells_work(&cells, jobs, strength_cell_work, callbacks, err) &&
                      conclude(study, &cells, err);
    gb_cells_finish(&cells);
    return good;
}

void gb_strength_finish(struct gb_strength_study *study)
{
    if (study->result != NULL) {
        g_array_unref(study->result);
        gb_listing_free(study->curves);
    }
    memset(study, 0, sizeof *study);
}

/* --- tables and page ------------------------------------------------------------------ */

static GString *table(const struct gb_strength_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%s", "test");
    gb_listing_columns(listing, "%.8g",
                       "pressure_MPa,pressed_density,cells,density,strength_MPa,"
                       "strength_error_MPa,strain_percent,strain_error_percent,"
                       "broken_at_peak_percent,broken_at_end_percent,weibull_modulus,"
                       "weibull_low,weibull_high,weibull_scale_MPa,"
                       "broken_at_peak_error_percent,broken_at_end_error_percent");
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const double number[] = {r->mark.by_density ? (double)NAN : 1e-6 * r->mark.value,
                                 r->mark.by_density ? r->mark.value : (double)NAN,
                                 r->cells,
                                 r->density,
                                 1e-6 * r->strength_pa,
                                 1e-6 * r->strength_error_pa,
                                 100.0 * r->strain,
                                 100.0 * r->strain_error,
                                 100.0 * r->broken_at_peak,
                                 100.0 * r->broken_at_end,
                                 r->weibull.modulus,
                                 r->weibull.modulus_low,
                                 r->weibull.modulus_high,
                                 1e-6 * r->weibull.scale,
                                 100.0 * r->broken_at_peak_error,
                                 100.0 * r->broken_at_end_error};
        gb_listing_text(listing, gb_strength_tests[r->test].name);
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static GString *page(const struct gb_strength_study *study, const char *title,
                     const char *command)
{
    GString *text = g_string_new(NULL);
    g_string_append_printf(
        text,
        "# Strength after unloading: %s\n\n`%s`\n\n%d cells. Each compact is pressed, its "
        "stresses are taken away, and copies are broken. Standard errors over the cells; "
        "Weibull modulus by maximum likelihood with its 95 %% interval.\n\n",
        title, command, study->options.replicas);
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s",
                       "pressed to,test,strength (MPa),strain (%),"
                       "bridges broken at the peak (%),Weibull modulus");
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const struct gb_fit_value strength = {.value = r->strength_pa,
                                              .error = r->strength_error_pa};
        const struct gb_fit_value strain = {.value = r->strain, .error = r->strain_error};
        const struct gb_fit_value broken = {.value = r->broken_at_peak,
                                            .error = r->broken_at_peak_error};
        const struct gb_fit_value modulus = {.value = r->weibull.modulus,
                                             .low = r->weibull.modulus_low,
                                             .high = r->weibull.modulus_high};
        char *mark = g_strdup_printf(
            "%g%s", r->mark.by_density ? r->mark.value : 1e-6 * r->mark.value,
            r->mark.by_density ? "" : " MPa");
        gb_listing_text(listing, mark);
        gb_listing_text(listing, gb_strength_tests[r->test].name);
        gb_study_text_mean(listing, &strength, 1e-6);
        gb_study_text_mean(listing, &strain, 100.0);
        gb_study_text_mean(listing, &broken, 100.0);
        GString *interval = g_string_new(NULL);
        gb_study_text_interval(interval, "", "%.2g", &modulus, 1.0);
        gb_listing_text(listing, interval->str);
        g_string_free(interval, TRUE);
        g_free(mark);
    }
    GString *rows = gb_listing_end(listing, GB_LISTING_MARKDOWN);
    g_string_append(text, rows->str);
    g_string_free(rows, TRUE);
    if (study->failed > 0) {
        g_string_append_printf(text, "\nIncomplete: %s\n", study->why.text);
    }
    return text;
}

bool gb_strength_write(const struct gb_strength_study *study, const char *directory,
                       const char *title, const char *command, struct gb_error *err)
{
    char *comment = g_strdup_printf("preset: %s\ncommand: %s", title, command);
    gb_listing_comment(study->curves, comment);
    const struct gb_study_text_file file[] = {
        {"strength.csv", table(study, comment)},
        {"strength_curves.csv", gb_listing_print(study->curves, GB_LISTING_CSV)},
        {"strength.md", page(study, title, command)}};
    g_free(comment);
    return gb_study_text_write(file, G_N_ELEMENTS(file), directory, err);
}
