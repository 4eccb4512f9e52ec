#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output/bench_output.h"
#include "cli/output/json_output.h"

static const struct gb_options_page page = {
    .usage = "[PRESET] [group.key=value]...",
    .summary =
        "Measures the speed of the engine on this machine: the initial structure; one\n"
        "force evaluation with its move (forces, torques, history, relaxer) on one\n"
        "core and on all of them, at a coordination number of a pressed packing, of\n"
        "1000 particles, in double precision and of many sizes; a checkpoint, written\n"
        "in TMPDIR; the planar dynamic scene of P2 at density 0.9; and the bed of P3\n"
        "at 50 MPa in its die.",
    .description =
        "Without a preset: 8000 particles of 9.7 nm with bridges (P1, set II).\n"
        "Times are medians of 5 rounds, in which the rows of a kind are timed in turn;\n"
        "behind +- half of the range of the rounds.  --compare calls a row better or\n"
        "worse where it changed by more than both ranges and by more than 3 %.",
};

/* Time of an evaluation with and without terms of the contact laws. */
static bool report_terms(const struct gb_params *params, double coordination,
                         gboolean csv, GString *text, struct gb_error *err)
{
    struct gb_bench_term term[GB_BENCH_TERMS];
    if (!gb_bench_terms(term, params, coordination, err)) {
        return false;
    }
    const double micro = 1e6 / (double)params->count;
    g_string_append(text, csv ? "terms,us_per_particle,share,spread\n"
                              : "evaluation and move on one core\n");
    for (int i = 0; i < GB_BENCH_TERMS; i++) {
        const struct gb_bench_figure time =
            gb_bench_figure_scaled(term[i].evaluation, micro);
        const double share = time.value / (micro * term[0].evaluation.value);
        if (isfinite(time.value) && csv) {
            g_string_append_printf(text, "%s,%.6g,%.4g,%.3g\n", term[i].name, time.value,
                                   share, time.spread);
        } else if (isfinite(time.value)) {
            g_string_append_printf(
                text, "  %-30s %8.4g +- %.1g us per particle, %5.3g of all\n",
                term[i].name, time.value, time.spread, share);
        }
    }
    return true;
}

enum { SIZES_MAX = 16 };

/* "1000, 8000": 2 to 16 numbers of particles. */
static bool read_sizes(const char *text, struct gb_bench_cell *size, size_t *sizes,
                       struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", SIZES_MAX + 1);
    bool good = g_strv_length(parts) >= 2 && g_strv_length(parts) <= SIZES_MAX;
    *sizes = 0;
    for (char **part = parts; *part && good; part++) {
        good = g_ascii_string_to_signed(g_strstrip(*part), 10, 10, 10000000,
                                        &size[*sizes].params.count, NULL) &&
               (*sizes == 0 || size[*sizes].params.count > size[*sizes - 1].params.count);
        ++*sizes;
    }
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--sizes %s: must be 2 to %d growing numbers of "
                                "particles from 10 to 10000000, with commas between",
                                text, SIZES_MAX);
}

/* Progress on stderr. */
static void print_progress(void *data, const struct gb_bench_cell *cell, int round)
{
    const struct gb_bench_cell *last = data;
    if (round == 0) {
        gb_visible_line(stderr, "%lld particles: packing ready",
                        (long long)cell->params.count);
    } else if (cell == last) {
        gb_visible_line(stderr, "round %d of %d", round, GB_BENCH_ROUNDS);
    }
}

static void print_sizes(GString *text, const struct gb_bench_cell *size, size_t sizes,
                        gboolean csv)
{
    double particles[SIZES_MAX], one[SIZES_MAX], all[SIZES_MAX];
    g_string_append(
        text, csv ? "particles,coordination,one_core_us,all_cores_us,bytes\n"
                  : " particles   coordination   one core   all cores, us   bytes per "
                    "particle\n");
    for (size_t i = 0; i < sizes; i++) {
        particles[i] = (double)size[i].params.count;
        one[i] = size[i].one.value;
        all[i] = size[i].all.value;
        const double micro = 1e6 / particles[i];
        g_string_append_printf(text,
                               csv ? "%.0f,%.4g,%.5g,%.5g,%.5g\n"
                                   : "%10.0f   %12.4g   %8.4g   %13.4g   %16.4g\n",
                               particles[i], size[i].coordination, micro * one[i],
                               micro * all[i], size[i].bytes_per_particle);
    }
    g_string_append_printf(text,
                           csv ? "exponent,,%.4f,%.4f,\n"
                               : "exponent of the cost        %11.3f   %13.3f\n",
                           gb_bench_exponent(particles, one, sizes),
                           gb_bench_exponent(particles, all, sizes));
}

/* Cost of an evaluation against the number of particles. */
static bool report_sizes(const struct gb_params *params, const char *list,
                         double coordination, gboolean csv, GString *text,
                         struct gb_error *err)
{
    struct gb_bench_cell size[SIZES_MAX];
    size_t sizes = 0;
    for (int i = 0; i < SIZES_MAX; i++) {
        size[i] = (struct gb_bench_cell){.params = *params};
    }
    if (!read_sizes(list, size, &sizes, err) ||
        !gb_bench_cells_run(size, sizes, coordination, print_progress, &size[sizes - 1],
                            err)) {
        return false;
    }
    for (size_t i = 0; i < sizes; i++) {
        if (!size[i].same_bits) {
            return gb_error_set(err, GB_ERR_GUARD,
                                "%lld particles: other bits on one core than on all",
                                (long long)size[i].params.count);
        }
    }
    print_sizes(text, size, sizes, csv);
    return true;
}

