#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/units.h"
#include "cli/batch_progress.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "many/axes.h"
#include "many/ensemble.h"
#include "many/reading.h"
#include "many/sweep_table.h"
#include "measure/fit/average.h"
#include "run/cost.h"

/* Fewer replicas than this say too little about their own scatter to stop at. */
enum { REPLICAS_LEAST = 4, REPLICAS_MOST = 100000 };

/* What the command line said. */
struct request {
    char **sets, **vary;
    char *out, *at, *target;
    gint replicas, jobs;
    gboolean quiet, yes;
};

struct sweep {
    struct gb_preset *preset;
    struct gb_axes axes;
    struct gb_ensemble ensemble;
    struct gb_batch_progress crowd;
    struct gb_sweep_table_pressures at;
    /* --until-se */
    double target, target_pa;
    double *density; /* of every run at target_pa */
    bool *known;
    char foretold[160]; /* "": nobody knows, or nothing is to be done */
};

static bool refuse_target(const char *text, struct gb_error *err)
{
    return gb_error_set(
        err, GB_ERR_INPUT,
        "--until-se %.80s: accepted a standard error of the density and a "
        "pressure, as in 0.002@100MPa",
        text);
}

static bool parse_target(struct sweep *sweep, const char *text, struct gb_error *err)
{
    char **parts = g_strsplit(text, "@", 3);
    const bool good =
        g_strv_length(parts) == 2 &&
        gb_units_parse(parts[0], GB_DIM_NONE, &sweep->target, NULL) &&
        gb_units_parse(parts[1], GB_DIM_PRESSURE, &sweep->target_pa, NULL) &&
        sweep->target > 0.0 && sweep->target_pa > 0.0;
    g_strfreev(parts);
    return good || refuse_target(text, err);
}

/* The density of a run that has ended, read once. */
static double density_of(const struct sweep *sweep, const struct gb_ensemble_run *run)
{
    const size_t i = (size_t)(run - sweep->ensemble.run);
    double values[GB_READING_QUANTITIES] = {NAN};
    struct gb_table *curve = NULL;
    if (sweep->known[i]) {
        return sweep->density[i];
    }
    if (run->error.code == GB_OK && gb_reading_open(&curve, run->directory, NULL)) {
        gb_reading_loaded(curve, sweep->target_pa, values);
    }
    gb_table_destroy(curve);
    sweep->known[i] = true;
    sweep->density[i] = values[GB_READING_DENSITY];
    return sweep->density[i];
}

/* Some first replicas, all ended, know the density well enough. */
static bool is_enough(const struct gb_ensemble *ensemble, size_t point, void *data)
{
    const struct sweep *sweep = data;
    double *values = g_new(double, ensemble->replicas);
    bool enough = false;
    for (size_t r = 0; r < ensemble->replicas && !enough; r++) {
        const struct gb_ensemble_run *run = gb_ensemble_at(ensemble, point, r);
        double mean = NAN;
        double error = NAN;
        if (!run->ended) {
            break;
        }
        values[r] = density_of(sweep, run);
        const size_t runs = gb_average_values(values, r + 1, &mean, &error);
        enough = runs >= REPLICAS_LEAST && error <= sweep->target;
    }
    g_free(values);
    return enough;
}

static bool watch_target(struct sweep *sweep, struct gb_error *err)
{
    const size_t runs = sweep->ensemble.points * sweep->ensemble.replicas;
    sweep->density = gb_alloc_array(runs, sizeof *sweep->density, err);
    sweep->known =
        sweep->density ? gb_alloc_array(runs, sizeof *sweep->known, err) : NULL;
    sweep->ensemble.enough = is_enough;
    sweep->ensemble.data = sweep;
    return sweep->known != NULL;
}

/* Parameters and directory of every run. */
static bool fill(struct sweep *sweep, const char *out, struct gb_error *err)
{
    for (size_t i = 0; i < sweep->ensemble.points * sweep->ensemble.replicas; i++) {
        struct gb_ensemble_run *run = &sweep->ensemble.run[i];
        run->params = *gb_preset_params(sweep->preset);
        if (!gb_axes_apply(&sweep->axes, run->point, &run->params, err)) {
            return false;
        }
        run->params.seed += run->replica;
        /* the runs keep the cores busy, not the threads of each */
        run->params.threads = run->params.threads > 0 ? run->params.threads : 1;
        char *name = gb_axes_name(&sweep->axes, run->point);
        run->directory =
            g_strdup_printf("%s/%s_seed-%" G_GUINT64_FORMAT, out, name, run->params.seed);
        g_free(name);
    }
    return true;
}

