/* The tables of a report, each a part of it: results with errors and conditions, densities at
 * round pressures, fitted equations, keys in use, papers.  First what the parts share: a table
 * of page and CSV, the conditions of a scene, the papers. */
#include "figures/report_tables.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/number.h"
#include "figures/report.h"
#include "figures/series.h"
#include "io/measured.h"
#include "io/status_json.h"
#include "many/compaction_data.h"
#include "many/die_summary.h"
#include "many/runset.h"
#include "measure/average.h"
#include "measure/compaction_fits.h"
#include "run/moduli_table.h"
#include "scene/derived.h"
#include "scene/field/field.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"

void gb_report_tables_begin(struct gb_report_table *table, const char *const *heads)
{
    table->columns = 0;
    table->markup = -1;
    for (int k = 0; heads[k] != NULL; k++) {
        table->heads[table->columns++] = heads[k];
    }
    table->cells = g_ptr_array_new_with_free_func(g_free);
}

void gb_report_tables_put(struct gb_report_table *table, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    g_ptr_array_add(table->cells, g_strdup_vprintf(format, arguments));
    va_end(arguments);
}

/* "mean ± error"; without error when it is NaN, empty when the mean is. */
static void put_mean_cell(struct gb_report_table *table, double mean, double error,
                          int decimals)
{
    if (fabs(mean) < 0.5 * pow(10.0, -decimals)) {
        mean = 0.0; /* no "-0" */
    }
    if (!isfinite(mean)) {
        gb_report_tables_put(table, "%s", "");
    } else if (error > 0.0) {
        char number[GB_NUMBER_ERROR_MAX];
        gb_report_tables_put(table, "%s", gb_number_error(mean, error, 2, " ± ", number));
    } else {
        gb_report_tables_put(table, "%.*f", decimals, mean);
    }
}

/* A table of the page as one for spreadsheets: everything in quotes, no markup. */
static struct gb_listing *listing_of(const struct gb_report_table *table)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_quote(listing);
    for (guint k = 0; k < table->columns; k++) {
        gb_listing_column(listing, "%s", "%s", table->heads[k]);
    }
    for (guint k = 0; k < table->cells->len; k++) {
        const char *cell = g_ptr_array_index(table->cells, k);
        char *plain = (int)(k % table->columns) == table->markup ? gb_page_plain(cell)
                                                                 : g_strdup(cell);
        gb_listing_text(listing, plain);
        g_free(plain);
    }
    return listing;
}

bool gb_report_tables_end(struct gb_report *report, struct gb_report_table *table,
                          const char *name, const char *caption, struct gb_error *err)
{
    if (table->cells->len == 0) {
        g_ptr_array_unref(table->cells);
        return true;
    }
    char *numbered = g_strdup_printf("Table %d. %s", ++report->tables, caption);
    char *file = g_strdup_printf("tables/%s.csv", name);
    const bool good = gb_listing_store(listing_of(table), report->folder, file, err);
    const struct gb_page_table_content content = {numbered, file, table->heads,
                                                  table->columns, table->markup};
    gb_page_table(&report->page, &content, table->cells);
    g_free(numbered);
    g_free(file);
    g_ptr_array_unref(table->cells);
    return good;
}

/* Differences of a group to the others, or its title where there are none or they are long.
 * g_free. */
static char *scene_of(const struct gb_runset *set, size_t group)
{
    char *label = gb_runset_label(set, group);
    if (*label != '\0' && strlen(label) < 120) {
        return label;
    }
    g_free(label);
    return g_strdup(gb_runset_first(set, group)->params.title);
}

/* What a scene was computed with, for captions and the table of conditions. */
enum { CONDITIONS = 7 };

enum { MATERIAL, PARTICLES, CELLS, SEEDS, LAW, LOADING, FIDELITY };
enum { SEEDS_LISTED = 6, VALUES_IN_CAPTION = 3 };

/* material, particles, cells, seeds, contact law, loading, fidelity */
static const char *const report_conditions_heads[CONDITIONS] = {
    "material", "particles", "cells", "seeds", "contact law", "loading", "fidelity"};

/* Value of a key as in a preset. */
static void append_value(GString *text, const struct gb_params *params, const char *group,
                         const char *key)
{
    char *buffer = g_malloc(GB_PARAMS_VALUE_MAX);
    const struct gb_field *field = gb_params_find(group, key);
    g_string_append(text, gb_params_format(params, field, buffer, GB_PARAMS_VALUE_MAX));
    g_free(buffer);
}

static void append_key(GString *text, const char *before, const struct gb_params *params,
                       const char *group, const char *key)
{
    g_string_append(text, before);
    append_value(text, params, group, key);
}

static void append_particles(GString *text, const struct gb_params *params)
{
    g_string_append_printf(text, "%" G_GINT64_FORMAT " %s, ", params->count,
                           params->dimension == 2 ? "discs" : "spheres");
    if (params->distribution == GB_DISTRIBUTION_MONO) {
        append_key(text, "d = ", params, "particles", "diameter");
    } else {
        append_value(text, params, "particles", "distribution");
    }
}

