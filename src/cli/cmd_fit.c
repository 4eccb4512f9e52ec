/* `greenbody fit`: fits compaction equations to runs or to a laboratory table.  It
 * prints the parameters with intervals as text or CSV, ordered by AICc, and can draw
 * the figure of the same data. */
#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/listing.h"
#include "base/units.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/lab_input.h"
#include "cli/options.h"
#include "figures/figures.h"
#include "figures/plotting.h"
#include "figures/series.h"
#include "many/compaction_data.h"
#include "measure/compaction_fits.h"

static void add_row(struct gb_listing *listing, const char *equation, const char *name,
                    const struct gb_fit_value *value, const char *unit)
{
    gb_listing_text(listing, equation);
    gb_listing_text(listing, name);
    gb_listing_number(listing, value->value);
    gb_listing_number(listing, value->low);
    gb_listing_number(listing, value->high);
    gb_listing_text(listing, unit);
}

/* Adds a number without an interval. */
static void add_figure(struct gb_listing *listing, const char *equation, const char *name,
                       double value, const char *unit)
{
    const struct gb_fit_value row = {value, NAN, NAN, NAN};
    add_row(listing, equation, name, &row, unit);
}

/* The ends of Heckel's linear range, MPa. */
static void stretch_ends(const struct gb_compaction_fits *fits,
                         const struct gb_equations_points *points, double ends[2])
{
    ends[0] = points->pressure[fits->stretch.first];
    ends[1] = points->pressure[fits->stretch.first + fits->stretch.count - 1];
}

static bool is_heckel(const struct gb_compaction_fits *fits, size_t index)
{
    return gb_compaction_fits_reported(fits, index) == &fits->heckel;
}

/* Rows equation,parameter,value,low,high,unit by ascending AICc: the parameters, the
 * ends of Heckel's linear range, rms and AICc of each fitted equation.  Cells are empty
 * if there is no interval or no end. */
static struct gb_listing *listing_of(const struct gb_compaction_fits *fits,
                                     const struct gb_compaction_data *data)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%s", "equation,parameter");
    gb_listing_columns(listing, "", "value,low,high");
    gb_listing_columns(listing, "%s", "unit");
    for (size_t i = 0; i < fits->fitted; i++) {
        const char *name = fits->fit[i].equation->name;
        for (size_t k = 0; k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            add_row(listing, name, value.name, &value.value, value.unit);
        }
        if (is_heckel(fits, i)) {
            double ends[2];
            stretch_ends(fits, &data->points, ends);
            add_figure(listing, name, "stretch_from", ends[0], "MPa");
            add_figure(listing, name, "stretch_to", ends[1], "MPa");
        }
        add_figure(listing, name, "rms", fits->fit[i].all.rms, "1");
        add_figure(listing, name, "aicc", fits->fit[i].all.aicc, "1");
    }
    return listing;
}

/* Describes the fit and its data. */
static void append_head(GString *text, const struct gb_compaction_data *data)
{
    const struct gb_equations_points *points = &data->points;
    if (data->curves > 0) {
        g_string_append_printf(text, "%zu run%s, ", data->curves,
                               data->curves == 1 ? "" : "s");
    }
    g_string_append_printf(
        text, "%zu points from %.4g to %.4g MPa, density %.4f to %.4f\n", points->count,
        points->pressure[0], points->pressure[points->count - 1], points->density[0],
        points->density[points->count - 1]);
    g_string_append_printf(text, "weights: %s; initial density D0: ",
                           points->error == NULL ? "equal"
                           : data->curves > 0    ? "standard errors of the replicas"
                                                 : "errors of the densities");
    if (isnan(points->initial)) {
        g_string_append(text, "unknown, fitted\n");
    } else {
        g_string_append_printf(text, "%.4g\n", points->initial);
    }
    g_string_append(text, "least squares in the density, 95 % intervals; dAICc: 0 is the "
                          "best description\n\n");
}

static void append_value(GString *text, const struct gb_compaction_value *value)
{
    g_string_append_printf(text, "  %-15s %12.5g", value->name, value->value.value);
    g_string_append_printf(text, "   %12.5g to %-12.5g %s\n", value->value.low,
                           value->value.high,
                           strcmp(value->unit, "1") == 0 ? "" : value->unit);
}

/* The result as text, with the data and the reasons why equations were not fitted. */
static GString *fit_output_text(const struct gb_compaction_fits *fits,
                                const struct gb_compaction_data *data)
{
    GString *text = g_string_new(NULL);
    append_head(text, data);
    for (size_t i = 0; i < fits->fitted; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        g_string_append_printf(text, "%s: dAICc %.1f, rms %.2g   %s\n",
                               row->equation->name, row->delta, row->all.rms,
                               row->equation->form);
        if (is_heckel(fits, i)) {
            double ends[2];
            stretch_ends(fits, &data->points, ends);
            g_string_append_printf(text,
                                   "  straightest stretch: %.4g to %.4g MPa, %zu points, "
                                   "R2 %.6f\n",
                                   ends[0], ends[1], fits->stretch.count,
                                   fits->stretch.determination);
        }
        for (size_t k = 0; k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            append_value(text, &value);
        }
    }
    for (size_t i = fits->fitted; i < fits->count; i++) {
        g_string_append_printf(text, "%s%s\n", i == fits->fitted ? "\nnot fitted:\n" : "",
                               fits->fit[i].refusal.text);
    }
    return text;
}

