#include "tui/session/results.h"

#include <glib.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "base/table.h"
#include "base/units.h"
#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "io/preset.h"
#include "io/run_list.h"
#include "many/compaction_data.h"
#include "measure/compaction_fits.h"
#include "scene/tolerances.h"
#include "study/calibration.h"
#include "tui/session/session.h"
#include "tui/term/pixels.h"

/* Results of jobs as cards of a few lines.  Each kind of result is a function that
 * fills the card, and a row of the table at the end. */

static void clear_line(void *data)
{
    g_free(((struct gb_result_line *)data)->text);
}

static void clear_value(void *data)
{
    g_free(((struct gb_result_value *)data)->text);
}

/* path may be NULL. */
static void results_card_init(struct gb_result_card *card,
                              const struct gb_result_kind *kind, const char *path)
{
    *card = (struct gb_result_card){
        .kind = kind,
        .lines = g_array_new(FALSE, TRUE, sizeof(struct gb_result_line)),
        .values = g_array_new(FALSE, TRUE, sizeof(struct gb_result_value)),
        .path = g_strdup(path),
    };
    g_array_set_clear_func(card->lines, clear_line);
    g_array_set_clear_func(card->values, clear_value);
}

static void results_card_finish(struct gb_result_card *card)
{
    if (card->kind != NULL) {
        g_array_unref(card->lines);
        g_array_unref(card->values);
    }
    g_free(card->path);
    g_free(card->page);
    g_free(card->picture);
    memset(card, 0, sizeof *card);
}

static void results_card_add(struct gb_result_card *card, enum gb_result_role role,
                             const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const struct gb_result_line line = {role, g_strdup_vprintf(format, list)};
    va_end(list);
    g_array_append_val(card->lines, line);
}

/* Offers the value of a field in params, which Enter then sets. */
static void results_card_offer(struct gb_result_card *card, const struct gb_field *field,
                               const struct gb_params *params)
{
    char text[GB_PARAMS_VALUE_MAX];
    gb_params_format(params, field, text, sizeof text);
    const struct gb_result_value value = {field, g_strdup(text)};
    g_array_append_val(card->values, value);
}

char *gb_results_card_text(const struct gb_result_card *card)
{
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < card->lines->len; i++) {
        g_string_append(text, g_array_index(card->lines, struct gb_result_line, i).text);
        g_string_append_c(text, '\n');
    }
    g_string_append(text, card->path != NULL ? card->path : "");
    return g_strchomp(g_string_free(text, FALSE));
}

bool gb_results_card_use(const struct gb_result_card *card, struct gb_params *params,
                         char **told, struct gb_error *err)
{
    struct gb_params changed = *params;
    GString *text = g_string_new(NULL);
    bool good = true;
    for (guint i = 0; i < card->values->len && good; i++) {
        const struct gb_result_value *value =
            &g_array_index(card->values, struct gb_result_value, i);
        good = gb_params_set(&changed, value->field, value->text, err);
        g_string_append_printf(text, "%s%s.%s = %s", i > 0 ? ", " : "",
                               value->field->group, value->field->key, value->text);
    }
    *told = g_string_free(text, !good);
    if (good) {
        *params = changed;
    }
    return good;
}

/* What the cards show, by file; as gb_result_kind.fill. */

/* Has row i the least margin of its method? */
static bool is_least(const struct gb_stability_csv *table, size_t i)
{
    for (size_t k = 0; k < table->count; k++) {
        const bool same = strcmp(table->row[k].method, table->row[i].method) == 0;
        if (same && (table->margin[k] < table->margin[i] ||
                     (table->margin[k] <= table->margin[i] && k < i))) {
            return false;
        }
    }
    return true;
}

static void add_method(struct gb_result_card *card, const struct gb_stability_csv *table,
                       size_t i)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    results_card_add(
        card, row->in_use && !row->stable ? GB_RESULT_WARNING : GB_RESULT_VALUE,
        "%s%s: %s to %.2f times its step (%.4g MPa)", row->method,
        row->in_use ? ", in use" : "", row->stable ? "stable" : "only stable",
        table->margin[i], table->p_mpa[i]);
}