static int compare_seeds(const void *a, const void *b)
{
    const uint64_t one = *(const uint64_t *)a;
    const uint64_t two = *(const uint64_t *)b;
    return (one > two) - (one < two);
}

/* "1, 2, 5", or "1 to 10 (10)" of many. */
static void append_seeds(GString *text, const struct gb_runset *set, size_t group)
{
    uint64_t *seeds = g_new(uint64_t, set->count);
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            seeds[count++] = set->run[i].params.seed;
        }
    }
    qsort(seeds, count, sizeof *seeds, compare_seeds);
    if (count > SEEDS_LISTED) {
        g_string_append_printf(text,
                               "%" G_GUINT64_FORMAT " to %" G_GUINT64_FORMAT " (%zu)",
                               seeds[0], seeds[count - 1], count);
    } else {
        for (size_t i = 0; i < count; i++) {
            g_string_append_printf(text, "%s%" G_GUINT64_FORMAT, i > 0 ? ", " : "",
                                   seeds[i]);
        }
    }
    g_free(seeds);
}

static void append_law(GString *text, const struct gb_params *params)
{
    g_string_append(text, gb_normal_law_of(params)->name);
    append_key(text, ", mu = ", params, "contact", "mu");
    if (gb_normal_law_of(params)->pair) {
        return;
    }
    if (gb_derived_bridge_length_m(params) < gb_derived_reference_m(params)) {
        append_key(text, ", bridges from ", params, "contact", "bridge_length");
    } else {
        g_string_append(text, ", no bridges");
    }
    g_string_append(text, params->epsilon_j > 0.0 ? ", attraction" : "");
}

static void append_loading(GString *text, const struct gb_params *params)
{
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    if (gb_loading_kind_follows_path(params)) {
        append_key(text, "path ", params, "loading", "path");
        return;
    }
    if (kind->periodic_cell) {
        append_value(text, params, "loading", "geometry");
    } else {
        g_string_append(text, "die");
    }
    append_key(text, " to ", params, "loading", "until");
    if (kind->given_rate) {
        append_key(text, ", rate ", params, "loading", "rate");
    }
    if (kind->unloading_branches && params->unload_count > 0) {
        GString *from = g_string_new(NULL);
        append_value(from, params, "loading", "unload_from");
        g_string_replace(from, ";", ",", 0); /* conditions are separated by ';' */
        g_string_append_printf(text, ", unloading from %s", from->str);
        g_string_free(from, TRUE);
    }
}

/* Of a group, plain text; g_free. */
static char *condition_of(const struct gb_runset *set, size_t group, int condition)
{
    const struct gb_params *params = &gb_runset_first(set, group)->params;
    GString *text = g_string_new(NULL);
    switch (condition) {
    case MATERIAL:
        g_string_append(text, params->material);
        break;
    case PARTICLES:
        append_particles(text, params);
        break;
    case CELLS:
        g_string_append_printf(text, "%zu", gb_runset_members(set, group));
        break;
    case SEEDS:
        append_seeds(text, set, group);
        break;
    case LAW:
        append_law(text, params);
        break;
    case LOADING:
        append_loading(text, params);
        break;
    default:
        append_value(text, params, "numerics", "fidelity");
    }
    return g_string_free(text, FALSE);
}

/* Values of a condition in the order of the groups, each once. */
static GPtrArray *condition_values(const struct gb_runset *set, int condition)
{
    GPtrArray *values = g_ptr_array_new_with_free_func(g_free);
    for (size_t g = 0; g < set->groups; g++) {
        char *value = condition_of(set, g, condition);
        if (g_ptr_array_find_with_equal_func(values, value, g_str_equal, NULL)) {
            g_free(value);
        } else {
            g_ptr_array_add(values, value);
        }
    }
    return values;
}

static void append_condition(GString *text, const struct gb_runset *set, int condition)
{
    static const char *const before[CONDITIONS] = {[CELLS] = "cells: ",
                                                   [SEEDS] = "seeds ",
                                                   [LAW] = "law ",
                                                   [FIDELITY] = "fidelity "};
    GPtrArray *values = condition_values(set, condition);
    g_string_append(text, text->len > 0 ? "; " : "Conditions: ");
    g_string_append(text, before[condition] != NULL ? before[condition] : "");
    if (values->len > VALUES_IN_CAPTION) {
        g_string_append_printf(text, "%u values of %s (Table 1)", values->len,
                               report_conditions_heads[condition]);
    }
    for (guint k = 0; k < values->len && values->len <= VALUES_IN_CAPTION; k++) {
        g_string_append_printf(text, "%s%s", k > 0 ? " or " : "",
                               (const char *)g_ptr_array_index(values, k));
    }
    g_ptr_array_unref(values);
}

char *gb_report_tables_conditions(const struct gb_runset *set)
{
    GString *text = g_string_new(NULL);
    for (int k = 0; k < CONDITIONS; k++) {
        append_condition(text, set, k);
    }
    g_string_append_c(text, '.');
    return g_string_free(text, FALSE);
}

