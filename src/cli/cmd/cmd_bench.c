#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/table.h"
#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output/json_output.h"
#include "pack/kernel/simd.h"
#include "study/bench/bench.h"
#include "study/bench/bench_compare.h"
#include "study/bench/bench_die.h"

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

/* The figures of the main table. */
struct figures {
    struct gb_bench_cell cell[GB_BENCH_CELLS];
    struct gb_bench_state state;
    struct gb_bench_figure planar, planar_all;
    struct gb_bench_die die;
};

enum { ROWS_MAX = 40 };

struct rows {
    struct gb_bench_row row[ROWS_MAX];
    size_t count;
};

static void add_row(struct rows *rows, const char *name, double value, double spread,
                    const char *unit, enum gb_bench_goal goal)
{
    if (isfinite(value)) {
        rows->row[rows->count++] = (struct gb_bench_row){name, value, spread, unit, goal};
    }
}

static void add_fact(struct rows *rows, const char *name, double value, const char *unit)
{
    add_row(rows, name, value, 0.0, unit, GB_BENCH_FACT);
}

/* A time, s, in units that are `scale` s long. */
static void add_time(struct rows *rows, const char *name, struct gb_bench_figure figure,
                     double scale, const char *unit)
{
    const struct gb_bench_figure scaled = gb_bench_figure_scaled(figure, 1.0 / scale);
    add_row(rows, name, scaled.value, scaled.spread, unit, GB_BENCH_LESS);
}

static void add_cell(struct rows *rows, const struct gb_bench_cell *cell, const char *one,
                     const char *all)
{
    const double scale = 1e-6 * (double)cell->params.count;
    add_time(rows, one, cell->one, scale, "us per particle");
    add_time(rows, all, cell->all, scale, "us per particle");
}

static void add_state(struct rows *rows, const struct gb_bench_state *state)
{
    const struct {
        const char *name;
        double seconds;
    } time[] = {{"checkpoint: engine blocked", state->held},
                {"checkpoint: processor time of writer", state->processor},
                {"checkpoint: time to write", state->written},
                {"checkpoint: of this the disk", state->disk}};
    add_fact(rows, "checkpoint", state->bytes_per_particle, "bytes per particle");
    for (size_t i = 0; i < G_N_ELEMENTS(time);
         i++) { /* a disk has no spread to rely on */
        add_fact(rows, time[i].name, 1e3 * time[i].seconds, "ms");
    }
}

static void add_scenes(struct rows *rows, const struct figures *figures)
{
    const struct gb_bench_die *die = &figures->die;
    const struct gb_bench_figure planar = gb_bench_figure_scaled(figures->planar, 1e-6);
    const struct gb_bench_figure all = gb_bench_figure_scaled(figures->planar_all, 1e-6);
    const char *rate = "million particle-steps per s", *step = "us per particle-step";
    add_row(rows, "planar dynamic scene on one core", planar.value, planar.spread, rate,
            GB_BENCH_MORE);
    add_row(rows, "planar dynamic scene on all cores", all.value, all.spread, rate,
            GB_BENCH_MORE);
    add_fact(rows, "die at coordination", die->coordination, "");
    add_time(rows, "die: Hertz on one core", die->hertz, 1e-6, step);
    add_time(rows, "die: Hertz with friction", die->hertz_friction, 1e-6, step);
    add_time(rows, "die: Storakers", die->storakers, 1e-6, step);
    add_time(rows, "die: Storakers with friction", die->storakers_friction, 1e-6, step);
}

static void make_rows(const struct figures *figures, struct rows *rows)
{
    const struct gb_bench_cell *scene = &figures->cell[GB_BENCH_SCENE];
    bool same_bits = true;
    rows->count = 0;
    for (int i = 0; i < GB_BENCH_CELLS; i++) {
        same_bits = same_bits && figures->cell[i].same_bits;
    }
    add_fact(rows, "particles", (double)scene->params.count, "");
    add_fact(rows, "cores", (double)g_get_num_processors(), "");
    add_fact(rows, "initial structure", scene->grow_s, "s");
    add_fact(rows, "timed at coordination", scene->coordination, "");
    add_fact(rows, "timed at density", scene->density, "");
    add_fact(rows, "same bits on one and all cores", same_bits, "(1: yes)");
    add_fact(rows, "memory", scene->bytes_per_particle, "bytes per particle");
    add_cell(rows, scene, "evaluation and move on one core",
             "evaluation and move on all cores");
    add_time(rows, "  all cores while another process has one", scene->all_busy,
             1e-6 * (double)scene->params.count, "us per particle");
    add_cell(rows, &figures->cell[GB_BENCH_SMALL], "1000 particles on one core",
             "1000 particles on all cores");
    add_cell(rows, &figures->cell[GB_BENCH_DOUBLE], "double precision on one core",
             "double precision on all cores");
    add_cell(rows, &figures->cell[GB_BENCH_SIZES], "many sizes on one core",
             "many sizes on all cores");
    add_state(rows, &figures->state);
    add_scenes(rows, figures);
}

/* CSV begins with a comment that names program and machine. */
static void print_csv(GString *text, const struct rows *rows)
{
    g_string_append_printf(text, "# greenbody %s, %s\nfigure,value,unit,spread\n",
                           GB_VERSION, gb_simd_name(gb_simd_width(0)));
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        g_string_append_printf(text, "%s,%.6g,%s,%.3g\n", row->name, row->value,
                               row->unit, row->spread);
    }
}

static void print_rows(GString *text, const struct rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        char spread[32] = "";
        if (row->spread > 0.0) {
            g_snprintf(spread, sizeof spread, "+- %.1g", row->spread);
        }
        g_string_append_printf(text, "%-42s %10.4g %-10s %s\n", row->name, row->value,
                               spread, row->unit);
    }
}

static void print_changes(GString *text, const struct rows *rows,
                          const struct gb_bench_change *change)
{
    static const char *const verdict[] = {"", "within the noise", "better", "worse"};
    g_string_append_printf(text, "%-42s %10s %10s %7s\n", "", "before", "now", "ratio");
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        if (isfinite(change[i].before)) {
            g_string_append_printf(text, "%-42s %10.4g %10.4g %7.3f  %s\n", row->name,
                                   change[i].before, row->value, change[i].ratio,
                                   verdict[change[i].verdict]);
        } else {
            g_string_append_printf(text, "%-42s %10s %10.4g\n", row->name, "-",
                                   row->value);
        }
    }
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
                                "--sizes %s: accepted 2 to %d growing numbers of "
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
    const int tables = !!request->terms + !!request->sizes + !!request->compare;
    if (tables > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--terms, --sizes, --compare: accepted one of them");
    }
    return !(request->compare && (request->csv || request->json)) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--compare: accepted without --csv and --json");
}

static bool measure_all(struct figures *figures, const struct gb_params *params,
                        double coordination, struct gb_error *err)
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
    struct figures figures;
    struct rows rows;
    struct gb_bench_change change[ROWS_MAX];
    struct gb_table *stored = NULL;
    /* before minutes of measuring */
    if (request->compare && !gb_table_read(&stored, request->compare, "figure", err)) {
        return false;
    }
    gb_table_destroy(stored);
    if (!measure_all(&figures, params, request->coordination, err)) {
        return false;
    }
    make_rows(&figures, &rows);
    if (request->compare &&
        !gb_bench_compare(request->compare, rows.row, rows.count, change, err)) {
        return false;
    }
    if (request->compare) {
        print_changes(request->text, &rows, change);
    } else if (request->csv || request->json) {
        print_csv(request->text, &rows);
    } else {
        print_rows(request->text, &rows);
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
