#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "study/bench.h"
#include "study/bench_die.h"

static const struct gb_options_page page = {
    .usage = "[PRESET] [group.key=value]...",
    .summary =
        "Times the engine on this machine: the initial structure, and one force\n"
        "evaluation with its move (forces, torques, history, relaxer) on one core and\n"
        "on all of them, at a coordination number of a pressed packing; a checkpoint\n"
        "of it, written in TMPDIR; the planar dynamic scene of P2 at density 0.9; and\n"
        "the bed of P3 at 50 MPa in its die.",
    .description =
        "Without a preset: 8000 particles of 9.7 nm with bridges (P1, set II).\n"
        "The times are medians of 15 batches of 24 evaluations; several sizes are timed\n"
        "in turn, in 5 rounds of 9 batches or more.",
};

struct line {
    const char *name;
    double value;
    const char *unit;
};

static void print_lines(const struct line *line, size_t count, gboolean csv)
{
    if (csv) {
        puts("figure,value,unit");
    }
    for (size_t i = 0; i < count; i++) {
        printf(csv ? "%s,%.6g,%s\n" : "%-34s %12.4g  %s\n", line[i].name, line[i].value,
               line[i].unit);
    }
}

static void report(const struct gb_bench *bench, double planar,
                   const struct gb_bench_die *die, double particles, gboolean csv)
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
        {"checkpoint, engine held", 1e3 * bench->state.held, "ms"},
        {"checkpoint, processor beside it", 1e3 * bench->state.processor, "ms"},
        {"checkpoint, written after", 1e3 * bench->state.written, "ms"},
        {"  of this on the disk", 1e3 * bench->state.disk, "ms"},
        {"planar dynamic scene, one core", 1e-6 * planar, "million particle-steps per s"},
        {"die at coordination", die->coordination, ""},
        {"die, Hertz, one core", 1e6 * die->hertz, "us per particle-step"},
        {"die, Hertz with friction", 1e6 * die->hertz_friction, "us per particle-step"},
        {"die, Storakers", 1e6 * die->storakers, "us per particle-step"},
        {"die, Storakers with friction", 1e6 * die->storakers_friction,
         "us per particle-step"},
    };
    print_lines(line, G_N_ELEMENTS(line), csv);
}

/* Time of each variant, and what the terms that it lacks cost. */
static bool report_terms(const struct gb_params *params, double coordination,
                         gboolean csv, struct gb_error *err)
{
    struct gb_bench_term term[GB_BENCH_TERMS];
    if (!gb_bench_terms(term, params, coordination, err)) {
        return false;
    }
    const double micro = 1e6 / (double)params->count;
    puts(csv ? "terms,us_per_particle,share" : "evaluation and move, one core");
    for (int i = 0; i < GB_BENCH_TERMS; i++) {
        if (isfinite(term[i].evaluation_s)) {
            printf(csv ? "%s,%.6g,%.4g\n"
                       : "  %-30s %8.4g us per particle, %5.3g of all\n",
                   term[i].name, micro * term[i].evaluation_s,
                   term[i].evaluation_s / term[0].evaluation_s);
        }
    }
    return true;
}

enum { SIZES_MOST = 16 };

/* "1000, 8000": 2 to 16 numbers of particles. */
static bool read_sizes(const char *text, struct gb_bench_size *size, size_t *sizes,
                       struct gb_error *err)
{
    char **parts = g_strsplit(text, ",", SIZES_MOST + 1);
    bool good = g_strv_length(parts) >= 2 && g_strv_length(parts) <= SIZES_MOST;
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
                                text, SIZES_MOST);
}

/* What is done, on stderr. */
static void tell(void *data, int64_t count, int round)
{
    const int64_t *last = data;
    if (round == 0) {
        fprintf(stderr, "%lld particles: pressed\n", (long long)count);
    } else if (count == *last) {
        fprintf(stderr, "round %d of %d\n", round, GB_BENCH_ROUNDS);
    }
}