enum { DIRECTORIES_MAX = 1000 };

/* The options of the command line. */
struct request {
    char *equation, *from, *to, *initial, *output;
    struct gb_lab_input lab;
    gboolean csv, json, force;
    const struct gb_equation *only; /* NULL: all */
    struct gb_compaction_window window;
};

static bool parse_equation(struct request *request, struct gb_error *err)
{
    request->only =
        request->equation != NULL ? gb_equations_find(request->equation) : NULL;
    if (request->equation == NULL || request->only != NULL) {
        return true;
    }
    GString *names = g_string_new(NULL);
    for (size_t i = 0; i < gb_equations_count(); i++) {
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "",
                               gb_equations_at(i)->name);
    }
    gb_error_set(err, GB_ERR_INPUT, "--equation %.80s: expected %s", request->equation,
                 names->str);
    g_string_free(names, TRUE);
    return false;
}

static bool parse_pressure(const char *option, const char *text, double *to,
                           struct gb_error *err)
{
    double pascal = 0.0;
    *to = NAN;
    if (text == NULL) {
        return true;
    }
    const bool good =
        gb_units_parse(text, GB_DIM_PRESSURE, &pascal, NULL) && pascal > 0.0;
    *to = 1e-6 * pascal;
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "%s %.80s: expected a pressure above 0 with its unit, as "
                                "in \"20 MPa\"",
                                option, text);
}

static bool parse_initial(struct request *request, struct gb_error *err)
{
    double *initial = &request->window.initial;
    *initial = NAN;
    if (request->initial == NULL) {
        return true;
    }
    request->window.fits_initial = strcmp(request->initial, "fit") == 0;
    return request->window.fits_initial ||
           (gb_units_parse(request->initial, GB_DIM_NONE, initial, NULL) &&
            *initial > 0.0 && *initial < 1.0) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--initial %.80s: expected a relative density between 0 and 1, or "
               "fit",
               request->initial);
}

static enum gb_plotting_existing existing_files(const struct request *request)
{
    return request->force ? GB_PLOTTING_REPLACE : GB_PLOTTING_KEEP;
}

static bool parse(struct request *request, struct gb_error *err)
{
    return parse_equation(request, err) &&
           parse_pressure("--from", request->from, &request->window.from, err) &&
           parse_pressure("--to", request->to, &request->window.to, err) &&
           parse_initial(request, err) &&
           (request->output == NULL ||
            gb_plotting_check(request->output, existing_files(request), err));
}

static bool read_runs(struct gb_compaction_data *data, const struct request *request,
                      char **words, struct gb_error *err)
{
    static const char *const none[] = {NULL};
    struct gb_runset set = {0};
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    for (size_t i = 0; words[i] != NULL; i++) {
        gb_runset_expand(list, words[i]);
    }
    bool good = (list->len <= DIRECTORIES_MAX ||
                 gb_error_set(err, GB_ERR_INPUT, "fit takes up to %d run directories",
                              DIRECTORIES_MAX)) &&
                gb_runset_read(&set, (char *const *)list->pdata, list->len, err);
    if (good && set.groups > 1) {
        const struct gb_field *field = gb_runset_difference(&set, 0, 1, none);
        good = gb_error_set(
            err, GB_ERR_INPUT,
            "%.200s: another scene than %.200s (%s.%s): expected runs of "
            "one scene, which are replicas",
            gb_runset_first(&set, 1)->directory, gb_runset_first(&set, 0)->directory,
            field != NULL ? field->group : "", field != NULL ? field->key : "");
    }
    const char *option = gb_lab_input_given(&request->lab);
    if (good && option != NULL) {
        good = gb_error_set(err, GB_ERR_INPUT, "--%s is for a file of measured points",
                            option);
    }
    good = good && gb_compaction_data_runs(data, &set, 0, &request->window, err);
    gb_runset_finish(&set);
    g_ptr_array_unref(list);
    return good;
}

static bool read_file(struct gb_compaction_data *data, const struct request *request,
                      const char *path, struct gb_error *err)
{
    struct gb_table *table = NULL;
    const bool good =
        gb_lab_input_read(&table, &request->lab, path, NULL, err) &&
        gb_compaction_data_file(data, table, request->lab.series, &request->window, err);
    gb_table_destroy(table);
    return good;
}

static bool read_data(struct gb_compaction_data *data, const struct request *request,
                      char **words, struct gb_error *err)
{
    if (words[0] == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "fit takes run directories of one scene, or one file of "
                            "measured points");
    }
    if (!g_file_test(words[0], G_FILE_TEST_IS_REGULAR)) {
        return read_runs(data, request, words, err);
    }
    return words[1] == NULL
               ? read_file(data, request, words[0], err)
               : gb_error_set(err, GB_ERR_INPUT,
                              "%.200s: one file of measured points at a time", words[0]);
}