/* A sentence with the conditions of the scenes; g_free. */
static char *report_caption(const struct gb_report *report, const char *text)
{
    return g_strdup_printf("%s %s", text, report->conditions);
}

/* Papers in full: authors, title, journal, year.  A paper is known by its tag, as sources of
 * keys and figures have it ("P1 (3), V"), or by the name of a normal law or of an equation of
 * compaction. */

/* In the order of the list. */
static const struct {
    const char *tag;  /* in a source, or the name of a law or equation */
    const char *name; /* shown in front: the tag of the other pages, or NULL */
    const char *text;
} papers[] = {
    {"P1", "P1",
     "G. Sh. Boltachev, K. E. Lukyashin, V. A. Shitov, N. B. Volkov, Three-dimensional "
     "simulations of nanopowder compaction processes by granular dynamics method, Phys. "
     "Rev. E 88, 012209 (2013), doi 10.1103/PhysRevE.88.012209"},
    {"P2", "P2",
     "G. Sh. Boltachev, N. B. Volkov, A. V. Spirin, E. A. Chingina, Simulation of "
     "nanopowder high-speed compaction by 2D granular dynamics method, Institute of "
     "Electrophysics, Ural Branch of RAS, Ekaterinburg"},
    {"P3", "P3",
     "J. Rojek, S. Nosewicz, K. Jurczak, M. Chmielewski, K. Bochenek, K. Pietrzak, "
     "Discrete element simulation of powder compaction in cold uniaxial pressing with low "
     "pressure, Comput. Part. Mech. 3, 513 (2016), doi 10.1007/s40571-015-0093-0"},
    {"hertz", NULL,
     "H. Hertz, \u00dcber die Ber\u00fchrung fester elastischer K\u00f6rper, J. Reine "
     "Angew. Math. 92, 156 (1881)"},
    {"storakers", NULL,
     "B. Stor\u00e5kers, S. Biwa, P.-L. Larsson, Similarity analysis of inelastic contact, "
     "Int. J. Solids Struct. 34, 3061 (1997)"},
    {"Potyondy", NULL,
     "D. O. Potyondy, P. A. Cundall, A bonded-particle model for rock, Int. J. Rock Mech. "
     "Min. Sci. 41, 1329 (2004)"},
    {"Salmon", NULL,
     "J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy "
     "as 1, 2, 3, Proc. Int. Conf. High Performance Computing (SC11), 16 (2011)"},
    {"heckel", NULL,
     "R. W. Heckel, Density-pressure relationships in powder compaction, Trans. Metall. "
     "Soc. AIME 221, 671 (1961)"},
    {"kawakita", NULL,
     "K. Kawakita, K.-H. L\u00fc"
     "dde, Some considerations on powder compression equations, Powder Technol. 4, 61 "
     "(1971)"},
    {"cooper-eaton", NULL,
     "A. R. Cooper, L. E. Eaton, Compaction behavior of several ceramic powders, J. Am. "
     "Ceram. Soc. 45, 97 (1962)"},
    {"walker", NULL,
     "E. E. Walker, The properties of powders. Part VI. The compressibility of powders, "
     "Trans. Faraday Soc. 19, 73 (1923)"},
    {"adams", NULL,
     "M. J. Adams, M. A. Mullier, J. P. K. Seville, Agglomerate strength measurement using "
     "a uniaxial confined compression test, Powder Technol. 78, 5 (1994)"},
    {"panelli-ambrozio", NULL,
     "R. Panelli, F. Ambrozio Filho, A study of a new phenomenological compacting equation, "
     "Powder Technol. 114, 255 (2001)"},
    {"secondi", NULL,
     "J. Secondi, Modelling powder compaction: from a pressure-density law to continuum "
     "mechanics, Powder Metall. 45, 213 (2002)"},
};

static void cite(struct gb_report *report, const char *text)
{
    if (!g_ptr_array_find_with_equal_func(report->cited, text, g_str_equal, NULL)) {
        g_ptr_array_add(report->cited, g_strdup(text));
    }
}

void gb_report_tables_cite(struct gb_report *report, const char *source)
{
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        /* tags of sources begin with a capital letter, names of laws do not */
        if (g_ascii_isupper(papers[k].tag[0]) && strstr(source, papers[k].tag) != NULL) {
            cite(report, papers[k].text);
        }
    }
}

/* Cites the paper of a normal law or of an equation; fallback: its text where the table has
 * none, NULL: not cited then. */
static void cite_name(struct gb_report *report, const char *name, const char *fallback)
{
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        if (strcmp(papers[k].tag, name) == 0) {
            cite(report, papers[k].text);
            return;
        }
    }
    if (fallback != NULL) {
        cite(report, fallback);
    }
}

static bool is_cited(const struct gb_report *report, const char *text)
{
    return g_ptr_array_find_with_equal_func(report->cited, text, g_str_equal, NULL);
}

/* Whether a cited text is one of the table. */
static bool is_known(const char *text)
{
    bool found = false;
    for (size_t k = 0; k < G_N_ELEMENTS(papers) && !found; k++) {
        found = strcmp(papers[k].text, text) == 0;
    }
    return found;
}