/* The least margin of each method, with its pressure. */
static bool results_stability_fill(struct gb_result_card *card,
                                   const struct gb_session *session)
{
    const struct gb_stability_csv *table = session->stability;
    if (table == NULL || table->count == 0 ||
        g_strcmp0(session->chart_job.directory, card->path) != 0) {
        return false;
    }
    for (size_t i = 0; i < table->count; i++) {
        if (is_least(table, i)) {
            add_method(card, table, i);
        }
    }
    const size_t weakest = gb_job_stability_weakest(table);
    if (!table->in_time && weakest < table->count && !table->row[weakest].stable) {
        results_card_add(card, GB_RESULT_NOTE,
                         "it shortens its step there, and takes more evaluations");
    }
    results_card_add(card, GB_RESULT_NOTE, "by pressure in view T; Enter applies there");
    return true;
}

/* Pressures of the table of densities; the last one that was reached is added. */
static const double wanted_pa[] = {10e6, 50e6, 100e6, 500e6};

static void add_density(struct gb_result_card *card,
                        const struct gb_runset_view_group *group, size_t level,
                        double pressure_pa)
{
    const size_t cells = group->reached[level];
    const double mean = group->mean[level];
    const double error = group->error[level];
    char pressure[32];
    char number[GB_NUMBER_ERROR_MAX];
    gb_units_format_short(pressure_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    if (cells < 2 || !isfinite(error)) {
        results_card_add(card, GB_RESULT_VALUE,
                         "density at %s: %.4f, one cell, no interval", pressure, mean);
        return;
    }
    const double half = error * gsl_cdf_tdist_Pinv(0.975, (double)cells - 1.0);
    gb_number_error(mean, error, 2, " +- ", number);
    results_card_add(card, GB_RESULT_VALUE,
                     "density at %s: %s, 95 %%: %.4f to %.4f (%zu cells)", pressure,
                     number, mean - half, mean + half, cells);
}

static bool is_level(const struct gb_runset_view *runset, size_t level,
                     double pressure_pa)
{
    return fabs(runset->level_pa[level] / pressure_pa - 1.0) < 1e-6;
}

/* Adds the target of --until-se. */
static void add_target(struct gb_result_card *card, const struct gb_replica_band *band,
                       const struct gb_runset_view_group *group)
{
    const size_t level = gb_runset_view_nearest(&band->runset, band->target_pa);
    const double error = group->error[level];
    char pressure[32];
    if (!(band->target > 0.0) || !(error > band->target)) {
        return;
    }
    gb_units_format_short(band->target_pa, GB_DIM_PRESSURE, 4, pressure, sizeof pressure);
    results_card_add(card, GB_RESULT_WARNING,
                     "standard error %.2g at %s is above %.2g: more cells reduce it",
                     error, pressure, band->target);
}

static void add_missing(struct gb_result_card *card, const struct gb_runset_view *runset)
{
    if (runset->done < runset->runs) {
        results_card_add(card, GB_RESULT_WARNING,
                         "%zu of %zu cells did not end: the others alone count",
                         runset->runs - runset->done, runset->runs);
    }
}

/* Mean densities with intervals, cells that failed. */
static bool results_replicas_fill(struct gb_result_card *card,
                                  const struct gb_session *session)
{
    const struct gb_replica_band *band = &session->replica_band;
    const struct gb_runset_view *runset = &band->runset;
    const struct gb_runset_view_group *group = gb_job_replicas_group(band);
    if (group == NULL || g_strcmp0(band->directory, card->path) != 0) {
        return false;
    }
    for (size_t k = 0; k < G_N_ELEMENTS(wanted_pa); k++) {
        const size_t level = gb_runset_view_nearest(runset, wanted_pa[k]);
        if (is_level(runset, level, wanted_pa[k]) && group->reached[level] > 0) {
            add_density(card, group, level, wanted_pa[k]);
        }
    }
    size_t last = runset->levels;
    while (last > 0 && group->reached[last - 1] < group->members) {
        last--;
    }
    if (card->lines->len == 0 && last > 0) {
        add_density(card, group, last - 1, runset->level_pa[last - 1]);
    }
    add_target(card, band, group);
    add_missing(card, runset);
    return card->lines->len > 0;
}

static double value_of(const struct gb_moduli_state *state, const char *column)
{
    return gb_moduli_table_mean(state, gb_moduli_table_find(column));
}

/* Adds the range of strain in which a linear law holds. */
static void add_range(struct gb_result_card *card, const struct gb_moduli_state *state)
{
    const double range = value_of(state, "elastic_range");
    const double probe = value_of(state, "probe_strain");
    if (range >= GB_PROBE_RANGE_MAX) {
        results_card_add(card, GB_RESULT_NOTE, "probe %.0e, elastic beyond %.1e", probe,
                         range);
    } else if (range < probe) {
        results_card_add(card, GB_RESULT_WARNING,
                         "probe %.0e, elastic to %.1e only: contacts open or slide",
                         probe, range);
    } else {
        results_card_add(card, GB_RESULT_NOTE, "probe %.0e, elastic to %.1e", probe,
                         range);
    }
}

/* Averages and constants of the last state. */
static bool results_moduli_fill(struct gb_result_card *card,
                                const struct gb_session *session)
{
    const GArray *states = session->moduli.states;
    if (states == NULL || states->len == 0) {
        return false;
    }
    const struct gb_moduli_state *last =
        &g_array_index(states, struct gb_moduli_state, states->len - 1);
    results_card_add(card, GB_RESULT_NOTE, "%u state%s: density %.4f, %.4g MPa",
                     states->len, states->len == 1 ? "" : "s, the last",
                     value_of(last, "density"), value_of(last, "p_MPa"));
    if (isfinite(value_of(last, "K_GPa"))) {
        results_card_add(card, GB_RESULT_VALUE,
                         "E %.4g GPa, K %.4g GPa, G %.4g GPa, nu %.3f",
                         value_of(last, "E_GPa"), value_of(last, "K_GPa"),
                         value_of(last, "G_GPa"), value_of(last, "nu"));
    }
    results_card_add(card, GB_RESULT_VALUE,
                     "C11 %.4g, C33 %.4g, C44 %.4g, C12 %.4g, C13 %.4g GPa",
                     value_of(last, "axial_C11_GPa"), value_of(last, "axial_C33_GPa"),
                     value_of(last, "axial_C44_GPa"), value_of(last, "axial_C12_GPa"),
                     value_of(last, "axial_C13_GPa"));
    add_range(card, last);
    results_card_add(card, GB_RESULT_NOTE,
                     "one cell, no interval: that needs replicas (R, then greenbody "
                     "moduli)");
    if (card->path == NULL) {
        card->path =
            g_build_filename(session->moduli.directory, GB_MODULI_STATES_FILE, NULL);
    }
    return true;
}

/* Equations whose AICc differs by less cannot be distinguished.  Source: K.  P.
 * Burnham, D.  R.  Anderson, Sociol.  Methods Res. 33, 261 (2004). */
static const double delta_alike = 2.0;

enum { OTHERS = 2 };

static void add_parameters(struct gb_result_card *card,
                           const struct gb_compaction_fits *fits, size_t index)
{
    char number[GB_NUMBER_ERROR_MAX];
    for (size_t k = 0; k < gb_compaction_fits_values(fits, index); k++) {
        const struct gb_compaction_value value = gb_compaction_fits_value(fits, index, k);
        const char *unit = strcmp(value.unit, "1") != 0 ? value.unit : "";
        gb_number_error(value.value.value, value.value.error, 2, " +- ", number);
        results_card_add(card, GB_RESULT_VALUE, "%s %s = %s%s%s, 95 %%: %.4g to %.4g",
                         fits->fit[index].equation->title, value.name, number,
                         *unit != '\0' ? " " : "", unit, value.value.low,
                         value.value.high);
    }
}

static void add_yield(struct gb_result_card *card, const struct gb_compaction_fits *fits)
{
    const struct gb_fit_value *yield = &fits->yield;
    char number[GB_NUMBER_ERROR_MAX];
    if (fits->heckel.equation != NULL) {
        gb_number_error(yield->value, yield->error, 2, " +- ", number);
        results_card_add(card, GB_RESULT_VALUE,
                         "Heckel 1/K = %s MPa, 95 %%: %.4g to %.4g", number, yield->low,
                         yield->high);
    }
}

/* Compares the fit with the others. */
static void add_ranking(struct gb_result_card *card,
                        const struct gb_compaction_fits *fits)
{
    const struct gb_equation_fit *best = &fits->fit[0].all;
    results_card_add(card, GB_RESULT_NOTE,
                     "RMS residual %.2g of relative density, %zu points", best->rms,
                     best->points);
    for (size_t i = 1; i < fits->fitted && i <= OTHERS; i++) {
        const bool alike = fits->fit[i].delta < delta_alike;
        results_card_add(card, alike ? GB_RESULT_WARNING : GB_RESULT_NOTE,
                         "%s: AICc %.3g higher%s", fits->fit[i].equation->title,
                         fits->fit[i].delta,
                         alike ? ", the points do not tell them apart" : "");
    }
    if (best->correlation > 2.0) {
        results_card_add(card, GB_RESULT_NOTE,
                         "residuals are correlated: %.0f points count as one",
                         best->correlation);
    }
}

/* Parameters of the best equation with intervals, what it is compared
 * with. */
static bool results_fit_fill(struct gb_result_card *card,
                             const struct gb_session *session)
{
    const struct gb_compaction_cache *cache = &session->results.fits;
    const struct gb_compaction_fits *fits = &cache->fits;
    const struct gb_runner *runner = session->runner;
    if (!cache->fitted) {
        return false;
    }
    add_parameters(card, fits, 0);
    if (fits->fit[0].equation != fits->heckel.equation) {
        add_yield(card, fits);
    }
    add_ranking(card, fits);
    g_free(card->path);
    card->path = g_strdup(runner != NULL ? gb_runner_directory(runner) : NULL);
    return true;
}

/* Size of the picture; pages and files of the report. */
static bool results_files_picture(struct gb_result_card *card,
                                  const struct gb_session *session)
{
    struct gb_png_pixels picture;
    struct gb_error err = {0};
    (void)session;
    if (!gb_pixels_png_measure(&picture, card->path, &err)) {
        results_card_add(card, GB_RESULT_WARNING, "%s", err.text);
        return true;
    }
    char *size = gb_run_list_size_text(gb_run_list_bytes(card->path));
    results_card_add(card, GB_RESULT_VALUE, "%d x %d pixels, %s", picture.wide,
                     picture.high, size);
    if (picture.per_inch > 0.0) {
        results_card_add(card, GB_RESULT_VALUE,
                         "in print %.3g x %.3g cm at %.0f pixels per inch",
                         2.54 * picture.wide / picture.per_inch,
                         2.54 * picture.high / picture.per_inch, picture.per_inch);
    }
    results_card_add(card, GB_RESULT_NOTE,
                     "greenbody run --from FILE repeats the run of it");
    card->picture = g_strdup(card->path);
    g_free(size);
    return true;
}

/* Number of files in a folder with this ending; *first: the first of them by name,
 * g_free. */
static int count_files(const char *folder, const char *ending, char **first)
{
    int count = 0;
    GDir *dir = g_dir_open(folder, 0, NULL);
    const char *name;
    while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
        if (!g_str_has_suffix(name, ending)) {
            continue;
        }
        count++;
        if (first != NULL && (*first == NULL || strcmp(name, *first) < 0)) {
            g_free(*first);
            *first = g_strdup(name);
        }
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    return count;
}

static bool results_files_report(struct gb_result_card *card,
                                 const struct gb_session *session)
{
    char *figures = g_build_filename(card->path, "figures", NULL);
    char *pictures = g_build_filename(card->path, "pictures", NULL);
    char *tables = g_build_filename(card->path, "tables", NULL);
    char *size = gb_run_list_size_text(gb_run_list_bytes(card->path));
    char *first = NULL;
    (void)session;
    const int drawn = count_files(figures, ".png", NULL);
    const int shown = count_files(pictures, ".png", &first);
    results_card_add(card, GB_RESULT_VALUE, "%d figures, %d pictures, %d tables, %s",
                     drawn, shown, count_files(tables, ".csv", NULL), size);
    if (first != NULL) {
        card->picture = g_build_filename(pictures, first, NULL);
    }
    card->page = g_build_filename(card->path, "index.html", NULL);
    g_free(first);
    g_free(size);
    g_free(tables);
    g_free(pictures);
    g_free(figures);
    return true;
}

enum { DESCRIPTION = 160 };

/* Offers the fields that the setting changes. */
static void offer_changes(struct gb_result_card *card, const struct gb_session *session)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    const struct gb_params *own = gb_preset_params(session->preset);
    struct gb_params *changed = g_memdup2(own, sizeof *own);
    gb_job_chart_csv_apply(session->chart, session->chart->chosen, changed);
    for (size_t i = 0; i < count; i++) {
        if (!gb_previous_diff_same(own, changed, &field[i])) {
            results_card_offer(card, &field[i], changed);
        }
    }
    g_free(changed);
}