/* The options of the command line. */
struct request {
    char **sets, **words;
    char *sizes, *compare;
    gboolean csv, json, terms, roofline;
    GString *text;
    double coordination;
};

static bool check_request(const struct request *request, struct gb_error *err)
{
    if (!(request->coordination > 0.0 && request->coordination < 12.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "--coordination %g: must be between 0 and 12",
                            request->coordination);
    }
    const int tables =
        !!request->terms + !!request->sizes + !!request->roofline + !!request->compare;
    if (tables > 1) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--terms, --sizes, --roofline, --compare: accepted one of them");
    }
    return !(request->compare && (request->csv || request->json)) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--compare: accepted without --csv and --json");
}

static void print_table(const struct request *request,
                        const struct gb_bench_output_rows *rows)
{
    (request->csv || request->json ? gb_bench_output_csv
                                   : gb_bench_output_table)(request->text, rows);
}

static bool report_roofline(const struct request *request, const struct gb_params *params,
                            struct gb_error *err)
{
    struct gb_bench_roofline roofline;
    struct gb_bench_output_rows rows;
    if (!gb_bench_roofline_run(&roofline, params, request->coordination, err)) {
        return false;
    }
    gb_bench_output_roofline(&roofline, (double)params->count, &rows);
    print_table(request, &rows);
    return true;
}

static bool measure_all(struct gb_bench_output_figures *figures,
                        const struct gb_params *params, double coordination,
                        struct gb_error *err)
{
    const int cores = (int)g_get_num_processors();
    figures->planar_all = (struct gb_bench_figure){NAN, NAN};
    if (!gb_bench_plan(figures->cell, params, err)) {
        return false;
    }
    figures->cell[GB_BENCH_SCENE].state = &figures->state;
    return gb_bench_cells_run(figures->cell, GB_BENCH_CELLS, coordination, NULL, NULL,
                              err) &&
           gb_bench_planar(1, &figures->planar, err) &&
           (cores < 2 || gb_bench_planar(cores, &figures->planar_all, err)) &&
           gb_bench_die_run(&figures->die, err);
}

static bool report_all(const struct request *request, const struct gb_params *params,
                       struct gb_error *err)
{
    struct gb_bench_output_figures figures;
    struct gb_bench_output_rows rows;
    struct gb_bench_change change[GB_BENCH_OUTPUT_ROWS];
    const struct gb_bench_row scene = {"particles", (double)params->count, 0.0, "",
                                       GB_BENCH_FACT};
    if (request->compare && /* before a minute of measuring */
        !gb_bench_compare(request->compare, &scene, 1, change, err)) {
        return false;
    }
    if (!measure_all(&figures, params, request->coordination, err)) {
        return false;
    }
    gb_bench_output_figures(&figures, &rows);
    if (request->compare &&
        !gb_bench_compare(request->compare, rows.row, rows.count, change, err)) {
        return false;
    }
    if (request->compare) {
        gb_bench_output_changes(request->text, &rows, change);
    } else {
        print_table(request, &rows);
    }
    return true;
}

static bool measure(const struct request *request, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_options_scene(&preset, request->words, request->sets,
                          GB_OPTIONS_PRESET_OPTIONAL, err)) {
        return false;
    }
    struct gb_params *params = gb_preset_params(preset);
    if (request->words[0] == NULL && request->sets == NULL) {
        params->diameter_m = 9.7e-9;
        params->fidelity = GB_FIDELITY_FAST;
    }
    bool done = check_request(request, err);
    if (done && request->terms) {
        done = report_terms(params, request->coordination, request->csv || request->json,
                            request->text, err);
    } else if (done && request->sizes != NULL) {
        done = report_sizes(params, request->sizes, request->coordination,
                            request->csv || request->json, request->text, err);
    } else if (done && request->roofline) {
        done = report_roofline(request, params, err);
    } else if (done) {
        done = report_all(request, params, err);
    }
    gb_preset_destroy(preset);
    return done;
}

int gb_cmd_bench(int argc, char **argv)
{
    struct request request = {.coordination = 6.0};
    const GOptionEntry entries[] = {
        {"csv", 0, 0, G_OPTION_ARG_NONE, &request.csv, "print CSV", NULL},
        gb_options_json(&request.json),
        {"coordination", 0, 0, G_OPTION_ARG_DOUBLE, &request.coordination,
         "press until this coordination number", "6"},
        {"terms", 0, 0, G_OPTION_ARG_NONE, &request.terms,
         "instead: the cost of each term of the contact laws", NULL},
        {"sizes", 0, 0, G_OPTION_ARG_STRING, &request.sizes,
         "instead: the cost against the number of particles", "1000,8000,64000"},
        {"roofline", 0, 0, G_OPTION_ARG_NONE, &request.roofline,
         "instead: counted work beside peak and bandwidth of one core", NULL},
        {"compare", 0, 0, G_OPTION_ARG_FILENAME, &request.compare,
         "what changed since a run stored with --csv", "FILE.csv"},
        gb_options_set(&request.sets),
        {0},
    };
    int status = 0;
    if (gb_options_parse(&page, entries, argc, argv, &request.words, &status)) {
        struct gb_error err = {0};
        request.text = g_string_new(NULL);
        status = measure(&request, &err) ? 0 : gb_options_fail(&err);
        if (request.json && status == 0) {
            gb_json_output_table(request.text->str);
        } else {
            gb_visible_put(stdout, request.text->str);
        }
        g_string_free(request.text, TRUE);
    }
    g_strfreev(request.words);
    g_strfreev(request.sets);
    g_free(request.sizes);
    g_free(request.compare);
    return status;
}