/* The papers of the table in its order, then the other ones in the order of citation. */
bool gb_report_tables_references(struct gb_report *report, struct gb_error *err)
{
    GPtrArray *items = g_ptr_array_new_with_free_func(g_free);
    (void)err;
    for (size_t k = 0; k < G_N_ELEMENTS(papers); k++) {
        if (is_cited(report, papers[k].text)) {
            g_ptr_array_add(
                items, papers[k].name != NULL
                           ? g_strdup_printf("%s: %s.", papers[k].name, papers[k].text)
                           : g_strdup_printf("%s.", papers[k].text));
        }
    }
    for (guint k = 0; k < report->cited->len; k++) {
        const char *text = g_ptr_array_index(report->cited, k);
        if (!is_known(text)) {
            g_ptr_array_add(items, g_strdup_printf("%s.", text));
        }
    }
    gb_page_list(&report->page, items);
    g_ptr_array_unref(items);
    return true;
}

/* Density of the recorded point from which unloading began: the first of loading at or above
 * the pressure.  NaN: there is none. */
static double density_before(const struct gb_runset_run *run, double from_mpa)
{
    double *pressure = NULL;
    double *density = NULL;
    size_t count = 0;
    double found = NAN;
    if (gb_runset_points(run, "load", "p_MPa", "density", &pressure, &density, &count,
                         NULL)) {
        for (size_t k = 0; k < count && isnan(found); k++) {
            found = pressure[k] >= from_mpa ? density[k] : found;
        }
    }
    gb_alloc_free(pressure);
    gb_alloc_free(density);
    return found;
}

/* Of one run, percent; NaN: it has no such branch. */
static double of_run(const struct gb_runset_run *run, const char *branch, double from_mpa)
{
    double *step = NULL;
    double *density = NULL;
    size_t count = 0;
    double value = NAN;
    if (run->table != NULL &&
        gb_runset_points(run, branch, "step", "density", &step, &density, &count, NULL)) {
        value = 100.0 * (density_before(run, from_mpa) / density[count - 1] - 1.0);
    }
    gb_alloc_free(step);
    gb_alloc_free(density);
    return value;
}

/* Relative growth of the volume of a periodic cell on unloading from a pressure to the end of
 * the branch, percent: mean and standard error over the runs of a group (NaN for one).
 * Returns how many have the branch. */
static size_t springback_of(const struct gb_runset *set, size_t group, double from_mpa,
                            double *mean, double *error)
{
    double *values = g_new(double, set->count);
    char *branch = g_strdup_printf("unload:%gMPa", from_mpa);
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            values[count++] = of_run(&set->run[i], branch, from_mpa);
        }
    }
    const size_t used = gb_average_values(values, count, mean, error);
    g_free(branch);
    g_free(values);
    return used;
}

/* Pressures of the first page, MPa. */
static const double results_levels[] = {10.0, 50.0, 100.0, 500.0};

static const double percent = 100.0;

/* A result of a group. */
struct result {
    const char *scene;
    size_t cells;
    double mean, error; /* error NaN: not known */
    const char *unit;
    int decimals;
};

/* Cells from which on the standard error of a mean needs no word on its own error. */
enum { CELLS_ENOUGH = 5 };

/* What the error of a mean is; that of few cells is uncertain by 1/sqrt(2 (n - 1)).  g_free. */
static char *basis_of(size_t cells)
{
    return cells < CELLS_ENOUGH
               ? g_strdup_printf("standard error of %zu cells, itself known to %.0f %%",
                                 cells, 100.0 / sqrt(2.0 * ((double)cells - 1.0)))
               : g_strdup("standard error of the cells");
}

/* basis: what the error is; NULL: the standard error of the cells, where it is known. */
static void put(struct gb_report_table *table, const struct result *result,
                const char *quantity, const char *basis)
{
    const bool known = isfinite(result->error) && result->error > 0.0;
    gb_report_tables_put(table, "%s", result->scene);
    gb_report_tables_put(table, "%s", quantity);
    put_mean_cell(table, result->mean, result->error, result->decimals);
    gb_report_tables_put(table, "%s", result->unit);
    gb_report_tables_put(table, "%zu", result->cells);
    char *of_cells = basis_of(MAX(result->cells, 2));
    gb_report_tables_put(table, "%s",
                         basis != NULL                ? basis
                         : known && result->cells > 1 ? of_cells
                         : known                      ? "expected scatter of one cell"
                                                      : "");
    g_free(of_cells);
}

static void put_densities(struct gb_report_table *table, const struct gb_runset *set,
                          size_t group, const char *scene)
{
    for (size_t k = 0; k < G_N_ELEMENTS(results_levels); k++) {
        struct result result = {.scene = scene, .unit = "1", .decimals = 4};
        result.cells = gb_series_density_at_pressure(set, group, results_levels[k],
                                                     &result.mean, &result.error, NULL);
        if (result.cells > 0) {
            char *quantity =
                g_strdup_printf("relative density at %g MPa", results_levels[k]);
            if (result.cells == 1) {
                result.error =
                    gb_average_cell_scatter(&gb_runset_first(set, group)->params);
            }
            put(table, &result, quantity, NULL);
            g_free(quantity);
        }
    }
}