static void add_chosen(struct gb_result_card *card, const struct gb_chart_csv *chart)
{
    char text[DESCRIPTION];
    const size_t i = chart->chosen;
    results_card_add(card, GB_RESULT_VALUE, "cheapest within the scatter: %s",
                     gb_chart_describe(&chart->setting[i], text, sizeof text));
    results_card_add(card, GB_RESULT_VALUE, "error of density below %.2g, %.3g CPU s",
                     chart->error[i], chart->seconds[i]);
    if (isfinite(chart->reference_s) && chart->seconds[i] > 0.0) {
        results_card_add(card, GB_RESULT_NOTE, "the reference takes %.3g times as long",
                         chart->reference_s / chart->seconds[i]);
    }
    if (chart->noise[i]) {
        results_card_add(card, GB_RESULT_WARNING,
                         "its error is within the noise: more cells tell more");
    }
}

/* The recommended setting, its error and cost. */
static bool results_chart_fill(struct gb_result_card *card,
                               const struct gb_session *session)
{
    const struct gb_chart_csv *chart = session->chart;
    if (chart == NULL || g_strcmp0(session->chart_job.directory, card->path) != 0) {
        return false;
    }
    if (chart->chosen < chart->count) {
        add_chosen(card, chart);
        offer_changes(card, session);
    } else {
        results_card_add(card, GB_RESULT_WARNING,
                         "no setting is known to have an error below the scatter: "
                         "more cells or CPU time tell more");
    }
    results_card_add(card, GB_RESULT_NOTE, "%zu of %zu settings measured, view 0",
                     chart->known + (isfinite(chart->reference_s) ? 1U : 0U),
                     chart->count);
    return true;
}

