#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output/json_output.h"
#include "study/bench/bench.h"
#include "study/bench/bench_die.h"

static const struct gb_options_page page = {
    .usage = "[PRESET] [group.key=value]...",
    .summary =
        "Measures the speed of the engine on this machine: the initial structure; one\n"
        "force evaluation with its move (forces, torques, history, relaxer) on one\n"
        "core and on all of them, at a coordination number of a pressed packing; a\n"
        "checkpoint of it, written in TMPDIR; the planar dynamic scene of P2 at\n"
        "density 0.9; and the bed of P3 at 50 MPa in its die.",
    .description =
        "Without a preset: 8000 particles of 9.7 nm with bridges (P1, set II).\n"
        "Times are medians of 15 batches of 24 evaluations; several sizes are timed\n"
        "alternately, in 5 rounds of 9 batches or more.",
};

struct line {
    const char *name;
    double value;
    const char *unit;
};

static void print_lines(GString *text, const struct line *line, size_t count,
                        gboolean csv)
{
    if (csv) {
        g_string_append(text, "figure,value,unit\n");
    }
    for (size_t i = 0; i < count; i++) {
        g_string_append_printf(text, csv ? "%s,%.6g,%s\n" : "%-34s %12.4g  %s\n",
                               line[i].name, line[i].value, line[i].unit);
    }
}

static void report(const struct gb_bench *bench, double planar,
                   const struct gb_bench_die *die, double particles, gboolean csv,
                   GString *text)
{
    const double micro = 1e6 / particles;
    const struct line line[] = {
        {"particles", particles, ""},
        {"initial structure", bench->grow_s, "s"},
        {"timed at coordination", bench->coordination, ""},
        {"timed at density", bench->density, ""},
        {"evaluation and move, one core", micro * bench->evaluation_s, "us per particle"},
        {"evaluation and move, all cores", micro * bench->evaluation_all_s,
         "us per particle"},
        {"cores", bench->cores, ""},
        {"same bits on one and all cores", bench->same_bits, "(1: yes)"},
        {"memory", bench->bytes_per_particle, "bytes per particle"},
        {"checkpoint", bench->state.bytes_per_particle, "bytes per particle"},
        {"checkpoint, engine blocked", 1e3 * bench->state.held, "ms"},
        {"checkpoint, processor time of writer", 1e3 * bench->state.processor, "ms"},
        {"checkpoint, time to write", 1e3 * bench->state.written, "ms"},
        {"  of this the disk", 1e3 * bench->state.disk, "ms"},
        {"planar dynamic scene, one core", 1e-6 * planar, "million particle-steps per s"},
        {"die at coordination", die->coordination, ""},
        {"die, Hertz, one core", 1e6 * die->hertz, "us per particle-step"},
        {"die, Hertz with friction", 1e6 * die->hertz_friction, "us per particle-step"},
        {"die, Storakers", 1e6 * die->storakers, "us per particle-step"},
        {"die, Storakers with friction", 1e6 * die->storakers_friction,
         "us per particle-step"},
    };
    print_lines(text, line, G_N_ELEMENTS(line), csv);
}

/* Time of an evaluation with and without terms of the contact laws. */
static bool report_terms(const struct gb_params *params, double coordination,
                         gboolean csv, GString *text, struct gb_error *err)
{
    struct gb_bench_term term[GB_BENCH_TERMS];
    if (!gb_bench_terms(term, params, coordination, err)) {
        return false;
    }
    const double micro = 1e6 / (double)params->count;
    g_string_append(text, csv ? "terms,us_per_particle,share\n"
                              : "evaluation and move, one core\n");
    for (int i = 0; i < GB_BENCH_TERMS; i++) {
        if (isfinite(term[i].evaluation_s)) {
            g_string_append_printf(text,
                                   csv ? "%s,%.6g,%.4g\n"
                                       : "  %-30s %8.4g us per particle, %5.3g of all\n",
                                   term[i].name, micro * term[i].evaluation_s,
                                   term[i].evaluation_s / term[0].evaluation_s);
        }
    }
    return true;
}

enum { SIZES_MAX = 16 };

/* "1000, 8000": 2 to 16 numbers of particles. */
static bool read_sizes(const char *text, struct gb_bench_size *size, size_t *sizes,
                       struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", SIZES_MAX + 1);
    bool good = g_strv_length(parts) >= 2 && g_strv_length(parts) <= SIZES_MAX;
    *sizes = 0;
    for (char **part = parts; *part && good; part++) {
        good = g_ascii_string_to_signed(g_strstrip(*part), 10, 10, 10000000,
                                        &size[*sizes].count, NULL) &&
               (*sizes == 0 || size[*sizes].count > size[*sizes - 1].count);
        ++*sizes;
    }
    g_strfreev(parts);
    return good || gb_error_set(err, GB_ERR_INPUT,
                                "--sizes %s: accepted 2 to %d growing numbers of "
                                "particles from 10 to 10000000, with commas between",
                                text, SIZES_MAX);
}

/* Progress on stderr. */
static void print_progress(void *data, int64_t count, int round)
{
    const int64_t *last = data;
    if (round == 0) {
        gb_visible_line(stderr, "%lld particles: packing ready", (long long)count);
    } else if (count == *last) {
        gb_visible_line(stderr, "round %d of %d", round, GB_BENCH_ROUNDS);
    }
}

static void print_sizes(GString *text, const struct gb_bench_size *size, size_t sizes,
                        gboolean csv)
{
    double particles[SIZES_MAX], one[SIZES_MAX], all[SIZES_MAX];
    g_string_append(
        text, csv ? "particles,coordination,one_core_us,all_cores_us,bytes\n"
                  : " particles   coordination   one core   all cores, us   bytes per "
                    "particle\n");
    for (size_t i = 0; i < sizes; i++) {
        particles[i] = (double)size[i].count;
        one[i] = size[i].evaluation_s;
        all[i] = size[i].evaluation_all_s;
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
    struct gb_bench_size size[SIZES_MAX];
    size_t sizes = 0;
    if (!read_sizes(list, size, &sizes, err) ||
        !gb_bench_growth_run(size, sizes, params, coordination, print_progress,
                             &size[sizes - 1].count, err)) {
        return false;
    }
    print_sizes(text, size, sizes, csv);
    return true;
}

/* The options of the command line. */
struct request {
    char **sets, **words;
    char *sizes;
    gboolean csv, json, terms;
    GString *text;
    double coordination;
};

static bool check_request(const struct request *request, struct gb_error *err)
{
    if (!(request->coordination > 0.0 && request->coordination < 12.0)) {
        return gb_error_set(err, GB_ERR_INPUT, "--coordination %g: accepted 0 to 12",
                            request->coordination);
    }
    return !(request->terms && request->sizes) ||
           gb_error_set(err, GB_ERR_INPUT, "--terms, --sizes: accepted one of them");
}

static bool report_all(const struct request *request, const struct gb_params *params,
                       struct gb_error *err)
{
    struct gb_bench bench;
    struct gb_bench_die die;
    double planar = 0.0;
    if (!gb_bench_run(&bench, params, request->coordination, err) ||
        !gb_bench_planar(&planar, err) || !gb_bench_die_run(&die, err)) {
        return false;
    }
    report(&bench, planar, &die, (double)params->count, request->csv || request->json,
           request->text);
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
    return status;
}