/* Seconds of one core for what is still to be done; NaN: nobody knows. */
static double missing_s(const struct sweep *sweep, size_t *runs)
{
    double seconds = 0.0;
    *runs = 0;
    for (size_t i = 0; i < sweep->ensemble.points * sweep->ensemble.replicas; i++) {
        const struct gb_ensemble_run *run = &sweep->ensemble.run[i];
        if (!run->ended) {
            seconds += gb_cost_assumed_s(&run->params);
            (*runs)++;
        }
    }
    return seconds;
}

/* A digit too much in --replicas costs nothing to type.  Under mpirun nobody is asked:
 * how many ranks there are, and that they are paid for, was somebody's decision. */
static bool foretell(struct sweep *sweep, const struct request *request,
                     struct gb_error *err)
{
    size_t runs = 0;
    char total[48], each[48];
    const double all_s = missing_s(sweep, &runs);
    const size_t workers =
        request->jobs > 0 ? (size_t)request->jobs : (size_t)g_get_num_processors();
    const double wait_s = all_s / (double)MAX(MIN(workers, runs), 1);
    if (runs == 0 || isnan(all_s) || sweep->crowd.ranks != NULL) {
        return true;
    }
    gb_cost_duration(wait_s, total, sizeof total);
    gb_cost_duration(all_s / (double)runs, each, sizeof each);
    if (!request->yes && !gb_cost_unasked_s(wait_s)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the sweep will take about %s: %zu runs of about %s, %zu at "
                            "once; accepted with --yes",
                            total, runs, each, workers);
    }
    snprintf(sweep->foretold, sizeof sweep->foretold,
             "foretold: about %s, %zu runs of about %s", total, runs, each);
    return true;
}

/* All that can be known to be wrong before anything is done. */
static bool prepare(struct sweep *sweep, const struct request *request, char **words,
                    struct gb_error *err)
{
    if (request->out == NULL || request->out[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "sweep needs --out DIR");
    }
    if (request->replicas < 1 || request->replicas > REPLICAS_MOST) {
        return gb_error_set(err, GB_ERR_INPUT, "--replicas %d: accepted 1 to %d",
                            request->replicas, REPLICAS_MOST);
    }
    if (!gb_options_scene(&sweep->preset, words, request->sets, true, err)) {
        return false;
    }
    for (size_t i = 0; request->vary && request->vary[i]; i++) {
        if (!gb_axes_add(&sweep->axes, request->vary[i], err)) {
            return false;
        }
    }
    gb_sweep_table_default(&sweep->at, gb_preset_params(sweep->preset));
    return (!request->at || gb_sweep_table_parse(&sweep->at, request->at, err)) &&
           (!request->target || parse_target(sweep, request->target, err)) &&
           gb_ensemble_init(&sweep->ensemble, gb_axes_points(&sweep->axes),
                            (size_t)request->replicas, err) &&
           fill(sweep, request->out, err) &&
           (!request->target || watch_target(sweep, err)) &&
           gb_ensemble_find_done(&sweep->ensemble, err) &&
           foretell(sweep, request, err) &&
           gb_batch_progress_directory(request->out, err);
}

static bool write_table(const char *out, const char *name, GString *text,
                        struct gb_error *err)
{
    char *path = g_build_filename(out, name, NULL);
    const bool good = gb_file_replace(path, text->str, text->len, err);
    g_free(path);
    g_string_free(text, TRUE);
    return good;
}

/* Whatever became of the runs, the tables say what is there. */
static bool write_tables(struct sweep *sweep, const char *out, struct gb_error *err)
{
    return write_table(out, "sweep.csv",
                       gb_sweep_table_means(&sweep->ensemble, &sweep->axes, &sweep->at),
                       err) &&
           write_table(out, "runs.csv", gb_sweep_table_runs(&sweep->ensemble), err);
}

/* Points whose replicas ran out before the target was met. */
static void tell_missed(const struct sweep *sweep, bool quiet)
{
    size_t missed = 0;
    for (size_t p = 0; p < sweep->ensemble.points && sweep->known; p++) {
        missed += !is_enough(&sweep->ensemble, p, (void *)sweep);
    }
    if (missed > 0 && !quiet) {
        fprintf(stderr,
                "%zu of %zu points: the standard error is still above %g; more "
                "--replicas would bring it down\n",
                missed, sweep->ensemble.points, sweep->target);
    }
}