static void print_sizes(const struct gb_bench_size *size, size_t sizes, gboolean csv)
{
    double particles[SIZES_MOST], one[SIZES_MOST], all[SIZES_MOST];
    puts(csv ? "particles,coordination,one_core_us,all_cores_us,bytes"
             : " particles   coordination   one core   all cores, us   bytes a particle");
    for (size_t i = 0; i < sizes; i++) {
        particles[i] = (double)size[i].count;
        one[i] = size[i].evaluation_s;
        all[i] = size[i].evaluation_all_s;
        const double micro = 1e6 / particles[i];
        printf(csv ? "%.0f,%.4g,%.5g,%.5g,%.5g\n"
                   : "%10.0f   %12.4g   %8.4g   %13.4g   %16.4g\n",
               particles[i], size[i].coordination, micro * one[i], micro * all[i],
               size[i].bytes_per_particle);
    }
    printf(csv ? "exponent,,%.4f,%.4f,\n"
               : "cost grows with the power   %11.3f   %13.3f\n",
           gb_bench_exponent(particles, one, sizes),
           gb_bench_exponent(particles, all, sizes));
}

/* How the cost of an evaluation grows with the size of the cell. */
static bool report_sizes(const struct gb_params *params, const char *text,
                         double coordination, gboolean csv, struct gb_error *err)
{
    struct gb_bench_size size[SIZES_MOST];
    size_t sizes = 0;
    if (!read_sizes(text, size, &sizes, err) ||
        !gb_bench_growth_run(size, sizes, params, coordination, tell,
                             &size[sizes - 1].count, err)) {
        return false;
    }
    print_sizes(size, sizes, csv);
    return true;
}

int gb_cmd_bench(int argc, char **argv)
{
    gboolean csv = FALSE, terms = FALSE;
    double coordination = 6.0;
    char **sets = NULL, **words = NULL, *sizes = NULL;
    const GOptionEntry entries[] = {
        {"csv", 0, 0, G_OPTION_ARG_NONE, &csv, "print CSV", NULL},
        {"coordination", 0, 0, G_OPTION_ARG_DOUBLE, &coordination,
         "press until this coordination number", "6"},
        {"terms", 0, 0, G_OPTION_ARG_NONE, &terms,
         "what each term of the contact laws costs instead", NULL},
        {"sizes", 0, 0, G_OPTION_ARG_STRING, &sizes,
         "cells of so many particles instead, and how the cost grows", "1000,8000,64000"},
        GB_OPTIONS_SET(&sets),
        {0},
    };
    int status = 0;
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        return status;
    }
    struct gb_error err = {0};
    struct gb_preset *preset = NULL;
    struct gb_bench bench;
    struct gb_bench_die die;
    const bool named = words && words[0] && !strchr(words[0], '=');
    bool done = gb_options_scene(&preset, words, sets, false, &err);
    if (done && !(coordination > 0.0 && coordination < 12.0)) {
        done = gb_error_set(&err, GB_ERR_INPUT, "--coordination %g: accepted 0 to 12",
                            coordination);
    }
    if (done && terms && sizes) {
        done = gb_error_set(&err, GB_ERR_INPUT, "--terms, --sizes: accepted one of them");
    }
    if (done) {
        struct gb_params *params = gb_preset_params(preset);
        if (!named && !sets && !(words && words[0])) {
            params->diameter_m = 9.7e-9;
            params->fidelity = GB_FIDELITY_FAST;
        }
        double planar = 0.0;
        if (terms) {
            done = report_terms(params, coordination, csv, &err);
        } else if (sizes) {
            done = report_sizes(params, sizes, coordination, csv, &err);
        } else if ((done = gb_bench_run(&bench, params, coordination, &err) &&
                           gb_bench_planar(&planar, &err) &&
                           gb_bench_die_run(&die, &err))) {
            report(&bench, planar, &die, (double)params->count, csv);
        }
    }
    gb_preset_destroy(preset);
    g_strfreev(words);
    g_strfreev(sets);
    g_free(sizes);
    return done ? 0 : gb_options_fail(&err);
}