/* Prints a line on stderr for each equation that is missing in the CSV. */
static void print_refusals(const struct gb_compaction_fits *fits)
{
    for (size_t i = fits->fitted; i < fits->count; i++) {
        gb_visible_line(stderr, "greenbody: %s", fits->fit[i].refusal.text);
    }
}

/* Draws the figure of the fits and writes its data next to it. */
static bool write_figure(const struct gb_series_powder *one,
                         const struct request *request, struct gb_error *err)
{
    const struct gb_figures_row *row = gb_figures_find("fit");
    const struct gb_plotting_page page = {.width = 1600,
                                          .height = 1200,
                                          .name = row->name,
                                          .existing = existing_files(request)};
    struct gb_series series = {0};
    bool good = gb_series_powder_fit(&series, one, 1, err);
    if (good) {
        gb_figures_axes(row, &series);
        good = gb_plotting_write(&series, &page, request->output, err);
    }
    gb_series_finish(&series);
    return good;
}

static bool print_fits(const struct gb_series_powder *one, bool csv, bool json,
                       struct gb_error *err)
{
    if (csv || json) {
        print_refusals(&one->fits);
    }
    if (!csv && !json) {
        return gb_options_print(fit_output_text(&one->fits, &one->data), err);
    }
    return gb_options_print(gb_listing_end(listing_of(&one->fits, &one->data),
                                           json ? GB_LISTING_JSON : GB_LISTING_CSV),
                            err);
}

static bool fit(struct request *request, char **words, struct gb_error *err)
{
    struct gb_compaction_data data = {0};
    struct gb_series_powder one = {0};
    const bool good =
        parse(request, err) && read_data(&data, request, words, err) &&
        gb_series_powder_init(&one, &data, request->only,
                              data.curves > 0 ? "simulated" : "measured", err) &&
        (request->output == NULL || write_figure(&one, request, err)) &&
        print_fits(&one, request->csv, request->json, err);
    gb_series_powder_finish(&one);
    return good;
}

/* The list of equations for the help, after the options. */
static char *describe_equations(void)
{
    GString *text = g_string_new("Equations (P pressure in MPa, rho relative density, D0 "
                                 "initial density, C = 1 - D0/rho):\n");
    for (size_t i = 0; i < gb_equations_count(); i++) {
        const struct gb_equation *equation = gb_equations_at(i);
        g_string_append_printf(text, "  %-18s %s\n  %-18s %s\n", equation->name,
                               equation->form, "", equation->source);
    }
    g_string_append(
        text,
        "\nThe density is fitted as a function of the pressure, at the same points for "
        "all\nequations.  Runs of one scene are replicas: their mean at up to 48 "
        "pressures, weighted\nby its standard errors.  Heckel's parameters belong to "
        "the straightest stretch of\nthe Heckel plot, dAICc and rms to all "
        "points.  A file of this program has the\ncolumns density (or density_percent) "
        "and p_MPa (or pressure_MPa; Pa, kPa, GPa), and\noptionally density_error, branch "
        "(load, unload), series.\n\n");
    g_string_append(text, gb_lab_input_help);
    return g_string_free(text, FALSE);
}

int gb_cmd_fit(int argc, char **argv)
{
    struct request request = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry own[] = {
        {"equation", 0, 0, G_OPTION_ARG_STRING, &request.equation,
         "one of those below (all)", "NAME"},
        {"csv", 0, 0, G_OPTION_ARG_NONE, &request.csv,
         "print equation,parameter,value,low,high,unit", NULL},
        gb_options_json(&request.json),
        {"from", 0, 0, G_OPTION_ARG_STRING, &request.from,
         "lowest pressure (runs: 1 % of the highest; file: its lowest)", "P"},
        {"to", 0, 0, G_OPTION_ARG_STRING, &request.to,
         "highest pressure (the highest that all runs reach)", "P"},
        {"initial", 0, 0, G_OPTION_ARG_STRING, &request.initial,
         "initial density, or fit (runs: before loading; file: at pressure 0, else fit)",
         "D0"},
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request.output,
         "the figure fit of these points, too", "FILE.png|svg|pdf|csv"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request.force, "replace an existing file",
         NULL},
        {0},
    };
    GOptionEntry *entries = gb_lab_input_entries(&request.lab, own);
    char *equations = describe_equations();
    const struct gb_options_page page = {
        .usage = "DIR... or FILE.csv",
        .summary = "Fits equations of compaction to runs of one scene, or to measured "
                   "points:\nparameters with 95 % intervals, ranked by AICc.",
        .description = equations,
    };
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = fit(&request, words, &err) ? 0 : gb_options_fail(&err);
    }
    char *const texts[] = {request.equation, request.from,   request.to,
                           request.initial,  request.output, equations};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_free(texts[k]);
    }
    g_free(entries);
    gb_lab_input_finish(&request.lab);
    g_strfreev(words);
    return status;
}