static bool perform(struct sweep *sweep, const struct request *request, char **words,
                    struct gb_error *err)
{
    struct gb_batch_progress *crowd = &sweep->crowd;
    crowd->quiet = request->quiet;
    if (!prepare(sweep, request, words, err)) {
        return false;
    }
    if (!request->quiet && sweep->foretold[0] != '\0') {
        fprintf(stderr, "%s\n", sweep->foretold);
    }
    struct gb_error stopped = {0};
    const bool worked =
        gb_batch_progress_work(crowd, &sweep->ensemble, request->jobs, &stopped);
    if (!write_tables(sweep, request->out, err)) {
        return false;
    }
    if (!worked) {
        return gb_error_set(err, stopped.code, "%s", stopped.text);
    }
    tell_missed(sweep, request->quiet);
    return gb_batch_progress_verdict(&sweep->ensemble, request->out, err);
}

static void finish(struct sweep *sweep, struct request *request)
{
    gb_alloc_free(sweep->density);
    gb_alloc_free(sweep->known);
    gb_ensemble_finish(&sweep->ensemble);
    gb_axes_finish(&sweep->axes);
    gb_preset_destroy(sweep->preset);
    g_strfreev(request->sets);
    g_strfreev(request->vary);
    g_free(request->out);
    g_free(request->at);
    g_free(request->target);
}

static const struct gb_options_page page = {
    "PRESET [group.key=value]...",
    "Many runs at once: a grid of varied keys, each point with replicas that differ by "
    "their"
    "\nseed.  Every run gets a directory in DIR; DIR/sweep.csv holds means with standard "
    "errors,\nDIR/runs.csv what became of every run.",
    "The same command again does only what is missing, failed runs included, and a "
    "larger "
    "grid or\nmore replicas add to what is there.  A run that fails costs only itself.  "
    "Each run uses one\nthread unless numerics.threads is given.\n\n"
    "Size effect (P1 Figs. 5 and 6), with bridges and by friction alone:\n"
    "  greenbody sweep p1-set2-9.7nm --vary 'particles.diameter=9.7;16;21;38 nm' "
    "--replicas 10 \\\n    --at '100 MPa' --out sizes\n"
    "  greenbody sweep p1-nobridge-9.7nm --vary 'particles.diameter=9.7;16;21;38 nm' "
    "\\\n    --replicas 10 --set 'loading.until=105 MPa' --set 'loading.unload_from=100 "
    "MPa' --out nobridge\n"
    "  greenbody plot sizes --figure densification -o fig5.png\n"
    "  greenbody plot sizes nobridge --figure size-effect -o fig6.png\n"
    "Geometry of loading (P1 Figs. 11-14: figures unloading, continuum, lateral, "
    "force-angle):\n"
    "  greenbody sweep p1-set1-uniaxial --vary "
    "'loading.geometry=uniaxial;biaxial;isotropic'"
    " \\\n    --replicas 10 --out geometry\n"
    "  greenbody plot geometry --figure force-angle -o fig14.png"};

int gb_cmd_sweep(int argc, char **argv)
{
    struct request request = {.replicas = 1};
    struct sweep sweep = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        GB_OPTIONS_SET(&request.sets),
        {"vary", 0, 0, G_OPTION_ARG_STRING_ARRAY, &request.vary,
         "key=FROM:TO:COUNT[:log] or key=VALUE;VALUE...; may be repeated", "KEY=VALUES"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "runs per point, seeds counted up from that of the preset (1)", "N"},
        {"until-se", 0, 0, G_OPTION_ARG_STRING, &request.target,
         "end the replicas of a point, at 4 or more, when the standard error of its "
         "density "
         "at a pressure is this small",
         "SE@PRESSURE"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "pressures of the table, as in '50;100;200 MPa'", "PRESSURES"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out, "directory of the sweep",
         "DIR"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "runs at once (one per processor)", "N"},
        {"yes", 'y', 0, G_OPTION_ARG_NONE, &request.yes,
         "begin also when it is foretold to take more than an hour", NULL},
        {"quiet", 'q', 0, G_OPTION_ARG_NONE, &request.quiet, "tell only what went wrong",
         NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status) &&
        !gb_batch_progress_serve(&sweep.crowd, request.jobs, &status)) {
        status =
            perform(&sweep, &request, words, &err) ? 0 : gb_batch_progress_exit(&err);
        gb_mpi_pool_destroy(sweep.crowd.ranks);
    }
    g_strfreev(words);
    finish(&sweep, &request);
    return status;
}