static void put_springback(struct gb_report_table *table, const struct gb_runset *set,
                           size_t group, const char *scene)
{
    const struct gb_params *params = &gb_runset_first(set, group)->params;
    for (int k = 0; k < params->unload_count; k++) {
        struct result result = {.scene = scene, .unit = "%", .decimals = 2};
        const double from_mpa = 1e-6 * params->unload_from_pa[k];
        result.cells = springback_of(set, group, from_mpa, &result.mean, &result.error);
        if (result.cells > 0) {
            char *quantity =
                g_strdup_printf("springback by volume from %g MPa", from_mpa);
            put(table, &result, quantity, NULL);
            g_free(quantity);
        }
    }
}

static void put_die(struct gb_report_table *table, const struct gb_runset *set,
                    size_t group, const char *scene)
{
    static const char *const names[] = {"axial_in_die_percent", "axial_percent",
                                        "radial_percent"};
    for (const struct gb_die_summary_row *row = gb_die_summary_table(); row->name;
         row++) {
        for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
            struct result result = {.scene = scene, .unit = "%", .decimals = 2};
            if (strcmp(names[k], row->name) != 0) {
                continue;
            }
            result.cells =
                gb_die_summary_mean(row, set, group, &result.mean, &result.error);
            if (result.cells > 0) {
                put(table, &result, row->doc, NULL);
            }
        }
    }
}

/* The state is the last point of the run: moduli.csv may lack it, or end before it. */
static bool is_end(const struct gb_runset_run *run, const struct gb_moduli_state *state)
{
    const double *steps =
        run->table != NULL ? gb_table_column(run->table, "step", NULL) : NULL;
    const size_t rows = steps != NULL ? gb_table_rows(run->table) : 0;
    return rows > 0 &&
           steps[rows - 1] == gb_moduli_table_mean(state, gb_moduli_table_find("step"));
}

/* A modulus of the last state of each run of a group, of those whose moduli.csv has it. */
static void put_modulus(struct gb_report_table *table, const struct gb_runset *set,
                        size_t group, const char *scene, const char *column,
                        const char *quantity)
{
    double *values = g_new(double, set->count);
    struct result result = {.scene = scene,
                            .unit = g_str_has_suffix(column, "_GPa") ? "GPa" : "1",
                            .decimals = 3};
    double own = NAN; /* error over the replicas of one table */
    for (size_t i = 0; i < set->count; i++) {
        GArray *states = g_array_new(FALSE, FALSE, sizeof(struct gb_moduli_state));
        char *path = g_build_filename(set->run[i].directory, GB_MODULI_STATES_FILE, NULL);
        if (set->run[i].group == group && gb_moduli_table_read(states, path, NULL) &&
            states->len > 0) {
            gb_moduli_table_sort(states);
            const struct gb_moduli_state *last =
                &g_array_index(states, struct gb_moduli_state, states->len - 1);
            if (is_end(&set->run[i], last)) {
                values[result.cells++] =
                    gb_moduli_table_mean(last, gb_moduli_table_find(column));
                own = gb_moduli_table_error(last, gb_moduli_table_find(column));
            }
        }
        g_free(path);
        g_array_unref(states);
    }
    gb_average_values(values, result.cells, &result.mean, &result.error);
    if (result.cells > 0) {
        result.error = result.cells == 1 ? own : result.error;
        char *basis = basis_of(MAX(result.cells, 2));
        put(table, &result, quantity,
            result.cells > 1 && result.error > 0.0 ? basis
            : result.error > 0.0                   ? "standard error of the cells"
                                                   : "");
        g_free(basis);
    }
    g_free(values);
}

static void put_moduli(struct gb_report_table *table, const struct gb_runset *set,
                       size_t group, const char *scene)
{
    static const char *const moduli[][2] = {
        {"E_GPa", "Young's modulus of the last state"},
        {"K_GPa", "bulk modulus of the last state"},
        {"G_GPa", "shear modulus of the last state"},
        {"nu", "Poisson's ratio of the last state"}};
    for (size_t k = 0; k < G_N_ELEMENTS(moduli); k++) {
        put_modulus(table, set, group, scene, moduli[k][0], moduli[k][1]);
    }
}

static bool is_unloading(const struct gb_table *data, size_t row)
{
    return gb_table_words(data) != NULL && strcmp(gb_table_words(data), "branch") == 0 &&
           g_str_has_prefix(gb_table_word(data, row), "unload");
}