enum { BYTES_MAX = 1 << 20 };

/* Reads the lines printed by the command. */
static bool read_lines(struct gb_result_card *card)
{
    char *text = NULL;
    size_t length = 0;
    char *path = g_build_filename(card->path, GB_CALIBRATION_TABLE_TEXT, NULL);
    const bool good = gb_file_read(path, BYTES_MAX, &text, &length, NULL);
    char **lines = g_strsplit(good ? text : "", "\n", -1);
    for (int i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            results_card_add(card,
                             gb_calibration_warns(lines[i]) ? GB_RESULT_WARNING
                                                            : GB_RESULT_VALUE,
                             "%s", g_strstrip(lines[i]));
        }
    }
    g_strfreev(lines);
    gb_alloc_free(text);
    g_free(path);
    return good;
}

/* Offers the keys of calibration.csv with their values from calibrated.ini. */
static void offer_values(struct gb_result_card *card)
{
    struct gb_table *table = NULL;
    struct gb_preset *preset = NULL;
    char *csv = g_build_filename(card->path, "calibration.csv", NULL);
    char *ini = g_build_filename(card->path, "calibrated.ini", NULL);
    if (gb_table_read(&table, csv, "key", NULL) && gb_preset_load(&preset, ini, NULL)) {
        for (size_t row = 0; row < gb_table_rows(table); row++) {
            const struct gb_field *field =
                gb_params_find_name(gb_table_word(table, row), NULL);
            if (field != NULL) {
                results_card_offer(card, field, gb_preset_params(preset));
            }
        }
    }
    gb_preset_destroy(preset);
    gb_table_destroy(table);
    g_free(ini);
    g_free(csv);
}