/* RMS of the density of the group less the measured one at the same pressure. */
static void put_misfit(struct gb_report_table *table, const struct gb_report *report,
                       size_t group, const char *scene)
{
    struct gb_measured *measured = NULL;
    double squares = 0.0;
    size_t points = 0;
    if (!gb_measured_take(&measured, report->data, false, NULL)) {
        return; /* a table of other quantities */
    }
    for (size_t i = 0; i < measured->count; i++) {
        double mean = NAN;
        double error = NAN;
        if (!is_unloading(report->data, i) &&
            gb_series_density_at_pressure(report->set, group,
                                          1e-6 * measured->pressure_pa[i], &mean, &error,
                                          NULL) > 0) {
            squares += pow(mean - measured->density[i], 2.0);
            points++;
        }
    }
    if (points > 0) {
        const struct result result = {scene,
                                      gb_runset_members(report->set, group),
                                      percent * sqrt(squares / (double)points),
                                      NAN,
                                      "% of theoretical density",
                                      2};
        char *basis =
            g_strdup_printf("%zu of %zu measured points", points, measured->count);
        put(table, &result, "RMS misfit to the laboratory file", basis);
        g_free(basis);
    }
    gb_measured_destroy(measured);
}

static bool write_conditions(struct gb_report *report, struct gb_error *err)
{
    const char *heads[CONDITIONS + 2] = {"scene"};
    struct gb_report_table table;
    for (int k = 0; k < CONDITIONS; k++) {
        heads[k + 1] = report_conditions_heads[k];
    }
    gb_report_tables_begin(&table, heads);
    for (size_t g = 0; g < report->set->groups; g++) {
        char *scene = scene_of(report->set, g);
        gb_report_tables_put(&table, "%s", scene);
        for (int k = 0; k < CONDITIONS; k++) {
            char *value = condition_of(report->set, g, k);
            gb_report_tables_put(&table, "%s", value);
            g_free(value);
        }
        g_free(scene);
    }
    return gb_report_tables_end(report, &table, "conditions", "Conditions of the scenes.",
                                err);
}

bool gb_report_tables_results(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "quantity", "value", "unit",
                                        "cells", "error",    NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    if (!write_conditions(report, err)) {
        return false;
    }
    gb_report_tables_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        char *scene = scene_of(set, g);
        put_densities(&table, set, g, scene);
        put_springback(&table, set, g, scene);
        put_die(&table, set, g, scene);
        put_moduli(&table, set, g, scene);
        if (report->data != NULL) {
            put_misfit(&table, report, g, scene);
        }
        g_free(scene);
    }
    char *caption = report_caption(
        report,
        "Key results on loading, with errors. The scatter expected of one cell is "
        "the standard deviation from structure to structure, measured for 3D "
        "quasi-static cells (0.0064 for 1000 particles).");
    const bool good = gb_report_tables_end(report, &table, "results", caption, err);
    g_free(caption);
    return good;
}

/* Pressures of the table of densities, MPa. */
static const double levels[] = {10.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0};

/* With the conditions behind its caption. */
static bool end_table(struct gb_report *report, struct gb_report_table *table,
                      const char *name, const char *text, struct gb_error *err)
{
    char *caption = report_caption(report, text);
    const bool good = gb_report_tables_end(report, table, name, caption, err);
    g_free(caption);
    return good;
}

static bool density_table(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "runs", "p (MPa)", "relative density",
                                        NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    gb_report_tables_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        char *name = scene_of(set, g);
        for (size_t k = 0; k < G_N_ELEMENTS(levels); k++) {
            double mean = NAN;
            double error = NAN;
            const size_t cells =
                gb_series_density_at_pressure(set, g, levels[k], &mean, &error, NULL);
            if (cells > 0) {
                gb_report_tables_put(&table, "%s", name);
                gb_report_tables_put(&table, "%zu", cells);
                gb_report_tables_put(&table, "%g", levels[k]);
                put_mean_cell(&table, mean, error, 4);
            }
        }
        g_free(name);
    }
    return end_table(report, &table, "density",
                     "Relative density where loading first reaches a pressure; mean and "
                     "standard error over the runs.",
                     err);
}

/* Last row of a branch; the number of rows when there is none. */
static size_t last_row(const struct gb_table *table, const char *branch)
{
    size_t found = gb_table_rows(table);
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        if (strcmp(gb_table_word(table, k), branch) == 0) {
            found = k;
        }
    }
    return found;
}

/* Did the run stop before the end of the branch that it recorded last? */
static bool stopped_in(const struct gb_runset_run *run, size_t row)
{
    char *status = g_build_filename(run->directory, "status.json", NULL);
    const bool stopped = row + 1 == gb_table_rows(run->table) &&
                         g_file_test(status, G_FILE_TEST_EXISTS) &&
                         !gb_status_json_is_done(status);
    g_free(status);
    return stopped;
}

/* A run that stopped early is at another state than its replicas: it is left out of means. */
static void put_mean(struct gb_report_table *table, const struct gb_runset *set,
                     size_t group, const char *branch, const char *column, int decimals)
{
    const bool replicas = gb_runset_members(set, group) > 1;
    double *values = g_new(double, set->count + 1);
    size_t filled = 0;
    double mean = NAN;
    double error = NAN;
    for (size_t i = 0; i < set->count; i++) {
        const struct gb_runset_run *run = &set->run[i];
        const double *cells =
            run->table != NULL ? gb_table_column(run->table, column, NULL) : NULL;
        if (run->group == group && cells != NULL) {
            const size_t row = last_row(run->table, branch);
            if (row < gb_table_rows(run->table) && !(replicas && stopped_in(run, row))) {
                values[filled++] = cells[row];
            }
        }
    }
    gb_average_values(values, filled, &mean, &error);
    put_mean_cell(table, mean, error, decimals);
    g_free(values);
}

/* Branches of the first run of a group, in their order. */
static GPtrArray *branches_of(const struct gb_runset_run *run)
{
    GPtrArray *names = g_ptr_array_new();
    for (size_t k = 0; run->table != NULL && k < gb_table_rows(run->table); k++) {
        const char *word = gb_table_word(run->table, k);
        if (!g_ptr_array_find_with_equal_func(names, word, g_str_equal, NULL)) {
            g_ptr_array_add(names, (char *)(uintptr_t)word);
        }
    }
    return names;
}

static bool ends_table(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {
        "scene",        "branch",           "relative density", "p (MPa)",
        "coordination", "bridged fraction", "rattlers",         NULL};
    const struct gb_runset *set = report->set;
    struct gb_report_table table;
    gb_report_tables_begin(&table, heads);
    for (size_t g = 0; g < set->groups; g++) {
        GPtrArray *branches = branches_of(gb_runset_first(set, g));
        char *name = scene_of(set, g);
        for (guint b = 0; b < branches->len; b++) {
            const char *branch = g_ptr_array_index(branches, b);
            gb_report_tables_put(&table, "%s", name);
            gb_report_tables_put(&table, "%s", branch);
            put_mean(&table, set, g, branch, "density", 4);
            put_mean(&table, set, g, branch, "p_MPa", 1);
            put_mean(&table, set, g, branch, "coordination", 3);
            put_mean(&table, set, g, branch, "bridged", 3);
            put_mean(&table, set, g, branch, "rattlers", 4);
        }
        g_free(name);
        g_ptr_array_unref(branches);
    }
    return end_table(report, &table, "ends",
                     "Last point of each branch; mean and standard error over the runs "
                     "that reached its end.",
                     err);
}

bool gb_report_tables_densities(struct gb_report *report, struct gb_error *err)
{
    return density_table(report, err) && ends_table(report, err);
}

/* A number, or an empty cell for an end without bound. */
static void put_number(struct gb_report_table *table, double value)
{
    if (isfinite(value)) {
        gb_report_tables_put(table, "%.4g", value);
    } else {
        gb_report_tables_put(table, "%s", "");
    }
}

static void put_fit(struct gb_report_table *table, const char *scene,
                    const struct gb_compaction_fits *fits, size_t index)
{
    const struct gb_compaction_fit *row = &fits->fit[index];
    for (size_t k = 0; k < gb_compaction_fits_values(fits, index); k++) {
        const struct gb_compaction_value value = gb_compaction_fits_value(fits, index, k);
        gb_report_tables_put(table, "%s", scene);
        gb_report_tables_put(table, "%s", row->equation->name);
        gb_report_tables_put(table, "%.1f", row->delta);
        gb_report_tables_put(table, "%.2g", row->all.rms);
        gb_report_tables_put(table, "%s", value.name);
        put_number(table, value.value.value);
        put_number(table, value.value.low);
        put_number(table, value.value.high);
        gb_report_tables_put(table, "%s", value.unit);
    }
}

/* What is fitted, to which points, and Heckel's stretch. */
static void describe(struct gb_report *report, const char *scene,
                     const struct gb_compaction_data *data,
                     const struct gb_compaction_fits *fits)
{
    const struct gb_equations_points *points = &data->points;
    GString *text = g_string_new(scene);
    g_string_append_printf(text, ": %zu pressures from %.4g to %.4g MPa", points->count,
                           points->pressure[0], points->pressure[points->count - 1]);
    if (fits->heckel.equation != NULL) {
        g_string_append_printf(
            text, "; Heckel on the straightest stretch, %.4g to %.4g MPa",
            points->pressure[fits->stretch.first],
            points->pressure[fits->stretch.first + fits->stretch.count - 1]);
    }
    g_string_append_c(text, '.');
    gb_page_paragraph(&report->page, text->str);
    g_string_free(text, TRUE);
}

static bool add_group(struct gb_report *report, struct gb_report_table *table,
                      size_t group, struct gb_error *err)
{
    static const struct gb_compaction_window window = {
        .from = (double)NAN, .to = (double)NAN, .initial = (double)NAN};
    struct gb_compaction_data data = {0};
    struct gb_compaction_fits fits;
    struct gb_error cause = {0};
    if (!gb_compaction_data_runs(&data, report->set, group, &window, &cause)) {
        return cause.code == GB_ERR_INPUT ||
               gb_error_set(err, cause.code, "%s", cause.text);
    }
    const bool good =
        gb_compaction_fits(&fits, &data.points, NULL, GB_COMPACTION_PROFILE, err);
    if (good) {
        char *scene = scene_of(report->set, group);
        describe(report, scene, &data, &fits);
        for (size_t i = 0; i < fits.fitted; i++) {
            const struct gb_equation *equation = fits.fit[i].equation;
            put_fit(table, scene, &fits, i);
            cite_name(report, equation->name, equation->source);
        }
        g_free(scene);
    }
    gb_compaction_data_finish(&data);
    return good;
}