/* Values with intervals, correlations, what the data cannot tell. */
static bool results_calibration_fill(struct gb_result_card *card,
                                     const struct gb_session *session)
{
    (void)session;
    offer_values(card);
    return read_lines(card);
}

static bool is_current(const struct gb_compaction_cache *cache,
                       const struct gb_curve *curve, size_t points,
                       enum gb_compaction_intervals intervals)
{
    return cache->curve == curve && cache->points == points &&
           cache->intervals == intervals &&
           cache->first == gb_curve_at(curve, 0)->density;
}

/* Copies the loading branch to arrays (MPa, density).  D0: density of the last point
 * before it. */
static size_t take_loading(const struct gb_curve *curve, size_t points, double *pressure,
                           double *density, double *initial)
{
    size_t count = 0;
    *initial = NAN;
    for (size_t i = 0; i < points; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (point->branch == GB_BRANCH_LOAD && isfinite(point->p_pa)) {
            pressure[count] = 1e-6 * point->p_pa;
            density[count++] = point->density;
        } else if (point->branch == GB_BRANCH_RELAX && count == 0) {
            *initial = point->density;
        }
    }
    return count;
}

static bool fit(struct gb_compaction_cache *cache, const struct gb_curve *curve,
                size_t points)
{
    const struct gb_compaction_window window = {
        .from = (double)NAN, .to = (double)NAN, .initial = (double)NAN};
    struct gb_error *err = &cache->reason;
    double *pressure = gb_alloc_array(2 * points, sizeof *pressure, err);
    if (pressure == NULL) {
        return false;
    }
    double initial = NAN;
    struct gb_average_curve loading = {.x = pressure, .y = pressure + points};
    loading.count = take_loading(curve, points, pressure, pressure + points, &initial);
    const bool good =
        gb_compaction_data_curves(&cache->data, &loading, 1, initial, &window, err) &&
        gb_compaction_fits(&cache->fits, &cache->data.points, NULL, cache->intervals,
                           err);
    gb_alloc_free(pressure);
    return good;
}