bool gb_report_tables_fits(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "equation", "dAICc", "rms",  "parameter",
                                        "value", "low",      "high",  "unit", NULL};
    struct gb_report_table table;
    bool good = true;
    gb_report_tables_begin(&table, heads);
    for (size_t g = 0; g < report->set->groups && good; g++) {
        good = add_group(report, &table, g, err);
    }
    char *caption = report_caption(
        report, "Equations of compaction by AICc, least squares in the density: "
                "parameters with 95 % intervals; an empty cell has no bound.");
    const bool written =
        gb_report_tables_end(report, &table, "fits", caption, good ? err : NULL);
    g_free(caption);
    return written && good;
}

/* Keys that say nothing about the model. */
static bool is_housekeeping(const struct gb_field *field)
{
    return strcmp(field->group, "output") == 0 || strcmp(field->key, "title") == 0 ||
           strcmp(field->key, "threads") == 0 || strcmp(field->key, "seed") == 0;
}

/* Values of a key in the groups that use it, each once. */
static GPtrArray *values_of(const struct gb_runset *set, const struct gb_field *field)
{
    GPtrArray *values = g_ptr_array_new_with_free_func(g_free);
    char *buffer = g_malloc(GB_PARAMS_VALUE_MAX);
    for (size_t g = 0; g < set->groups; g++) {
        const struct gb_params *params = &gb_runset_first(set, g)->params;
        if (!gb_field_applies(field, params)) {
            continue;
        }
        gb_params_format(params, field, buffer, GB_PARAMS_VALUE_MAX);
        if (*buffer != '\0' &&
            !g_ptr_array_find_with_equal_func(values, buffer, g_str_equal, NULL)) {
            g_ptr_array_add(values, g_strdup(buffer));
        }
    }
    g_free(buffer);
    return values;
}

/* "9.7 nm" -> "9.7" and "nm"; the unit stays with a list or a word. */
static const char *split_unit(const struct gb_field *field, char *value)
{
    char *blank = strchr(value, ' ');
    const bool number =
        field->type == GB_FIELD_NUMBER || field->type == GB_FIELD_RELATIVE;
    if (!number || blank == NULL) {
        return number && g_ascii_isdigit(value[0]) ? "1" : "";
    }
    *blank = '\0';
    return blank + 1;
}

/* Values of one unit share it; others keep theirs. */
static void put_values(struct gb_report_table *table, const struct gb_field *field,
                       GPtrArray *values)
{
    char *unit = NULL;
    GString *numbers = g_string_new(NULL);
    bool one_unit = true;
    for (guint k = 0; k < values->len; k++) {
        char *value = g_strdup(g_ptr_array_index(values, k));
        const char *own = split_unit(field, value);
        one_unit = one_unit && (unit == NULL || strcmp(unit, own) == 0);
        unit = unit != NULL ? unit : g_strdup(own);
        g_string_append_printf(numbers, "%s%s", k > 0 ? "; " : "", value);
        g_free(value);
    }
    if (!one_unit) {
        g_string_truncate(numbers, 0);
        for (guint k = 0; k < values->len; k++) {
            g_string_append_printf(numbers, "%s%s", k > 0 ? "; " : "",
                                   (const char *)g_ptr_array_index(values, k));
        }
    }
    gb_report_tables_put(table, "%s", numbers->str);
    gb_report_tables_put(table, "%s", one_unit && unit != NULL ? unit : "");
    g_string_free(numbers, TRUE);
    g_free(unit);
}

static void put_key(struct gb_report *report, struct gb_report_table *table,
                    const struct gb_field *field)
{
    GPtrArray *values = values_of(report->set, field);
    if (values->len > 0) {
        const char *symbol = field->symbol;
        gb_report_tables_put(table, "%s.%s", field->group, field->key);
        gb_report_tables_put(table, "%s", symbol != NULL ? symbol : "");
        put_values(table, field, values);
        gb_report_tables_put(table, "%s", field->meaning);
        gb_report_tables_put(table, "%s", field->source);
        gb_report_tables_cite(report, field->source);
    }
    g_ptr_array_unref(values);
}

bool gb_report_tables_keys(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"key",     "symbol", "value", "unit",
                                        "meaning", "source", NULL};
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    struct gb_report_table table;
    gb_report_tables_begin(&table, heads);
    table.markup = 1;
    for (size_t k = 0; k < count; k++) {
        if (!is_housekeeping(&fields[k])) {
            put_key(report, &table, &fields[k]);
        }
    }
    for (size_t g = 0; g < report->set->groups; g++) {
        cite_name(report,
                  gb_normal_law_of(&gb_runset_first(report->set, g)->params)->name, NULL);
    }
    return gb_report_tables_end(
        report, &table, "keys",
        "Keys that these scenes use; lengths in d are multiples of "
        "the particle diameter, stresses in E of Young's modulus, "
        "times in T of the reduced time.",
        err);
}