bool gb_results_fits_update(struct gb_compaction_cache *cache,
                            const struct gb_curve *curve, size_t points,
                            enum gb_compaction_intervals intervals)
{
    if (!is_current(cache, curve, points, intervals)) {
        gb_results_fits_finish(cache);
        *cache = (struct gb_compaction_cache){.curve = curve,
                                              .points = points,
                                              .first = gb_curve_at(curve, 0)->density,
                                              .intervals = intervals};
        cache->fitted = fit(cache, curve, points) && cache->fits.fitted > 0;
    }
    return cache->fitted;
}

void gb_results_fits_finish(struct gb_compaction_cache *cache)
{
    gb_compaction_data_finish(&cache->data);
    memset(cache, 0, sizeof *cache);
}

static const struct gb_result_kind kinds[GB_RESULTS_KINDS] = {
    [GB_RESULTS_CALIBRATION] = {"calibration", "calibration", "use the values",
                                results_calibration_fill},
    [GB_RESULTS_REPLICAS] = {"replicas", "replicas", NULL, results_replicas_fill},
    [GB_RESULTS_MODULI] = {"moduli", "elastic moduli", NULL, results_moduli_fill},
    [GB_RESULTS_CHART] = {"chart", "accuracy against cost", "use the setting",
                          results_chart_fill},
    [GB_RESULTS_STABILITY] = {"stability", "stability of the methods", NULL,
                              results_stability_fill},
    [GB_RESULTS_PICTURE] = {"picture", "picture", NULL, results_files_picture},
    [GB_RESULTS_REPORT] = {"report", "report", NULL, results_files_report},
    [GB_RESULTS_FIT] = {NULL, "equations of compaction", NULL, results_fit_fill},
};

void gb_results_finish(struct gb_results *results)
{
    for (int k = 0; k < GB_RESULTS_KINDS; k++) {
        results_card_finish(&results->card[k]);
    }
    gb_results_fits_finish(&results->fits);
    memset(results, 0, sizeof *results);
}

static void put_first(struct gb_results *results, enum gb_results_kind kind)
{
    int at = 0;
    while (at < results->count && results->recent[at] != kind) {
        at++;
    }
    results->count = MAX(results->count, at + 1);
    memmove(results->recent + 1, results->recent, (size_t)at * sizeof results->recent[0]);
    results->recent[0] = kind;
}

static bool make(struct gb_results *results, const struct gb_session *session,
                 enum gb_results_kind kind, const char *path)
{
    struct gb_result_card card;
    results_card_init(&card, &kinds[kind], path);
    if (!kinds[kind].fill(&card, session)) {
        results_card_finish(&card);
        return false;
    }
    results_card_finish(&results->card[kind]);
    results->card[kind] = card;
    put_first(results, kind);
    return true;
}

bool gb_results_make(struct gb_results *results, const struct gb_session *session,
                     enum gb_results_kind kind)
{
    const char *path = results->card[kind].path;
    char *kept = g_strdup(path);
    const bool made = make(results, session, kind, kept);
    g_free(kept);
    return made;
}

void gb_results_take(struct gb_results *results, const struct gb_session *session,
                     const char *job, const char *path)
{
    for (int k = 0; k < GB_RESULTS_KINDS; k++) {
        if (g_strcmp0(kinds[k].job, job) == 0 &&
            make(results, session, (enum gb_results_kind)k, path)) {
            results->news = true;
        }
    }
}

bool gb_results_take_news(struct gb_results *results)
{
    const bool news = results->news;
    results->news = false;
    return news;
}

const struct gb_result_card *gb_results_at(const struct gb_results *results, int back)
{
    return back >= 0 && back < results->count ? &results->card[results->recent[back]]
                                              : NULL;
}
